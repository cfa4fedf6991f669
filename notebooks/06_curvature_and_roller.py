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
#   title: "Three points, chords, the roller and undercut"
# ---

# %% [markdown]
# # 6. Three points, chords, the roller and undercut
#
# **Aim.** At the end you can find the sharpest point of a drawn curve with the compass, choose a roller that fits it, and recognise a
# profile that cannot be cut.
#
# **You need** a drawn pitch curve (notebook 5). On paper: A4, compass, ruler. **Time:** 50 minutes, 25 of them with the pencil.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
from math import degrees

import numpy as np
from IPython.display import Markdown

import graphcam as gc
from graphcam.drafting.hand import Hand, distance_between
from graphcam.drafting.ink import say
from graphcam.drafting.meaning import Meaning, ReadingMeaning
from graphcam.notebooks import ArrayQuestion, Question, changed, compared, lesson_task, show_steps, table

# %% [markdown]
# ## Background
#
# Three points determine a circle. Three *close* points of a curve determine, almost, its circle of curvature: the circle that fits
# the curve best there. Its centre lies where the perpendicular bisectors of the two chords meet; its radius $\rho$ is the radius of
# curvature.
#
# Why does it matter? The roller rolls *outside* the working profile, and its centre draws the pitch curve. The working profile is the inner
# parallel of the pitch curve at the distance $r$, so its own radius of curvature is
#
# $$ \rho_{\text{profile}} = \rho - r $$
#
# where the cam is convex. If $r < \rho$ all is well. If $r = \rho$ the profile has a point, which wears away at once. If $r > \rho$ the
# parallel curve turns back on itself in two cusps: the cutter that makes one flank removes what the other flank needs, and the cam that
# is left no longer moves the follower by the law. That is **undercut**. So the roller must stay well below the *minimum* convex radius:
#
# | school | rule |
# |:--|:--|
# | a share of the curvature, and of the cam | $r \le 0.7\,\rho_{\min}$ and $r \le 0.4\,r_0$, the smaller |
# | of the cam alone | $r = 0.45\,r_0$ |
# | a margin | $r = \rho_{\min} - (3\ldots5)$ mm |
#
# A large roller is good: it turns more slowly and the contact pressure is lower. The rule is a compromise
# again.
#
# ## The construction
#
# **Predict.** Where is the pitch curve sharpest: where the follower is lowest, on a flank, or near the top? Mark the place on your drawing of
# notebook 5 before you look.
#
# **Draw it.** `graphcam solve task.toml --upto inversion --out half` prints the sheet with the pitch curve.

# %%
task = lesson_task("task.toml", "translating", "oscillating")
solution = gc.solve(task)
curvature = solution.drawn["curvature"]
show_steps(curvature, within=solution)

# %% [markdown]
# **Write it.** Three points as complex numbers, in mm of paper: the centre is as far from the first as from the other two. Compute the centre, as a
# complex number too, and the radius. Four lines are enough: count from the first point.

# %%
first_point, middle_point, last_point = map(complex, curvature.points["triple"])

# %% jupyter={"source_hidden": true} tags=["remove-input"]
drawn_centre, drawn_rho = complex(curvature.points["centre"]), float(curvature.readings["rho"].paper)
circle = ArrayQuestion(
    (drawn_centre, drawn_rho), 1e-6, "the bisectors: where is what lies as far from the first point as from the second?",
    {"the centre is counted from the first point: add it": (drawn_centre - first_point, drawn_rho), "that is the diameter": (drawn_centre, 2 * drawn_rho)},
)

# %% tags=["try-it"]
your_circle = None  # (centre, radius), mm of paper, from first_point, middle_point and last_point
circle.check(your_circle)

# %% tags=["hide-input"]
def through(a, b, c):
    """Centre and radius of the circle through three points."""
    p, q = b - a, c - a
    centre = a + 1j * (abs(q) ** 2 * p - abs(p) ** 2 * q) / (2 * (p.conjugate() * q).imag)
    return centre, abs(centre - a)


centre, radius = through(first_point, middle_point, last_point)
print(f"radius {radius:.3f} mm of paper; on the drawing {float(curvature.readings['rho'].paper):.3f} mm")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert circle.check((centre, radius)).status == "right"
assert abs(radius - drawn_rho) < 1e-9
assert abs(through(0j, 30 + 8j, 60 + 0j)[1] - abs(float(gc.circumradius([0, 0], [30, 8], [60, 0])))) < 1e-9

# %% [markdown]
# Where is the sharpest point? Not where the curve *looks* pointed at first glance: move the compass along the curve. A strongly negative
# $a$ bends the pitch curve, most where the follower is high at the same time. Never take three points across a jump of the acceleration: the curvature jumps there too, and the circle would be a mean of two.
#
# Then the roller:

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(solution.drawn["roller"], within=solution)
show_steps(solution.drawn["working_profile"], 1, 2, 3, 4, within=solution)

# %% [markdown]
# ## Try it yourself
#
# Three points of a pitch curve, on paper: $A(0, 0)$, $B(30, 8)$, $C(60, 0)$ mm. Draw them, bisect the chords, find the centre. How long is
# $\rho$ on the paper? The profile is drawn at **2:1**: how long is it in the machine? And how large may the roller be by the rule
# $0.7\,\rho$?

# %% jupyter={"source_hidden": true} tags=["remove-input"]
MEANING = Meaning("three_points", say("Three points"), say("Three points determine a circle."),
                  {"paper": ReadingMeaning(say("radius"), "ρ", "mm of paper"), "machine": ReadingMeaning(say("radius"), "ρ", "mm")})


def drawn_radius(name, scale):
    def draw(pencil):
        hand = Hand(pencil, MEANING)
        a = hand.given("A")
        c, middle = hand.lay_off("C", a, 1 + 0j, 60.0), hand.lay_off("below B", a, 1 + 0j, 30.0)
        b = hand.lay_off("B", middle, 1j, 8.0)
        centre = hand.cross("centre", hand.bisect("bisector of AB", a, b), hand.bisect("bisector of BC", b, c))
        return hand.read(name, distance_between(centre, b), scale)
    return draw


three = through(0j, 30 + 8j, 60 + 0j)[1]
rho_paper = Question.by(
    drawn_radius("paper", 1.0), "the bisectors: both must be square to their chords",
    {"that is the length of the chord": float(np.hypot(30, 8)), "the centre lies on the bisector of AC; measure from B": three - 8},
)
rho_machine = Question.by(drawn_radius("machine", 0.5), "the drawing scale", {"2:1 is not 1:2": 2 * three})
roller = Question.by(
    drawn_radius("machine", 0.35), "the rule, applied in the machine",
    {"the rule was applied to the length on paper": 0.7 * three, "the roller must be smaller than ρ": three / 2},
)

# %% tags=["try-it"]
your_rho_paper = None  # mm of paper
rho_paper.check(your_rho_paper)

# %% tags=["try-it"]
your_rho = None  # mm
rho_machine.check(your_rho)

# %% tags=["try-it"]
your_roller = None  # mm
roller.check(your_roller)

# %% [markdown]
# ## Undercut, seen
#
# A smooth law on a cam that is much too small. Move the roller and watch the circles: where the profile should be, one circle covers the
# contact points of its neighbours.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
small = changed(gc.builtin_task(), {
    "cam.prime_radius": 30.0,
    "follower.roller_radius": 8.0,
    "motion.phases": tuple(changed(p, {"law": "cycloidal"}) if p.kind != "dwell" else p for p in gc.builtin_task().motion.phases),
})
gc.studio(small, view="profile", stills={
    f"roller radius, mm: {radius}": {"follower.roller_radius": radius} for radius in (8, 24)})

# %% [markdown]
# The exact result for the roller of 24 mm, and the largest roller that avoids the cusps:

# %%
cam = gc.solve(changed(small, {"follower.roller_radius": 24.0})).cam
lost = cam.undercuts()[0]
print(f"cusps at {degrees(lost.cusps[0]):.1f}° and {degrees(lost.cusps[1]):.1f}°, "
      f"largest roller {gc.largest_roller(cam):.2f} mm")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert abs(gc.largest_roller(cam) - 18.798) < 0.001
assert not gc.solve(changed(small, {"follower.roller_radius": 18.0})).cam.undercuts()

# %% [markdown]
# ## Drawn and exact

# %%
compared(solution, "min_pitch_curvature_radius", "roller_radius")

# %% jupyter={"source_hidden": true} tags=["remove-input"]
rho = solution.comparison.quantities["min_pitch_curvature_radius"]
chord = float(np.abs(np.diff(curvature.points["triple"])).mean())
unsafe = "on the *unsafe* side: the cam is sharper than drawn" if rho.error > 0 else "on the safe side"
Markdown(f"With an ideal pencil the radius is off by {abs(rho.error):.2f} mm, {unsafe}. With a pencil of 0.2 mm it scatters by "
         f"{np.nanstd(rho.by_hands):.1f} mm. Why?")

# %% [markdown]
# ## Where the error comes from
#
# Two effects pull in opposite directions. Let the points be $h$ apart and each off by $\sigma$ mm.
#
# - **The points are too far apart.** The circle is a mean over the arc. For equal chords the curvature is off by $\kappa'' h^2/12$.
# - **The points are too close.** What is measured is the height of the arc, $h^2/(2\rho)$; an error of $\sigma$ in it gives the radius a
#   relative scatter of
#
# $$ \frac{\Delta\rho}{\rho} \approx \frac{\sqrt6\,\sigma\,\rho}{h^2}. $$

# %%
sigma, rho_on_paper = 0.2, 60.0
table(("chord h, mm", "scatter of ρ, %"), [(f"{h}", 100 * 6**0.5 * sigma * rho_on_paper / h**2) for h in (5, 10, 15, 20, 30)], digits=1)

# %% [markdown]
# With chords of 10 mm a pencil of 0.2 mm gives a scatter of 29 %. With chords of 5 mm the scatter is larger than the radius itself, which is
# pure chance then. **Take points 20 to 30 mm apart, and state on the sheet how far apart they were.** The best distance balances
# the two: $h \approx 2.33\,(\sigma/|\kappa''|)^{1/4}$. Drawn with a pencil, the sheet steps off a part of the phase that goes with the fourth
# root of the line, and without one it says which part to take by hand.
#
# With some laws the sharpest point is the end of a phase, where the curvature jumps: on the other side of it lies the arc of the dwell. But
# there the follower dwells, so that the curve runs square to the ray from $A$. One side is enough: the third point is its mirror image in the ray.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
Markdown(f"On our sheet the chords are {chord:.1f} mm long, because it is drawn without errors; drawn by you they should be longer.")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
# The scatter of circles through three points of a circle of 60 mm, 20 mm apart, and the best distance.
seed = np.random.default_rng(1)
turns = np.array([-1, 0, 1]) * 20 / 60
points = 60 * np.exp(1j * turns) + sigma * (seed.standard_normal((20000, 3)) + 1j * seed.standard_normal((20000, 3)))
radii = np.array([through(*map(complex, row))[1] for row in points])
assert abs(np.std(radii) / 60 / (6**0.5 * sigma * 60 / 20**2) - 1) < 0.05
assert [round(100 * 6**0.5 * sigma * 60 / h**2) for h in (5, 10)] == [118, 29]
# The sum of the squares, (h^2 b / 12)^2 + 6 s^2 / h^4, is least at h^8 = 864 (s / b)^2.
assert abs(864 ** (1 / 8) - 2.33) < 0.002

# %% [markdown]
# ## Questions
#
# 1. The profile is concave on a flank. Which condition must the roller satisfy there?
# 2. Why does the knife-edge follower never undercut, and why is it not used?
# 3. A cam is undercut with a roller of 20 mm. Name three things to change. Which one changes the sheet by the smallest amount?
# 4. Derive $\sqrt6\,\sigma\rho/h^2$: the height of the arc is $B - (A + C)/2$, and all three points are off by $\sigma$.
#
# <details><summary>Model answers</summary>
#
# 1. None: the hollow of the profile has the radius $|\rho| + r$, which is larger than $r$. The cutter or grinding wheel must be smaller than that.
# 2. With $r = 0$ the profile is the pitch curve itself, and no parallel curve can turn back. The edge wears, and its contact stress has no bound.
# 3. A smaller roller, a larger prime radius, a longer phase or a smoother law. The roller: only the working profile is drawn again.
# 4. The variances add: $\sigma^2(1 + \tfrac14 + \tfrac14) = 1.5\,\sigma^2$. The height is $y = h^2/(2\rho)$, so $\Delta\rho/\rho = \Delta y/y = \sqrt{1.5}\,\sigma\cdot 2\rho/h^2 = \sqrt6\,\sigma\rho/h^2$.
#
# </details>
