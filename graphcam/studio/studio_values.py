"""What the studio says in numbers: drawn beside exact with bounds, scales, adopted sizes, warnings."""

from collections.abc import Mapping
from typing import Any

from graphcam.comparison.quantities import Quantity
from graphcam.constructions.views import ANGLE, PROFILE
from graphcam.drafting.ink import Construction
from graphcam.drafting.scale import unit
from graphcam.language import Language
from graphcam.report.markdown import number
from graphcam.solving.arcs_solution import AnySolution
from graphcam.solving.shown_solution import plain_number
from graphcam.solving.solution import Solution
from graphcam.solving.solution_warnings import Caution
from graphcam.words import Caption, say

VALUE_DECIMALS = 3
"""Decimals of a value that is said."""


def compared_quantities(drawn: Mapping[str, Construction]) -> set[str]:
    """The names of the quantities that are read in these constructions.

    >>> import graphcam as gc
    >>> drawn = gc.solve(gc.builtin_task()).drawn
    >>> sorted(compared_quantities({"roller": drawn["roller"]}))
    ['roller_radius']
    """
    return {said.name for each in drawn.values() for _, said in each.meaning.compared_readings}


def values(quantities: Mapping[str, Quantity], spoken: Language) -> list[dict[str, Any]]:
    """Every quantity that there is, drawn beside exact.

    >>> import graphcam as gc
    >>> from graphcam.language import ENGLISH
    >>> found = values(gc.solve(gc.builtin_task()).comparison.quantities, ENGLISH)
    >>> [each["said"]["drawn"] for each in found if each["id"] == "minimum_prime_radius"]
    ['43.280 mm']
    """
    return [_value(quantity, spoken) for quantity in quantities.values() if quantity.exists]


def _value(quantity: Quantity, spoken: Language) -> dict[str, Any]:
    drawn, exact, error, bound = (
        plain_number(each) for each in (quantity.drawn, quantity.exact, quantity.error_paper, quantity.tolerance_paper)
    )
    said = {
        "drawn": _value_caption(quantity.drawn, quantity.unit),
        "exact": _value_caption(quantity.exact, quantity.unit),
        "error_paper": number(quantity.error_paper, VALUE_DECIMALS, sign=True),
        "bound": number(quantity.tolerance_paper, VALUE_DECIMALS),
    }
    return {
        "id": quantity.name,
        "title": spoken.text(quantity.title),
        "drawn": drawn,
        "exact": exact,
        "unit": quantity.unit,
        "error_paper": error,
        "bound": bound,
        "said": {name: spoken.text(each) for name, each in said.items()},
    }


def _value_caption(value: float, of: str) -> Caption:
    """A value with its unit; an angle with the sign of degrees."""
    if of == "deg":
        return say("{value}°", value=number(value, VALUE_DECIMALS))
    return say("{value} {unit}", value=number(value, VALUE_DECIMALS), unit=unit(of))


def given_sizes(solution: AnySolution) -> dict[str, float | None]:
    """The sizes that the task gives [mm], without those that are to be found.

    >>> import graphcam as gc
    >>> given_sizes(gc.solve(gc.builtin_task()))
    {'offset': -10.0}
    """
    if not isinstance(solution, Solution):
        return {"offset": 0.0, "roller_radius": solution.motion.roller_radius}
    board = solution.chain.board
    of_follower = {size.name: size.value for size in board.follower.sizes(board.follower.place, board.roller_radius)}
    return {
        name: size for name, size in {"prime_radius": board.prime_radius, **of_follower}.items() if size is not None
    }


def sizes(solution: AnySolution) -> dict[str, float | None]:
    """The adopted sizes [mm], also those that the task gives.

    >>> import graphcam as gc
    >>> sizes(gc.solve(gc.builtin_task()))
    {'prime_radius': 44.0, 'offset': -10.0, 'roller_radius': 17.0}
    """
    if not isinstance(solution, Solution):
        moved = solution.motion
        return {"prime_radius": moved.prime_radius, "offset": 0.0, "roller_radius": moved.roller_radius}
    chain = solution.chain
    of_follower = chain.board.follower.sizes(chain.place, solution.cam.roller_radius)
    return {"prime_radius": chain.prime_radius, **{size.name: size.value for size in of_follower}}


CAUTION_VIEWS = {"profile": PROFILE.name, "pressure angle": ANGLE.name}
"""The views in which a caution has a place."""


def warnings(solution: AnySolution, spoken: Language) -> list[dict[str, Any]]:
    """What is wrong with the cam, the gravest first, each where it is seen, as far as that is known.

    ``at`` is the first place in ``view``, x and y [mm of paper, y downwards];  ``limit`` says that a limit is passed.

    >>> import graphcam as gc
    >>> from dataclasses import replace
    >>> from graphcam.language import ENGLISH
    >>> task = gc.builtin_task()
    >>> given = replace(task.cam, prime_radius=44.0), replace(task.follower, roller_radius=40.0)
    >>> sharp = gc.solve(replace(task, cam=given[0], follower=given[1]))
    >>> [(each["view"], each["at"]) for each in warnings(sharp, ENGLISH)]
    [('profile', [-33.52, 0.8])]
    """
    return [_warning(solution, caution, spoken) for caution in solution.cautions]


def _warning(solution: AnySolution, caution: Caution, spoken: Language) -> dict[str, Any]:
    view = CAUTION_VIEWS.get(caution.of)
    at = _place(solution, caution) if view and isinstance(solution, Solution) else None
    return {
        "text": spoken.text(caution.said),
        "limit": caution.of not in ("rounding", "unit", "scale", "divisions", "velocity", "drawing"),
        "of": caution.of,
        "view": view,
        "at": None if at is None else [round(at.real, 2), round(-at.imag, 2)],
    }


def _place(solution: Solution, caution: Caution) -> complex | None:
    """The place where a caution is seen in its view [mm of paper, y upwards]."""
    if not caution.phi:
        return None
    phi, chain = caution.phi[0], solution.chain
    if caution.alpha is not None:
        return complex(phi, caution.alpha) / chain.board.mu_phi.per_mm
    x, y = solution.cam.profile(phi).tolist()
    return complex(x, y) / chain.profile_scale.per_mm
