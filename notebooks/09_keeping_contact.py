# ---
# jupyter:
#   jupytext:
#     text_representation:
#       extension: .py
#       format_name: percent
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
#   title: "Keeping contact: springs and stress"
# ---

# %% [markdown]
# # 9. Keeping contact: springs and stress
#
# **Aim.** At the end you can find the preload that keeps a follower on its cam, draw the force plan at a station with and without friction, say when a follower
# jams, and estimate the pressure between roller and profile.
#
# **You need** the acceleration (notebook 1), the pressure angle (notebook 3). On paper: A4. **Time:** 60 minutes, 25 of them with the pencil.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
from math import cos, degrees, radians, sin

import numpy as np
from IPython.display import Markdown

import graphcam as gc
from graphcam.drafting.ink import reading
from graphcam.mechanism.forces import jamming_angle
from graphcam.notebooks import (
    ArrayQuestion,
    Question,
    Slider,
    changed,
    chart,
    explore,
    lesson_task,
    picture_of,
    show_steps,
    table,
)
from graphcam.tasks.task import SpringTable

# %% [markdown]
# ## Background
#
# The cam can push, it cannot pull. While the follower is braked on the rise, or accelerated downwards on the return, something else must move it: the **spring**. Let the
# follower, of mass $m$, be pressed down by a spring of stiffness $c$ and preload $F_0$. The cam pushes it with the force
#
# $$ \xi = m\,\omega^2 a + c\,s + F_0 . $$
#
# Contact is kept as long as $\xi \ge 0$. The inertia $m\omega^2a$ is negative where $a$ is; the higher the follower is, the more the spring force $c\,s$ helps. So the minimum
# preload is
#
# $$ F_{0} \ge \max_\varphi\,\bigl(-m\,\omega^2 a - c\,s\bigr). $$
#
# It is *not* enough to look at the largest negative acceleration: the sum with the spring force counts. On the $s$ and $a$ diagrams: lay off $c\,s$ and $-m\omega^2a$ in the same scale of force;
# the maximum height by which the second exceeds the first is the preload.
#
# Note the units: $a$ in mm/rad² times $\omega^2$ in 1/s² is mm/s². In newtons: $m\,[\text{kg}]\;\omega^2\,a\,[\text{mm/rad}^2]/1000$.
#
# ## The construction
#
# The task of the course, from the file `task.toml`, at 400 rpm, with a mass of 0.5 kg and a spring of 3 N/mm.
#
# **Predict.** At which place of the turn is the spring too weak by most: where the follower is high, where it is low, or where $a$ is most negative? Mark it on your diagrams of notebook 2.
#
# **Draw it.** `graphcam solve task.toml --upto integration --out half` prints the sheet with all three diagrams. Over the axis of $s$ draw $c\,s$ and $-m\omega^2a$ at one scale of force, at every
# station; the dividers find the place where the second is above the first by most.

# %%
speed, mass, stiffness = 400.0, 0.5, 3.0
task = changed(lesson_task("task.toml", "translating", roller=True), {"speed_rpm": speed, "spring": SpringTable(mass=mass, stiffness=stiffness)})
solution = gc.solve(task)
design = solution.spring
omega = speed * 2 * np.pi / 60

# %% jupyter={"source_hidden": true} tags=["remove-input"]
motion = task.motion()
phi = np.radians(np.linspace(0, 360, 1441))
s, _, a, _ = motion(phi)
least = gc.spring_preload(motion, mass, speed, stiffness)
worst_s, _, worst_a, _ = (float(x) for x in motion(least.phi, side="left"))
after = float(motion(least.phi)[2])  # where the acceleration jumps, it has two values; the more negative one counts
worst_a = min(worst_a, after)
inertia = mass * omega**2 * abs(worst_a) / 1000
figure, axes = chart("φ, °", "force, N", 3.0)
axes.plot(np.degrees(phi), stiffness * s, color="#5a5a5a", label="spring without preload, c·s")
axes.plot(np.degrees(phi), -mass * omega**2 * a / 1000, color="#b3201c", label="needed, −m·ω²·a")
axes.plot(np.degrees(phi), least.preload + stiffness * s + mass * omega**2 * a / 1000, color="#0b57a4", label="left for the cam, ξ")
axes.axhline(0, color="black", linewidth=0.6)
axes.legend(fontsize=8)
picture_of(figure, f"Over the cam angle: the spring force c s; the force needed to brake the follower, which exceeds the spring most at {degrees(least.phi):.0f} degrees, "
           f"by {least.preload:.1f} N; and the contact force with the minimum preload, which touches zero there.",
           f"What the inertia needs (red) exceeds what the spring gives (grey) by up to {least.preload:.1f} N, at {degrees(least.phi):.0f}°")

# %% jupyter={"source_hidden": true} tags=["remove-input"]
Markdown(f"The spring is weakest, beside what is needed, at $\\varphi = {degrees(least.phi):.1f}°$: $s = {worst_s:.2f}$ mm, $c\\,s = {stiffness * worst_s:.1f}$ N, "
         f"but $m\\omega^2|a| = {inertia:.1f}$ N with $a = {worst_a:.1f}$ mm/rad². The missing {least.preload:.1f} N are the preload.")

# %% [markdown]
# **Write it.** From the readings of the drawing compute at every station by how much the spring without preload is too weak, in N; negative
# where it is strong enough. The maximum of these is the preload. One line is enough.

# %%
read = solution.drawn["integration"].readings
drawn_s, lowest_a = read["s"].value, np.minimum(read["a_before"].value, read["a"].value)  # before and after a jump

# %% jupyter={"source_hidden": true} tags=["remove-input"]
weak_by = -mass * omega**2 * lowest_a / 1000 - stiffness * drawn_s
missing_force = ArrayQuestion(
    weak_by, 1e-6, "the two curves of the figure: what is needed, less what the spring gives",
    {"mm/s² are thousandths of m/s²": -mass * omega**2 * lowest_a - stiffness * drawn_s,
     "the spring is needed where a is negative": mass * omega**2 * lowest_a / 1000 - stiffness * drawn_s, "the difference is the other way round": -weak_by},
)

# %% tags=["try-it"]
your_missing_force = None  # N, one for each station, from mass, omega, lowest_a, stiffness and drawn_s
missing_force.check(your_missing_force)

# %% tags=["hide-input"]
missing = -mass * omega**2 * lowest_a / 1000 - stiffness * drawn_s
print(f"minimum preload {max(missing):.1f} N at the stations, {least.preload:.1f} N exactly")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert missing_force.check(missing).status == "right"
assert abs(design.least.preload - least.preload) < 1e-9
assert abs(inertia - stiffness * worst_s - least.preload) < 1e-6

# %% [markdown]
# **Predict.** A cam drives the same follower once with a pressure angle of 0 and once of 30°: by how many per cent is the contact force larger? And what
# carries the difference?
#
# **The force plan.** At a station all forces on the follower are in equilibrium: the load $Q$ (inertia, spring, preload) along the motion, the contact force $F$ along the normal,
# at the pressure angle $\alpha$, and the reaction of the guide across the motion. Three directions and one magnitude are known, which determine a triangle. It is similar to the
# velocity plan of notebook 3.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(design.force_plan, within=solution)

# %% [markdown]
# The contact force is $F = Q/\cos\alpha$, so a pressure angle of 30° costs 15 %. The guide carries $Q\tan\alpha$, which wears it.

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert round(100 * (1 / cos(radians(30)) - 1)) == 15

# %% [markdown]
# ## Try it yourself
#
# The speed is **doubled**; everything else is unchanged. Think first: which of the two forces changes, and how? Then find the minimum preload, from the diagrams of
# $s$ and $a$ on your sheet. (The critical position moves: look for it again.)

# %% jupyter={"source_hidden": true} tags=["remove-input"]
def needed(inertias, springs=1.0):
    """The maximum of so many times the inertia less so many times the spring force [N]."""
    fine_s, _, fine_a, _ = motion(np.radians(np.linspace(0, 360, 7201)))
    return float(np.max(-inertias * mass * omega**2 * fine_a / 1000 - springs * stiffness * fine_s))


def drawn_preload(pencil):
    by_hand = solution.chain.by(pencil)["integration"].readings
    lowest = np.minimum(by_hand["a_before"].value, by_hand["a"].value)
    forces = -4 * mass * omega**2 * lowest / 1000 - stiffness * by_hand["s"].value
    return reading(forces.max(axis=-1), 1.0, "N")


double = Question.by(
    drawn_preload, "the formula of ξ: which term contains ω?",
    {"the inertia grows with the square of the speed": needed(2), "the spring force does not grow with the speed": 4 * least.preload,
     "the spring force helps: subtract it": needed(4, -1), "that is the inertia alone": needed(4, 0)},
    exact=gc.spring_preload(motion, mass, 2 * speed, stiffness).preload,
)
contact_force = Question(
    100 / cos(radians(25)), 1.0, "N", "the triangle of forces",
    {"F is the hypotenuse": 100 * cos(radians(25)), "that is what the guide carries": 100 * np.tan(radians(25))},
)

# %% tags=["try-it"]
your_preload = None  # N
double.check(your_preload)

# %% [markdown]
# At a station the load is $Q = 100$ N and the pressure angle 25°. How large is the contact force?

# %% tags=["try-it"]
your_contact_force = None  # N
contact_force.check(your_contact_force)

# %% [markdown]
# ## Move the sliders
#
# Speed and preload. Where the blue curve is below zero the follower leaves the cam, flies, and comes down with a knock.


# %% jupyter={"source_hidden": true} tags=["remove-input"]
def contact(speed, preload):
    curve = gc.Contact(motion, gc.SpringLoad(mass=mass, speed_rpm=float(speed), stiffness=stiffness, preload=float(preload))).curve()
    figure, axes = chart("φ, °", "ξ, N", 2.4)
    axes.plot(np.degrees(curve.phi), curve.force, color="#0b57a4")
    axes.fill_between(np.degrees(curve.phi), curve.force, 0, where=curve.force < 0, color="#b3201c", alpha=0.4)
    axes.axhline(0, color="black", linewidth=0.6)
    return picture_of(figure, f"The contact force over the cam angle at {speed} rpm with a preload of {preload} N; where it is negative it is filled.",
                      "Contact force; contact is lost where it is filled")


explore(
    contact,
    speed=Slider("speed, rpm", (100, 200, 300, 400, 500, 600), 400, (400, 600)),
    preload=Slider("preload, N", (0, 10, 40, 80, 160, 240), 40, (240,)),
)

# %% [markdown]
# ## Friction at the cam
#
# The cam slides past the follower, always in its own sense, and drags it along the profile with $\mu N$. Along the motion this takes away $\mu N\sin\alpha$:
#
# $$ m\,(a\,\omega^2 + v\,\varepsilon) = N\,(\cos\alpha - \mu\sin\alpha) - (F_0 + c\,s) - P . $$
#
# Here $N$ is the normal force, $\varepsilon$ the angular acceleration of the camshaft (0 at a steady speed) and $P$ what the machine's work presses against the
# follower. What is left of a unit of normal force, $\tau = \cos\alpha - \mu\sin\alpha$, is the **transmission coefficient**. Where it falls to zero, at $\tan\alpha = 1/\mu$, no
# force, however large, moves the follower: it **jams**. On the return $\alpha$ is negative, and friction carries part of the load.
#
# With $\mu = 0.15$ that would be at 81°. Why then is 30° the usual limit? Because of the **guide**. The side force $N\sin\alpha$ acts below its two bearings and tilts the stem,
# so that the bearings carry more than it: with the overhang $b$ and the bearings $l$ apart, $1 + 2b/l$ times as much. Their friction $\mu$ holds the stem back, and it jams at
#
# $$ \tan\alpha = \frac{l}{\mu\,(2b + l)}. $$

# %%
table(("overhang b / l", *(f"jams at, °, μ = {mu}" for mu in (0.1, 0.15, 0.3))), [
    (f"{ratio}", *(degrees(jamming_angle(gc.Guide(friction=mu, overhang=ratio, length=1))) for mu in (0.1, 0.15, 0.3)))
    for ratio in (0.5, 1, 2, 4)
], digits=0)

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert round(degrees(np.arctan(1 / 0.15))) == 81
assert abs(degrees(jamming_angle(gc.Guide(friction=0.3, overhang=2, length=1))) - 33.7) < 0.1

# %% [markdown]
# A dry stem ($\mu = 0.3$) that stands out twice the length of its guide jams at 34°, a little above the usual limit; one that is oiled and well guided nowhere near it.
#
# In the force plan the contact force makes the friction angle, whose tangent is $\mu$, with the normal; everything else is unchanged. A perpendicular to
# the normal resolves it into $N$ and the friction $T = \mu N$.

# %%
rubbing = gc.solve(changed(task, {"spring": SpringTable(mass=mass, stiffness=stiffness, preload=least.preload + 20, friction=0.15)}))

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(rubbing.spring.force_plan, within=rubbing)

# %% [markdown]
# Over the turn: without friction the spring gives back on the return what it took on the rise, and the mean torque is zero. With friction the shaft must also be driven
# on average.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
smooth = gc.CamForces(rubbing.cam, rubbing.spring.load)
figure, axes = chart("φ, °", "M, N·m", 2.6)
for forces, color, label in ((smooth, "#5a5a5a", "without friction"), (rubbing.spring.forces, "#b3201c", "with μ = 0.15")):
    share = np.linspace(0, 1, 241)
    at = [forces.at(k, share) for k in range(len(motion.phases))]
    axes.plot(np.degrees(np.concatenate([each.phi for each in at])), np.concatenate([each.torque for each in at]) / 1000, color=color, label=label)
axes.axhline(0, color="black", linewidth=0.6)
axes.legend(fontsize=8)
picture_of(figure, "The torque on the cam over the cam angle: with friction it is greater on the rise, less negative on the return, and a little above zero in the dwells.",
           "The driving torque without friction (grey) and with it (red)")

# %%
rows = []
for mu in (0.0, 0.15, 0.3):
    forces = gc.CamForces(rubbing.cam, rubbing.spring.load, friction=mu)
    most = forces.max_normal()
    rows.append((mu, gc.jamming_margin(rubbing.cam, mu).value, most.value, degrees(float(rubbing.cam.pressure_angle(most.phi))), gc.mean_torque(forces) / 1000))
table(("μ", "minimum τ", "maximum N, N", "there α, °", "mean M, N·m"), rows, digits=2)

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert abs(rows[0][-1]) < 1e-9 < rows[1][-1] < rows[2][-1]
assert all(row[1] > 0 for row in rows)
turn = np.radians(np.arange(0.5, 360))
alpha, dry, oiled = rubbing.cam.pressure_angle(turn), rubbing.spring.forces.at(turn).normal, smooth.at(turn).normal
assert np.all((dry < oiled)[(alpha < -0.1) & (oiled > 1)])
assert np.all((dry > oiled)[(alpha > 0.1) & (oiled > 1)])

# %% [markdown]
# Where $\alpha$ is negative, on the return, the normal force *falls* with friction, which carries part of the load there. On the rise it grows.
#
# At a station the load along the motion is $Q = 100$ N, the pressure angle 30° and $\mu = 0.2$. How large is the normal force?

# %% jupyter={"source_hidden": true} tags=["remove-input"]
normal_force = Question(
    100 / (cos(radians(30)) - 0.2 * sin(radians(30))), 1.0, "N", "the transmission coefficient",
    {"that is without friction": 100 / cos(radians(30)),
     "on a rise friction takes away, it does not help": 100 / (cos(radians(30)) + 0.2 * sin(radians(30)))},
    found_by="calculation",
)

# %% tags=["try-it"]
your_normal_force = None  # N
normal_force.check(your_normal_force)

# %% [markdown]
# ## Stress between roller and profile
#
# Roller and profile touch along a line. By Hertz the pressure in its middle is
#
# $$ p = \sqrt{\frac{F}{\pi\,b\,E'}\left(\frac1{r} + \frac1{\rho - r}\right)}, \qquad
# E' = \frac{1-\nu_1^2}{E_1} + \frac{1-\nu_2^2}{E_2}, $$
#
# with the width $b$, the roller radius $r$ and the profile's radius of curvature $\rho - r$. Here notebooks 5 and 6 come back: a small cam is sharp, and
# a sharp profile has a high contact pressure.

# %%
cam = solution.cam
forces = gc.CamForces(cam, gc.SpringLoad(mass=mass, speed_rpm=speed, stiffness=stiffness, preload=least.preload + 20))
stress = gc.ContactStress(forces, gc.RollerContact(width=15))
found = stress.max_pressure()
table(("maximum pressure, MPa", "at φ, °", "minimum width for 600 MPa, mm"), [(found.value, degrees(found.phi), stress.min_width(600))], digits=1)

# %% [markdown]
# ## Drawn and exact
#
# The force plan drawn at its station, by an ideal pencil and in 400 careful drawings, and the exact contact force there. Where the acceleration jumps, the force has two values; a
# value is worth nothing without its *side*, and the larger one counts:

# %% jupyter={"source_hidden": true} tags=["remove-input"]
plan = design.force_plan
station = plan.givens.station
stations = solution.chain.board.stations
exact_forces = gc.CamForces(cam, design.load)
place = int(stations.phase[station]), float(stations.u[station])
exact = {side: float(exact_forces.at(*place, side=side).normal) for side in ("left", "right")}
by_hands = gc.solve(task, gc.Pencil.of(0.2, samples=400, seed=1)).spring.force_plan.readings["normal"].value
table(("contact force", "ideal pencil, N", "careful drawings: mean, N", "scatter, N", "exact before, N", "exact after, N"),
      [(f"station {station}", float(plan.readings["normal"].value), float(by_hands.mean()), float(by_hands.std()), *exact.values())], digits=1)

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
drawn_force = float(plan.readings["normal"].value)
assert min(abs(drawn_force - force) for force in exact.values()) < 0.05 * max(exact.values())

# %% [markdown]
# ## Where the error comes from
#
# The acceleration enters with the scale $\mu_a$, the last of the chain: an error of 1 % in the lift's length on paper is 1 % in the inertia. A larger uncertainty is what is *not* on the sheet: the true
# moving mass (a third of the spring moves too), the friction, and the uneven speed of the shaft. So choose the preload 20 to 50 % above the minimum.
#
# ## Questions
#
# 1. At which speed does our spring need no preload at all?
# 2. For which motion laws is the critical position inside a phase, not at a jump?
# 3. A groove cam holds the roller on both sides. Which equation of this notebook then changes its meaning?
# 4. A follower without any guide friction jams at the cam with $\mu = 0.4$. At which pressure angle, and why never on the return?
# 5. The pressure $p$ grows with the square root of the force. What does doubling the preload cost in $p$, and in width $b$?
#
# <details><summary>Model answers</summary>
#
# 1. Up to the speed at which $c\,s$ is everywhere as large as $m\omega^2|a|$ where $a$ is negative. Find it with the sliders, where the preload is 0.
# 2. For those whose acceleration does not jump.
# 3. $\xi \ge 0$: where $\xi$ is negative the other side of the groove pushes. At its zeros the roller changes sides and must reverse its spin.
# 4. At $\tan\alpha = 1/0.4$, 68°. On the return $\alpha$ is negative, and $\cos\alpha - \mu\sin\alpha$ is larger than $\cos\alpha$.
# 5. If the preload were all of the force, $\sqrt2$ times the pressure; and for the old pressure twice the width, since $p \sim \sqrt{F/b}$.
#
# </details>
