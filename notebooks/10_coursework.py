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
#   title: "The whole coursework sheet"
# ---

# %% [markdown]
# # 10. The whole coursework sheet
#
# **Aim.** At the end you have a complete sheet: task, diagrams, minimum radius, profile, roller, checks; and you know the order of the decisions and who makes them.
#
# **You need** notebooks 1 to 6. On paper: A1 or two sheets of A3. **Time:** this reading 40 minutes; the sheet an afternoon.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
import numpy as np
from IPython.display import Markdown

import graphcam as gc
from graphcam.notebooks import (
    ArrayQuestion,
    Question,
    changed,
    compared,
    lesson_task,
    picture_of_page,
    show_steps,
    table,
)
from graphcam.report.documents import sheet_of

# %% [markdown]
# ## Background: the chain
#
# | step | given | read off | notebook |
# |:--|:--|:--|:--|
# | acceleration diagram | laws, phase angles, one chosen ordinate | the return's ordinate | 1 |
# | two integrations | middle ordinates, two poles | $v$, $s$, the three scales | 2 |
# | combined diagram | $s$, $v$, limits | $r_0$, $e$, $s_0$ | 4 |
# | **decision** | the proposals | $r_0$ rounded up, $e$ rounded | 4 |
# | pressure angles | $s$, $v$, the *adopted* $r_0$ and $e$ | $\alpha$ at every station | 3 |
# | inversion | $s$, $r_0$, $e$ | the pitch curve | 5 |
# | three points | the pitch curve | $\rho_{\min}$ | 6 |
# | **decision** | $\rho_{\min}$, $r_0$, the rule | $r$ rounded down | 6 |
# | working profile | pitch curve, $r$ | the cam | 5, 6 |
#
# Each line uses only what was given or read off before. The two *decisions* are different from readings: as in a design office the drawing proposes 43.28 mm, say, and the
# engineer adopts 44 mm, and from there on everything is drawn for 44 mm. Radii are rounded **up**, rollers **down**: always to the safe side.
#
# ## The sheet
#
# **Predict.** Write down your guess of $r_0$ and of the roller, in millimetres, for the task in `task.toml`, before you draw or look.
#
# **Draw it.** `graphcam solve task.toml --worksheet --out blank` prints the empty sheet, with axes and nothing else.

# %%
task = lesson_task("task.toml", "translating")
solution = gc.solve(task)
picture_of_page(sheet_of(solution).pages[0], "The finished coursework sheet: three diagrams one under the other with their poles, beside the displacement the combined "
                "diagram with the shaded region, the cam profile with its inversion lines, tables and title block.", "The finished sheet")

# %% [markdown]
# Look at how it is arranged: the three diagrams stand exactly one under the other on one axis of the cam angle; the combined diagram stands beside $s$, so that the displacements are
# *projected* across and not measured. Thin lines are construction lines, thick lines are results.
#
# ## Step by step through the decisions

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(solution.drawn["integration"], 7, 8, 9, within=solution)
show_steps(solution.drawn["minimum_radius"], 5, within=solution)

# %% jupyter={"source_hidden": true} tags=["remove-input"]
proposed = float(solution.drawn["minimum_radius"].value("prime_radius"))
Markdown(f"The drawing proposes {proposed:.2f} mm; {solution.cam.prime_radius:g} mm is adopted and used from here on.")

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(solution.drawn["pressure_angle"], 1, 2, within=solution, on=solution.drawn["minimum_radius"])
show_steps(solution.drawn["angle_diagram"], 2, within=solution)
show_steps(solution.drawn["curvature"], 3, 4, within=solution)
show_steps(solution.drawn["roller"], within=solution)
show_steps(solution.drawn["working_profile"], 1, 4, 5, within=solution)

# %% [markdown]
# **Write it.** The decisions of many drawings at once: from arrays of proposed prime radii and radii of curvature compute the rollers, in whole millimetres, by the rule
# $\min(0.7\,\rho,\ 0.4\,r_0)$ with the *adopted* radii, in whole millimetres too. Two lines are enough.

# %%
proposed_radii = np.array([43.28, 51.02, 60.0, 37.6])  # mm
curvature_radii = np.array([29.6, 25.1, 41.0, 24.9])  # mm

# %% jupyter={"source_hidden": true} tags=["remove-input"]
adopted_radii = np.ceil(proposed_radii)
rollers = np.floor(np.minimum(0.7 * curvature_radii, 0.4 * adopted_radii))
many_rollers = ArrayQuestion(
    rollers, 1e-9, "the table of the chain: which way is each rounded, and which radius does the rule take?",
    {"rollers are rounded down": np.ceil(np.minimum(0.7 * curvature_radii, 0.4 * adopted_radii)),
     "radii are rounded up, and the rule takes the adopted ones": np.floor(np.minimum(0.7 * curvature_radii, 0.4 * np.floor(proposed_radii))),
     "the rule takes the smaller of the two": np.floor(np.maximum(0.7 * curvature_radii, 0.4 * adopted_radii))},
)

# %% tags=["try-it"]
your_rollers = None  # mm, from proposed_radii and curvature_radii
many_rollers.check(your_rollers)

# %% tags=["hide-input"]
radii = np.ceil(proposed_radii)
drawn_rollers = np.floor(np.minimum(0.7 * curvature_radii, 0.4 * radii))
print("adopted:", radii, "rollers:", drawn_rollers)

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert many_rollers.check(drawn_rollers).status == "right"
assert many_rollers.check(np.floor(np.minimum(0.7 * curvature_radii, 0.4 * np.floor(proposed_radii)))).text.startswith("Not yet: radii are")

# %% [markdown]
# ## Try it yourself
#
# A task of your own: the same motion, but the cam turns the **other way** and the follower stands on the **other side** of the centre. Which minimum radius will you find? (Think
# before you draw: notebook 3.) Then two decisions. The drawing of a colleague proposes $r_0 = 52.37$ mm, and $\rho = 29.6$ mm; the rule for the roller is
# $\min(0.7\,\rho,\ 0.4\,r_0)$. Which radius is adopted, in whole millimetres, and which roller?

# %% jupyter={"source_hidden": true} tags=["remove-input"]
other_way = {"cw": "ccw", "ccw": "cw"}[task.rotation]
offset = solution.cam.follower.offset
other_side = None if task.follower.offset is None else -offset  # an offset that is found is found again
mirrored = gc.solve(changed(task, {"follower.offset": other_side, "rotation": other_way}))
wrong_side = gc.solve(changed(task, {"follower.offset": -offset}))


def mirrored_radius(pencil):
    return mirrored.chain.by(pencil)["minimum_radius"].readings["prime_radius"]


least = Question.by(
    mirrored_radius, "notebook 3: rotation and offset enter only as their product",
    {"the offset lies on the same side of the motion as before": float(wrong_side.drawn["minimum_radius"].value("prime_radius"))},
    exact=mirrored.comparison.least[0],
)
adopted = Question(
    53, 0.01, "mm", "the decision: round to a whole millimetre, to the safe side",
    {"rounded down: the limit would be exceeded": 52, "that is the proposal, not the decision": 52.37}, found_by="counting",
)
roller = Question(
    20, 0.01, "mm", "the rule with the adopted radius, rounded down",
    {"round the roller down": 21, "that is the proposal; a workshop wants a round number": 0.7 * 29.6, "the rule has the adopted radius, and the smaller of the two counts": 0.4 * 53},
    found_by="counting",
)

# %% tags=["try-it"]
your_least_radius = None  # mm
least.check(your_least_radius)

# %% tags=["try-it"]
your_adopted_radius = None  # mm
adopted.check(your_adopted_radius)

# %% tags=["try-it"]
your_roller = None  # mm
roller.check(your_roller)

# %% [markdown]
# ## Move the sliders
#
# The decisions on the finished profile:


# %% jupyter={"source_hidden": true} tags=["remove-input"]
gc.studio(task, view="profile", stills={
    "offset, mm: 0": {"follower.offset": 0},
    **{f"limit on the rise, °: {limit}": {"limits.pressure_angle_rise": limit} for limit in (20, 40)},
})

# %% [markdown]
# ## Drawn and exact

# %%
compared(solution)

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert proposed <= solution.cam.prime_radius + 1e-6 or task.cam.prime_radius is not None
assert abs(float(mirrored.drawn["minimum_radius"].value("prime_radius")) - proposed) < 1e-9
assert int(0.7 * 29.6) == 20
assert 0.7 * 29.6 < 0.4 * 53

# %% jupyter={"source_hidden": true} tags=["remove-input"]
beyond = [str(quantity.title) for quantity in solution.comparison.quantities.values() if quantity.is_beyond_bound]
verdict = "every quantity lies within its bound" if not beyond else f"all but {', '.join(beyond)} lie within their bounds: such a value is drawn with more parts"
Markdown("The *ideal pencil* is off by the error of the method alone. graphcam proves or estimates a bound for it beforehand, and "
         f"{verdict}; drawing by hand adds bias and scatter, notebook 7.")

# %% [markdown]
# ## At speed
#
# What the follower really does in each phase, at the speed of the task:

# %% jupyter={"source_hidden": true} tags=["remove-input"]
table(("phase", "time, s", "maximum velocity, m/s", "maximum acceleration, m/s²"), [
    (p.kind, q.time, q.max_velocity, q.max_acceleration)
    for p, q in zip(task.motion.phases or (), solution.comparison.phases(task.speed_rpm), strict=False)
])

# %% [markdown]
# ## Before you hand it in
#
# 1. The areas under the acceleration are equal in each phase; velocity and displacement return to the axis; the closing errors are stated.
# 2. All scales are on the sheet, with units, and $\mu_\varphi$ in radians.
# 3. The segments in the combined diagram are in the scale of $s$; the tangents touch; the dwell line is there.
# 4. The follower's line is on the favourable side; the numbers run against the rotation of the cam.
# 5. $s$ is laid off from the prime circle; the dwells are arcs about the centre.
# 6. The maximum pressure angle *of the adopted cam* is below the limit; the roller satisfies the rule.
# 7. The scale bar on a print measures 100 mm.
#
# ## Where the error comes from
#
# Compare the columns of the table: where the scatter is much larger than the ideal pencil's error, a sharper pencil and a larger sheet help; where it is not, more parts do. Draw the
# same sheet with another law and with a pencil: `graphcam solve cam.toml --pencil 0.2`.
#
# ## Questions
#
# 1. Which decision would you revise if the roller came out at 8 mm?
# 2. The client wants the cam to turn the other way. Which parts of the sheet must be redrawn?
# 3. Which number on your sheet would you rely on, and which not?
# 4. Follow the chain backwards: what must be known to check the profile of someone else's cam?
#
# <details><summary>Model answers</summary>
#
# 1. The prime radius: a larger one leaves a blunter profile and, by the rule, a larger roller. Or the law, if the phase angles are given.
# 2. Those about the cam centre, as mirror images: combined diagram, angles, profile. The diagrams over $\varphi$ stay.
# 3. On the prime radius to some per cent; not on the radius of curvature, nor on what hangs on it.
# 4. The roller radius, the offset and the sense of rotation; then the pitch curve, the displacement from its distances, and velocity and acceleration by differentiation.
#
# </details>
