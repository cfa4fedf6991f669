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
#   title: "How exact is a drawing"
# ---

# %% [markdown]
# # 7. How exact is a drawing?
#
# **Aim.** At the end you can say, for every number on your sheet, how far it can be trusted; you know how many parts are worth drawing, and
# what a computer adds.
#
# **You need** notebooks 2 and 4, and an idea of mean and standard deviation. **Time:** 50 minutes, no pencil.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
import tomllib
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np
from IPython.display import Markdown, display

import graphcam as gc
from graphcam.comparison.bounds import ErrorBudget
from graphcam.notebooks import (
    Question,
    Slider,
    changed,
    chart,
    drawing,
    explore,
    lesson_task,
    picture_of,
    table,
)
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable

# %% [markdown]
# ## Background: two kinds of error
#
# **The error of the method** remains with an ideal pencil: a curve is replaced by chords. It depends on the number of parts $n$ and falls, for
# the pole construction, with $1/n^2$.
#
# **The drawing error** remains with the best method: a sharp line is 0.1 to 0.2 mm wide; dividers repeat to 0.1 to 0.3 mm; a rule is read to half a
# division, 0.5 mm; a protractor to half a degree. These errors are random, so they do not simply add: $n$ independent errors of size $\sigma$ add up
# to about $\sqrt n\,\sigma$. But each chord passes its error on to all that follow, so **with more parts the drawing error grows**.
#
# One falls with $n$, the other grows. There is a best number of parts.
#
# ## A construction with a thousand hands
#
# graphcam draws each construction with a *pencil*. The default pencil is ideal. Any other misses every line and every divider setting by a random amount, and every angle by as much at the
# edge of a protractor of 100 mm; and it can draw a thousand sheets at once. Four students with a pencil of 0.5 mm (a bad one, so that you see it):


# %% jupyter={"source_hidden": true} tags=["remove-input"]
task = lesson_task("task.toml", by_laws=True)
ideal = gc.solve(task)
lift = float(ideal.drawn["integration"].readings["s"].value.max())


def with_pencil(sigma, seed):
    hand = gc.Pencil.of(float(sigma), seed=int(seed))
    return drawing(gc.solve(task, hand).drawn["minimum_radius"])


explore(
    with_pencil,
    sigma=Slider("pencil, mm", (0.0, 0.1, 0.2, 0.5, 1.0), 0.5),
    seed=Slider("student", (1, 2, 3, 4, 5, 6), 1, (1, 2, 3, 4)),
)

# %% [markdown]
# Each found a different minimum radius. The spread of many such results is what "how exact" means.
#
# ## The best number of parts

# %%
rows = []
for parts in (4, 6, 8, 12, 16, 24, 48):
    finer = changed(task, {"drawing.divisions": parts})
    perfect = gc.solve(finer)
    exact = perfect.comparison.exact_stations.values[0]
    method = np.abs(perfect.drawn["integration"].readings["s"].value - exact).max()
    hands = gc.solve(finer, gc.Pencil.of(0.2, samples=400, seed=1)).drawn["integration"]
    both = np.nanmean(np.abs(hands.readings["s"].value - exact).max(axis=-1))
    rows.append((parts, 100 * method / lift, 100 * both / lift))
table(("parts n", "ideal pencil, % of the lift", "pencil of 0.2 mm, % of the lift"), rows, digits=2)

# %% jupyter={"source_hidden": true} tags=["remove-input"]
n, method, both = np.transpose(rows)
figure, axes = chart("parts of a phase", "maximum error of s, % of the lift", 2.8)
axes.loglog(n, method, "o-", color="#5a5a5a", label="ideal pencil: falls with 1/n²")
axes.loglog(n, both, "o-", color="#0b57a4", label="pencil of 0.2 mm (mean of 400)")
axes.legend(fontsize=8)
axes.set_xticks(n, [f"{int(k)}" for k in n], minor=False)
axes.minorticks_off()
best = int(n[np.argmin(both)])
straight = method[-1] < 1e-6  # straight ordinates leave no error of the method
picture_of(figure, f"Error against the number of parts, both axes logarithmic: the ideal pencil's error falls steadily from {method[0]:.1f} to {method[-1]:.2f} "
           f"percent; that of a 0.2 mm pencil falls to {both.min():.1f} percent at {best} parts and is {both[-1]:.1f} percent at {int(n[-1])}.",
           f"More parts help an ideal pencil; a real one is best at {best}")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert straight or abs(np.polyfit(np.log(n[3:]), np.log(method[3:]), 1)[0] + 2) < 0.3
assert both[-1] > both.min() * 1.2

# %% jupyter={"source_hidden": true} tags=["remove-input"]
near = [int(parts) for parts, error in zip(n, both, strict=True) if error < 1.1 * both.min()]
Markdown("The ordinates of this law are straight, so that the method has no error: the fewer parts, the better." if straight else
         f"With this pencil **{' to '.join(f'{k}' for k in sorted({min(near), max(near)}))} parts are best**, within a tenth of the error. That is why courses divide a phase into about so many parts; "
         f"with {int(n[-1])} the error is {both[-1] / both.min():.1f} times as large, for several times the work.")

# %% [markdown]
# A better pencil moves the optimum to the right, a larger drawing too: what counts is $\sigma$ compared with the size of the
# diagram.
#
# ## Error budget of the sheet
#
# The readings of one construction are the data of the next: acceleration, velocity, displacement, minimum radius, curvature, roller. An error
# travels down this chain. Of 400 sheets by a pencil of 0.2 mm two things can be told: the **scatter**, their standard deviation, and the
# **bias**, how far their mean is from the exact value. Another sheet by the same hand differs by the scatter; the bias stays, however many are
# averaged. The *error* has both in it: its root mean square is $\sqrt{\text{bias}^2 + \text{scatter}^2}$.

# %%
names = {"maximum v": "max_v", "minimum radius": "minimum_prime_radius", "minimum radius of curvature": "min_pitch_curvature_radius"}
budget = []
for title, name in names.items():
    quantity = ideal.comparison.quantities[name]
    if not quantity.exact:  # such a minimum radius is no size: any radius would do
        continue
    hands = quantity.by_hands[np.isfinite(quantity.by_hands)]
    bias, scatter = hands.mean() - quantity.exact, hands.std()
    errors = (quantity.error, bias, scatter, np.sqrt(np.mean((hands - quantity.exact) ** 2)))
    budget.append((title, quantity.exact, *(100 * float(error) / quantity.exact for error in errors)))
table(("quantity", "exact", "ideal pencil: error, %", "pencil of 0.2 mm: bias, %", "scatter, %", "error, root mean square, %"), budget, digits=1)

# %% [markdown]
# Which operations cause this? Draw the same sheets again, with errors in one kind of operation only: only the marks that the dividers divide an axis
# by, only the circles, only the bisectors. Each kind causes a share of the variance, the square of the standard deviation; independent errors add by
# their squares, so the shares of a row make 100 %. The remainder is listed under *together*: errors can make the eye choose another point as the
# sharpest one, and no single kind of operation causes that alone.

# %%
kinds = ErrorBudget(ideal.chain, gc.Pencil.of(0.2))
shares = {title: kinds.of(*place) for title, place in (
    ("maximum v", ("integration", "max_v")), ("minimum radius", ("minimum_radius", "prime_radius")), ("radius of curvature", ("curvature", "rho")))}
acts = [kind for kind in kinds.hands if kind and any(each.of[kind] > 0.02 for each in shares.values())]
table(("act: share of the variance, %", *shares), [
    *((kind.value, *(100 * each.of[kind] for each in shares.values())) for kind in acts),
    ("together", *(100 * each.together for each in shares.values())),
], digits=0)

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert all(abs(row[5] ** 2 - row[3] ** 2 - row[4] ** 2) < 1e-6 for row in budget)

# %% jupyter={"source_hidden": true} tags=["remove-input"]
worst = max(budget, key=lambda row: row[5])
Markdown(f"The weak point is the {worst[0]}: {worst[5]:.1f} %, of which the bias is {abs(worst[3]):.1f} %. "
         f"The best of the three is the {min(budget, key=lambda row: row[5])[0]}, good to {min(row[5] for row in budget):.1f} %.")

# %% [markdown]
# ## Try it yourself
#
# A diagram has $n$ parts, and each chord's end is off by 0.2 mm, independently of the others. By how much is the *last* end off
# after **16** parts (one standard deviation)?

# %% jupyter={"source_hidden": true} tags=["remove-input"]
walk = Question(
    0.8, 0.03, "mm of paper", "how independent errors add",
    {"independent errors do not add; their squares do": 3.2, "each chord passes its error on to the next": 0.2, "they do not average out either: the question is about the sum, not the mean": 0.05},
    found_by="calculation",
)
halved = Question(
    12, 0.5, "parts", "second order: twice the parts, a quarter of the error",
    {"a quarter of the error needs twice the parts, not four times as many, as it would with first order": 24, "fewer parts make it worse": 3},
    found_by="counting",
)

# %% tags=["try-it"]
your_last_end = None  # mm of paper
walk.check(your_last_end)

# %% [markdown]
# With 6 parts an ideal pencil leaves a certain error of the displacement. How many parts bring it to a quarter of that?

# %% tags=["try-it"]
your_parts = None  # parts
halved.check(your_parts)

# %% [markdown]
# ## Drawn and exact: speed against error
#
# One quantity, the maximum velocity, by three methods: the *construction* as graphcam draws it, with all its lines; the *same method in NumPy*, two
# running sums; and the *closed formula* of the law. Each is repeated, and the median of its times stands beside its error:

# %%
rising = next(phase for phase in task.motion().phases if isinstance(phase, gc.Rise))
law, angle = rising.normalised, rising.angle
exact = float(law.peak_velocity) * rising.lift / angle


def by_sums(parts):
    dx = angle / parts
    v = np.concatenate([[0.0], np.cumsum(law((np.arange(parts) + 0.5) / parts)[2] * dx)])
    s = np.cumsum((v[1:] + v[:-1]) / 2 * dx)
    return np.abs(v).max() * rising.lift / s[-1]


def by_drawing(parts):
    chain = gc.solve(changed(task, {"drawing.divisions": parts})).chain
    return lambda: np.abs(chain.redrawn()["integration"].readings["v"].value[: parts + 1]).max()


def timed(method, repeats=15):
    times = []
    for _ in range(repeats):
        start = perf_counter()
        value = method()
        times.append(perf_counter() - start)
    return float(value), 1000 * median(times)


methods = {f"drawn, {parts} parts": by_drawing(parts) for parts in (6, 12, 24, 48)}
methods |= {f"two running sums, {parts} parts": lambda parts=parts: by_sums(parts) for parts in (6, 12, 24, 48, 96, 192)}
methods["closed formula"] = lambda: float(law.peak_velocity) * rising.lift / angle
measured = {name: timed(method) for name, method in methods.items()}
table(("method", "maximum v of the rise", "error, %", "median time, ms"),
      [(name, value, 100 * abs(value / exact - 1), took) for name, (value, took) in measured.items()], digits=4)

# %% jupyter={"source_hidden": true} tags=["remove-input"]
figure, axes = chart("time, ms (median of 15)", "error of the maximum v, %", 3.0)
for start, mark, colour, label in (("drawn", "o", "#b3201c", "drawn"), ("two", "s", "#0b57a4", "two running sums"), ("closed", "*", "#1b7a3d", "closed formula")):
    points = [(took, max(100 * abs(value / exact - 1), 1e-14)) for name, (value, took) in measured.items() if name.startswith(start)]
    axes.loglog(*np.transpose(points), mark + "-", color=colour, label=label)
axes.legend(fontsize=8)
picture_of(figure, "Error against time, both axes logarithmic: the drawn construction on the right, the same method as two running sums far to the left with the same errors, "
           "and the closed formula with no error but rounding.", "Error against time for one quantity, as the figure of graphcam bench shows it for every construction")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
# The same method has the same error, whoever does it; the drawing divides a law of unequal parts at its corner, and takes its scale from all rises.
alike = rising.ratio == 1 and sum(phase.lift > 0 for phase in task.motion().phases) == 1
assert not alike or all(abs(measured[f"drawn, {parts} parts"][0] / measured[f"two running sums, {parts} parts"][0] - 1) < 1e-9 for parts in (6, 12, 24, 48))
assert abs(measured["closed formula"][0] / exact - 1) < 1e-15

# %% [markdown]
# The two that follow one method have one error: what the drawing costs more is the drawing of its lines. By hand the same takes half an hour. What the
# drawing gives is not speed and not digits. It shows *which* line is active and where the sensitive point is, and it reveals gross mistakes of a computation,
# which also come with many digits. `graphcam bench` measures all this for every construction.
#
# ## Hard cases
#
# Where is either in trouble? A jump at a station, lines that hardly cross, a cusp, an offset as large as the radius. The last digits of an exact
# program are seen beside values that were computed with 50 digits by other means; they stand in the file `hard_cases.toml`.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
TABLES = {"rise": RiseTable, "return": ReturnTable}


def hard_task(case):
    phases = [TABLES[kind](angle, h, *law) if h else DwellTable(angle) for kind, h, angle, *law in case["phases"]]
    rest = 360 - sum(phase.angle for phase in phases)
    sizes = {key: case[key] for key in ("follower.offset", "follower.roller_radius", "cam.prime_radius", "limits.pressure_angle_rise", "drawing.divisions") if key in case}
    return changed(gc.builtin_task(), {"rotation": "cw", "motion": MotionTable((*phases, DwellTable(rest))), "limits.pressure_angle_rise": 30.0,
                                       "follower.offset": 10.0, **sizes})


def digits_left(value, reference):
    off = abs(value - reference) / abs(reference)
    return "all" if off == 0 else f"{-np.log10(off):.1f}"


rows, hard = [], {}
for case in tomllib.loads(Path("hard_cases.toml").read_text(encoding="utf-8"))["case"]:
    solved = hard[case["name"]] = gc.solve(hard_task(case))
    quantity = solved.comparison.quantities[case["quantity"]]
    drawn = f"{quantity.drawn:.6g}" if np.isfinite(quantity.drawn) else "cannot be read"
    rows.append((case["name"], drawn, f"{quantity.exact:.15g}", digits_left(quantity.exact, float(case["reference"]))))
table(("case", "drawn", "exact", "right digits"), rows)

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert all(digits == "all" or float(digits) > 14 for *_, digits in rows)
assert [name for name, drawn, *_ in rows if drawn == "cannot be read"] == ["lines that cross at less than a degree"]

# %% [markdown]
# The drawing of the flat crossing says itself why nothing is read, which is better than a wrong number:

# %% jupyter={"source_hidden": true} tags=["remove-input"]
flat = hard["lines that cross at less than a degree"]
said = [str(step.caption) for step in flat.drawn["minimum_radius"].steps() if "less than a degree" in str(step.caption)]
display(Markdown("> " + " ".join(said)))
drawing(flat.drawn["minimum_radius"])

# %% [markdown]
# At a **cusp** the profile turns back on itself; drawing and computation agree that such a cam cannot be cut:

# %% jupyter={"source_hidden": true} tags=["remove-input"]
sharp = hard["an undercut envelope"]
display(Markdown(f"Cusps at {', '.join(f'{np.degrees(angle):.2f}°' for angle in sharp.cam.undercuts()[0].cusps)}; the largest roller is {gc.largest_roller(sharp.cam):.3f} mm."))
drawing(sharp.drawn["working_profile"])

# %% [markdown]
# **A noisy table.** A displacement was measured every 5° and is off by 0.02 mm. Its second differences are the accelerations that a chord
# construction draws; a fitted curve has the noise taken out:

# %%
seed = np.random.default_rng(3)
true = gc.Motion([gc.Rise(20, np.radians(150), "cycloidal"), gc.Return(20, np.radians(150), "cycloidal"), gc.Dwell(np.radians(60))])
at = np.radians(np.arange(0, 360, 5))
table_s = true(at)[0] + 0.02 * seed.standard_normal(at.size)
second = (np.roll(table_s, -1) - 2 * table_s + np.roll(table_s, 1)) / np.radians(5) ** 2
fitted = gc.measured_motion(at, table_s, tolerance=0.06)
off = {"second differences": second - true(at)[2], "fitted curve": fitted(at - fitted.zero)[2] - true(at)[2]}
table(("acceleration by", "standard deviation, mm/rad²", "of the maximum, %"),
      [(name, float(error.std()), 100 * float(error.std()) / float(np.abs(true(at)[2]).max())) for name, error in off.items()], digits=1)

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert off["second differences"].std() > 3 * off["fitted curve"].std()

# %% [markdown]
# **A thousand million turns.** An angle of so many turns has lost all but some digits *of the angle*; what is left of them is kept:

# %%
steady = gc.Motion([gc.Rise(30, np.radians(120), "3-4-5"), gc.Dwell(np.radians(60)), gc.Return(30, np.radians(120), "cycloidal"), gc.Dwell(np.radians(60))])
far = 360.0 * 10**9 + 36.0
print(f"s at 36°: {float(steady(np.radians(36.0))[0]):.12f} mm, after 10⁹ turns: {float(steady(gc.cam_angle(far, turn=360.0))[0]):.12f} mm")

# %% [markdown]
# ## Where the error comes from
#
# In summary, by the table of shares: chords that pass their errors on (the parallels: the largest share of velocity and minimum radius); settings of
# the dividers; the marks of the axis and the uprights on them, wherever a curve is steep; chords that are too short at the three points, where errors that
# are harmless alone move the point; the protractor, in the inversion; the method with 12 parts. For a better sheet draw it *larger*, not with more parts.
#
# ## Questions
#
# 1. The sheet is drawn on A3 instead of A1, with the same pencil. What happens to each column of the first table?
# 2. Why is the mean of 400 drawn minimum radii not exactly the radius of the ideal pencil?
# 3. Two students differ by 1.5 mm in the minimum radius. Must one of them have made a mistake?
# 4. Which reading of your own sheet would you repeat if you had ten minutes?
#
# <details><summary>Model answers</summary>
#
# 1. All lengths are half as long. The ideal pencil's column stays, in per cent; what the pencil adds is doubled.
# 2. A reading does not follow the errors in proportion: the largest of many noisy values is too large on average. That bias stays. Besides, the mean of 400 has itself a scatter of a twentieth of the single drawing's.
# 3. No: each scatters by about that much, and their difference by $\sqrt2$ times as much.
# 4. The one with the largest error in the table, usually the radius of curvature; with points farther apart.
#
# </details>
