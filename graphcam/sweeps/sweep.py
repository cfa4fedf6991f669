"""The sweep: quantities of many designs, in chunks that stay in the cache, on as many processors as there are."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError, check_kind, nearest_word_remedy
from graphcam.given.follower import FOLLOWERS_BY_KIND, Limits
from graphcam.given.making_errors import MakingErrors
from graphcam.given.spring_load import ArmLoad, SpringLoad
from graphcam.mechanism.motion_bands import COVERAGE
from graphcam.sweeps.designs import Designs
from graphcam.sweeps.sweep_forces import FORCE_QUANTITIES, QuantityUnderLoad, SweptLoad
from graphcam.sweeps.sweep_quantities import BAND_QUANTITIES, QUANTITIES, Chunk, Quantity, QuantityOfErrors, SweptErrors
from graphcam.words import say
from graphcam.workers import ordered_results


class Swept(dict[str, NDArray[Any]]):
    """The quantities of a sweep by name, (n,) each; and with what differs from design to design, as a table."""

    def __init__(self, columns: Mapping[str, NDArray[Any]], designs: Designs) -> None:
        super().__init__(columns)
        self.designs = designs

    @property
    def array(self) -> NDArray[Any]:
        """(n,) a structured array: the sizes, laws and senses that differ, then the quantities."""
        columns = self.designs.varied | self
        kinds = [(name, column.dtype) for name, column in columns.items()]
        found = np.empty(len(self.designs), dtype=kinds)
        for name, column in columns.items():
            found[name] = column
        return found

    def frame(self) -> Any:
        """The same as a DataFrame of pandas, which must be installed."""
        import pandas

        return pandas.DataFrame(self.designs.varied | self)


CHUNK_OF_DESIGNS = 4096
"""Designs that are computed at a time: what they need stays in the processor's cache."""
CHUNKS_PER_JOB = 8
"""Chunks that an executor is given at a time: what one costs to hand out does not count then."""
JOBS_AHEAD = 32
"""Jobs that wait for an executor at a time: all columns of so many take a hundred megabytes."""
WORKING_SET = 2**22
"""Bytes that a chunk needs."""
# The C library on Linux keeps free memory only up to twice the largest array that it was given back.  What it does not
# keep it asks the system for again at once, which would cost more than all arithmetic.
np.empty(WORKING_SET, dtype=np.uint8)
Columns = dict[str, NDArray[Any]]
AnyQuantity = Quantity | QuantityUnderLoad | QuantityOfErrors


def sweep(
    designs: Designs,
    quantities: AnyQuantity | Sequence[AnyQuantity] = QUANTITIES,
    executor: Executor | None = None,
    *,
    limits: Limits | None = None,
    load: SpringLoad | ArmLoad | None = None,
    friction: float = 0.0,
    errors: MakingErrors | None = None,
    coverage: float = COVERAGE,
    chunk: int = CHUNK_OF_DESIGNS,
) -> Swept:
    """Extremes and feasibility of many cams.

    Parameters
    ----------
    designs : n cams; those of every combination of sizes are :func:`graphcam.grid`
    quantities : the quantities to compute, from this list, or one of them

        - max_pressure_angle_rise, max_pressure_angle_return [rad], the signed value of maximum magnitude
        - min_pitch_curvature_radius [mm], the minimum of the convex parts, inf without any; of a flat face minimum rho
        - max_v [mm/rad] and max_a [mm/rad^2], magnitudes; of an arm [rad/rad] and [rad/rad^2]
        - feasible: within the limits, and the roller smaller than the minimum radius of curvature
        - under a load, and not by default: max_normal_force, min_normal_force [N], max_torque [N mm] on the cam,
          least_preload [N; N mm of a torsion spring], jamming_margin, the minimum cos(alpha) - mu sin(alpha)
        - with manufacturing errors, and not by default: position_band [mm; of an arm rad], the maximum half-width of
          the band of s to the first order, see :class:`graphcam.MotionBands`

    executor : any of concurrent.futures: threads, processes, or dask's ``Client.get_executor()``; None computes here
    limits : permitted pressure angles and curvature of the profile, as ``gc.Limits(rise=math.radians(30),
        return_=math.radians(45), curvature=5)``; the rest belongs to the rise.  None is the usual angle, 30 degrees or
        an arm's 45, and force closure
    load : what presses every follower, a number of N with it but no table; needed for forces
    friction : mu between cam and follower
    errors : the tolerances to which all cams are made; needed for bands
    coverage : the part of all mechanisms that a band holds
    chunk : designs computed at a time

    Returns
    -------
    Swept : a dict, by name (n,), float64 (bool for feasible); NaN (False) where there can be no cam: an offset as large
        as the prime radius, an arm that does not reach, phases longer than the turn; forces are NaN where it jams.
        The results are the same to the last bit for every ``chunk`` and executor.  Its ``array`` is one structured
        array with the sizes that differ, its ``frame()`` a DataFrame of pandas

    Raises
    ------
    DesignError : angles or lifts of arms beyond a turn in every design, as degrees are, an unknown quantity, forces
        without a load or with one of another follower, bands without errors or with errors of sizes that the followers
        do not have, or an empty chunk

    >>> import numpy as np
    >>> import graphcam as gc
    >>> designs = gc.Designs(lift=30, rise_angle=np.radians(120), return_angle=np.radians(90), prime_radius=[9, 50, 60],
    ...                   offset=10, roller_radius=12)
    >>> found = gc.sweep(designs, ["max_pressure_angle_rise", "feasible"])
    >>> np.degrees(found["max_pressure_angle_rise"]).round(3).tolist(), found["feasible"].tolist()
    ([nan, 14.978, 12.949], [False, True, True])
    >>> spring = gc.SpringLoad(mass=0.5, speed_rpm=300, stiffness=4, preload=100)
    >>> gc.sweep(designs, ["max_normal_force"], load=spring, friction=0.1)["max_normal_force"].round(3).tolist()
    [nan, 218.984, 218.924]
    >>> errors = gc.MakingErrors(roller_diameter=0.02, offset=0.05)
    >>> (1e3 * gc.sweep(designs, ["position_band"], errors=errors)["position_band"]).round(3).tolist()  # micrometres
    [nan, 12.736, 11.029]
    """
    check_kind("designs", designs, Designs)
    if limits is not None:
        remedy = say("write limits=graphcam.Limits(rise=..., return_=...), in radians")
        check_kind("limits", limits, Limits, remedy=remedy)
    if errors is not None:
        check_kind("errors", errors, MakingErrors)
    designs.check_units()
    wanted = (quantities,) if isinstance(quantities, str) else tuple(quantities)
    for name in wanted:
        if name not in (known := (*QUANTITIES, *FORCE_QUANTITIES, *BAND_QUANTITIES)):
            raise DesignError("quantity", name, say("one that a sweep can find"), nearest_word_remedy(name, known))
        if name in FORCE_QUANTITIES and load is None:
            given = say("given for {name}", name=name)
            raise DesignError("load", say("left out"), given, say("give a SpringLoad or an ArmLoad"))
        if name in BAND_QUANTITIES and errors is None:
            limit = say("given for {name}", name=name)
            raise DesignError("errors", say("left out"), limit, say("give MakingErrors"))
    if chunk < 1:
        raise DesignError("chunk", chunk, say("at least 1 design"))
    swept = None if load is None else SweptLoad(load, friction)
    first = Chunk(designs.part(slice(0, 1)), limits or Limits(usual_limit(designs.follower)))
    if swept:
        swept.load_for(first.all_kinematics)
    made = None if errors is None else SweptErrors(errors, coverage)
    limits = limits or Limits(usual_limit(designs.follower))
    compute = partial(computed, quantities=wanted, limits=limits, chunk=chunk, swept=swept, made=made)
    if made:
        made.check(first.all_kinematics, designs.roller_radius)
    if executor is None:
        return Swept(compute(designs), designs)
    out, size = _empty_columns(wanted, len(designs)), CHUNKS_PER_JOB * chunk
    starts = range(0, len(designs), size)
    jobs = (designs.part(slice(k, k + size)) for k in starts)
    for k, columns in zip(starts, ordered_results(executor, compute, jobs, JOBS_AHEAD), strict=True):
        for name, column in columns.items():
            out[name][k : k + size] = column
    return Swept(out, designs)


def usual_limit(follower: str) -> float:
    """The permitted pressure angle on the rise [rad] where none is given.

    >>> np.degrees(usual_limit("oscillating")).round(9).tolist()
    45.0
    """
    return math.radians(FOLLOWERS_BY_KIND[follower].usual_limit_deg)


def computed(
    designs: Designs,
    quantities: tuple[str, ...],
    limits: Limits,
    chunk: int = CHUNK_OF_DESIGNS,
    swept: SweptLoad | None = None,
    made: SweptErrors | None = None,
) -> Columns:
    """The quantities of designs, chunk by chunk, without an executor."""
    n = len(designs)
    out = _empty_columns(quantities, n)
    for k in range(0, n, chunk):
        here = slice(k, min(k + chunk, n))
        some = Chunk(designs.part(here), limits, swept, made)
        for name in quantities:
            out[name][here] = some.under_load(name) if name in FORCE_QUANTITIES else getattr(some, name)
    return out


def _empty_columns(quantities: tuple[str, ...], n: int) -> Columns:
    return {name: np.empty(n, dtype=bool if name == "feasible" else np.float64) for name in quantities}
