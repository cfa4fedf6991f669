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
#   title: "Inversion: translating follower, arm, flat face"
# ---

# %% [markdown]
# # 5. Inversion: translating follower, arm and flat face
#
# **Aim.** At the end you can draw the pitch curve of a cam for the three kinds of followers, number the positions in the right sense,
# and explain why they are numbered *against* the rotation.
#
# **You need** the displacement diagram (notebook 2) and an adopted prime radius (notebook 4). On paper: A3, compass, protractor,
# dividers. **Time:** 75 minutes, 45 of them with the pencil.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
from math import degrees

import numpy as np
from IPython.display import Markdown

import graphcam as gc
from graphcam.drafting.hand import Hand, distance_between
from graphcam.drafting.ink import say
from graphcam.drafting.meaning import Meaning, ReadingMeaning
from graphcam.notebooks import ArrayQuestion, Question, changed, lesson_task, show_steps, table

# %% [markdown]
# ## Background: stop the cam
#
# In the machine the cam turns and the follower's guide stands still. On paper the cam must stand still, because its profile is to be
# drawn. So we give the *whole* mechanism an additional rotation, opposite to the cam's: the cam stops, and the frame with the
# follower's guide travels round the cam **against the cam's rotation**. The relative motion has not changed, so the path of the
# follower's trace point relative to the cam is the same. That path, drawn on the fixed cam, is the **pitch curve**.
#
# This is the whole method of *inversion*. For every follower it reads:
#
# 1. Draw the follower in its lowest position.
# 2. Turn its *frame* about the cam centre by the cam angle $\varphi_i$, against the rotation of the cam.
# 3. In the turned frame move the follower by its displacement $s_i$.
# 4. The trace point lies on the pitch curve.
#
# In formulas a point $p$ of the frame appears on the cam turned by $-\sigma\varphi$:
#
# $$ P = p\,e^{-i\sigma\varphi}, \qquad p = e + i\,(s_0 + s) \ \text{for a translating follower}. $$
#
# ## The translating follower
#
# The follower's line does not pass through the centre but at the distance $e$. In every turned position it touches the *offset circle* of
# the radius $|e|$. So divide the offset circle, not the prime circle, and draw tangents.
#
# **Predict.** In which sense round the fixed cam do you meet the phases in their order, with the rotation of the cam or against it? Sketch the cam, the
# rise and the return on their sides, before you look.
#
# **Draw it.** `graphcam solve task.toml --upto angle_diagram --out half` prints the sheet with all diagrams; the profile's place is empty.

# %%
task = lesson_task("task.toml", "translating")
solution = gc.solve(task)
show_steps(solution.drawn["inversion"], within=solution)

# %% [markdown]
# Two mistakes are common:
#
# - **Numbering with the rotation.** The cam comes out as its mirror image: the follower would rise on the return.
# - **Laying $s$ off from the offset circle.** The foot of the tangent is at the height 0, the lowest position of the trace point at
#   the height $s_0$: where the tangent meets the *prime circle*. From there $s$ is laid off.
#
# **Write it.** A turn is a product with a complex number, so all stations are inverted at once: compute the points of the pitch curve as complex numbers,
# in mm, the cam centre at 0 and the follower's motion upwards. One line is enough.

# %%
s = solution.drawn["integration"].readings["s"].value
phi = solution.drawn["acceleration"].points["axis"].real * float(solution.drawn["acceleration"].readings["base"].scale)
sigma, e, r0 = {"ccw": 1, "cw": -1}[task.rotation], solution.cam.follower.offset, solution.cam.prime_radius

# %% jupyter={"source_hidden": true} tags=["remove-input"]
read = solution.drawn["inversion"].readings
drawn_points = read["x"].value + 1j * read["y"].value
usual = {"the frame is turned with the cam: that is the mirror image": drawn_points * np.exp(2j * sigma * phi),
         "s was added to r₀ as if the follower were central": (e + 1j * (r0 + s)) * np.exp(-1j * sigma * phi),
         "s was laid off from the offset circle": (e + 1j * s) * np.exp(-1j * sigma * phi)}
pitch_curve = ArrayQuestion(drawn_points, 1e-6, "the formula of the background: where the trace point is in the frame, and how the frame is turned", usual)

# %% tags=["try-it"]
your_pitch_points = None  # complex numbers, mm, one for each station, from s, phi, sigma, e and r0
pitch_curve.check(your_pitch_points)

# %% tags=["hide-input"]
pitch_points = (e + 1j * (np.sqrt(r0**2 - e**2) + s)) * np.exp(-1j * sigma * phi)
print(f"farthest from the points of the drawing: {np.abs(pitch_points - drawn_points).max():.1e} mm")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert pitch_curve.check(pitch_points).status == "right"
assert np.abs(pitch_points - drawn_points).max() < 1e-9

# %% [markdown]
# The working profile comes last: circles of the roller radius about points of the pitch curve, and their inner envelope.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(solution.drawn["working_profile"], 2, 3, 4, within=solution)

# %% [markdown]
# ## The oscillating follower
#
# The frame now holds the *pivot* of an arm. The pivot travels round the centre on a circle of the radius $c$, the centre distance. In each
# position: an arc of the arm's length about the pivot meets the prime circle in the lowest position of the trace point; from there
# the arm is turned by the displacement, which is an angle.

# %%
arm = gc.solve(gc.builtin_task("arm"))
show_steps(arm.drawn["inversion"], within=arm)

# %% [markdown]
# The polar angle of a point of the pitch curve is **not** the cam angle: the trace point moves on an arc about the pivot and drifts
# sideways while it rises. Plotting the radius over the cam angle shifts the points by degrees:

# %% jupyter={"source_hidden": true} tags=["remove-input"]
read = arm.drawn["inversion"].readings
phi = arm.drawn["acceleration"].points["axis"].real * float(arm.drawn["acceleration"].readings["base"].scale)
turned = np.abs(np.degrees(np.unwrap(read["polar_angle"].value - float(read["polar_angle"].value[0]))))
parts = phi.size // 2 - 1
table(("station of the rise", "cam angle φ, °", "polar angle from the start, °", "difference, °"), [
    (f"{k}", degrees(phi[k]), turned[k], turned[k] - degrees(phi[k])) for k in range(0, parts + 1, 2)
], digits=2)

# %% [markdown]
# ## The flat-faced follower
#
# The follower ends in a plane face, square to its motion. There is no trace point, but each position of the *face* is a tangent of the cam:
# on the ray turned by $\varphi_i$ lay off $r_0 + s_i$ and draw the perpendicular. The cam is the **envelope** of these lines. Where does the
# face touch? At the distance $v$ beside the ray: again the velocity diagram contains a length of the mechanism, and its maximum values to
# both sides give the width of the face.

# %%
flat = gc.solve(gc.builtin_task("flat"))
show_steps(flat.drawn["inversion"], within=flat)

# %% [markdown]
# The pressure angle of this follower is always zero, so there is nothing to shade with tangents of $v$. What limits the radius is that the
# envelope must not turn back on itself: the radius of curvature $\rho = r_0 + s + a$ must stay positive. Draw $s$ against $a$ in equal
# scales; the line at 45° that touches the curve from below gives the minimum radius.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(flat.drawn["minimum_radius"], within=flat)

# %% [markdown]
# ## Try it yourself
#
# Another cam: it turns **clockwise**, $r_0 = 50$ mm, $e = -30$ mm, and is drawn at **2:1**. At $\varphi = 40°$ the displacement is
# 15 mm. How far from the cam centre is the point of the pitch curve, **on your paper**? And in which direction do the numbers run?

# %% jupyter={"source_hidden": true} tags=["remove-input"]
MEANING = Meaning("one_point", say("One point"), say("The frame is turned."), {"radius": ReadingMeaning(say("distance"), "R", "mm of paper")})


def drawn_distance(pencil):
    hand = Hand(pencil, MEANING)
    centre = hand.given("A")
    ray = hand.protractor("ray", centre, -1 + 0j, np.radians(40))
    foot = hand.lay_off("foot", centre, ray, 60.0)
    tangent = hand.perpendicular("tangent", hand.join("radius", foot, centre), foot)
    lowest = hand.cross("lowest place", tangent, hand.circle("prime circle", centre, 100.0))
    return hand.read("radius", distance_between(centre, hand.lay_off("point", lowest, tangent, 30.0)), 1.0)


distance = Question.by(
    drawn_distance, "point 3: where does s start?",
    {"that is the machine's distance; the profile is drawn at 2:1": float(np.hypot(30, 55)),
     "s was laid off from the offset circle": 2 * float(np.hypot(30, 15)), "s was added to r₀ as if the follower were central": 2 * 65.0},
)
sense = Question(
    1, 0.01, "+1 or −1", "the background: which way does the frame travel round the fixed cam?",
    {"that is the sense in which the cam turns": -1}, found_by="counting",
)

# %% tags=["try-it"]
your_distance = None  # mm of paper
distance.check(your_distance)

# %% tags=["try-it"]
your_sense = None  # +1 if the stations are numbered anticlockwise, -1 if clockwise
sense.check(your_sense)

# %% [markdown]
# ## Move the sliders
#
# The prime radius is a decision; see how it changes the profile. Watch the flanks: on a small cam they become concave.


# %% jupyter={"source_hidden": true} tags=["remove-input"]
with_roller = changed(task, {"cam.prime_radius": solution.cam.prime_radius, "follower.roller_radius": solution.cam.roller_radius})
gc.studio(with_roller, view="profile", stills={
    **{f"prime radius, mm: {radius:g}": {"cam.prime_radius": radius} for radius in (r0 + 10, r0 + 30)},
    f"offset, mm: {-e:g}": {"follower.offset": -e},
})

# %% [markdown]
# ## Drawn and exact
#
# Points of the pitch curve, drawn by inversion and from the formula:

# %%
drawn, exact = solution.comparison.drawn_stations, solution.comparison.exact_stations
shown = range(0, s.size // 2, 3)
table(("station", "x drawn", "x exact", "y drawn", "y exact"), [
    (f"{k}", float(drawn["x"][k]), float(exact.pitch[k][0]), float(drawn["y"][k]), float(exact.pitch[k][1])) for k in shown
])

# %% jupyter={"source_hidden": true} tags=["remove-input"]
off = np.hypot(*(np.stack([drawn["x"], drawn["y"]], axis=-1) - exact.pitch).T)
hands = gc.solve(task, gc.Pencil.of(0.2, samples=400, seed=1)).drawn["inversion"].readings
scatter = max(float(hands[name].value.std(axis=0).max()) for name in "xy")
Markdown(f"The points are off by up to {off.max():.3f} mm, each by exactly as much as its displacement is: inversion itself has no error of the method. "
         f"By a pencil of 0.2 mm they scatter by {scatter:.2f} mm to either side.")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert abs(float(np.hypot(*exact.pitch[0])) - r0) < 1e-9
assert np.allclose(off, np.abs(drawn["s"] - exact.values[0]), atol=1e-9)
assert np.abs(turned[: parts + 1] - np.degrees(phi[: parts + 1])).max() > 1
assert abs(distance.value - 2 * np.hypot(30, 55)) < 1e-9

# %% [markdown]
#
# ## Where the error comes from
#
# 1. **From the displacements**: whatever error notebook 2 left in $s$ goes into the profile in full, times the
#    scale.
# 2. **From the division of the circle**: a protractor set wrongly by half a degree moves a point at 60 mm from the centre by 0.5 mm *along* the
#    curve, which matters only where the curve is steep. Set each angle off from the start, not from the previous one: errors of steps add.
# 3. **From tangents**: the point of contact on a circle of 10 mm is badly defined; draw the radius first and the tangent square to
#    it.
#
# ## Questions
#
# 1. Why are the dwells arcs about the cam centre, for every kind of follower?
# 2. Sketch what happens if the numbering runs with the rotation, for a cam whose rise and return have different angles.
# 3. For the arm the pivot circle is divided, for the flat face the rays. What exactly is turned in each case?
# 4. The flat face touches at the distance $v$ from the ray. Derive it, with the velocity plan of notebook 3.
#
# <details><summary>Model answers</summary>
#
# 1. In its frame the follower does not move; the frame is turned about the cam centre, so the trace point keeps its distance from it.
# 2. The cam is the mirror image: in its sense of rotation the follower rises over the angle of the return and falls over that of the rise.
# 3. The frame, every time: of the arm the pivot that it holds, of the flat face the line of motion, to which the face stays square.
# 4. The face moves along its motion with $\omega v$. The point of the cam at the distance $x$ from the ray has the velocity component $\omega x$ in that direction. Neither parts from the other, so $x = v$.
#
# </details>
