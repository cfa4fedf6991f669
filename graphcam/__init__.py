"""Cams designed on the drawing board: textbook constructions drawn to scale, computed, and compared with exact values.

Units.  Machine lengths in mm, forces in N, stress in MPa, mass in kg; angles in radians, but in degrees in files,
tables, captions and any name that ends in ``_deg``.  Derivatives are with respect to the cam angle phi in radians:
s [mm], v = ds/dphi [mm/rad], a [mm/rad^2], j [mm/rad^3].  For an oscillating follower s is the angle psi - psi0 [rad].

Paper.  Lengths on paper are in mm too, so every name of one ends in ``_paper``.  A scale mu is machine units per mm of
paper: value = mu * length_paper.

Frame.  Cam centre at the origin, x right, y up.  The cam turns by phi >= 0 in the sense sigma: ``rotation="ccw"`` is
sigma = +1, ``"cw"`` is sigma = -1.  By inversion a point fixed to the frame appears in cam coordinates turned by
-sigma*phi.  All coordinates of profiles are cam coordinates at phi = 0.

- Translating follower: the trace point (roller centre or knife edge) moves up along x = e.  r0 is the *prime radius*,
  the minimum radius of the pitch curve; s0 = sqrt((r0 - e)(r0 + e)); the trace point is (e, s0 + s), and
  tan(alpha) = (v - sigma*e)/(s0 + s), positive on an ordinary rise.  A favourable offset has sigma*e > 0.
- Oscillating follower: pivot at (c, 0), arm l above the line of centres, psi the angle between them;
  cos(psi0) = (c^2 + l^2 - r0^2)/(2 c l), psi = psi0 + s, tan(alpha) = (l (1 + sigma*v) - c cos(psi))/(c sin(psi)).
  A rise turns the arm clockwise; alpha is positive on an ordinary rise for sigma = +1 (opposite senses), negative for
  sigma = -1 (the same sense).
- Flat-faced follower: contact at (sigma*v, r0 + s); the radius of curvature of the profile is r0 + s + a.
- Oscillating flat face: pivot at (c, 0), face along (-cos(psi), sin(psi)), f beside the pivot towards the cam centre;
  c*sin(psi0) = r0 + f; psi = psi0 + s, on the rise the face turns clockwise.
- Curvature kappa of the pitch curve is positive where the cam is convex.
- The working profile is the inner parallel curve of the pitch curve at the roller radius.

Errors.  A design that cannot be raises :class:`DesignError`, a wrong file :class:`TaskError`; inside arrays a miss is
NaN.
"""

import lazy_loader

__version__ = "0.1.0"

# The public names and where they stand are listed once, in __init__.pyi: a module loads when its name is first used.
_found, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str) -> object:
    """A public name, loaded when it is first used; of a misspelt one the nearest is told."""
    try:
        return _found(name)
    except AttributeError as error:
        if name.startswith("_") or name in __all__:
            raise
        from graphcam.errors import nearest_word_remedy
        from graphcam.former_names import FORMER_NAMES

        if name in FORMER_NAMES:
            told = f"graphcam has no name {name!r} any more: write {FORMER_NAMES[name]!r}"
            raise AttributeError(told, name=name) from None
        near = nearest_word_remedy(name, __all__)
        told = f"; {near}" if str(near).endswith("?") else ""
        raise AttributeError(f"graphcam has no name {name!r}{told}", name=name) from error
