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
#   title: "Graphical integration and differentiation"
# ---

# %% [markdown]
# # 2. Integration with a pole, and differentiation back
#
# **Aim.** At the end you can turn a drawn acceleration into a velocity and a displacement with nothing but ruler and
# pencil, say what a millimetre of each diagram means, and go back again from a displacement.
#
# **You need** the acceleration diagram of notebook 1. On paper: A3, ruler, two set squares (for parallels), pencil.
# **Time:** 60 minutes, 35 of them with the pencil.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
import numpy as np
from IPython.display import Markdown

import graphcam as gc
from graphcam.constructions.differentiation import differentiation
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
# ## Background: why a pole integrates
#
# To integrate $a(\varphi)$ means to find a curve $v$ whose *slope* is $a$ everywhere. An ordinate is a length, a slope is a
# direction; what turns the one into the other is a right triangle with a fixed leg. Put the **pole** $P$ on the axis, the
# distance $H$ to the left of the origin. Carry an ordinate of the length $y$ over to the vertical axis and join its end to
# the pole: the **ray** has the slope
#
# $$ \tan\beta = \frac{y}{H}. $$
#
# A **chord** drawn parallel to this ray across a part of the width $\Delta x$ climbs by $\Delta Y = y\,\Delta x/H$. Chord
# after chord, each from the end of the previous one, this adds up to $\frac{1}{H}\sum y\,\Delta x$: the area, divided by
# $H$.
#
# **Which ordinate stands for a part?** The one in its *middle*. A part whose curve is straight has exactly the area
# "middle ordinate times width", so only the *curvature* of the curve inside a part causes an error, and it shrinks
# with the square of the number of parts. With the ordinate at the end of each part it would shrink only in
# proportion.
#
# **What does a millimetre mean?** Let $\mu_\varphi$ be radians per mm of the axis and $\mu_a$, $\mu_v$, $\mu_s$ the machine
# units per mm of the three diagrams. A chord of the first integration stands for
# $\Delta v = a\,\Delta\varphi = (\mu_a y)(\mu_\varphi\Delta x)$, and is drawn as $\Delta Y = y\,\Delta x/H_1$. So
#
# $$ \mu_v = \mu_a\,\mu_\varphi\,H_1, \qquad \mu_s = \mu_v\,\mu_\varphi\,H_2. $$
#
# The acceleration was drawn in an unknown scale. But the *lift* is known, so it is read backwards: measure the maximum
# displacement on the paper, and
#
# $$ \mu_s = \frac{h}{s_{\max}^{\text{paper}}}, \qquad \mu_v = \frac{\mu_s}{\mu_\varphi H_2}, \qquad
# \mu_a = \frac{\mu_v}{\mu_\varphi H_1}. $$
#
# Here $\mu_\varphi$ is in **radians** per millimetre: 1° to the mm is 0.01745 rad/mm. If you choose $H = 1/\mu_\varphi = 57.3$
# mm, the scales of two neighbouring diagrams are numerically equal.
#
# ## The construction
#
# The task of notebook 1, from the file `task.toml`:

# %%
task = lesson_task("task.toml", by_laws=True)
solution = gc.solve(task)
integration = solution.drawn["integration"]

# %% jupyter={"source_hidden": true} tags=["remove-input"]
rising = next(phase for phase in task.motion().phases if isinstance(phase, gc.Rise))
parts, poles = solution.chain.spans[0].stop - 1, integration.givens.poles
Markdown(f"Each phase has {parts} parts; the poles are {poles[0]:g} and {poles[1]:g} mm from the origin.")

# %% [markdown]
# **Predict.** Of the chords of $v$ on the rise, which is the steepest, and where is $v$ largest? And what if the law had its acceleration
# constant, up and then down: which figure would the chords make? Sketch both before you look.
#
# **Draw it.** `graphcam solve task.toml --upto acceleration --out half` prints the sheet with the acceleration diagram drawn; the
# axes of $v$ and $s$ wait for you.
#
# **First integration, a to v.** Every middle ordinate has its ray, and every ray its chord.
# In a phase the chords start on the axis and must return to it: the follower is at rest before and after.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(integration, 1, 2, 3, within=solution)

# %% [markdown]
# **Second integration, v to s.** The same again, with the middle ordinates of $v$. They are read from the polygon just
# drawn: halfway between the ends of a chord. The return's chords go down because its velocity is negative; where they end
# shows whether the ordinates of notebook 1 were right.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(integration, 4, 5, 6, within=solution)

# %% [markdown]
# **The scales** come last, and they come from the lift alone:

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(integration, 7, 8, 9, within=solution)

# %% [markdown]
# **Write it.** A pole integrates by one running sum: each chord climbs by the ordinate times the width of the part, divided by the pole
# distance. From the `middles` of $a$ and the `widths` of the parts of the rise, all in mm of paper, compute the heights at which the chords
# of $v$ end, with the first one, 0; then those of $s$, whose middle ordinates are the means of the ends of the chords of $v$. Four lines are enough.

# %%
diagram = solution.drawn["acceleration"]
axis = diagram.points["axis"].real  # the stations of the rise come first
widths = np.diff(axis[: parts + 1])
middles = diagram.readings["middles"].paper[:parts]
first_pole, second_pole = poles

# %% jupyter={"source_hidden": true} tags=["remove-input"]
# But for residuals, which the drawing distributes.
residual = {name: float(np.abs(integration.readings[f"closing_{name}"].paper).max()) for name in "vs"}
ends_v, ends_s = (integration.readings[name].paper[: parts + 1] for name in "vs")
off_s = residual["s"] + residual["v"] * axis[parts] / poles[1]
velocities = ArrayQuestion(
    ends_v, 1e-6 + residual["v"], "what a chord climbs: ordinate times width over the pole distance",
    {"the pole distance is forgotten": ends_v * poles[0], "the first chord begins at 0: put it in front": np.append(ends_v[1:], 0.0)},
)
displacements = ArrayQuestion(
    ends_s, 1e-6 + off_s, "the ordinate at the middle of a chord of v",
    {"the second pole distance is forgotten": ends_s * poles[1],
     "the ordinate is that at the middle of the part, not at its end": np.append(0, np.cumsum(ends_v[1:] * widths / poles[1]))},
)

# %% tags=["try-it"]
your_v = None  # parts + 1 heights, from middles, widths and first_pole
velocities.check(your_v)

# %% tags=["try-it"]
your_s = None  # parts + 1 heights, from your_v, widths and second_pole
displacements.check(your_s)

# %% tags=["hide-input"]
def by_pole(ordinates, widths, pole):
    """The ends of the chords on paper: the running sum of ordinate times width over the pole distance."""
    return np.concatenate([[0.0], np.cumsum(ordinates * widths / pole)])


v = by_pole(middles, widths, first_pole)
s = by_pole((v[1:] + v[:-1]) / 2, widths, second_pole)
print(f"s at the end of the rise: {s[-1]:.3f} mm of paper; on the drawing {float(integration.readings['s'].paper[parts]):.3f} mm")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert velocities.check(v).status == displacements.check(s).status == "right"
assert np.abs(v - ends_v).max() < 1e-9 + residual["v"]
assert np.abs(s - ends_s).max() < 1e-9 + off_s

# %% [markdown]
# ## Try it yourself
#
# The sheet of a fellow student: the axis has **2° to the millimetre**, the poles are $H_1 = 30$ mm and $H_2 = 50$ mm, the lift is
# 24 mm and the maximum displacement on paper measures 60 mm. What are the three scales?

# %% jupyter={"source_hidden": true} tags=["remove-input"]
mu_phi = np.radians(2)
mu_s = 24 / 60
mu_v = mu_s / (mu_phi * 50)
mu_a = mu_v / (mu_phi * 30)
scale_s = Question(mu_s, 0.002, "mm/mm", "the known lift and its length on paper", {"that is its inverse": 60 / 24}, found_by="calculation")
scale_v = Question(
    mu_v, 0.002, "(mm/rad)/mm", "the formula of μᵥ",
    {"the pole distance H₂ is forgotten": mu_s / mu_phi, "the first pole belongs to the first integration": mu_s / (mu_phi * 30),
     "the axis is in degrees; μᵩ must be in radians": mu_s / (2 * 50), "the axis has 2° to the millimetre": 2 * mu_v},
    found_by="calculation",
)
scale_a = Question(
    mu_a, 0.005, "(mm/rad²)/mm", "the formula of μₐ",
    {"the pole distance H₁ is forgotten": mu_v / mu_phi, "the poles are exchanged": mu_v / (mu_phi * 50),
     "the axis is in degrees; μᵩ must be in radians": mu_v / (2 * 30)},
    found_by="calculation",
)

# %% tags=["try-it"]
your_mu_s = None  # mm/mm
scale_s.check(your_mu_s)

# %% tags=["try-it"]
your_mu_v = None  # (mm/rad)/mm
scale_v.check(your_mu_v)

# %% tags=["try-it"]
your_mu_a = None  # (mm/rad²)/mm
scale_a.check(your_mu_a)

# %% [markdown]
# ## Move the sliders
#
# More parts, another pole. Before you look: does a longer pole distance make the next diagram higher or flatter? And does
# it change the *velocity*, in mm/rad?


# %% jupyter={"source_hidden": true} tags=["remove-input"]
gc.studio(task, view="velocity", stills={
    **{f"parts of each phase: {parts}": {"drawing.divisions": parts} for parts in (4, 24)},
    **{f"pole distance H₁, mm: {pole}": {"drawing.poles": [pole, poles[1]]} for pole in (30, 60)},
})

# %% [markdown]
# ## The way back: differentiation
#
# A measured displacement has to be differentiated. Everything is reversed: draw the **chord** of the curve across a part,
# draw the parallel to it through the pole, and read off the ordinate that it cuts on the vertical axis. It belongs to the
# *middle* of the part. Here the rise just drawn is differentiated twice, with the same poles in the reverse order:

# %% jupyter={"source_hidden": true} tags=["remove-input"]
rise = slice(0, parts + 1)
drawn_s, mu_phi = integration.readings["s"], gc.Scale(float(diagram.readings["base"].scale), "rad")


def differentiated(pencil):
    return differentiation(axis[rise], drawn_s.paper[rise], mu_phi, gc.Scale(float(drawn_s.scale), "mm"), poles[::-1], pencil)


back = differentiated(gc.Pencil())
show_steps(back, 2, 3, 4)

# %% [markdown]
# A chord has the *mean* slope of its part, so the maximum velocity, which the curve has at one point only, is missed; the second
# differentiation misses more. That is the error of the method. Drawn by hand there is the other one, and this is the great
# difference between the two directions: **integration smooths errors, differentiation amplifies them.**

# %% jupyter={"source_hidden": true} tags=["remove-input"]
hands = differentiated(gc.Pencil.of(0.2, samples=400, seed=1))
begins = task.motion().starts[task.motion().phases.index(rising)]
_, true_v, true_a, _ = task.motion()(begins + np.linspace(0, rising.angle * (1 - 1e-9), 20001))
rows = []
for name, exact in (("max_v", true_v.max()), ("max_a", np.abs(true_a).max())):
    ideal, by_hand = float(back.readings[name].value), hands.readings[name].value
    off = 100 * (by_hand / exact - 1)
    rows.append((f"maximum {name[-1]} of the rise", 100 * (ideal / exact - 1), float(off.mean()), float(off.std())))
table(("differentiated", "ideal pencil, %", "400 careful drawings: bias, %", "scatter, %"), rows, digits=1)

# %% jupyter={"source_hidden": true} tags=["remove-input"]
width = widths.mean()
turn = np.degrees(np.arctan(0.2 / width))
Markdown(f"An error of 0.2 mm at one end of a chord {width:.1f} mm wide turns the chord by {turn:.1f}°, and at a pole distance of "
         f"{poles[1]:g} mm that is {0.2 / width * poles[1]:.1f} mm of velocity; the second differentiation does it again.")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert rows[0][1] < 0  # the mean slope misses the greatest one
assert rows[1][3] > 2 * rows[0][3]

# %% jupyter={"source_hidden": true} tags=["remove-input"]
trembling = differentiated(gc.Pencil.of(0.2, seed=3))
figure, axes = chart("axis, mm", "ordinate on paper, mm", 2.8)
for c, style, label in ((back, "-", "ideal pencil"), (trembling, "o", "pencil of 0.2 mm")):
    for name, colour in (("v", "#0b57a4"), ("a", "#b3201c")):
        points = c.points[name]
        axes.plot(points.real, points.imag, style, color=colour, label=f"{name}, {label}", markersize=4, linewidth=1)
axes.legend(fontsize=8)
picture_of(figure, "Velocity and acceleration found by differentiating a displacement of a rise: with an ideal pencil two smooth "
           "curves; with a pencil of 0.2 mm the velocity scatters a little, the acceleration very much.",
           "Differentiated twice: the velocity (blue) is noisy, the acceleration (red) is lost")

# %% [markdown]
# That is why the coursework starts from the acceleration.
#
# ## Drawn and exact

# %%
compared(solution, "max_v", "max_a")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
straight = gc.solve(gc.builtin_task()).comparison.quantities
assert abs(straight["max_v"].error) < 1e-9

# %% [markdown]
# With constant acceleration (the rectangular law) drawn and exact would agree to the last digit: straight lines have no curvature. With
# other laws they do not. The cycloidal law by this method gives the lift $\frac{\pi/n}{\sin(\pi/n)}$ times too large; the scale, which is fixed by the lift,
# removes this factor, and a small error of *shape* remains, about $\pi/(6n^2)$ of the lift:

# %%
errors = {}
smooth = changed(gc.builtin_task(), {"motion.phases": tuple(
    changed(p, {"law": "cycloidal"}) if p.kind != "dwell" else p for p in gc.builtin_task().motion.phases)})
for parts in (6, 12, 24, 48):
    finer = gc.solve(changed(smooth, {"drawing.divisions": parts}))
    stations = finer.comparison
    errors[parts] = float(np.abs(stations.drawn_stations["s"] - stations.exact_stations.values[0]).max()) / 30
table(("parts n", "maximum error of s, % of the lift", "π/(6n²), %"),
      [(n, 100 * e, 100 * np.pi / (6 * n**2)) for n, e in errors.items()])

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert abs(errors[12] - 0.0037) < 0.0003
assert abs(errors[12] / errors[24] - 4) < 0.2
for parts, factor in ((12, 1.0115), (24, 1.0029)):  # the lift before its scale is known
    ordinates = gc.law("cycloidal")((np.arange(parts) + 0.5) / parts)[2]
    ends = by_pole(ordinates, 1 / parts, 1.0)
    lift = by_pole((ends[1:] + ends[:-1]) / 2, 1 / parts, 1.0)[-1]
    assert abs(lift - np.pi / parts / np.sin(np.pi / parts)) < 1e-9
    assert abs(lift - factor) < 1e-4
# Notebook 7: twelve parts are smaller an error than a pencil of 0.2 mm makes.
scattered = gc.solve(smooth, gc.Pencil.of(0.2, samples=400, seed=1)).drawn["integration"].readings["s"].value.std(axis=0).max() / 30
assert errors[12] < scattered / 2

# %% [markdown]
# Twice the parts, a quarter of the error: the method is of *second order*. At 12 parts the error of 0.4 % is already
# less than half of what a pencil of 0.2 mm adds. Drawing 24 parts is wasted work.
#
# ## Where the error comes from
#
# 1. **The method**: the curvature inside a part; second order in $n$, zero for straight ordinates.
# 2. **The drawing errors**: each chord starts where the last one ended, with its error. Independent errors add as $\sqrt n$: with
#    more parts the drawing errors *grow*. The best $n$ is a compromise, and notebook 7 finds it.
# 3. **The closing error**: the residual of $v$ at the end of a phase is removed by rotating the base line; the residual of $s$ is
#    distributed over the return. It must be *stated* on the sheet: a sheet that closes perfectly has been adjusted.
#
# ## Questions
#
# 1. What happens to the three scales if you take $H_1$ twice as long? And to the readings in machine units?
# 2. Why is the end ordinate of a part the wrong choice, and for which law does it make no difference?
# 3. The velocity diagram of a rise does not come back to the axis. Name two causes, and say how to tell them
#    apart.
# 4. A displacement was measured every 5° to 0.05 mm. Would you differentiate it once with chords of 5° or of 10°?
#
# <details><summary>Model answers</summary>
#
# 1. On paper $v$ and $s$ become half as high, so $\mu_v$ and $\mu_s$ are doubled; $\mu_a = \mu_v/(\mu_\varphi H_1)$ stays. The readings in machine units do not change.
# 2. It leaves out how the curve rises or falls within the part, so its error falls with $1/n$ only. It makes no difference where the acceleration is constant in every part: with the rectangular law.
# 3. Unequal areas under $a$ (a wrong ordinate or a curve plotted wrongly), or errors of the chords. Draw it again: what comes back the same is in the ordinates, what changes is drawing.
# 4. Of 10°: an error of the measurement turns a chord of twice the length by half as much, and the error of the method, though four times as large, is still small for a smooth motion.
#
# </details>
