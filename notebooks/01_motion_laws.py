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
#   title: Motion laws and the acceleration diagram
# ---

# %% [markdown]
# # 1. Motion laws and the acceleration diagram
#
# **Aim.** At the end you can choose a motion law and say what it costs, and you can draw the acceleration diagram of a
# whole revolution so that the follower comes back to where it started, before any scale is known.
#
# **You need** derivatives and areas under a curve; on paper a ruler, a pencil and a sheet of A3.
# **Time:** 45 minutes, 20 of them with the pencil.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
import numpy as np
from IPython.display import Markdown

import graphcam as gc
from graphcam.notebooks import ArrayQuestion, Question, chart, compared, lesson_task, picture_of, show_steps, table

# %% [markdown]
# ## Background
#
# A cam turns steadily and lifts a follower. While the cam turns through the *phase angle* $\varPhi$ the follower rises
# by the *lift* $h$; then it dwells, returns, and dwells again. How it rises in between is our choice: the **motion
# law**. We measure the progress of the phase by $u = \varphi/\varPhi$, from 0 to 1, and write the law as a function
# $f(u)$ that rises from 0 to 1:
#
# $$ s = h\,f(u), \qquad v = \frac{ds}{d\varphi} = \frac{h}{\varPhi}\,f'(u), \qquad
# a = \frac{d^2s}{d\varphi^2} = \frac{h}{\varPhi^2}\,f''(u). $$
#
# The derivatives are taken with respect to the cam angle, so $v$ is in mm per radian and $a$ in mm per radian². At the
# angular velocity $\omega$ the follower's velocity is $\omega v$ and its acceleration $\omega^2 a$: the *shape* of the
# motion belongs to the cam, the speed comes later.
#
# **Why begin with the acceleration?** Because the forces do. The follower's inertia is $m\,\omega^2 a$; where $a$
# jumps, the force jumps, and the mechanism knocks. We distinguish
#
# - a **rigid impact** where the *velocity* jumps: the acceleration is infinite there;
# - a **soft impact** where the *acceleration* jumps: the force does too, but stays finite;
# - **no impact** where the acceleration is continuous.
#
# Three laws that every course begins with:

# %% jupyter={"source_hidden": true} tags=["remove-input"]
u = np.linspace(0, 1, 401)
shown = ("rectangular", "cosine", "cycloidal")
figure, _ = chart("", "", 2.6)
figure.clear()
for axes, k, title in zip(figure.subplots(1, 3), range(3), ("s / h", "v Φ / h", "a Φ² / h"), strict=True):
    for name, style in zip(shown, ("-", "--", "-."), strict=True):
        axes.plot(u, gc.law(name)(u)[k], style, label=name)
    axes.set_title(title)
    axes.set_xlabel("u")
    axes.grid(visible=True, color="#dddddd", linewidth=0.5)
figure.axes[0].legend(fontsize=8)
figure.tight_layout()
picture_of(
    figure,
    "Three charts over u from 0 to 1 for the rectangular, cosine and cycloidal laws: displacement, velocity, acceleration."
    " The rectangular acceleration is +4, then -4; the cosine falls from 4.9 to -4.9; the cycloidal is a full sine wave.",
    "Displacement, velocity and acceleration of three laws; only the cycloidal acceleration begins and ends at zero",
)

# %% [markdown]
# The rectangular law keeps the acceleration as small as possible and causes three impacts. The cycloidal law causes
# none, but its acceleration is $6.28/4 = 1.57$ times as large. Two numbers tell the price of a law, the
# maximum values of $f'$ and $f''$:
#
# $$ v_{\max} = C_v\,\frac{h}{\varPhi}, \qquad a_{\max} = C_a\,\frac{h}{\varPhi^2}. $$

# %% jupyter={"source_hidden": true} tags=["remove-input"]
laws = {name: gc.law(name) for name in gc.LAWS}
jump = {True: "soft", False: "none"}
ends = {name: max(abs(float(law(0.0)[2])), abs(float(law(1.0)[2]))) for name, law in laws.items()}
table(
    ("law", "$C_v$", "$C_a$", "impact"),
    [(n, float(x.peak_velocity), float(x.peak_acceleration), jump[ends[n] > 1e-9]) for n, x in laws.items()],
)

# %% [markdown]
# Read the table as a bargain: nobody beats $C_a = 4$, and whoever wants a smooth beginning pays in $C_a$; whoever
# wants a small $C_v$, and with it, as we will see, a small cam, takes the 2-3 law ($C_v = 1.5$) or the cosine (1.571), and with
# them a soft impact. Of the laws without an impact the modified sine has the smallest $C_v$, 1.760, before the 3-4-5
# law with 1.875.

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
# f = u - sin(2πu)/(2π): the greatest f'' is 2π, and no law stays under 4.
assert abs(laws["cycloidal"].peak_acceleration - 2 * np.pi) < 1e-9
assert min(law.peak_acceleration for law in laws.values()) >= 4 - 1e-9
# What the advice says of the table.
by_speed = sorted(laws, key=lambda name: laws[name].peak_velocity)
smooth = [name for name in by_speed if ends[name] < 1e-9]
assert by_speed[:3] == ["2-3", "cosine", "modified-sine"]
assert ends["2-3"] > 1
assert ends["cosine"] > 1
assert smooth[0] == "modified-sine"
assert [round(laws[name].peak_velocity, 3) for name in ("2-3", "cosine", "modified-sine", "3-4-5")] == [1.5, 1.571, 1.76, 1.875]

# %% [markdown]
# ## The diagram of a whole revolution
#
# Our task, the same in all the following notebooks, stands in the file `task.toml` beside them. Put another one in its place, and
# the drawings, numbers and questions of this notebook follow it.

# %%
task = lesson_task("task.toml", by_laws=True)
table(("phase", "angle, °", "lift, mm", "law"),
      [(p.kind, p.angle, getattr(p, "lift", "–"), getattr(p, "law", "–")) for p in task.motion.phases], digits=0)

# %% [markdown]
# Now comes the trick. We do **not** compute accelerations and divide them by a
# scale. We *choose* the length of the first ordinate, to suit the sheet, and leave the scale open. Only the following must be
# consistent:
#
# 1. Lay off one revolution on the axis.
# 2. Choose the maximum ordinate $y_1$ of the rise.
# 3. **Compute** the maximum ordinate of the return. Both movements end at rest and have the same lift, so the two
#    accelerations must be in the ratio of $C_a h/\varPhi^2$:
#
# $$ \frac{y_2}{y_1} = \frac{C_{a2}\,h_2/\varPhi_2^{\,2}}{C_{a1}\,h_1/\varPhi_1^{\,2}}. $$

# %% jupyter={"source_hidden": true} tags=["remove-input"]
solution = gc.solve(task)
diagram = solution.drawn["acceleration"]
greatest = np.ravel(diagram.readings["greatest"].paper)
base = diagram.readings["base"]
Markdown(f"Here the axis of a revolution is {float(base.paper):.0f} mm long, and the longest ordinates of the phases are "
         + " and ".join(f"{y:.1f}" for y in greatest) + " mm.")

# %% [markdown]
# The square of the angles decides: with equal laws and lifts, a return over 60° needs $(80/60)^2 = 1.78$ times the ordinate of a
# rise over 80°. If both ordinates are chosen freely, the displacement does not return to the axis,
# and no smoothing with a French curve will hide it.
#
# **Predict.** By how many millimetres does the displacement miss the axis at the end of the turn if the return's ordinate is made 2 %
# too long, and the lift is 50 mm on paper? Write your number down; the last section has the answer.
#
# **Draw it** while you read: `graphcam solve task.toml --worksheet --out blank` prints the blank axes, and
# `--upto acceleration` the sheet as far as this notebook goes.
#
# 4. Plot the law in each phase. A rise begins with acceleration *upwards*, a return with acceleration *downwards*.
# 5. Divide each phase into $n$ equal parts and draw the ordinate at the **middle** of every part. These middle
#    ordinates are all that the next construction will use.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(diagram, within=solution)

# %% [markdown]
# The areas above and below the axis are equal in each phase: whatever velocity the follower gains, it must lose
# again. That is the first thing an examiner checks, and you can check it by eye.
#
# **Write it.** The middle ordinates of the rise, in mm of paper: `law(u)` gives $f$ and its first three derivatives at the fractions $u$ of
# the phase, the longest ordinate is `y1`, and there are `n` parts. Two lines are enough.

# %%
rising = next(phase for phase in task.motion().phases if isinstance(phase, gc.Rise))
law, y1, n = rising.normalised, float(greatest[0]), solution.chain.spans[0].stop - 1

# %% jupyter={"source_hidden": true} tags=["remove-input"]
plotted = diagram.readings["middles"].paper[:n]
at_ends = law(np.linspace(0, 1, n + 1)[1:] - 1e-9)[2] * y1 / law.peak_acceleration
middle_ordinates = ArrayQuestion(
    plotted, 1e-6, "where the middle of a part lies, and what the longest ordinate stands for",
    {"these are the ordinates at the ends of the parts": at_ends, "f″ must be divided by its maximum": plotted * law.peak_acceleration},
)

# %% tags=["try-it"]
your_middles = None  # n ordinates, mm of paper, from law, y1 and n
middle_ordinates.check(your_middles)

# %% tags=["hide-input"]
middle_u = (np.arange(n) + 0.5) / n
middles = y1 * law(middle_u)[2] / law.peak_acceleration
print(f"the first is {middles[0]:.2f} mm, the last {middles[-1]:.2f} mm")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert middle_ordinates.check(middles).status == "right"

# %% [markdown]
# ## Try it yourself
#
# A second task: a rise of 25 mm over **120°** by the **cosine** law, a dwell, a return over **90°** by the **cycloidal**
# law. You choose 40 mm for the rise. How long is the maximum ordinate of the return?

# %% jupyter={"source_hidden": true} tags=["remove-input"]
ordinate = Question(
    40 * (2 * np.pi / 90**2) / (np.pi**2 / 2 / 120**2), 0.5, "mm of paper", "point 3, the ratio of the ordinates",
    {"both ordinates cannot be chosen freely: the return's follows": 40.0,
     "the phase angles enter with their squares": 40 * (2 * np.pi / 90) / (np.pi**2 / 2 / 120),
     "the two laws have different Cₐ": 40 * (120 / 90) ** 2,
     "the lifts are equal and the ratio of the angles is inverted": 40 * (2 * np.pi * 90**2) / (np.pi**2 / 2 * 120**2)},
    found_by="calculation",
)
second_ordinate = Question(
    30.0, 0.5, "mm of paper", "the areas: a third of the phase times 60 mm equals two thirds of it times the ordinate required",
    {"ν is inverted: braking lasts longer, so its ordinate is shorter": 120.0,
     "with equal ordinates the areas would differ": 60.0},
    found_by="calculation",
)

# %% tags=["try-it"]
your_ordinate = None  # mm of paper
ordinate.check(your_ordinate)

# %% [markdown]
# Now a rectangular rise in *unequal* parts: the follower is accelerated for one third of the phase and braked for two
# thirds. The ratio of the two ordinates is $\nu = a_1/a_2$. You drew the first one 60 mm long. How long is the second?
# (Think of the two areas.)

# %% tags=["try-it"]
your_second_ordinate = None  # mm of paper
second_ordinate.check(your_second_ordinate)

# %% [markdown]
# Choose other laws for rise and return and watch the ordinates. The rise keeps its chosen ordinate; what the law changes is
# everything else.


# %% jupyter={"source_hidden": true} tags=["remove-input"]
laws = ("cosine", "cycloidal", "2-3", "3-4-5")
moving = [k for k, phase in enumerate(task.motion.phases) if hasattr(phase, "law")]
gc.studio(task, view="acceleration", stills={
    f"law of rise and return: {law}": {f"motion.phases[{k}].{key}": value for k in moving for key, value in (("ratio", 1), ("law", law))} for law in laws})

# %% [markdown]
# ## Drawn and exact
#
# What acceleration does a millimetre mean? We do not know yet: $\mu_a$ is found after two integrations, in notebook 2.
# But the exact side knows, and the *lengths* can be compared already. With $\mu_a$ from the finished drawing:

# %%
mu_a = float(solution.drawn["integration"].readings["a"].scale)
phases = [p for p in task.motion().phases if not isinstance(p, gc.Dwell)]
exact = np.array([p.normalised.peak_acceleration * p.lift / p.angle**2 for p in phases])
table(("phase", "on paper, mm", "× μₐ", "exact"), [
    (type(phase).__name__.lower(), float(y), float(y) * mu_a, float(a)) for phase, y, a in zip(phases, greatest, exact, strict=True)
])

# %% [markdown]
# The *ratio* of the ordinates is exact; the scale is not, because the two integrations that find it replace a curve by chords. Drawn by
# hand, both scatter:

# %%
compared(solution, "max_a")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
# The ratio has no error; that of the scale is one of the method: small, and none where the ordinates are straight.
assert np.allclose(greatest / greatest[0], exact / exact[0], rtol=1e-9)
assert abs(greatest[0] * mu_a / exact[0] - 1) < 0.1
# The scale is that of two integrations: the ordinate of the return goes into the displacement in proportion.
dx = np.radians(60) / 12
middles = gc.law("3-4-5")((np.arange(12) + 0.5) / 12)[2]
velocity = np.cumsum(middles) * dx
lifts = [float(np.sum(np.concatenate([[0], (factor * velocity)[:-1]]) + factor * velocity) / 2 * dx) for factor in (1, 1.01)]
assert abs(lifts[1] / lifts[0] - 1.01) < 1e-12

# %% [markdown]
# ## Where the error comes from
#
# The ordinates are *given*, not measured, so an ideal pencil makes no error in them. Drawing by hand makes three: the
# ordinates are laid off with a ruler (half a division is 0.5 mm, 1 % of an ordinate of 50 mm), the middle of a part is found by
# eye, and the curve is plotted through few points. An error of the return's ordinate by 1 % leaves the displacement 1 % of the
# lift away from the axis at the end (of a lift of 50 mm on paper, 2 % are 1 mm). Notebook 7 follows these errors through the whole chain.
#
# ## Questions
#
# 1. Why can no law have $C_a < 4$? (Consider the triangle under $f'$: it must enclose the area 1.)
# 2. A cam for an engine valve runs at 3000 rpm, one for a sewing machine at 300 rpm. How much larger are the
#    accelerations, and which law would you choose for each?
# 3. The 2-3 law has the smallest $C_v$ of all and still a soft impact. Where does its acceleration jump?
# 4. The task gives the return 30° instead of 60°. What happens to its ordinate, and what would you change on the sheet?
#
# <details><summary>Model answers</summary>
#
# 1. $f'$ begins and ends at 0 and must enclose the area 1. With $|f''| \le C$ it stays under the triangle whose sides rise and fall with the slope $C$; that has the height $C/2$ and the area $C/4$. So $C \ge 4$.
# 2. The angular velocity is ten times, the accelerations are $10^2 = 100$ times as large. The valve needs a law without an impact (modified sine, 3-4-5, cycloidal); at 300 rpm a soft impact may be borne, and a law with a small $C_v$ makes the cam smaller.
# 3. At both ends: with $f = 3u^2 - 2u^3$, $f'' = 6 - 12u$ jumps from 0 to 6 at the beginning and from −6 to 0 at the end.
# 4. It becomes $(60/30)^2 = 4$ times as long. Choose a shorter $y_1$ for the rise, so that both have room on the sheet.
#
# </details>
