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

import graphcam as gc
from graphcam.notebooks import Question, changed, show_steps, table

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

# %%
solution = gc.solve(gc.builtin_task())
show_steps(solution.drawn["inversion"], within=solution)

# %% [markdown]
# Two mistakes are common:
#
# - **Numbering with the rotation.** The cam comes out as its mirror image: the follower would rise on the return.
# - **Laying $s$ off from the offset circle.** The foot of the tangent is at the height 0, the lowest position of the trace point at
#   the height $s_0$: where the tangent meets the *prime circle*. From there $s$ is laid off.
#
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
# sideways while it rises. Plotting the radius over the cam angle shifts the points by degrees; a published table has that error, up
# to 3.6°.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
read = arm.drawn["inversion"].readings
stations = arm.chain.board.stations
start = float(read["polar_angle"].value[0])
turned = np.unwrap(read["polar_angle"].value - start)
rise = arm.chain.spans[0]
table(("station", "cam angle φ, °", "polar angle from the start, °", "difference, °"), [
    (f"{k}", degrees(stations.phi[k]), abs(degrees(turned[k])), abs(degrees(turned[k])) - degrees(stations.phi[k]))
    for k in range(rise.start, rise.stop, 2)
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
# The coursework cam: clockwise, $r_0 = 44$ mm, $e = -10$ mm, drawn at 2:1. At station 6 of the rise ($\varphi = 40°$) the displacement is
# 15 mm. How far from the cam centre is the point of the pitch curve, **on your paper**? And in which direction do the numbers run?

# %% jupyter={"source_hidden": true} tags=["remove-input"]
inversion = solution.drawn["inversion"]
distance = Question(
    2 * float(inversion.readings["radius"].value[6]), 1.0, "mm of paper", "point 3: where does s start?",
    {"that is the machine's distance; the profile is drawn at 2:1": float(inversion.readings["radius"].value[6]),
     "s was laid off from the offset circle": 2 * np.hypot(10, 15), "s was added to r₀ as if the follower were central": 2 * 59.0},
)
sense = Question(
    1.0, 0.01, "+1 or −1", "the background: which way does the frame travel round the fixed cam?",
    {"that is the sense in which the cam turns": -1.0},
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
with_roller = changed(gc.builtin_task(), {"cam.prime_radius": 44.0, "follower.roller_radius": 10.0})
gc.studio(with_roller, view="profile", stills={
    **{f"prime radius, mm: {radius}": {"cam.prime_radius": radius} for radius in (30, 60)},
    "offset, mm: 10": {"follower.offset": 10},
})

# %% [markdown]
# ## Drawn and exact
#
# Points of the pitch curve, drawn by inversion and from the formula:

# %%
drawn, exact = solution.comparison.drawn_stations, solution.comparison.exact_stations
shown = range(0, 13, 3)
table(("station", "x drawn", "x exact", "y drawn", "y exact"), [
    (f"{k}", float(drawn["x"][k]), float(exact.pitch[k][0]), float(drawn["y"][k]), float(exact.pitch[k][1])) for k in shown
])

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
pitch = np.stack([drawn["x"], drawn["y"]], axis=-1)
assert np.abs(pitch - exact.pitch).max() < 1e-9
assert abs(float(np.hypot(*exact.pitch[0])) - 44) < 1e-9
assert abs(np.abs(degrees(turned[rise][-1])) - 75) > 1

# %% [markdown]
# For constant acceleration the displacements carry no error of the method, so an ideal pencil reproduces the
# curve exactly.
#
# ## Where the error comes from
#
# 1. **From the displacements**: whatever error notebook 2 left in $s$ goes into the profile in full, times the
#    scale.
# 2. **From the division of the circle**: a protractor set wrongly by half a degree moves a point of a 60 mm radius by 0.5 mm *along* the
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
