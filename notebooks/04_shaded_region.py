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
#   title: The shaded region and the minimum radius
# ---

# %% [markdown]
# # 4. The shaded region and the minimum radius
#
# **Aim.** At the end you can find the smallest cam that never pushes too much sideways: draw the combined diagram, shade
# the region in which the cam centre may lie, and choose the centre. And you can say *why* the region lies where it does.
#
# **You need** the displacement and velocity diagrams of notebook 2 (their readings are given below if you missed it) and
# the idea of the pressure angle (it is repeated below). On paper: A4, ruler, protractor, dividers.
# **Time:** 60 minutes, 30 of them with the pencil.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
from math import degrees, radians

import numpy as np
from IPython.display import Markdown

import graphcam as gc
from graphcam.comparison.bounds import ErrorBudget
from graphcam.drafting.ink import reading
from graphcam.notebooks import (
    ArrayQuestion,
    Question,
    changed,
    chart,
    compared,
    lesson_task,
    picture_of,
    show_steps,
    table,
)

# %% [markdown]
# ## What is asked
#
# The cam pushes the follower along the common normal of profile and roller. The follower can only move along its guide.
# The angle between the two directions is the **pressure angle** $\alpha$. Only the component $\cos\alpha$ of the force
# lifts; the component $\sin\alpha$ presses the follower against the side of its guide. At 30° that is half the force;
# the friction of the guide grows with it, until the follower jams (notebook 9). So the task sets a limit $[\alpha]$: usually 30° on the
# rise, where the cam does work, and 60° to 80° on the return, where a spring pushes back.
#
# A large cam has small pressure angles, because the same lift is spread over a longer profile. A small cam is lighter
# and cheaper, and slides less. **What is the smallest cam that stays within the limit everywhere?** One could try
# radii and compute $\alpha$ for each. The construction finds all permitted cams at once.
#
# ## The one idea
#
# From the velocity plan (notebook 3) we know the pressure angle without knowing the profile. With the lift $s$, the
# velocity $v = ds/d\varphi$, the offset $e$ and the height $s_0$ of the lowest position above the cam centre
#
# $$ \tan\alpha = \frac{v - \sigma e}{s_0 + s}, $$
#
# where $\sigma = +1$ for a cam that turns anticlockwise and $-1$ for one that turns clockwise. Do not compute it.
# *Look* at it: it is the ratio of a horizontal and a vertical length. So draw a right triangle:
#
# - the vertical leg $s_0 + s$ runs from the height of the cam centre $A$ up to the height $s$ of the follower;
# - the horizontal leg runs from the follower's line, at the distance $e$ from the centre, out to the end $D$ of a
#   segment of length $v$ that is drawn *at the height* $s$.
#
# Then **the angle at $A$ between the vertical and the line $AD$ is the pressure angle itself.** Standing at $A$ and
# looking up at the point $D$ of some station, we see it at exactly the pressure angle of that station.
#
# Turn this round. The points $D_0, D_1, \dots$ depend only on the motion: $s$ and $v$. They can be drawn *before* the
# cam exists. Then each possible centre $A$ is a point from which we look at them. A point is good if no $D$ of the rise
# is seen from it at more than $[\alpha]$. Every $D$ forbids all points on one side of a line through it; the region is
# what no $D$ forbids.
#
# ## The construction, step by step
#
# Our task is that of the file `task.toml` with one more limit, so that you see everything that can occur: 30° on the rise, 50°
# on the return. The follower's offset is to be found.

# %%
task = changed(lesson_task("task.toml", "translating"), {
    "follower.offset": None,
    "limits.pressure_angle_rise": 30.0,
    "limits.pressure_angle_return": 50.0,
})
solution = gc.solve(task)
region = solution.drawn["minimum_radius"]

# %% [markdown]
# **Predict.** From which of the points $D_0, D_1, \dots$ do you expect the lowest line at 30°: the one where $v$ is largest, an earlier or a later
# one?
#
# **Draw it.** `graphcam solve task.toml --upto integration --out half` prints the sheet with the diagrams of $s$ and $v$; the region goes
# beside them, in the scale of $s$.
#
# The readings from notebook 2, at the stations of the rise. **Segments and heights must have the same scale**, otherwise the
# angles are wrong, so each $v$ (in mm/rad) is divided by $\mu_s$ and not by $\mu_v$:

# %% jupyter={"source_hidden": true} tags=["remove-input"]
read = solution.drawn["integration"].readings
mu_s = float(read["s"].scale)
s, v = read["s"], read["v"]
rise, back = solution.chain.spans[:2]
sigma = {"ccw": 1, "cw": -1}[task.rotation]
sense, side, other = {"cw": ("clockwise", "right", "left"), "ccw": ("anticlockwise", "left", "right")}[task.rotation]
table(
    ("station of the rise", "s on paper, mm", "v, mm/rad", "v to lay off, mm"),
    [(f"{k}", float(s.paper[k]), float(v.value[k]), float(v.value[k]) / mu_s) for k in range(rise.start, rise.stop)],
    digits=1,
)

# %% [markdown]
# **First the points.** Draw the follower's line of motion vertical and mark the start of the lift on it: the lowest
# position of the follower, $s = 0$. Mark the heights $s_1, s_2, \dots$ above it. At each height lay off $v$ *turned from
# the direction of motion by 90° in the sense in which the cam rotates*. No rule of signs needs to be remembered: turn the arrow of
# the velocity with the cam.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
Markdown(f"The scale of the displacement is $\\mu_s = {mu_s:.3f}$ mm per mm of paper. Our cam turns {sense}, and on the rise the follower moves up; "
         f"up, turned {sense} by a quarter turn, is to the **{side}**. On the return it moves down, so the segments go to the **{other}**.")

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(region, 1, within=solution)

# %% [markdown]
# The ends are joined by two smooth curves. In the lowest and in the highest position the follower dwells, $v = 0$, and
# the curves meet the line of motion. (With constant acceleration $v^2$ grows in proportion to $s$: the curves would be
# parabolas, with a corner in the middle, where that acceleration jumps.)

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(region, 2, within=solution)

# %% [markdown]
# **Then the lines.** Take one end, say $D_3$. From which points $A$ is it seen at *exactly* 30° to the vertical? From all
# points of the line through $D_3$ at 30° to the vertical. From above this line $D_3$ is seen at more
# than 30°; from *below*, at less. So $D_3$ permits one half of the paper. Do this for every $D$ of the
# rise: you get a set of **parallel** lines, because the angle is always the same. Only the outermost one matters: whatever
# satisfies it satisfies all the others. The outermost of parallel lines that still touches a curve is its **tangent**.
# That is why *one* line replaces twelve: **the tangent to the curve of the rise at the permitted angle**.
#
# Set the protractor to 30°, lean the ruler, and shift it parallel until it just touches the curve: a little below the point of the
# maximum velocity.
#
# **Write it.** Each line of the rise meets the line of motion at some depth below the start of the lift: the centre of a cam with a central follower
# must lie at least so deep. From the `heights` $s$ and the `segments` $v$ of the rise, both in mm of paper, compute the depths of the lines
# at 30°. The tangent is the deepest of them. One line is enough.

# %%
heights, segments = s.paper[rise], v.value[rise] / mu_s

# %% jupyter={"source_hidden": true} tags=["remove-input"]
aside, up = np.abs(region.points["ends"][rise].real), region.points["ends"][rise].imag
depth_lines = ArrayQuestion(
    aside / np.tan(radians(30)) - up, 1e-6, "the right triangle of D, with 30° at the cam centre",
    {"from D down to the line of motion is the leg divided by tan 30°, not times it": aside * np.tan(radians(30)) - up,
     "the depth is counted from the start of the lift: subtract the height of D": aside / np.tan(radians(30)),
     "NumPy's tan takes radians": aside / np.tan(30) - up},
)

# %% tags=["try-it"]
your_depths = None  # mm of paper, one for each station of the rise, from heights and segments
depth_lines.check(your_depths)

# %% tags=["hide-input"]
depths = segments / np.tan(radians(30)) - heights
print(f"deepest: station {depths.argmax()}, {depths.max():.2f} mm of paper below the start; v is largest at station {segments.argmax()}")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert depth_lines.check(depths).status == "right"
assert depths.argmax() <= segments.argmax()

# %% [markdown]
# The return's curve lies on the other side, so its tangent leans the other way, at its own limit of 50°. And there is
# a third line, easily forgotten: in the lower dwell the follower does not move, $v = s = 0$, yet the cam still
# supports it, and the angle there is $\tan\alpha = -\sigma e/s_0$. Its point $D_0$ is the start of the lift, and the
# line through it at 30° is the **dwell line**.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(region, 3, within=solution)

# %% [markdown]
# **The region** is what all three lines permit. It is open downwards: the further down, the larger the cam, and a large
# cam is always permitted. It is convex, because each line cuts off half of the paper. The best centre lies on the side to which $v$ of
# the rise was laid off: from there the points of the rise are seen more steeply. That is what a favourable offset means; for a clockwise
# cam the follower stands to the *left* of the centre, for an anticlockwise one to the right.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(region, 4, within=solution)

# %% [markdown]
# **Last the choice.** The distance from the centre $A$ to the start of the lift is the prime radius, because at the start
# the follower is at its lowest:
#
# $$ r_0 = \sqrt{s_0^2 + e^2}. $$
#
# So the smallest permitted cam has its centre at the *point of the region nearest to the start of the lift*. Often that
# is a corner of the region, sometimes the foot of a perpendicular to a side: measure both. There are three cases:
#
# | the task says | the centre is |
# |:--|:--|
# | nothing about the offset | the region's point nearest to the start of the lift |
# | the offset $e$ | where the vertical line at the distance $e$ enters the region |
# | a central follower, $e = 0$ | where the line of motion itself enters the region |

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(region, 5, within=solution)

# %% [markdown]
# Often the nearest point is the *apex*, where the two tangents cross, and many books always take the apex. That is
# not always right. For a cycloidal rise over 60° and return over 240° with limits of 30° and 85° the apex gives a radius
# of 46.98 mm, but this violates the dwell line; the smallest permitted cam has 49.16 mm. Without the dwell line you
# would find 42.58 mm. So look at the region, not at a rule.

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
odd = gc.Motion([gc.Rise(30, radians(60), "cycloidal"), gc.Dwell(radians(30)), gc.Return(30, radians(240), "cycloidal"), gc.Dwell(radians(30))])
least = gc.minimum_radius(odd, gc.Translating(), rotation="cw", rise=radians(30), return_=radians(85))
assert abs(least.prime_radius - 49.16) < 0.005
assert set(least.active) == {"rise", "rest"}
# The two tangents, and the distance of their crossing and of the foot on that of the rise: without the dwell line.
at = np.linspace(0, 2 * np.pi, 400001)
heights, speeds = odd(at)[:2]
up, down = np.tan(radians(30)), np.tan(radians(85))
need, back_need = (speeds - heights * up).max(), (-speeds - heights * down).max()
depth = (need + back_need) / (up + down)
apex = np.hypot(depth, depth * down - back_need)
assert abs(apex - 46.98) < 0.005
depth = np.linspace(1, 100, 200001)
across = need - depth * up
assert abs(np.hypot(depth, across)[across <= depth * down - back_need].min() - 42.58) < 0.01

# %% [markdown]
# ## Do not believe it: look from every place
#
# The following map does what we could not do by hand. For every point of the paper it looks at all points $D$ of the
# rise, the return and the lower dwell, and notes whether a limit is exceeded. No tangent is drawn, no formula of the
# region is used. White is permitted. The lines are those of our construction.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
ends = region.points["ends"]
reach = 1.6 * max(abs(complex(region.points["centre"])), np.abs(ends).max())
x, y = np.meshgrid(np.linspace(-reach, reach, 241), np.linspace(-1.1 * reach, 0.6 * reach, 191))
places = x + 1j * y
# The angle to the vertical under which each place sees each D: positive to the side on which v of the rise lies.
seen = np.degrees(sigma * np.angle((ends[:, None, None] - places) / 1j))
over = {
    "rise": seen[rise].max(axis=0) > 30,
    "return": (-seen[back]).max(axis=0) > 50,
    "rest": np.abs(seen[0]) > 30,
}
figure, axes = chart("mm of paper", "mm of paper", 4.4)
forbidden = np.where(over["rise"] | over["return"] | over["rest"], 1.0, 0.0)
axes.contourf(x, y, forbidden, levels=[0.5, 1.5], colors=["#d8dce2"])
axes.plot(ends.real, ends.imag, ".", color="black", markersize=4)
for name, angle, leans in (("rise", 30, 1), ("return", 50, -1), ("rest", 30, -1)):
    touch = complex(region.points[name])
    down = np.array([0, 2 * reach]) * np.exp(-1j * (np.pi / 2 - sigma * leans * radians(angle)))
    axes.plot((touch + down).real, (touch + down).imag, color="#b3201c", linewidth=1)
centre = complex(region.points["centre"])
axes.plot([0, centre.real], [0, centre.imag], color="#0b57a4", marker="o")
axes.annotate("A", (centre.real, centre.imag), xytext=(6, -4), textcoords="offset points")
axes.set(xlim=(-reach, reach), ylim=(-1.1 * reach, 0.6 * reach), aspect="equal")
picture_of(
    figure,
    "A map of the paper: grey where some pressure angle exceeds its limit. The white rest is "
    "a wedge open downwards, bounded by the three drawn lines, with A at its point nearest to the start.",
    "Where some limit is exceeded (grey), found by looking from every point; the drawn lines bound what is left",
)

# %% [markdown]
# The white wedge found by brute force is the shaded region of the drawing. The lines *are* its boundary, because each
# of them is the set of points from which one point is seen at exactly its limit.

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
# A millimetre inside the region no limit is exceeded, a millimetre outside, towards the start, one is.
def exceeded(place):
    sees = np.degrees(sigma * np.angle((ends - place) / 1j))
    return max(sees[rise].max() - 30, (-sees[back]).max() - 50, abs(sees[0]) - 30)


assert exceeded(centre - 1j) <= 0.1
assert exceeded(centre + 1j) > 0
assert exceeded(centre) < 0.3  # the curve between the stations reaches a little further

# %% [markdown]
# ## Do it on paper
#
# 1. Line of motion vertical, start of the lift marked; heights $s_i/\mu_s$ above it.
# 2. At each height $v_i/\mu_s$ (the *same* scale) turned from the velocity with the cam's rotation; number the ends.
# 3. Draw the two smooth curves.
# 4. Tangent to the curve of the rise at $[\alpha]$, to that of the return at its limit (none with force closure),
#    line through the start at $[\alpha]$ on the other side.
# 5. Shade the region that all lines permit, downwards.
# 6. Choose the centre; measure its distance from the start; times $\mu_s$ it is $r_0$. Measure $e$ and $s_0$ too.
# 7. Round $r_0$ **up**: a larger cam is permitted, a smaller one is not.
#
# ## Try it yourself
#
# Let the limit on the rise be **40°** instead of 30°, with everything else unchanged. Two new lines on your drawing are
# enough. Measure the distance from the start of the lift to the new centre.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
eased = gc.solve(changed(task, {"limits.pressure_angle_rise": 40.0}))
centred = gc.solve(changed(task, {"follower.offset": 0.0}))
before = region.readings["prime_radius"]


def radius_drawn(solved, on_paper=False):
    """How the minimum radius of a solution is drawn by any pencil, from the acceleration on."""
    def draw(pencil):
        read = solved.chain.by(pencil)["minimum_radius"].readings["prime_radius"]
        return reading(read.paper, 1.0, "mm of paper") if on_paper else read
    return draw


new = eased.drawn["minimum_radius"].readings["prime_radius"]
distance = Question.by(
    radius_drawn(eased, on_paper=True), "the choice of the centre, the last step",
    {"that is already the machine's radius": float(new.value), "that is still the centre for 30°": float(before.paper)},
)
prime_radius = Question.by(radius_drawn(eased), "the last step, and the scale μₛ", exact=eased.comparison.least[0])
central = Question.by(
    radius_drawn(centred), "the table of the three cases: where does the line of motion enter the region?",
    {"that is the radius at the best offset": float(before.value)}, exact=centred.comparison.least[0],
)
drawn_angle = Question(
    degrees(np.arctan(np.tan(radians(30)) * 0.6 / 0.859)), 0.5, "degrees", "the slope with two scales",
    {"the scales are inverted": degrees(np.arctan(np.tan(radians(30)) * 0.859 / 0.6)),
     "the tangents are in proportion, not the angles": 30 * 0.6 / 0.859,
     "30° would be right only with equal scales": 30.0},
    found_by="calculation",
)

# %% tags=["try-it"]
your_distance = None  # mm of paper
distance.check(your_distance)

# %% [markdown]
# And now the prime radius itself, in millimetres of the machine:

# %% tags=["try-it"]
your_r0 = None  # mm
prime_radius.check(your_r0)

# %% [markdown]
# Back to 30°. Now the follower is to be **central**. Draw nothing new; one more measurement on your drawing is enough.
# What is $r_0$?

# %% tags=["try-it"]
your_central_r0 = None  # mm
central.check(your_central_r0)

# %% [markdown]
# A fellow student took $v$ in its own scale, $\mu_v = 0.859$ (mm/rad)/mm, beside $s$ in $\mu_s = 0.6$ mm/mm, and drew
# the tangent at 30°. Which angle should it have been? The drawn slope is $\tan\alpha_{\text{drawn}} =
# \tan\alpha\;\mu_s/\mu_v$, because a length of $v$ has become shorter than one of $s$.

# %% tags=["try-it"]
your_angle_deg = None  # degrees
drawn_angle.check(your_angle_deg)

# %% [markdown]
# ## Move the sliders
#
# The limits move the lines, the offset moves the point on them. Answer before you look: which way does the tangent of the
# rise move when its limit grows from 30° to 40°? What does force closure (no limit on the return) do? What happens with an
# offset on the wrong side?


# %% jupyter={"source_hidden": true} tags=["remove-input"]
gc.studio(task, view="combined", stills={
    **{f"limit on the rise, °: {limit}": {"limits.pressure_angle_rise": limit} for limit in (25, 40)},
    "limit on the return, °: none": {"limits.pressure_angle_return": None},
    f"offset, mm: {-10 * sigma}": {"follower.offset": -10 * sigma},
})

# %% [markdown]
# ## Drawn and exact
#
# The exact side solves the three inequalities
#
# $$ s_0\tan[\alpha] + \sigma e \ge \max_{\text{rise}}\,(v - s\tan[\alpha]), \quad
# s_0\tan[\alpha'] - \sigma e \ge \max_{\text{return}}\,(|v| - s\tan[\alpha']), \quad
# \sigma e \le s_0\tan[\alpha] $$
#
# for the minimum $r_0$, with the closed formulas of the law. The maxima are the intercepts of our tangents.

# %%
compared(solution, "minimum_prime_radius", "minimum_offset")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
exact = gc.minimum_radius(
    task.motion(), gc.Translating(), rotation=task.rotation, rise=radians(30), return_=radians(50), offset=None
)
quantity = solution.comparison.quantities["minimum_prime_radius"]
assert abs(quantity.exact - exact.prime_radius) < 1e-9
assert sigma * exact.offset >= 0

# %% [markdown]
# ## Where the error comes from
#
# With an ideal pencil only from the readings of $s$ and $v$: the region needs nothing but points and tangents. If the
# tangent is drawn through *plotted* points instead of the smooth curve, it can only lie too far inside, so the radius
# comes out **too small, on the unsafe side**, whenever the true point of contact lies between two stations.
#
# With a real pencil every kind of act has its share. Here are the shares in the variance of the radius, for the pencil of 0.2 mm:

# %%
budget = ErrorBudget(solution.chain, gc.Pencil.of(0.2)).of("minimum_radius", "prime_radius")
shares = sorted(((100 * share, kind.value) for kind, share in budget.of.items()), reverse=True)
table(("act", "share of the variance, %"), [(name, share) for share, name in shares if share > 0.5], digits=0)

# %% [markdown]
# $s$ and $v$ come from a chain of chords, each drawn parallel to its ray and carrying the errors of those before it.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
of_protractor = {name: share for share, name in shares}["protractor"]
Markdown(f"The largest share has *{shares[0][1]}*, {shares[0][0]:.0f} %; the protractor has {of_protractor:.0f} %.")

# %% [markdown]
# What does a protractor cost that is set wrongly by half a degree?

# %%
def radius_at(limit):
    motion = task.motion()
    return gc.minimum_radius(motion, gc.Translating(), rotation=task.rotation, rise=radians(limit), return_=radians(50)).prime_radius


half_degree = (radius_at(29.5) - radius_at(30.5)) / 2
print(f"half a degree changes the radius by {half_degree:.2f} mm; the scatter of a drawing is {mu_s * budget.deviation:.2f} mm")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert abs(sum(share for share, _ in shares) + 100 * budget.together - 100) < 1e-6
assert abs(100 * np.tan(radians(30)) - 57.7) < 0.05

# %% [markdown]
# Where you want the angle better than a protractor has it, use its tangent: for 30° go 100 mm down and 57.7 mm aside.
#
# ## Questions
#
# 1. Why are the lines of all stations parallel, and why would they not be if the limit differed from station to station?
# 2. The region is never closed below. What does that say about a cam that is large enough?
# 3. Which two of the three lines are active in our task? How do you see on the drawing that the third does not
#    matter?
# 4. The same motion with a cam that turns anticlockwise: which part of the drawing changes, and how does the sign
#    of the best offset change?
# 5. In which case is the nearest point of the region *not* a corner?
#
# <details><summary>Model answers</summary>
#
# 1. All are drawn at the same angle to the vertical. With a limit of its own each station would have its own direction, and no single tangent would replace them.
# 2. That it keeps any limit: with $s_0$ all angles go to zero.
# 3. Those on which $A$ lies: the tangents of the rise and of the return, with the task of the course. The dwell line passes beside $A$, and $A$ lies on its permitted side.
# 4. All of it is mirrored in the line of motion: $v$ is laid off to the other side, and the best offset changes its sign.
# 5. Where the foot of the perpendicular from the start to a side lies between the ends of that side: often with force closure, where the return has no line.
#
# </details>
