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
#   title: "What a given cam does"
# ---

# %% [markdown]
# # 13. What a given cam does
#
# **Aim.** At the end you can take a cam as it is, by its radii or by points of it, and find with paper and compass what it does to its follower: displacement, phase angles, pressure
# angles, velocity and acceleration; and you can say what becomes of that under another follower.
#
# **You need** inversion (notebook 5), chords and their slopes (notebook 2), circles that touch (notebook 8). On paper: A3, compass, protractor, dividers. **Time:** 60 minutes, 40 of them with the pencil.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
import math

import numpy as np

import graphcam as gc
from graphcam.notebooks import ArrayQuestion, Question, Slider, chart, compared, explore, picture_of, show_steps, table
from graphcam.tasks.task_file import task_from

# %% [markdown]
# ## Background
#
# So far the motion was given and the cam was sought. The inverse question stands in every examination, and in every workshop that gets an old machine: **here is the cam, what does it do?** The idea is the
# same: hold the cam still and turn the frame round it, against the rotation. In each position the follower touches the outline, and its distance from the prime circle is its displacement.
#
# The **tangent cam** of the textbooks has a base circle of 28 mm, straight flanks and a round nose; it lifts a roller of 16 mm by 15 mm within 70°. The nose's radius $R_3$ follows. Its centre is $d = R_1 + h - R_3$ away
# from the cam centre, and the straight flank touches both circles, so $d\cos\beta = R_1 - R_3$:
#
# $$ R_3 = \frac{R_1 - (R_1 + h)\cos\beta}{1 - \cos\beta} . $$

# %%
cam = gc.cam_by_radii(base_radius=28, flank_radius="straight", lift=15, ascent=math.radians(70))
c = math.cos(math.radians(70))
print(f"nose radius {cam.nose_radius:.3f} mm; by the formula {(28 - 43 * c) / (1 - c):.3f} mm")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert abs(cam.nose_radius - (28 - 43 * c) / (1 - c)) < 1e-12

# %% [markdown]
# **Predict.** The roller's centre runs on the pitch curve, 16 mm outside of the cam. At which place of the rise does the acceleration change its sign: early on the flank, where the flank ends, or at the nose?

# %% [markdown]
# ## The construction
#
# **Draw it.** Write these lines into a file `given.toml`; `graphcam solve given.toml --upto 2.1 --out half` prints the sheet with the outline, and all else is yours.
#
# ```toml
# rotation = "ccw"
# speed_rpm = 600
#
# [arcs]
# base_radius = 28
# flank_radius = "straight"
# lift = 15
# ascent = 70
#
# [follower]
# kind = "translating"
# offset = 0
# roller_radius = 16
# ```

# %%
task = task_from({
    "rotation": "ccw", "speed_rpm": 600,
    "arcs": {"base_radius": 28, "flank_radius": "straight", "lift": 15, "ascent": 70},
    "follower": {"kind": "translating", "offset": 0, "roller_radius": 16},
})
solution = gc.solve(task)
show_steps(solution.drawn["analysis"], within=solution)

# %% [markdown]
# ## Velocity and acceleration
#
# The displacement is a curve now, and its derivatives are drawn by chords and a pole, as in notebook 2 but the other way round.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(solution.drawn["differentiation"], 2, 3, 5, 6, within=solution)

# %% [markdown]
# **Write it.** The displacement was measured every 5° over the whole turn: compute the slopes of its chords, which are the velocities in the middles of the
# parts, and from these in the same way the accelerations at the stations. After the last station comes the first. Two lines are enough; `np.roll` goes round.

# %%
motion, step = gc.outline_motion(cam, gc.Translating(roller_radius=16)), math.radians(5)
s = motion(np.arange(0, 2 * math.pi, step))[0]

# %% jupyter={"source_hidden": true} tags=["remove-input"]
slopes = np.diff(np.concatenate([s[-1:], s, s[:1]])) / step
chord_slopes = ArrayQuestion(
    slopes[1:], 1e-9, "the rise of a chord over its width",
    {"the width must be in radians": slopes[1:] * step / 5, "a chord runs from its station to the next one": slopes[:-1]},
)
chord_accelerations = ArrayQuestion(
    np.diff(slopes) / step, 1e-6, "the two chords of v that meet at a station",
    {"that belongs to the next station": np.roll(np.diff(slopes) / step, -1)},
)

# %% tags=["try-it"]
your_velocities = None  # mm/rad, from each station to the next, from s and step
chord_slopes.check(your_velocities)

# %% tags=["try-it"]
your_accelerations = None  # mm/rad², at the stations, from your_velocities and step
chord_accelerations.check(your_accelerations)

# %% tags=["hide-input"]
v = (np.roll(s, -1) - s) / step
a = (v - np.roll(v, 1)) / step
print(f"maximum v {v.max():.2f} mm/rad, maximum a {a.max():.2f} mm/rad²")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert chord_slopes.check(v).status == chord_accelerations.check(a).status == "right"

# %% [markdown]
# ## The same cam, another follower
#
# What if the roller wears out and the shop has only one of 20 mm? Or the stem is replaced by an arm? The outline stays, everything else changes:

# %%
followers = {
    "roller 16 mm": gc.Translating(roller_radius=16), "roller 8 mm": gc.Translating(roller_radius=8),
    "roller 32 mm": gc.Translating(roller_radius=32), "offset 8 mm": gc.Translating(8, 16),
}
found = {name: gc.outline_motion(cam, follower) for name, follower in followers.items()}
turn = np.linspace(0, 2 * math.pi, 3601)
table(("follower", "lift, mm", "rise, °", "maximum a, mm/rad²"), [
    (name, m.lift, math.degrees(m.phases[0].angle), float(max(m(turn)[2]))) for name, m in found.items()], digits=2)

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert len({round(found[name].lift, 9) for name in ("roller 16 mm", "roller 8 mm", "roller 32 mm")}) == 1
assert found["roller 32 mm"](0.0, side="right")[2] > found["roller 8 mm"](0.0, side="right")[2]

# %% [markdown]
# The lift of a central follower is the same for every roller: it is the difference of two circles about the cam centre. The acceleration is not: it begins with $R_1 + r$, so a larger roller starts harder.

# %% [markdown]
# ## Move the slider
#
# The acceleration under rollers of other sizes. A larger roller starts harder, and leaves the flank earlier: at 33.8° with 4 mm, at 19.7° with 32 mm.


# %% jupyter={"source_hidden": true} tags=["remove-input"]
def under_a_roller(radius):
    m = gc.outline_motion(cam, gc.Translating(roller_radius=float(radius)))
    phi = np.radians(np.linspace(-10, 150, 1601))
    figure, axes = chart("φ, °", "a, mm/rad²", 2.6)
    axes.plot(np.degrees(phi), m(phi % (2 * math.pi))[2], color="#b3201c")
    axes.set(ylim=(-60, 90))
    return picture_of(figure, f"The acceleration over the cam angle for a roller of {radius} mm: it jumps to {28 + radius:.0f} mm/rad² at the start, grows along the flank, and jumps below zero at the nose.",
                      f"Roller {radius:g} mm: it starts with R₁ + r = {28 + radius:g} mm/rad²")


explore(under_a_roller, radius=Slider("roller radius, mm", (4.0, 8.0, 16.0, 32.0), 16.0, (8.0, 32.0)))

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
leaves = [math.degrees(gc.outline_motion(cam, gc.Translating(roller_radius=radius)).breaks[1]) for radius in (4.0, 32.0)]
assert np.allclose(leaves, [33.8, 19.7], atol=0.06)

# %% [markdown]
# ## A cam that was measured
#
# Of an old cam nobody knows the radii. A measuring machine gives points; the outline is the smooth curve through them, and the follower is laid against it. Here are 360 points of the same cam, each off by 0.005 mm:

# %%
rng = np.random.default_rng(1)
angle = np.radians(np.arange(0, 360, 1.0))
dense = np.linspace(0, 2 * math.pi, 20001)
profile = gc.Cam(motion, gc.Translating(roller_radius=16), 44.0).profile(dense) @ [1, 1j]
order = np.argsort(np.angle(profile))
radius = np.interp(angle, np.angle(profile)[order] % (2 * math.pi), np.abs(profile)[order], period=2 * math.pi)
measured = gc.outline_motion(gc.cam_through_points((radius + 0.005 * rng.standard_normal(360)) * np.exp(1j * angle)),
                             gc.Translating(roller_radius=16), tolerance=0.03)
there = np.linspace(0, 2 * math.pi, 721)
off = measured(there - measured.zero)[0] - motion(there)[0]
print(f"lift {measured.lift:.3f} mm; s is off by {np.abs(off).max():.3f} mm at most")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert np.abs(off).max() < 0.03
assert abs(measured.lift - 15) < 0.02

# %% [markdown]
# ## Try it yourself
#
# An **eccentric**: a disc of 60 mm diameter turns about a point **8 mm** beside its centre, under a central roller of 10 mm. How large is the lift?

# %% jupyter={"source_hidden": true} tags=["remove-input"]
disc = gc.cam_by_radii(base_radius=22, lift=16)
under = gc.outline_motion(disc, gc.Translating(roller_radius=10))
lift = Question(under.lift, 0.5, "mm", "how far is the disc from the axis, at least and at most?", {
    "that is the eccentricity: the disc is as far beyond the axis as it falls short of it": 8.0, "that is the largest radius": 38.0}, found_by="calculation")
greatest = Question(float(np.abs(under(there)[1]).max()), 0.15, "mm/rad", "draw s over φ, and the steepest tangent", {
    "that is the lift": 16.0})

# %% tags=["try-it"]
your_lift = None  # mm
lift.check(your_lift)

# %% [markdown]
# Draw its displacement by inversion at 24 stations, and the steepest tangent to it. How large is the maximum velocity?

# %% tags=["try-it"]
your_velocity = None  # mm/rad
greatest.check(your_velocity)

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert abs(under.lift - 16) < 1e-9
assert abs(greatest.value - 8.0) < 0.2

# %% [markdown]
# ## Drawn and exact
#
# Every part of a cam of arcs has a closed form: on the flank $s = (R_1 + r)\,(1/\cos\varphi - 1)$, on the nose a crank and connecting rod. At the ends of the flank the acceleration **jumps**.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
phi = np.radians(np.linspace(-10, 150, 3201))
exact = motion(phi % (2 * math.pi))[2]
figure, axes = chart("φ, °", "a, mm/rad²", 2.8)
axes.plot(np.degrees(phi), exact, color="#b3201c", label="exact")
stations, chorded = np.arange(s.size) * 5.0, np.diff(np.concatenate([s[-1:], s, s[:1]]), 2) / step**2
shown = stations <= 150
axes.plot(stations[shown], chorded[shown], "o", markersize=3, color="#5a5a5a", label="chords of chords, 5°")
axes.legend(fontsize=8)
picture_of(figure, "The acceleration over the cam angle. On the flank it grows from 44 to 72 mm/rad², at the nose it jumps to about -19 and falls to -37; at the end of the rise it is symmetrical. The points of the "
           "chords lie on the curve but beside the jumps, where they lie between the two values.", "Chords bridge a jump: a point beside it lies between its two sides")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
w = 600 * math.pi / 30
assert abs(motion([0.0], side="right")[2][0] * w**2 / 1000 - 173.71) < 0.01
assert abs(motion([motion.phases[0].angle])[2][0] * w**2 / 1000 + 146.67) < 0.01
on_flank = np.radians(np.linspace(1, 20, 50))
assert np.abs(motion(on_flank)[0] - 44 * (1 / np.cos(on_flank) - 1)).max() < 1e-12

# %%
compared(solution, "measured_lift", "measured_rise_deg", "measured_max_v", "measured_max_a", "measured_max_pressure_angle_rise_deg")

# %% [markdown]
# ## Where the error comes from
#
# The displacement is right within a pencil line, the velocity nearly so. The acceleration is not: twice differentiated, every error is divided by the square of a part, and next to a jump chords see both of its sides. So a drawn
# acceleration of a *given* cam tells its course; the values at a jump come from the radii.

# %% [markdown]
# ## Questions
#
# 1. Why does a flat face need rounded flanks? What would it do on a straight one?
# 2. The nose may have the radius 0. What does the pitch curve look like there, and what the acceleration?
# 3. The cam turns the other way round. What changes for a central follower, and what for an offset one?
# 4. You measure a cam and its acceleration looks ragged. How do you find out whether the cam is bad or the measurement?
#
# <details><summary>Model answers</summary>
#
# 1. A face touches where the outline is square to the follower: on a straight flank at one cam angle alone, all along it. The contact would run from one end of the flank to the other at once, and the velocity would jump.
# 2. An arc of the radius $r$ about the tip: the roller turns about a corner. Its centre does so at a finite speed, so the acceleration is that of a crank, but the contact stress is not to be borne.
# 3. Nothing for a central follower on a cam that is its own mirror image, but that rise and return change places. An offset one has other pressure angles, and another motion.
# 4. Measure again, or turn the cam by some angle on the machine and measure once more: what goes with the cam is the cam's, what stays is the machine's. And differentiate twice only after smoothing by what the machine is known to err.
#
# </details>
