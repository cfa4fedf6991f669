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
#   title: "Cams of three circular arcs"
# ---

# %% [markdown]
# # 8. Cams of three circular arcs
#
# **Aim.** At the end you can design a cam flank from circular arcs with ruler and compass, say which of the two solutions can be made, and read the
# acceleration of such a cam off the drawing.
#
# **You need** circles that touch, perpendicular bisectors, notebook 3. On paper: A3, compass, ruler. **Time:** 60 minutes, 40 of them with the pencil.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
import numpy as np
from IPython.display import Markdown

import graphcam as gc
from graphcam.drafting.hand import Hand, distance_between
from graphcam.drafting.ink import say
from graphcam.drafting.meaning import Meaning, ReadingMeaning
from graphcam.notebooks import ArrayQuestion, Question, changed, compared, show_steps, table

# %% [markdown]
# ## Background
#
# So far we chose the motion and found the profile. The workshop prefers the reverse: arcs can be turned, ground and measured. The flank from the base circle to
# the outer circle is made of **three arcs that touch one another**: the first leaves the base circle in $A$ and ends in $G$, the second runs from $G$ to $F$,
# the third from $F$ to $D$ on the outer circle. The motion follows from the arcs.
#
# Everything is based on one theorem: **where two circles touch, their centres and the point of contact lie on one
# line.** So
#
# - the centre $C_1$ of the arc that ends in $D$ lies on the line from the cam centre $O$ to $D$, at the distance $\rho_1$ from $D$;
# - the centre $C_2$ of the arc that begins in $A$ lies on the line $OA$, equally far from $A$ and from $G$: on the *perpendicular bisector* of $AG$;
# - the centre $C_3$ of the arc in between lies on the line $C_2G$, and it is to touch the first arc, whose centre is $\rho_1$ away from the arc: lay $\rho_1$ off
#   from $G$ on the line $GC_2$ to a point $P$; then $C_3$ is equally far from $P$ and from $C_1$: on the bisector of $PC_1$.
#
# ## The construction
#
# **Predict.** Where on a flank does the acceleration jump, and how often? Mark the places on a sketch of the profile before you look.
#
# **Draw it.** Write these lines into a file `arcs.toml`; `graphcam solve arcs.toml --upto 1.1 --out half` prints the sheet with the given points, and the arcs are yours.
#
# ```toml
# [arcs]
# A = [0, 40]
# G = [22.24, 37.84]
# D = [51.68, 18.81]
# rho1 = 17
# dwell = 40
#
# [follower]
# kind = "translating"
# roller_radius = 10
# ```

# %%
task = gc.builtin_arcs_task()
solution = gc.solve(task)
show_steps(solution.drawn["three_arcs"], within=solution)

# %% [markdown]
# **Write it.** The points as complex numbers in mm, the cam centre at 0: compute the three centres. Twice a point is sought on a given line, equally far from two others: one
# function of two lines does both. A place on the line from $P$ in the direction $u$, of length 1, is $P + t\,u$; it is as far from $Q$ as from $P$ for $t = |PQ|^2 / (2\,\mathrm{Re}(\bar u\,PQ))$.

# %%
A, G, D, rho1 = 40j, 22.24 + 37.84j, 51.68 + 18.81j, 17.0

# %% jupyter={"source_hidden": true} tags=["remove-input"]
drawn_centres = np.array([complex(solution.drawn["three_arcs"].readings[f"{name}_x"].value, solution.drawn["three_arcs"].readings[f"{name}_y"].value)
                          for name in ("C1", "C2", "C3", "other_C3")])
three_centres = ArrayQuestion(
    drawn_centres[:3], 0.1, "the theorem: two centres and the point of contact on one line",
    {"that is the other root: ρ₁ is laid off from G towards C₂": drawn_centres[[0, 1, 3]],
     "C₁ lies inside of D, towards the cam centre": [2 * (51.68 + 18.81j) - drawn_centres[0], *drawn_centres[1:3]]},
)

# %% tags=["try-it"]
your_centres = None  # [C1, C2, C3], mm, from A, G, D and rho1
three_centres.check(your_centres)

# %% tags=["hide-input"]
def equally_far(start, way, other):
    """The place on a line that is as far from its start as from another point."""
    return start + way * abs(other - start) ** 2 / (2 * (way.conjugate() * (other - start)).real)


C1 = D - rho1 * D / abs(D)
C2 = equally_far(A, -1j, G)
towards = (C2 - G) / abs(C2 - G)
C3 = equally_far(G + rho1 * towards, towards, C1)
print(f"C1 {C1:.2f}, C2 {C2:.2f}, C3 {C3:.2f}")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert three_centres.check([C1, C2, C3]).status == "right"

# %% [markdown]
# **Why two roots?** $\rho_1$ can be laid off from $G$ to either side. One root is a profile; in the other the arcs touch on the wrong side, and the profile would
# turn back in a cusp. The test is the *order* on the lines of centres: it must be $F, C_1, C_3$ and $G, C_3, C_2$.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
table(("root", "C3 x, mm", "C3 y, mm", "can be built", "why"), [
    (f"{k}", float(root.C3[0]), float(root.C3[1]), "yes" if root.sound else "no", root.why)
    for k, root in enumerate(solution.roots, 1)
])

# %% [markdown]
# ## What the roller does
#
# The roller's centre runs on the parallel arcs, $r$ further out. As long as it runs on one arc, its distance from that arc's centre is fixed: the cam behaves like a
# **crank and connecting rod**, with the crank $OC$ and the rod $\rho + r$. So velocity and acceleration of every station can be drawn as plans of a crank
# mechanism.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(solution.drawn["arc_roller"], within=solution)

# %% [markdown]
# At $G$ and $F$ the length of the rod changes suddenly. The velocity stays continuous, the **acceleration jumps**: the curvature of the profile jumps there. Three
# arcs mean four soft impacts per flank.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(solution.drawn["arc_diagrams"], 1, 2, within=solution)

# %% [markdown]
# ## Try it yourself
#
# Another flank ends in $D(45,\ 33)$ mm on its outer circle, with $\rho_1 = 26$ mm. Draw it at 1:1. Where is $C_1$?

# %% jupyter={"source_hidden": true} tags=["remove-input"]
away = np.array([45.0, 33.0])
outer = float(np.hypot(*away))
c1 = away * (1 - 26 / outer)
MEANING = Meaning("first_centre", say("First centre"), say("The centres lie on one line."),
                  {"x": ReadingMeaning(say("place across"), "x", "mm"), "y": ReadingMeaning(say("height"), "y", "mm"), "lift": ReadingMeaning(say("lift"), "h", "mm")})


def drawn_on_line(name):
    def draw(pencil):
        hand = Hand(pencil, MEANING)
        o = hand.given("O")
        across, up = hand.erect("axis across", o, 1 + 0j), hand.erect("axis up", o, 1j)
        d = hand.lay_off("D", hand.lay_off("below D", o, 1 + 0j, away[0]), 1j, away[1])
        if name == "lift":
            base = hand.lay_off("on the base circle", o, hand.join("OD", o, d), 40.0)
            return hand.read("lift", distance_between(base, d), 1.0)
        c = hand.lay_off("C1", d, hand.join("DO", d, o), 26.0)
        return hand.read(name, distance_between(c, hand.project("foot", c, up if name == "x" else across)), 1.0)
    return draw


look = "the theorem: O, C₁ and D on one line"
centre_x = Question.by(drawn_on_line("x"), look, {
    "the centre lies inside, towards O": float((away * (1 + 26 / outer))[0]), "that is y": float(c1[1]), "ρ₁ is laid off along OD, not along x": 45.0 - 26})
centre_y = Question.by(drawn_on_line("y"), look, {"ρ₁ is laid off along OD, not along y": 33.0 - 26, "that is x": float(c1[0])})
lift = Question.by(drawn_on_line("lift"), "the two circles about O", {
    "the lift is the difference of the radii, not the outer radius": outer, "A lies on the base circle, whose radius is OA": outer - 26})

# %% tags=["try-it"]
your_x = None  # mm
centre_x.check(your_x)

# %% tags=["try-it"]
your_y = None  # mm
centre_y.check(your_y)

# %% [markdown]
# And how large is the lift of this cam? The rise begins in $A(0,\ 40)$.

# %% tags=["try-it"]
your_lift = None  # mm
lift.check(your_lift)

# %% [markdown]
# ## Move the sliders


# %% jupyter={"source_hidden": true} tags=["remove-input"]
gc.studio(task, view="acceleration", stills={
    f"roller radius, mm: {radius}": {"follower.roller_radius": radius} for radius in (0, 20)})

# %% [markdown]
# A larger roller makes the rods longer. What does that do to the steps of the acceleration at the joints?

# %% jupyter={"source_hidden": true} tags=["remove-input"]
steps = {}
for radius in (0.0, 10.0, 20.0):
    read = gc.solve(changed(task, {"follower.roller_radius": radius})).drawn["arc_roller"].readings
    a = {name: float(np.ravel(read[f"a_{name}"].value)[0]) for name in ("A", "G_before", "G_after", "F_before", "F_after", "D")}
    steps[radius] = a["A"], a["G_after"] - a["G_before"], a["F_after"] - a["F_before"], -a["D"]
table(("roller radius, mm", "step at A, mm/rad²", "at G", "at F", "at D"), [(f"{radius:g}", *row) for radius, row in steps.items()], digits=1)

# %% jupyter={"source_hidden": true} tags=["remove-input"]
change = [100 * (abs(last) / abs(first) - 1) for first, last in zip(steps[0.0], steps[20.0], strict=True)]
Markdown("From no roller to one of 20 mm the steps at A and G grow, by "
         f"{change[0]:.0f} and {change[1]:.0f} %; those at F and D, where the short rod ends and begins, shrink, by {-change[2]:.0f} and {-change[3]:.0f} %. None vanishes.")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert change[0] > 0 < change[1]
assert change[2] < 0 > change[3]
assert all(abs(step) > 5 for row in steps.values() for step in row)  # four soft impacts

# %% [markdown]
# ## Drawn and exact

# %%
compared(solution, "lift", "F_x", "F_y", "rho3", "a_G_before", "a_G_after", "a_F_before", "a_F_after")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert abs(float(solution.drawn["three_arcs"].readings["F_x"].value) - 46.834) < 0.001
assert abs(solution.comparison.quantities["rho3"].exact - 53.228) < 0.001
assert [root.sound for root in solution.roots] == [True, False]

# %% [markdown]
# An ideal pencil is exact here: ruler and compass constructions have no error of the method.
#
# ## Where the error comes from
#
# From lines that cross at a flat angle. The bisector of $PC_1$ and the line $C_2G$ meet at a small angle:

# %% jupyter={"source_hidden": true} tags=["remove-input"]
places = {name: np.array([solution.comparison.quantities[f"{name}_{axis}"].by_hands for axis in "xy"]) for name in ("C1", "C3", "F")}
scatter = {name: float(np.sqrt(xy.var(axis=1).sum())) for name, xy in places.items()}
table(("place", "scatter by a pencil of 0.2 mm, mm"), [*scatter.items()], digits=2)

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert scatter["C3"] > 2 * scatter["C1"]
assert scatter["C3"] > scatter["F"]

# %% [markdown]
# It does less harm than it seems: $C_3$ slides *along* the line through $G$, and the arc still passes through $G$ with the right tangent. Check $F$: it must
# lie on both arcs.
#
# ## Questions
#
# 1. Why do the arcs touch with a common tangent, and what would happen to the *velocity* if they did not?
# 2. Which kind of impact (notebook 1) does a cam of arcs have? Where?
# 3. The flank may be a straight line instead of the middle arc. Where is $C_3$ then?
# 4. Why does the follower's acceleration jump *down* from the second to the third arc? Which rod is longer?
#
# <details><summary>Model answers</summary>
#
# 1. The centres and the point of contact lie on one line, which is square to both arcs there: one normal, one tangent. Without it the velocity would jump, a rigid impact.
# 2. Soft ones, where the curvature jumps: at A, G, F and D.
# 3. At infinity, on the perpendicular to the flank.
# 4. The second arc has the longer rod. On the shorter one, of the nose, the roller's centre must turn away more sharply, so it is accelerated downwards more.
#
# </details>
