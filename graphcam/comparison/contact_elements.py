"""The contact of roller and cam by finite elements: an independent check of Hertz's formulas.

Both bodies are meshed as far as the smaller radius reaches, as halves to one side of the common normal, in plane strain
and without friction.  Their meshes share the distances from the normal, so places of contact lie opposite each other;
which of them touch is found by an active set.  Hertz takes both bodies as half spaces; at a half-width of 1/200 of the
radius that is true to some 1e-5.

Source: K. L. Johnson, *Contact Mechanics* (1985), chapters 4 and 5; the rest is linear elasticity.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError, installed
from graphcam.former_names import renamed
from graphcam.given.laws import Floats
from graphcam.given.roller_contact import STEEL_POISSON_RATIO, STEEL_YOUNG_MODULUS
from graphcam.mechanism.hertz import LineContact, hertz_line_contact
from graphcam.words import say

MESH_HALF_WIDTH, MESH_DEPTH = 1.5, 2.0
"""Half-widths of the contact, to the side and into the depth, over which the mesh is even."""
MESH_GROWTH = 1.15
"""The growth from element to element beyond the even mesh."""
MESHED_SHARE = 0.8
"""Share of the smaller radius that is meshed: a profile over more of it would stand upright."""
MAX_HALF_WIDTH = 0.2
"""Share of the smaller radius that the half-width may be; beyond, nothing about it is a line contact."""
MIN_ELEMENTS = 4
"""Elements over the half-width: with fewer there is no distribution of a pressure."""


@dataclass(frozen=True, eq=False)
class ElementStresses:
    """Stresses in the middles of a body's elements (n,), MPa, tension positive.

    x : distance from the common normal;  depth : below the surface [mm]
    across, along : normal to the common normal and along it;  out : along the axis;  shear : between the first two
    """

    x: Floats
    depth: Floats
    across: Floats
    along: Floats
    out: Floats
    shear: Floats

    @property
    def max_shear(self) -> Floats:
        """The maximum shear stress in the plane of the figure, (n,) MPa."""
        return np.hypot((self.across - self.along) / 2, self.shear)

    @property
    def von_mises(self) -> Floats:
        """The equivalent stress after von Mises (n,) [MPa]."""
        a, b, c = self.across - self.along, self.along - self.out, self.out - self.across
        return np.sqrt((a * a + b * b + c * c) / 2 + 3 * self.shear**2)


@renamed(greatest_shear="max_shear")
@dataclass(frozen=True, eq=False)
class ElementContact:
    """A contact by finite elements.

    hertz : the same by Hertz
    x : (n,) distances of the nodes from the common normal [mm];  pressure : (n,) MPa, 0 where there is no contact
    bodies : stresses in the cam and in the roller
    elements : the number of elements of both meshes
    """

    hertz: LineContact
    x: Floats
    pressure: Floats
    bodies: tuple[ElementStresses, ElementStresses]
    elements: int

    @property
    def peak_pressure(self) -> float:
        """The pressure in the middle, MPa."""
        return float(self.pressure[0])

    @cached_property
    def half_width(self) -> float:
        """The place where the pressure ends [mm]: there the line fitted to p^2 over x^2 by least squares is zero."""
        touch = self.pressure > 0
        slope, middle = np.polyfit(self.x[touch] ** 2, self.pressure[touch] ** 2, 1)
        return math.sqrt(-middle / slope)


@renamed(young="young1", poisson="poisson1")
def contact_by_elements(
    force: float,
    width: float,
    radius1: float,
    radius2: float,
    young1: float = STEEL_YOUNG_MODULUS,
    young2: float = STEEL_YOUNG_MODULUS,
    poisson1: float = STEEL_POISSON_RATIO,
    poisson2: float = STEEL_POISSON_RATIO,
    parts: int = 20,
) -> ElementContact:
    """The contact of two cylinders with parallel axes; it needs the extra ``fem``.

    force : N, more than 0;  width : of the contact along the axes [mm]
    radius1, radius2 : of the cam and of the roller [mm]; a concave one is negative, a flat one infinite
    young1, young2 : MPa;  poisson1, poisson2 : from 0, less than 0.5
    parts : elements over the half-width of the contact; errors fall with their square, and the time grows with it

    Raises
    ------
    DesignError : a value is impossible, they touch in no single line, or the contact is too wide for one
    TaskError : scikit-fem is not installed

    >>> contact = contact_by_elements(1000, 20, 30, 15)
    >>> round(contact.peak_pressure / contact.hertz.peak_pressure, 3)
    1.0
    >>> round(contact.half_width / contact.hertz.half_width, 3)
    1.0
    """
    if not force > 0:
        raise DesignError("force", force, say("a finite number greater than 0 N"))
    for name, poisson in (("poisson1", poisson1), ("poisson2", poisson2)):
        if not poisson < 0.5:
            raise DesignError(name, poisson, say("less than 0.5"), say("what keeps its volume needs another element"))
    if parts < MIN_ELEMENTS:
        raise DesignError("parts", parts, say("{least} elements over the half-width or more", least=MIN_ELEMENTS))
    hertz = hertz_line_contact(force, width, radius1, radius2, young1, young2, poisson1, poisson2)
    reach = MESHED_SHARE * min(abs(radius1), abs(radius2))
    if not hertz.half_width < MAX_HALF_WIDTH * reach / MESHED_SHARE:
        expected = say("such that the half-width {half_width:.3g} mm is less than {most:g} of the radius")
        expected = expected.with_values(half_width=hertz.half_width, most=MAX_HALF_WIDTH)
        raise DesignError("force", force, expected, say("reduce the force, or widen the contact"))
    x = _graded(MESH_HALF_WIDTH * hertz.half_width, round(MESH_HALF_WIDTH * parts), reach)
    depth = _graded(MESH_DEPTH * hertz.half_width, round(MESH_DEPTH * parts), reach)
    materials = (radius1, young1, poisson1), (radius2, young2, poisson2)
    bodies = [_Body(*material, x, depth) for material in materials]
    near = x[: round(MESH_HALF_WIDTH * parts)]
    yielding = bodies[0].yielding(near.size) + bodies[1].yielding(near.size)
    loads = _loads(yielding, _gap(radius1, near) + _gap(radius2, near), force / width)
    steps = np.diff(x[: near.size + 1])
    # The force at a node comes from half of the elements on both sides; in the middle from the one that is meshed.
    lengths = np.append(steps[0], steps[:-1] + steps[1:]) / 2
    return ElementContact(
        hertz,
        near,
        loads / lengths,
        (bodies[0].stresses(loads), bodies[1].stresses(loads)),
        sum(body.mesh.t.shape[1] for body in bodies),
    )


def _graded(even: float, count: int, reach: float) -> Floats:
    """Places from 0 to the reach: evenly so many at first, then ever farther apart."""
    fine = np.linspace(0, even, count + 1)
    step = even / count
    growing = math.ceil(math.log1p((reach - even) / step * (MESH_GROWTH - 1) / MESH_GROWTH) / math.log(MESH_GROWTH))
    beyond = np.cumsum(MESH_GROWTH ** np.arange(1, growing + 1))
    return np.append(fine, even + (reach - even) * beyond / beyond[-1])


def _gap(radius: float, x: Floats) -> Floats:
    """How far an arc lies behind its tangent at distances x (n,) from the place where it touches that, mm."""
    # As x^2/(R + sqrt(R^2 - x^2)), which loses no digits near the tangent; nothing for a plane.
    return x * x / (radius + math.copysign(1, radius) * np.sqrt((abs(radius) - x) * (abs(radius) + x)))


def _loads(yielding: Floats, gap: Floats, load: float) -> Floats:
    """The forces (n,) on nodes to one side of the normal that together are half of the load: none pulls.

    yielding : (n, n) by how much nodes approach by unit forces;  gap : (n,) between them without a force
    """
    touch = gap <= gap[gap.size // 2]
    for _ in range(gap.size):
        count = int(touch.sum())
        system = np.zeros((count + 1, count + 1))
        system[:-1, :-1] = yielding[np.ix_(touch, touch)]
        system[:-1, -1], system[-1, :-1] = -1, 1
        *pushed, nearer = np.linalg.solve(system, np.append(-gap[touch], load / 2))
        loads = np.zeros(gap.size)
        loads[touch] = pushed
        closed = np.where(touch, loads > 0, yielding @ loads + gap < nearer)
        if np.array_equal(closed, touch):
            return loads
        touch = closed
    raise ArithmeticError("it is not found which nodes touch")


class _Body:
    """One of the bodies: its mesh, held far from the contact, and its solved stiffness."""

    def __init__(self, radius: float, young: float, poisson: float, x: Floats, depth: Floats) -> None:
        with installed("contact_by_elements", "scikit-fem", "fem"):
            import skfem
            from skfem.models import elasticity
        from scipy.sparse.linalg import splu

        self.depth, self.poisson = depth, poisson
        flat: Any = skfem.MeshQuad.init_tensor(x, -depth[::-1])
        at, down = flat.p
        # The surface follows the profile; at the foot there is no need to.
        self.mesh: Any = skfem.MeshQuad(np.array([at, down - _gap(radius, at) * (1 + down / depth[-1])]), flat.t)
        self.basis: Any = skfem.Basis(self.mesh, skfem.ElementVector(skfem.ElementQuad1()))
        self.lame: tuple[float, float] = elasticity.lame_parameters(young, poisson)
        stiffness: Any = skfem.asm(elasticity.linear_elasticity(*self.lame), self.basis).tocsc()
        sideways, along = self.basis.nodal_dofs
        surface = np.flatnonzero(down == 0)
        self.surface: NDArray[np.int64] = along[surface[np.argsort(at[surface])]]
        held = np.concatenate([along[down == -depth[-1]], sideways[at == 0]])
        self.size = int(self.basis.N)
        self.free = np.setdiff1d(np.arange(self.size), held)
        self.solved = splu(stiffness[self.free][:, self.free])

    def moved(self, forces: Floats) -> Floats:
        """Displacements (size, m) by forces (size, m)."""
        found = np.zeros(forces.shape)
        found[self.free] = self.solved.solve(forces[self.free])
        return found

    def yielding(self, count: int) -> Floats:
        """The displacements of the first surface nodes by unit forces on them (count, count), mm."""
        nodes = self.surface[:count]
        pushed = np.zeros((self.size, count))
        pushed[nodes, np.arange(count)] = 1
        return self.moved(pushed)[nodes]

    def stresses(self, loads: Floats) -> ElementStresses:
        """Stresses under forces (n,) per mm of width that push the nodes of the surface."""
        pushed = np.zeros((self.size, 1))
        pushed[self.surface[: loads.size], 0] = -loads
        # The mean of an element is the value in its middle, where four-cornered elements are most exact.
        strain = np.asarray(self.basis.interpolate(self.moved(pushed)[:, 0]).grad).mean(axis=-1)
        first, second = self.lame
        pressed = first * (strain[0, 0] + strain[1, 1])
        across, along = pressed + 2 * second * strain[0, 0], pressed + 2 * second * strain[1, 1]
        corners = self.mesh.p[:, self.mesh.t].mean(axis=1)
        return ElementStresses(
            x=corners[0],
            depth=-corners[1],
            across=across,
            along=along,
            out=self.poisson * (across + along),
            shear=second * (strain[0, 1] + strain[1, 0]),
        )
