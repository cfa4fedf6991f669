"""Other packages on one test cam: prime radius 60, offset 10, roller 12, lift 30, phases of 120, 30, 90, 120 degrees,
cycloidal rise, harmonic return.  Rows that a package cannot describe are omitted, with the reason.
"""

import math
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np

from graphcam.bench.convergence import distance_from_profile, nearest_angles
from graphcam.bench.rivals import optional
from graphcam.bench.rows import EMPTY_CELL, Line, Section
from graphcam.bench.timing import Timer
from graphcam.given.follower import Translating
from graphcam.given.laws import LawName, law
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.least_radius import minimum_radius
from graphcam.words import say

LIFT, BASE, ROLLER, OFFSET = 30.0, 48.0, 12.0, 10.0
ANGLES = tuple(math.radians(degrees) for degrees in (120, 30, 90, 120))
SEARCH_ANGLE = math.radians(20)
"""How far from its own direction the nearest place of the profile is sought: the packages leave out the roller."""
STATIONS = 360


@dataclass(frozen=True)
class Peer:
    """What a package gives for one quantity.

    error : in ``unit``, None where it gives nothing; slower : its time over graphcam's for the same; reason : why there
    is no figure, or what the error comes from
    """

    package: str
    quantity: str
    error: float | None
    unit: str
    slower: float | None
    reason: str


def peer_cam() -> Cam:
    """The cam that the packages are asked for.

    >>> round(math.degrees(peer_cam().extremes().pressure_angle_rise[0]), 3)
    14.264
    """
    return Cam(_motion("cosine"), Translating(OFFSET, ROLLER), BASE + ROLLER)


def _motion(back: LawName) -> Motion:
    rise, dwell, fall, rest = ANGLES
    return Motion([Rise(LIFT, rise, "cycloidal"), Dwell(dwell), Return(LIFT, fall, back), Dwell(rest)])


def peers(timer: Timer) -> Iterator[Peer]:
    """Each package where it can be imported, else the reason why not."""
    for package, imported, asked in (
        ("mechanism", "mechanism", _mechanism),
        ("pylinkage", "pylinkage.cam", _pylinkage),
    ):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # theirs, not ours
            name, module = _package_version(package), optional(imported)
            if module is None or name == package:
                yield Peer(package, "everything", None, "", None, "not installed; it comes with the extra peers")
                continue
            try:
                yield from [Peer(name, *told) for told in asked(module, timer)]
            except Exception as error:  # noqa: BLE001  whatever another package does, the report goes on
                yield Peer(name, "everything", None, "", None, f"it fails: {error}")


_Told = tuple[str, float | None, str, float | None, str]
"""What a peer has beside the name of its package."""


def _mechanism(module: Any, timer: Timer) -> Iterator[_Told]:
    degrees = [math.degrees(angle) for angle in ANGLES]
    phases = [("Rise", LIFT, degrees[0]), ("Dwell", degrees[1]), ("Fall", LIFT, degrees[2]), ("Dwell", degrees[3])]
    cam, given = peer_cam(), {"degrees": True, "omega": 1.0, "rotation": "ccw", "h": FULL_TURN / STATIONS}
    theirs = module.Cam(motion=phases, **given)
    phi = np.asarray(theirs.thetas)
    # It takes one law for all phases, so rise and return come from two cams.
    rising = phi < ANGLES[0] + ANGLES[1] / 2
    s = np.where(rising, theirs.cycloidal.S, theirs.harmonic.S)
    lift = float(np.abs(s - cam.motion(phi)[0]).max())
    slower = timer.seconds(lambda: module.Cam(motion=phases, **given)) / timer.seconds(cam.profile, phi)
    yield "displacement", lift, "mm", slower, "its two laws joined: it takes one law for all phases"
    drawn = (BASE + s) * np.exp(1j * (math.pi / 2 - phi))
    profile = float(np.abs(distance_from_profile(cam, drawn, nearest_angles(cam, drawn), SEARCH_ANGLE)).max())
    yield "working profile", profile, "mm", slower, "no offset and no roller envelope"
    sized = theirs.get_base_circle(
        kind="cycloidal", follower="roller", roller_radius=ROLLER, eccentricity=OFFSET, max_pressure_angle=30
    )
    limit = math.radians(30)
    least = minimum_radius(_motion("cycloidal"), Translating(), return_=limit, offset=OFFSET, rest=False).prime_radius
    off, reason = float(sized["Rb"]) + ROLLER - least, "30 degrees on both sides; its s0 is sqrt(r0^2 + e^2)"
    yield "minimum prime radius", off, "mm", None, reason


def _pylinkage(module: Any, timer: Timer) -> Iterator[_Told]:
    ends = {"rise_end": ANGLES[0], "dwell_high_end": sum(ANGLES[:2]), "fall_end": sum(ANGLES[:3])}
    cycloidal = module.CycloidalMotionLaw()
    profile = module.FunctionProfile(motion_law=cycloidal, base_radius=BASE, total_lift=LIFT, rise_start=0.0, **ends)
    motion, phi = peer_cam().motion, np.linspace(0, ANGLES[0], STATIONS)

    def theirs() -> list[float]:
        """The peer's radii [mm] at all stations."""
        return [profile.evaluate(x) for x in phi.tolist()]

    off = float(np.abs(np.array(theirs()) - BASE - motion(phi)[0]).max())
    slower = timer.seconds(theirs) / timer.seconds(motion, phi)
    yield "displacement, rise", off, "mm", slower, "one law for rise and return: no harmonic return"
    trapezoidal, u = module.ModifiedTrapezoidalMotionLaw(), np.linspace(0, 1, 1001)
    lift = np.array([trapezoidal.displacement(x) for x in u.tolist()])
    wrong = float(np.abs(lift - law("modified-trapezoidal")(u)[0]).max())
    yield "modified-trapezoidal law", wrong * LIFT, "mm", None, "its lift jumps"
    yield "working profile", None, "mm", None, "gives a radius by angle, without offset and envelope"


def _package_version(package: str) -> str:
    """Name and version of an installed package; the name alone where only a folder of that name is there."""
    try:
        return f"{package} {version(package)}"
    except PackageNotFoundError:
        return package


def _texts(found: Sequence[Peer], _: float) -> Iterator[list[str]]:
    yield ["package", "quantity", "remark", "maximum error", "time ratio"]
    for p in found:
        error, slower = EMPTY_CELL if p.error is None else f"{p.error:.2g} {p.unit}", p.slower
        yield [p.package, p.quantity, p.reason, error, EMPTY_CELL if slower is None else f"{slower:.1f}"]


def _line(p: Peer) -> Iterator[Line]:
    found = {"error": p.error, "error_unit": p.unit, "ratio": p.slower, "ratio_unit": "times graphcam's"}
    yield {"subject": p.package, "quantity": p.quantity, **found, "remark": p.reason}


PEERS = Section(
    "peers",
    say("Other packages"),
    "On a cam of prime radius 60, offset 10, roller 12, lift 30, phases of 120, 30, 90 and 120 degrees, cycloidal "
    "rise, harmonic return. Time is a multiple of graphcam's for 360 stations.",
    lambda effort: peers(effort.timer),
    _texts,
    _line,
    derived=(),
    words=3,
)
