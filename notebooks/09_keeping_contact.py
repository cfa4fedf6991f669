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

import graphcam as gc
from graphcam.notebooks import Question, Slider, changed, chart, explore, picture_of, show_steps, table
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
# The coursework task at 300 rpm, with a mass of 0.5 kg and a spring of 3 N/mm.

# %%
task = changed(gc.builtin_task(), {"speed_rpm": 300.0, "spring": SpringTable(mass=0.5, stiffness=3.0)})
solution = gc.solve(task)
design = solution.spring
omega = 300 * 2 * np.pi / 60

# %% jupyter={"source_hidden": true} tags=["remove-input"]
motion = task.motion()
phi = np.radians(np.linspace(0, 360, 1441))
s, _, a, _ = motion(phi)
figure, axes = chart("φ, °", "force, N", 3.0)
axes.plot(np.degrees(phi), 3 * s, color="#5a5a5a", label="spring without preload, c·s")
axes.plot(np.degrees(phi), -0.5 * omega**2 * a / 1000, color="#b3201c", label="needed, −m·ω²·a")
axes.plot(np.degrees(phi), design.contact.load.preload + 3 * s + 0.5 * omega**2 * a / 1000, color="#0b57a4", label="left for the cam, ξ")
axes.axhline(0, color="black", linewidth=0.6)
axes.legend(fontsize=8)
picture_of(figure, "Over the cam angle: the spring force c s, which is 90 N during the upper dwell; the force needed to brake the follower, which exceeds the "
           "spring just before 155 degrees by 9 N; and the contact force with the minimum preload, which touches zero there.",
           "What the inertia needs (red) exceeds what the spring gives (grey) by 9 N just before 155°")

# %% [markdown]
# In our task the follower is accelerated downwards with 109.4 mm/rad² in the first half of the return. The spring is weakest at the *end* of this half, where the follower is
# already half way down: $s = 15$ mm, $c\,s = 45$ N, but $m\omega^2|a| = 54$ N. The missing 9 N are the preload.

# %%
print(f"minimum preload {design.least.preload:.2f} N at {degrees(design.least.phi):.0f}°")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert abs(design.least.preload - 9) < 1e-9
assert abs(degrees(design.least.phi) - 155) < 1e-6
assert abs(gc.spring_preload(motion, 0.5, 300, 3).preload - 9) < 1e-9

# %% [markdown]
# **The force plan.** At a station all forces on the follower are in equilibrium: the load $Q$ (inertia, spring, preload) along the motion, the contact force $F$ along the normal,
# at the pressure angle $\alpha$, and the reaction of the guide across the motion. Three directions and one magnitude are known, which determine a triangle. It is similar to the
# velocity plan of notebook 3.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(design.force_plan, within=solution)

# %% [markdown]
# The contact force is $F = Q/\cos\alpha$, so a pressure angle of 30° costs 15 %. The guide carries $Q\tan\alpha$: this wears it, and with friction it makes the
# follower jam.
#
# ## Try it yourself
#
# The speed is doubled to **600 rpm**; everything else is unchanged. Think first: which of the two forces changes, and how? Then find the minimum preload. (The critical
# position does not move.)

# %% jupyter={"source_hidden": true} tags=["remove-input"]
double = Question(
    4 * 0.5 * omega**2 * 109.427 / 1000 - 45, 1.0, "N", "the formula of ξ: which term contains ω?",
    {"the inertia grows with the square of the speed": 2 * 0.5 * omega**2 * 109.427 / 1000 - 45,
     "the spring force does not grow with the speed": 4 * 9.0,
     "the spring force helps: subtract it": 4 * 0.5 * omega**2 * 109.427 / 1000 + 45,
     "that is the inertia alone": 4 * 0.5 * omega**2 * 109.427 / 1000},
)
contact_force = Question(
    100 / cos(radians(25)), 1.0, "N", "the triangle of forces",
    {"F is the hypotenuse": 100 * cos(radians(25)), "that is what the guide bears": 100 * np.tan(radians(25))},
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
    curve = gc.Contact(motion, gc.SpringLoad(mass=0.5, speed_rpm=float(speed), stiffness=3, preload=float(preload))).curve()
    figure, axes = chart("φ, °", "ξ, N", 2.4)
    axes.plot(np.degrees(curve.phi), curve.force, color="#0b57a4")
    axes.fill_between(np.degrees(curve.phi), curve.force, 0, where=curve.force < 0, color="#b3201c", alpha=0.4)
    axes.axhline(0, color="black", linewidth=0.6)
    return picture_of(figure, f"The contact force over the cam angle at {speed} rpm with a preload of {preload} N; where it is negative it is filled.",
                      "Contact force; contact is lost where it is filled")


explore(
    contact,
    speed=Slider("speed, rpm", (100, 200, 300, 400, 500, 600), 300, (300, 600)),
    preload=Slider("preload, N", (0, 9, 30, 60, 120, 180), 9, (180,)),
)

# %% [markdown]
# ## Friction at the cam
#
# The cam slides past the follower, always in its own sense, and drags it along the profile with $\mu N$. Along the motion this takes away $\mu N\sin\alpha$:
#
# $$ m\,(a\,\omega^2 + v\,\varepsilon) = N\,(\cos\alpha - \mu\sin\alpha) - (F_0 + c\,s) - P . $$
#
# What is left of a unit of normal force, $\tau = \cos\alpha - \mu\sin\alpha$, is the **transmission coefficient**. Where it falls to zero, at $\tan\alpha = 1/\mu$, no
# force, however large, moves the follower: it **jams**. On the return $\alpha$ is negative, and friction carries part of the load.
#
# In the force plan the contact force makes the friction angle, whose tangent is $\mu$, with the normal; everything else is unchanged. A perpendicular to
# the normal resolves it into $N$ and the friction $T = \mu N$.

# %%
rubbing = gc.solve(changed(task, {"spring": SpringTable(mass=0.5, stiffness=3.0, preload=30.0, friction=0.15)}))

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
    rows.append((mu, gc.jamming_margin(rubbing.cam, mu).value, forces.greatest_normal().value, gc.mean_torque(forces) / 1000))
table(("μ", "minimum τ", "maximum N, N", "mean M, N·m"), rows, digits=2)

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert abs(rows[0][3]) < 1e-9 < rows[1][3] < rows[2][3]
assert abs(rows[1][3] - 0.415) < 0.001
assert all(row[1] > 0 for row in rows)
assert rows[0][2] > rows[1][2] > rows[2][2]

# %% [markdown]
# Here the maximum normal force *falls* with friction: it lies on the return, at 49° of pressure angle, where friction carries part of the load. On the rise it grows.
#
# At a station the load along the motion is $Q = 100$ N, the pressure angle 30° and $\mu = 0.2$. How large is the normal force?

# %% jupyter={"source_hidden": true} tags=["remove-input"]
normal_force = Question(
    100 / (cos(radians(30)) - 0.2 * sin(radians(30))), 1.0, "N", "the transmission coefficient",
    {"that is without friction": 100 / cos(radians(30)),
     "on a rise friction takes away, it does not help": 100 / (cos(radians(30)) + 0.2 * sin(radians(30)))},
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
forces = gc.CamForces(cam, gc.SpringLoad(mass=0.5, speed_rpm=300, stiffness=3, preload=30))
stress = gc.ContactStress(forces, gc.RollerContact(width=15))
found = stress.greatest()
table(("maximum pressure, MPa", "at φ, °", "minimum width for 600 MPa, mm"), [(found.value, degrees(found.phi), stress.least_width(600))], digits=1)

# %% [markdown]
# ## Drawn and exact
#
# The force plan drawn at its station, and the exact contact force there:

# %%
plan = design.force_plan
normal = plan.readings["normal"]
station = plan.givens.station
u, phase = solution.chain.board.stations.u[station], solution.chain.board.stations.phase[station]
exact = float(gc.CamForces(cam, design.load).at(phase, u).normal)
table(("contact force", "drawn, N", "exact, N"), [("station " + str(station), float(normal.value), exact)])

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert abs(float(normal.value) - exact) < 0.05 * exact

# %% [markdown]
# ## Where the error comes from
#
# The acceleration enters with the scale $\mu_a$, the last of the chain: an error of 1 % in the lift's length on paper is 1 % in the force. A larger uncertainty is what is *not* on the sheet: the true
# moving mass (a third of the spring moves too), the friction, and the uneven speed of the shaft. So choose the preload 20 to 50 % above the minimum.
#
# ## Questions
#
# 1. At which speed does our spring need no preload at all?
# 2. For which motion laws is the critical position inside a phase, not at a jump?
# 3. A groove cam holds the roller on both sides. Which equation of this notebook then changes its meaning?
# 4. A follower jams with $\mu = 0.4$. At which pressure angle, and why never on the return?
# 5. The pressure $p$ grows with the square root of the force. What does doubling the preload cost in $p$, and in width $b$?
