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
#   title: "The velocity plan and the pressure angle"
# ---

# %% [markdown]
# # 3. The velocity plan and the pressure angle
#
# **Aim.** At the end you can find the pressure angle at any station from three lengths, without the profile, and the sign of the
# offset and the direction of rotation will no longer mislead you.
#
# **You need** the readings of displacement and velocity (notebook 2), vectors that are added head to tail.
# On paper: A4, ruler, protractor. **Time:** 45 minutes, 20 of them with the pencil.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
from math import atan2, degrees

import numpy as np
from IPython.display import Markdown

import graphcam as gc
from graphcam.drafting.hand import Hand, distance_between
from graphcam.drafting.ink import say
from graphcam.drafting.meaning import Meaning, ReadingMeaning
from graphcam.notebooks import (
    ArrayQuestion,
    Question,
    Slider,
    chart,
    compared,
    explore,
    lesson_task,
    picture_of,
    show_steps,
    table,
)

# %% [markdown]
# ## Background
#
# The **pressure angle** $\alpha$ lies between the direction in which the cam pushes, the common normal of profile and roller, and
# the direction in which the follower can move, its guide. A student who has drawn the profile can measure it there, but the
# profile depends on the size of the cam, and the size is what we are looking for. We need $\alpha$ *before* the profile.
#
# Consider the point $B$, the roller's centre. It belongs to the follower, which moves with $\vec v_2$ along its guide. The point of the
# *cam* that lies under it moves with $\vec v_1$, of magnitude $\omega\cdot AB$, square to the radius $AB$. The two differ by the sliding
# $\vec v_{21}$ along the profile:
#
# $$ \vec v_2 = \vec v_1 + \vec v_{21}. $$
#
# Two directions and one complete vector are known: the **velocity plan** is a triangle that can be drawn.
#
# Now the trick. In the mechanism draw through the cam centre $A$ the perpendicular to the motion; it meets the normal of the
# profile in $C$. The triangle $ABC$ has its sides square to the three vectors: $AB \perp \vec v_1$, $BC \perp \vec v_{21}$ (the normal and the
# tangent), $AC \perp \vec v_2$. So the two triangles are similar, and
#
# $$ \frac{AC}{AB} = \frac{v_2}{v_1} = \frac{\omega\,ds/d\varphi}{\omega\,AB}
# \quad\Longrightarrow\quad AC = \frac{ds}{d\varphi} = v. $$
#
# **The velocity diagram contains a length of the mechanism.** $C$ can be laid off with the dividers; the line $BC$ is the normal; and
# the profile has not been used.
#
# In practice one draws the congruent triangle on the other side: lay the length $v$ off from $B$, square to the motion, **turned
# from $\vec v_2$ by 90° in the sense of the cam's rotation**, to $D$. Then the angle between $DA$ and the motion is $\alpha$. In
# numbers
#
# $$ \tan\alpha = \frac{v - \sigma e}{s_0 + s}, \qquad s_0 = \sqrt{r_0^2 - e^2}, $$
#
# with $\sigma = +1$ for an anticlockwise cam and $-1$ for a clockwise one, and $e$ positive to the right.
#
# ## The construction
#
# The task of the course, from the file `task.toml`, at the station of the maximum velocity of the rise. The minimum radius is that of
# notebook 4; here take it as given.
#
# **Predict.** Where is the pressure angle of the rise largest: where $v$ is, before it, or after it? Look at the formula, and think of what
# the height $s_0 + s$ does meanwhile.
#
# **Draw it.** `graphcam solve task.toml --upto minimum_radius --out half` prints the sheet with everything that the plan starts from.

# %%
task = lesson_task("task.toml", "translating")
solution = gc.solve(task)

# %% jupyter={"source_hidden": true} tags=["remove-input"]
sense = {"cw": "clockwise", "ccw": "anticlockwise"}[task.rotation]
cam = solution.cam
Markdown(f"The cam turns {sense}; $r_0 = {cam.prime_radius:g}$ mm, $e = {cam.follower.offset:g}$ mm.")

# %% jupyter={"source_hidden": true} tags=["remove-input"]
plan = solution.drawn["pressure_angle"]
show_steps(plan, within=solution, on=solution.drawn["minimum_radius"])

# %% [markdown]
# Then the angle is found at every station and plotted over the cam angle. The maximum values are compared with the limits.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
show_steps(solution.drawn["angle_diagram"], within=solution)

# %% [markdown]
# Where the acceleration jumps, the curve has a corner: the angle itself is continuous, its slope is not. With a law without jumps it is
# smooth.
#
# **Write it.** From the readings of $s$ and $v$ compute the pressure angle at all stations at once, in degrees, with its sign. Two lines are
# enough.

# %%
s, v = (solution.drawn["integration"].readings[name].value for name in ("s", "v"))
e, r0, sigma = cam.follower.offset, cam.prime_radius, {"ccw": 1, "cw": -1}[task.rotation]

# %% jupyter={"source_hidden": true} tags=["remove-input"]
s0_of_r0 = np.sqrt(r0**2 - e**2)
pressure_angles = ArrayQuestion(
    np.degrees(plan.readings["alpha"].value), 1e-6, "the two legs of the triangle, and which way the cam turns",
    {"e has the wrong sign": np.degrees(np.arctan((v + sigma * e) / (s0_of_r0 + s))),
     "the height is counted from s₀, not from r₀": np.degrees(np.arctan((v - sigma * e) / (r0 + s))),
     "the angles are in radians": plan.readings["alpha"].value},
)

# %% tags=["try-it"]
your_alphas = None  # degrees, one for each station, from s, v, e, r0 and sigma
pressure_angles.check(your_alphas)

# %% tags=["hide-input"]
s0 = np.sqrt(r0**2 - e**2)
alpha = np.degrees(np.arctan2(v - sigma * e, s0 + s))
print(f"maximum on the rise {alpha.max():.2f}°, on the return {alpha.min():.2f}°")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert pressure_angles.check(alpha).status == "right"
assert np.abs(alpha - np.degrees(plan.readings["alpha"].value)).max() < 1e-9

# %% [markdown]
# ## The sign of the offset, tried out
#
# The follower's line may pass the cam centre on either side. On one side the rise gains and the return loses; on the other it is the
# reverse. Which one? Look at $\tan\alpha = (v - \sigma e)/(s_0 + s)$: on the rise $v > 0$, and the angle shrinks if $\sigma e > 0$. So
#
# > **The favourable offset for the rise lies on the side that the top of the cam moves away from:** right of the centre for
# > an anticlockwise cam, left of it for a clockwise one.
#
# Try all four cases on one cam, $r_0 = 45$ mm, $|e| = 10$ mm, with a smooth law:

# %% jupyter={"source_hidden": true} tags=["remove-input"]
motion = gc.Motion([
    gc.Rise(30, np.radians(120), "3-4-5"), gc.Dwell(np.radians(60)),
    gc.Return(30, np.radians(120), "3-4-5"), gc.Dwell(np.radians(60)),
])
cases = {}
for rotation in ("ccw", "cw"):
    for offset in (10.0, -10.0):
        cam = gc.Cam(motion, gc.Translating(offset=offset), prime_radius=45, rotation=rotation)
        extremes = cam.extremes()
        cases[rotation, offset] = degrees(extremes.pressure_angle_rise[0]), degrees(extremes.pressure_angle_return[0])
table(("rotation", "e, mm", "maximum α on the rise, °", "on the return, °"),
      [(rotation, f"{offset:+g}", *angles) for (rotation, offset), angles in cases.items()], digits=2)

# %% [markdown]
# Rotation and offset enter only together, as $\sigma e$: turn the cam the other way *and* put the follower on the other side, and you
# have the mirror image of the same mechanism. What the rise gains, the return pays for. With a spring (force closure) the return's
# angle does not matter, and the offset costs nothing.

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert cases["ccw", 10.0] == cases["cw", -10.0]
assert [round(cases["ccw", e][0], 1) for e in (10.0, -10.0)] == [16.3, 33.1]  # question 3


# %% jupyter={"source_hidden": true} tags=["remove-input"]
def angles(offset, rotation):
    cam = gc.Cam(motion, gc.Translating(offset=float(offset)), prime_radius=45, rotation=rotation)
    phi = np.radians(np.linspace(0, 360, 721))
    figure, axes = chart("φ, °", "α, °", 2.6)
    axes.plot(np.degrees(phi), np.degrees(cam.pressure_angle(phi)), color="#0b57a4")
    for limit in (-30, 30):
        axes.axhline(limit, color="#b3201c", linewidth=0.8)
    axes.set_ylim(-50, 50)
    return picture_of(figure, f"The pressure angle over the cam angle for an offset of {offset} mm and a cam that turns {rotation}, "
                      "with lines at plus and minus 30 degrees.", "Pressure angle over a revolution, limits of 30°")


explore(
    angles,
    offset=Slider("offset e, mm", (-20, -15, -10, -5, 0, 5, 10, 15, 20), 0, (-15, 15)),
    rotation=Slider("rotation", ("ccw", "cw"), "ccw"),
)

# %% [markdown]
# ## Try it yourself
#
# A cam turns **anticlockwise**, $r_0 = 50$ mm, $e = +30$ mm. At a station of the rise $s = 12$ mm and $v = 50$ mm/rad. Construct
# the angle at 1:1: $B$ on the follower's line at the height $s_0 + s$ above the centre, $v$ from $B$ to the correct side, the angle of $DA$ with the
# motion.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
MEANING = Meaning("height_and_angle", say("Height and angle"), say("A triangle of two lengths."),
                  {"s0": ReadingMeaning(say("height"), "s0", "mm"), "alpha": ReadingMeaning(say("pressure angle"), "α", "rad")})


def drawn_triangle(reading, side):
    """How s₀ or the angle is drawn at 1:1: the prime circle cut by the follower's line, and D beside B, to the left or right."""
    def draw(pencil):
        hand = Hand(pencil, MEANING)
        centre = hand.given("A")
        line = hand.erect("line of the follower", hand.lay_off("e", centre, 1 + 0j, 30.0))
        lowest = hand.cross("lowest place", line, hand.circle("prime circle", centre, 50.0))
        if reading == "s0":
            return hand.read("s0", distance_between(lowest, hand.project("foot", centre, line)), 1.0)
        end = hand.lay_off("D", hand.lay_off("B", lowest, 1j, 12.0), side + 0j, 50.0)
        return hand.angle("alpha", 1j, hand.join("AD", centre, end), -side)
    return draw


def alpha_of(across, height):
    return degrees(atan2(across, height))


height = Question.by(
    drawn_triangle("s0", -1), "the right triangle of r₀ and e",
    {"s₀ is not the prime radius: the follower's line passes the centre at the distance e": 50.0,
     "e is a leg, not the hypotenuse": (50**2 + 30**2) ** 0.5},
)
angle = Question.by(
    drawn_triangle("alpha", -1), "the side of D and the height of B",
    {"v was laid off to the wrong side, or e has the wrong sign": alpha_of(50 + 30, 52),
     "the displacement s is forgotten": alpha_of(50 - 30, 40),
     "the offset is forgotten in the horizontal leg": alpha_of(50, 52),
     "the height is taken from r₀ instead of s₀": alpha_of(50 - 30, 62),
     "that is the transmission angle, 90° − α": 90 - alpha_of(50 - 30, 52)},
)
reverse = Question.by(
    drawn_triangle("alpha", 1), "what changes with the sense of rotation: the side of D",
    {"the angle does change with the rotation": alpha_of(50 - 30, 52)},
)

# %% tags=["try-it"]
your_s0 = None  # mm
height.check(your_s0)

# %% tags=["try-it"]
your_alpha = None  # degrees
angle.check(your_alpha)

# %% [markdown]
# Now the same cam turns **clockwise**. What does the pressure angle become?

# %% tags=["try-it"]
your_alpha_clockwise = None  # degrees
reverse.check(your_alpha_clockwise)

# %% [markdown]
# ## Drawn and exact

# %%
compared(solution, "max_pressure_angle_rise_deg", "max_pressure_angle_return_deg")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
# Each leg off by 0.3 mm, 75 mm of AD: whatever the angle, it is off by 0.3/75.
seed = np.random.default_rng(1)
for degree in (10, 30, 50):
    q, p = (75 * f(np.radians(degree)) + 0.3 * seed.standard_normal(10**5) for f in (np.sin, np.cos))
    assert abs(np.std(np.arctan2(q, p)) / (0.3 / 75) - 1) < 0.02
assert abs(degrees(0.3 / 75) - 0.23) < 0.001
assert abs(height.value - 40) < 1e-9
assert abs(angle.value - alpha_of(20, 52)) < 1e-9

# %% [markdown]
# ## Where the error comes from
#
# A pressure angle is the quotient of two lengths. Let each be off by $\delta$ mm of paper, one independently of the other; then
# $\alpha$ is off by $\delta/\overline{AD}$ radians, whatever it is, where $\overline{AD}$ is the length on paper. At 75 mm and
# $\delta = 0.3$ mm that is 0.23°. A protractor that is read to half a degree adds twice as much: **compute $\alpha$ from the two measured legs** rather than measure the angle.
#
# The maximum angle lies *between* stations, so it is read from the smooth curve. The largest of the plotted points is always on the
# unsafe side.
#
# ## Questions
#
# 1. Why is the profile not needed to find $\alpha$? Which of its properties is used nevertheless?
# 2. Where does the pressure angle vanish during the rise of an offset follower, and what does the velocity plan look like there?
# 3. Your neighbour's cam has 16.3° on the rise where you have 33.1°, with the same $r_0$ and $|e|$. What do you ask?
# 4. During a dwell the follower does not move. Is the pressure angle zero then?
#
# <details><summary>Model answers</summary>
#
# 1. The normal passes through $C$, and $AC = v$ is known from the motion. Of the profile only this is used: that it touches the roller, so that both have one normal and slide square to it.
# 2. Where $v = \sigma e$. The normal lies along the motion then, so $\vec v_{21}$ is square to $\vec v_2$: the triangle has a right angle.
# 3. On which side of the centre the follower stands, and which way the cam turns: one of the two is the other way round in one of the drawings.
# 4. Only for a central follower: with $v = 0$, $\tan\alpha = -\sigma e/(s_0 + s)$.
#
# </details>
