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
#   title: "Stress below the surface: Hertz and finite elements"
# ---

# %% [markdown]
# # 11. Stress below the surface: Hertz and finite elements
#
# **Aim.** At the end you can say where the material under a roller is stressed most, and judge whether the stress from a finite element program can be right.
#
# **You need** the stress between roller and profile (notebook 9), the radius of curvature (notebook 6). On paper: A4. **Time:** 45
# minutes, 15 of them with the pencil.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
from math import degrees, inf, pi, sqrt

import numpy as np

import graphcam as gc
from graphcam.notebooks import Question, Slider, changed, chart, explore, picture_of, show_steps, table
from graphcam.tasks.material_table import MaterialTable
from graphcam.tasks.spring_tables import SpringTable

# %% [markdown]
# ## Background
#
# A roller of radius 15 mm is pressed onto a cam whose profile has a radius of 30 mm there, with 1000 N over a width of 20 mm; both are of steel. Hertz's formulas give the pressure in the middle
# of the contact and half of the width over which they touch:

# %%
contact = gc.contact_by_elements(force=1000, width=20, radius1=30, radius2=15, parts=20)
p0, a = contact.hertz
print(f"Hertz: peak pressure {p0:.1f} MPa, half-width {a:.4f} mm")

# %% [markdown]
# The strip is 0.15 mm wide, 1/200 of the roller's diameter. All that matters happens in a piece of steel of about this size. That determines the computation: the mesh must be fine
# *there*.
#
# Below the middle, at the depth $z$, K. L. Johnson's book *Contact Mechanics* (section 4.2) has
#
# $$ \sigma_z = -\frac{p_0}{\sqrt{1+(z/a)^2}}, \qquad
# \sigma_x = -p_0\left(\frac{1+2(z/a)^2}{\sqrt{1+(z/a)^2}} - 2\,\frac za\right), \qquad \tau = \frac{|\sigma_x-\sigma_z|}{2}. $$
#
# At the surface both are $-p_0$: the steel is compressed from all sides and hardly sheared. The shear stress has its maximum *below* the surface, $0.300\,p_0$ at the
# depth $0.786\,a$. There cracks begin in rolling contacts, and pits form.

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert abs(2 * a - 0.15) < 0.001
assert round(2 * 15 / (2 * a)) == 200
depth = np.linspace(0, 3, 300001)
sigma_z, sigma_x = -1 / np.sqrt(1 + depth**2), -((1 + 2 * depth**2) / np.sqrt(1 + depth**2) - 2 * depth)
shear_below = np.abs(sigma_x - sigma_z) / 2
assert abs(shear_below.max() - 0.300) < 0.001
assert abs(depth[shear_below.argmax()] - 0.786) < 0.001

# %% [markdown]
#
# ## Computed by elements
#
# Independently of any formula, one half of each body, on one side of the common normal, is divided into small quadrilaterals. Elasticity gives the displacement of the surface under forces on it. Which nodes touch
# is found by iteration: a node under tension is released, one that would penetrate the other body is closed, until nothing changes.

# %% jupyter={"source_hidden": true} tags=["remove-input"]
figure, axes = chart("distance from the common normal, half-widths", "pressure, MPa", 2.8)
x = np.linspace(0, 1, 300)
axes.plot(x, p0 * np.sqrt(1 - x * x), color="#5a5a5a", label="Hertz: half an ellipse")
axes.plot(contact.x / a, contact.pressure, ".", color="#0b57a4", label="nodes of the mesh")
axes.legend(fontsize=8)
picture_of(figure, "The pressure over the distance from the common normal: the nodes of the mesh lie on the quarter of an ellipse that Hertz's formula gives, from 424 MPa in "
           "the middle to zero at the half-width.", "The pressure between roller and profile")

# %% [markdown]
# How fine must the mesh be? The errors of peak pressure and half-width against Hertz, over the number of elements on the half-width:

# %%
parts = np.array([5, 10, 20, 40])
meshes = [gc.contact_by_elements(1000, 20, 30, 15, parts=int(count)) for count in parts]
pressure_errors = np.array([abs(mesh.peak_pressure / p0 - 1) for mesh in meshes])
width_errors = np.array([abs(mesh.half_width / a - 1) for mesh in meshes])
orders = [-np.polyfit(np.log(parts), np.log(errors), 1)[0] for errors in (pressure_errors, width_errors)]
table(("elements on the half-width", "in all", "error of peak pressure, %", "of half-width, %"),
      [(str(count), str(mesh.elements), 100 * one, 100 * other)
       for count, mesh, one, other in zip(parts, meshes, pressure_errors, width_errors, strict=True)])

# %% jupyter={"source_hidden": true} tags=["remove-input"]
figure, axes = chart("elements on the half-width", "error", 2.6)
axes.loglog(parts, pressure_errors, "o-", color="#0b57a4", label="peak pressure")
axes.loglog(parts, width_errors, "s-", color="#b3201c", label="half-width")
axes.loglog(parts, 0.1 / parts**2.0, "--", color="#5a5a5a", label="second order")
axes.legend(fontsize=8)
picture_of(figure, "Errors over the number of elements on the half-width, both axes logarithmic: they fall at least with the square of that number, from one percent with 5 elements "
           "to some hundred-thousandths with 40.", "The errors fall at least with the square of the elements' size")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert min(orders) > 1.8
assert pressure_errors[1] < 0.002
assert width_errors[1] < 0.002

# %% [markdown]
# The stresses themselves, in both bodies:

# %% jupyter={"source_hidden": true} tags=["remove-input"]


def fields(found, names=("max_shear", "von_mises")):
    """Stresses about the contact as shares of the peak pressure, over places in half-widths: above the roller, below the cam."""
    from matplotlib.figure import Figure

    unit, peak = found.hertz.half_width, found.hertz.peak_pressure
    figure = Figure((7.0, 3.6))
    for axes, name, title in zip(figure.subplots(1, 2), names, ("maximum shear stress / p0", "von Mises stress / p0"), strict=True):
        for body, up in zip(found.bodies, (-1, 1), strict=True):
            near = (body.x < 2.3 * unit) & (body.depth < 2.3 * unit)
            # What is meshed is one half; the other one is its image.
            across = np.concatenate([-body.x[near], body.x[near]]) / unit
            filled = axes.tricontourf(across, up * np.tile(body.depth[near], 2) / unit, np.tile(getattr(body, name)[near], 2) / peak,
                                      levels=np.linspace(0, 0.32 if name == "max_shear" else 0.6, 9), cmap="viridis")
        axes.axhline(0, color="white", linewidth=0.8)
        axes.set(xlim=(-2, 2), ylim=(-2, 2), aspect="equal", title=title, xlabel="half-widths")
        axes.title.set_fontsize(9)
        figure.colorbar(filled, ax=axes, shrink=0.8)
    return figure


picture_of(fields(meshes[1]), "Two maps of the stress about the contact, roller above and cam below: both have their maximum below the surface on the common normal, the shear stress at three quarters of the "
           "half-width, and small at the surface beside the contact.", "Stresses in the roller (above) and in the cam (below)")

# %% [markdown]
# ## Where on the cam
#
# Over the turn the force changes, and so does the curvature of the profile. A task gives the materials in a table `[material]`; then the sheet has a diagram of the stress beside the permitted stress. Here a
# follower of 2 kg on a cam with a preload of 1500 N, at 300 rpm:

# %%
task = changed(gc.builtin_task(), {
    "speed_rpm": 300.0, "spring": SpringTable(mass=2, stiffness=20, preload=1500),
    "material": MaterialTable(width=15, permitted_stress=1000),
})
solution = gc.solve(task)
show_steps(solution.stress.drawn["contact_stress"], within=solution)

# %%
at, most = solution.stress.contact, solution.stress.max_pressure
print(f"{most.value:.0f} MPa at {degrees(most.phi):.1f} degrees: {float(at.force):.0f} N on a profile of radius {float(at.profile_radius):.1f} mm")

# %% [markdown]
# The maximum stress is not where the force has its maximum: the stress grows with the square root of the force, and with the square root of the relative curvature $1/\varrho + 1/r$. On a sharp, convex part a small force
# does more harm than a large one in a hollow. A knife edge has no radius at all, and by Hertz an infinite stress.

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert abs(most.value - gc.hertz_line_contact(float(at.force), 15, float(at.profile_radius), solution.cam.roller_radius).peak_pressure) < 1e-6
assert degrees(abs(most.phi - solution.spring.max_normal.phi)) > 1

# %% [markdown]
# ## Try it yourself
#
# The load is 4000 N instead of 1000 N, everything else is unchanged. First sketch how the quarter of an ellipse changes. How large is the peak pressure, and at which depth is the maximum shear
# stress?

# %% jupyter={"source_hidden": true} tags=["remove-input"]
heavy = gc.hertz_line_contact(4000, 20, 30, 15)
pressure_of_four = Question(
    heavy.peak_pressure, 5.0, "MPa", "how does the force enter the formula?",
    {"the force is under a square root": 4 * p0, "the pressure grows, it does not stay": p0},
    found_by="calculation",
)
depth_of_four = Question(
    0.786 * heavy.half_width, 0.005, "mm", "the half-width first",
    {"the half-width grows too, with the root of the force": 0.786 * a, "that is the half-width": heavy.half_width},
    found_by="calculation",
)

# %% tags=["try-it"]
your_peak_pressure = None  # MPa
pressure_of_four.check(your_peak_pressure)

# %% tags=["try-it"]
your_depth = None  # mm
depth_of_four.check(your_depth)

# %% [markdown]
# ## Move the sliders
#
# The profile's radius of curvature: convex, flat, and concave.


# %% jupyter={"source_hidden": true} tags=["remove-input"]
def below(radius):
    found = gc.contact_by_elements(1000, 20, float(radius), 15, parts=8)
    figure, axes = chart("depth, mm", "stress, MPa", 2.6)
    body = found.bodies[0]
    axis = np.flatnonzero(body.x < 1.001 * body.x.min())
    axis = axis[np.argsort(body.depth[axis])]
    for name, color, label in (("max_shear", "#b3201c", "maximum shear"), ("von_mises", "#0b57a4", "von Mises")):
        axes.plot(body.depth[axis], getattr(body, name)[axis], color=color, label=label)
    axes.set(xlim=(0, 0.4), ylim=(0, 260))
    axes.legend(fontsize=8)
    return picture_of(figure, f"Shear stress and von Mises stress over the depth below the surface for a profile radius of {radius} mm: both rise from the surface to a peak and fall slowly.",
                      f"Below the middle; peak pressure {found.hertz.peak_pressure:.0f} MPa, half-width {found.hertz.half_width:.3f} mm")


explore(below, radius=Slider("profile radius, mm", (30.0, 60.0, inf, -60.0, -30.0), 30.0, (30.0, -30.0)))

# %% [markdown]
# ## Drawn and exact
#
# Nothing is drawn here; elements are compared with formulas:

# %%
body = contact.bodies[0]
shear, mises = int(body.max_shear.argmax()), int(body.von_mises.argmax())
table(("", "by elements", "by formulas"), [
    ("peak pressure, MPa", contact.peak_pressure, p0),
    ("half-width, mm", contact.half_width, a),
    ("maximum shear stress / p0", body.max_shear[shear] / p0, 0.3003),
    ("its depth / a", body.depth[shear] / a, 0.786),
    ("maximum von Mises stress / p0", body.von_mises[mises] / p0, 0.5578),
    ("its depth / a", body.depth[mises] / a, 0.704),
], digits=4)

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert abs(body.max_shear[shear] / p0 - 0.3003) < 0.002
assert abs(body.depth[shear] / a - 0.786) < 0.05

# %% [markdown]
# ## Where the error comes from
#
# **The half spaces.** Hertz assumes that both bodies are infinite. Ours end at 12 mm, so all stresses across the normal are off by some 0.3 % of the peak pressure. This error grows with the ratio of
# half-width to radius.
#
# **The mesh.** A design report states "6.4 MPa" for a roller of 15 mm under 100 N, read off a finite element program. What does Hertz say for a cam of 60 mm and a width of 15 mm?

# %%
hertz = gc.hertz_line_contact(force=100, width=15, radius1=60, radius2=15)
print(f"peak pressure {hertz.peak_pressure:.0f} MPa, half-width {hertz.half_width:.4f} mm")
print(f"100 N over 15 mm and an element of 1 mm: {100 / 15 / 1:.1f} MPa")

# %% jupyter={"source_hidden": true} tags=["remove-cell"]
assert abs(hertz.peak_pressure - 141.5) < 1
assert round(hertz.peak_pressure / 6.4) == 22
assert abs(1000 * (0.2 / 0.786 / a) ** 2 - 11500) < 50  # question 3
assert abs(2 * hertz.half_width - 0.06) < 0.001
assert abs(hertz.peak_pressure - sqrt(100 / 15 * 113186.813 / pi * (1 / 60 + 1 / 15))) < 1e-3

# %% [markdown]
# Twenty-two times as much. The strip is 0.06 mm wide; a mesh with elements of about 1 mm, as programs choose them for a cam of that size, cannot resolve it and spreads the force over a whole element:
# 100 N over 15 mm times 1 mm are 6.7 MPa. So a stress of that size tells how large the elements were, not how the steel is stressed. (The report gives neither its width nor its mesh; this
# explanation is our interpretation of its number.)
#
# ## Questions
#
# 1. A mesh is made twice as fine, and the stress doubles. What follows?
# 2. Why is the surface in the middle of the contact hardly sheared, although the pressure is highest there?
# 3. Pits in a cam are some tenths of a millimetre deep. Which load would put the maximum shear stress at 0.2 mm here?
# 4. With friction the point of maximum stress moves. Which way?
#
# <details><summary>Model answers</summary>
#
# 1. That the force goes into one element, however large: the mesh does not resolve the contact, and its stress says nothing. It must be made finer there until the stress stays.
# 2. Both stresses are $-p_0$ there; shear comes from their difference.
# 3. The depth is $0.786\,a$, and $a$ grows with the root of the force: about 11.5 kN.
# 4. Towards the surface.
#
# </details>
