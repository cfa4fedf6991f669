"""What is drawn of an oscillating follower: arm positions, lines at the limits, velocity plan, inversion."""

from __future__ import annotations

import cmath
import copy
import math
import re
from functools import cache
from itertools import combinations

import numpy as np
import pytest
from boards import arm_board, arm_motion, arm_motion_of, limits
from numpy.testing import assert_allclose
from over_all import over_all

import graphcam as gc
from graphcam.constructions.arm_positions import example_station, lift_directions
from graphcam.constructions.axes import sense_caption
from graphcam.constructions.chain import Chain
from graphcam.drafting.act_order import pieces_of
from graphcam.drafting.acts import Act, Kind
from graphcam.drafting.ink import Construction, Part, Step
from graphcam.drafting.marks import (
    AngleMark,
    Arc,
    Arrow,
    Circle,
    Dimension,
    Dots,
    Label,
    Line,
    Mark,
    Region,
    Role,
    Segments,
)
from graphcam.drafting.pencil import Pencil
from graphcam.tasks.task_file import task_from

SIGMA = 0.1
TREMBLING = Pencil(line=SIGMA, dividers=SIGMA, protractor=0.004, seed=3)
MANY = 6
"""So many standard deviations no error of a fixed seed's hand is greater than."""
EXACT = 1e-9
FREE, FORM = None, limits(45, 35)
REACH = "no rest line"
BOARDS = {
    "force, ccw": arm_board(arm_motion("3-4-5"), FREE),
    "force, cw": arm_board(arm_motion("cycloidal"), FREE, rotation="cw"),
    "form, ccw": arm_board(arm_motion("cycloidal"), FREE, limits=FORM),
    "form, cw": arm_board(arm_motion("3-4-5"), FREE, rotation="cw", limits=FORM),
    "given distance, cw": arm_board(arm_motion("cosine"), 120.0, rotation="cw"),
    "dwell first": arm_board(arm_motion_of((0, 30), (20, 80, "rectangular"), (0, 40), (-20, 100, "cosine")), FREE),
    "return first": arm_board(arm_motion_of((-20, 80, "3-4-5"), (0, 40), (20, 100, "cosine")), 110.0, arm=90.0),
    REACH: arm_board(arm_motion("cosine", 60.0), FREE, limits=limits(15, rest=False)),
}
EVERY = over_all("name", ["built-in", *BOARDS])


@cache
def chain(name: str, pencil: Pencil | None = None) -> Chain:
    if name == "built-in":
        return gc.solve(gc.builtin_task("arm"), pencil).chain
    return Chain(BOARDS[name], pencil or Pencil())


def steps_of(name: str, construction: str, pencil: Pencil | None = None) -> tuple[Construction, list[Step]]:
    drawn = chain(name, pencil)[construction]
    return drawn, drawn.steps()


def marks(step: Step, kind: type, role: Role | None = None) -> list:
    """The marks of a kind in a step, or those of them in one role."""
    return [mark for mark in step.marks if isinstance(mark, kind) and (role is None or mark.role is role)]


def labels(step: Step) -> dict[str, Label]:
    return {str(mark.text): mark for mark in marks(step, Label)}


def numbers(caption: object, pattern: str) -> list[float]:
    """The numbers that a caption says where the pattern has groups."""
    found = re.search(pattern, str(caption))
    assert found, caption
    return [float(each) for each in found.groups()]


def sense(drawn: Construction) -> int:
    return 1 if drawn.givens.rotation == "ccw" else -1


def motion(drawn: Construction) -> tuple[np.ndarray, np.ndarray]:
    """Displacement [rad] and velocity [rad/rad] at the stations."""
    integrated = drawn.givens.integrated
    return integrated.value("s"), integrated.value("v")


def directions(drawn: Construction) -> np.ndarray:
    """At each station 1 on a rise, -1 on a return."""
    phases = drawn.givens.integrated.givens.motion.phases
    return np.array([phases[k].direction for k in drawn.givens.integrated.givens.stations.phase])


def station(drawn: Construction, name: str) -> int:
    """The index of a station by its name, such as 5′."""
    return drawn.givens.integrated.givens.stations.phases[name.count("′")].start + int(name.rstrip("′"))


def ratio(scale: float) -> str:
    return f"1:{scale:g}" if scale >= 1 else f"{1 / scale:g}:1"


def names_of(drawn: Construction) -> list[str]:
    """The names of all stations: 0, 1 ... in the first phase, 0′, 1′ ... in the second."""
    phases = drawn.givens.integrated.givens.stations.phases
    return [f"{k}" + n * "′" for n, span in enumerate(phases) for k in range(span.stop - span.start)]


def ordinates(drawn: Construction) -> tuple[np.ndarray, np.ndarray]:
    """Displacement and velocity at the stations on paper [mm]."""
    readings = drawn.givens.integrated.readings
    return readings["s"].paper, readings["v"].paper


def titled(steps: list[Step], title: str) -> Step:
    """The step of a title, of which there is one."""
    (found,) = (step for step in steps if re.fullmatch(title, str(step.title)))
    return found


def draws(part: Part) -> dict[str, list[int]]:
    """What a part leaves: by the names of acts, which of their places."""
    return {each.act.name: each.index.tolist() for each in part.draws}


def direction(angle: float | complex) -> complex:
    """The unit vector of an angle [rad], or along a vector."""
    return angle / abs(angle) if isinstance(angle, complex) else cmath.exp(1j * angle)


def on_arc(arc: Arc, place: complex) -> bool:
    """Whether an arc passes through a place."""
    turn = (cmath.phase(place - arc.centre) - arc.start) % (2 * math.pi)
    return abs(abs(place - arc.centre) - arc.radius) < 1e-6 and turn <= arc.end - arc.start


def angle_at_pivot(drawn: Construction) -> float:
    """Between the arm at rest and the line of centres, by the law of cosines."""
    c, arm, r0 = drawn.givens.distance, drawn.givens.arm, drawn.givens.prime_radius
    return math.acos((c * c + arm * arm - r0 * r0) / (2 * c * arm))


# --- all steps -------------------------------------------------------------------------------------------------------


def undrawn(step: Step) -> list[Mark]:
    """The marks that no part of a step draws, or not at all of their places."""
    found: dict[int, set[int]] = {}
    for part in step.places:
        for piece in pieces_of(part.draws):
            found.setdefault(id(piece.act), set()).update(piece.at)
    left = list[Mark]()
    for mark in step.own_marks:
        if getattr(mark, "role", None) in (Role.AXIS, Role.SCALE) or not isinstance(mark.of, Act):
            continue
        index = set() if mark.index is None else set(mark.index.tolist())
        if mark.of.kind is not Kind.READ and not (id(mark.of) in found and index <= found[id(mark.of)]):
            left.append(mark)
    return left


@EVERY
@over_all("pencil", [None, TREMBLING])
def test_every_step_has_a_reason_and_its_parts_draw_all_its_marks(name, pencil):
    for construction in ("minimum_radius", "pressure_angle", "inversion"):
        for step in steps_of(name, construction, pencil)[1]:
            why = str(step.why)
            assert re.fullmatch(r"(?!Because)[A-Z][^.]*(\.\d[^.]*)*\.", why), (str(step.title), why)
            assert construction == "pressure_angle" or step.parts, str(step.title)
            assert undrawn(step) == [], str(step.title)
            for part in (*step.parts, *step.places):
                assert re.fullmatch(r"[A-Z].*\.", str(part.caption)), str(part.caption)
                assert not re.search(r"\b(nan|inf|None)\b|[{}]|  | 0\.00 mm", str(part.caption)), str(part.caption)


# --- the least radius ------------------------------------------------------------------------------------------------


def positions(region: Construction) -> tuple[float, np.ndarray, np.ndarray, np.ndarray]:
    """The arm's length on paper, the directions of its positions from the pivot, its ends B, and the ends D."""
    (s, v), length = motion(region), region.givens.arm / region.givens.mu_l.per_mm
    outward = -np.exp(-1j * s)
    return length, outward, length * outward, length * (1 + sense(region) * v) * outward


def example_of(step: Step, region: Construction) -> int:
    """The station that a caption works as the example."""
    (name,) = re.search(r"[Ss]tation (\d+′*)", str(step.caption)).groups()
    return station(region, name)


TURNED = r"([\d.]+) mm × ([\d.]+)°/mm = ([\d.]+)°"
LAID_OFF = r"([\d.]+) mm × ([\d.]+) = ([\d.]+) mm"


@EVERY
def test_the_arm_swings_about_its_pivot_by_the_displacements(name):
    region, steps = steps_of(name, "minimum_radius")
    step, (length, _, ends, _) = steps[0], positions(region)
    (arms,), (pivot, dots) = marks(step, Segments), marks(step, Dots)
    assert_allclose(arms.starts, 0, atol=EXACT)
    assert_allclose(arms.ends, ends, atol=EXACT)
    assert_allclose(dots.points, ends, atol=EXACT)
    assert_allclose(pivot.points, [0], atol=EXACT)
    (level,), (arc,) = marks(step, Line), marks(step, Arc)
    assert_allclose(level.points, [0, -length], atol=EXACT)
    assert arc.centre == 0
    assert all(on_arc(arc, end) for end in (*ends, -length))
    assert arc.end - arc.start < np.ptp(motion(region)[0]) + 0.1
    named = labels(step)
    assert named.pop("C").at == 0
    assert named.pop("B₀").at == pytest.approx(-length)
    for text, label in named.items():
        assert label.at == pytest.approx(ends[station(region, text)])
    if name == "built-in":  # it returns as it rose
        assert not any("′" in text for text in named)
    places = [label.at for label in named.values()]
    assert len(places) >= 2
    assert min(abs(one - other) for one, other in combinations([*places, -length], 2)) > 1  # each number at a place


@EVERY
def test_every_arm_is_said_with_its_ordinate_its_factor_and_its_angle(name):
    region, steps = steps_of(name, "minimum_radius")
    step, (s, _), length = steps[0], ordinates(region), positions(region)[0]
    said, turns = str(step.caption), np.degrees(motion(region)[0])
    told = f"At {ratio(region.givens.mu_l.per_mm)} the arm is {length:.1f} mm long: draw CB₀ horizontally to the left"
    assert told in said
    assert f"an arc of {length:.1f} mm about C" in said
    assert numbers(said, r"largest angle is ([\d.]+)°") == [round(turns.max(), 2)]
    k, factor = example_of(step, region), turns.max() / s.max()
    assert numbers(said, r"displacement by ([\d.]+)°/mm") == [pytest.approx(factor, rel=1e-3)]
    assert numbers(said, TURNED) == [
        pytest.approx(s[k], abs=0.0051),
        pytest.approx(factor, rel=1e-3),
        round(turns[k], 2),
    ]
    assert "set the angle off at C with the protractor, upwards from CB₀ (clockwise)" in said
    small = (turns > 0) & (turns < 0.5)
    assert ("An angle too small for the protractor" in said) == small.any()
    base, *arms = step.places
    assert numbers(base.caption, r"arm is ([\d.]+) mm long: .* an arc of ([\d.]+) mm") == [round(length, 1)] * 2
    assert draws(base) == {"arm at rest": [0], "arc of the arm": [0], "start": [0]}
    for n, (part, text) in enumerate(zip(arms, names_of(region), strict=True)):
        assert str(part.caption).startswith(f"Station {text}: ")
        assert draws(part) == {"arms": [n], "ends": [n]}
        if turns[n] < 0.005:
            assert str(part.caption).endswith(": 0°.")
            continue
        paper, by, angle = numbers(part.caption, TURNED)
        assert (paper, angle) == pytest.approx((s[n], turns[n]), abs=0.0051)
        assert paper * by == pytest.approx(angle, abs=0.0051 + 0.0051 * by + paper * by * 1e-3)
        chord = f"°, {2 * length * math.sin(math.radians(turns[n]) / 2):.2f} mm along the arc."
        assert str(part.caption).endswith(chord) == small[n]


@EVERY
def test_the_velocities_are_laid_off_along_the_arm_and_a_curve_is_faired_through_their_ends(name):
    region, steps = steps_of(name, "minimum_radius")
    step, (_, _, ends, tips) = steps[1], positions(region)
    (laid_off,), curves = marks(step, Segments), marks(step, Line)
    assert_allclose(laid_off.starts, ends, atol=EXACT)
    assert_allclose(laid_off.ends, tips, atol=EXACT)
    pieces = region.givens.integrated.givens.stations.pieces
    for curve, piece in zip(curves, pieces, strict=True):
        assert_allclose(curve.points[:: 8 if len(curve.points) > 2 else 1], tips[piece], atol=EXACT)
    for text, label in labels(step).items():
        k = station(region, text)
        assert label.at == pytest.approx(tips[k])
        assert cmath.phase(label.towards / tips[k]) == pytest.approx(0, abs=EXACT)
        assert abs(tips[k] - ends[k]) > 1


def side_of(way: float) -> str:
    """Where on the arm something lies that is laid off outward (1) or inward (-1)."""
    return "away from C" if way > 0 else "towards C"


@EVERY
def test_every_velocity_is_said_with_its_ordinate_its_factor_its_length_and_its_side(name):
    region, steps = steps_of(name, "minimum_radius")
    step, (length, outward, ends, tips) = steps[1], positions(region)
    said, v, sigma = str(step.caption), ordinates(region)[1], sense(region)
    factor = length * float(region.givens.integrated.readings["v"].scale)
    arm, mu, product = numbers(said, r"l·μᵥ = ([\d.]+) mm × ([\d.]+)/mm = ([\d.]+)")
    assert (arm, product) == (pytest.approx(length, abs=0.051), pytest.approx(factor, rel=1e-3))
    assert arm * mu == pytest.approx(product, rel=2e-3)
    assert f"on the rise {side_of(sigma)}, on the return {side_of(-sigma)}." in said
    k = example_of(step, region)
    wanted = [pytest.approx(abs(v[k]), abs=0.0051), pytest.approx(factor, rel=1e-3)]
    assert numbers(said, LAID_OFF) == [*wanted, pytest.approx(abs(tips[k] - ends[k]), abs=0.0051)]
    assert v[k] > 0.4 * v.max()  # a station that is worth an example
    texts, pieces = names_of(region), region.givens.integrated.givens.stations.pieces
    for n, (part, text) in enumerate(zip(step.places, texts, strict=False)):
        caption = str(part.caption)
        assert (caption.split(":")[0], draws(part)) == (f"Station {text}", {"tips": [n]})
        if abs(tips[n] - ends[n]) < 0.005:
            assert caption.endswith(": 0.")
            continue
        paper, by, mm = numbers(caption, LAID_OFF)
        assert (paper, mm) == pytest.approx((abs(v[n]), abs(tips[n] - ends[n])), abs=0.0051)
        assert by == pytest.approx(factor, rel=1e-3)
        assert caption.endswith(f" mm {side_of(((tips[n] - ends[n]) / outward[n]).real)}.")
    for part, piece in zip(step.places[len(texts) :], pieces, strict=True):
        assert str(part.caption) == f"From D{texts[piece.start]} to D{texts[piece.stop - 1]}."


LINES = "Lines at the limit of the (rise|return)"


@EVERY
def test_through_every_d_runs_the_line_at_the_permitted_angle_to_the_arms_normal(name):
    region, steps = steps_of(name, "minimum_radius")
    length, outward, ends, tips = positions(region)
    permitted, sigma, at = region.givens.limits, sense(region), directions(region)
    families = [(tips[at > 0], outward[at > 0], permitted.rise, sigma)]
    if permitted.return_ is not None:
        families.append((tips[at < 0], outward[at < 0], permitted.return_, -sigma))
    top = int(np.argmax(motion(region)[0]))
    rests, along = np.array([-length, ends[top]]), np.array([-1, outward[top]])
    if permitted.rest:
        families.append((rests, along, permitted.rise, -sigma))
        if permitted.return_ is not None:
            families.append((rests, along, permitted.return_, sigma))
    (shaded,) = marks(titled(steps, "The permitted region"), Region)
    drawn = [mark for step in steps[2:] for mark in marks(step, Segments, Role.CONSTRUCTION)]
    if not permitted.rest:  # the arms themselves, from the pivot beyond their ends
        reach = drawn.pop()
        assert_allclose(reach.starts, 0, atol=EXACT)
        assert_allclose(reach.ends, 1.3 * length * along, atol=EXACT)
    for lines, (places, arms, limit, side) in zip(drawn, families, strict=True):
        assert_allclose(lines.starts, places, atol=EXACT)
        way, wanted = lines.ends - lines.starts, 1j * arms * np.exp(1j * side * limit)
        along = way / np.abs(way)
        for start, direction_, far in zip(lines.starts, along, np.abs(way), strict=True):
            # Along the region if it bounds it, else a short piece.
            seen = (shaded.boundary - start) / direction_
            assert far == pytest.approx(max([20.0, *(seen.real[np.abs(seen.imag) < 1] + 5)]))
        assert_allclose((along * wanted.conj()).imag, 0, atol=1e-9)  # on the line at the limit
        assert np.all(way.imag < EXACT)  # and down, where the cam lies
    titles = [str(step.title) for step in steps]
    assert ("Lines at the limit of the return" in titles) == (permitted.return_ is not None)
    hatched = str(titled(steps, "The permitted region").caption)
    assert ("A spring drives the return" in hatched) == (permitted.return_ is None)


def kept_side(lines: Segments, way: str, turn: str) -> None:
    """What is said of lines is so: to which side of the normal they are turned, and on which side of them C lies."""
    for start, end in zip(lines.starts, lines.ends, strict=True):
        arm = start / abs(start) if abs(start) > 1e-6 else -1
        turned = cmath.phase((end - start) / (1j * arm))
        if abs(turned) > math.pi / 2:  # where the line at a great limit runs down on its other side
            turned -= math.copysign(math.pi, turned)
        assert turn == ("anticlockwise, towards C" if turned > 0 else "clockwise, away from C")
        normal = -1j * (end - start) * (1 if turned > 0 else -1)
        # A place a little below on the kept side, against C.
        c_side = ((0 - start) * normal.conjugate()).real
        assert (c_side < 0) == (turned > 0)
        assert way == ("away from C" if turned > 0 else "towards C")


@EVERY
def test_of_every_line_it_is_said_how_it_is_turned_and_on_which_side_of_it_the_centre_must_lie(name):
    region, steps = steps_of(name, "minimum_radius")
    permitted, at = region.givens.limits, directions(region)
    for step in steps:
        if not (found := re.fullmatch(LINES, str(step.title))):
            continue
        sign = 1 if found.group(1) == "rise" else -1
        limit = f"{math.degrees(permitted.rise if sign > 0 else permitted.return_):.6g}°"
        (lines,), (angle,) = marks(step, Segments), marks(step, AngleMark)
        told = re.search(r"turned from it (\w+, \w+ \w* ?C)\. .* must lie on the side (.*?)\.", str(step.caption))
        turn, way = told.groups()
        kept_side(lines, way, turn)
        assert f"the line at {limit} to its normal" in str(step.caption)
        assert f"on the {found.group(1)} this angle may be at most {limit}." in str(step.why)
        names = names_of(region)
        k = station(region, re.search(r"that at D(\d+′*) is shown", str(step.caption)).group(1))
        moving = [n for n in range(len(names)) if at[n] == sign]
        first, *others = step.places
        assert draws(first) == {"normal to the arm": [0]}
        assert f"At every point D of the {found.group(1)} draw the normal to the arm downwards" in str(first.caption)
        for part, n in zip(others, [k, *(n for n in moving if n != k)], strict=True):
            assert str(part.caption) == f"Line {names[n]}: {float(limit[:-1]):g}°."
            assert draws(part) == {f"limits: {found.group(1)}": [moving.index(n)]}
        # The normal that is shown is square to the arm, downwards, and the angle lies between it and the line.
        (normal,), tip = marks(step, Line), positions(region)[3][k]
        square = 1j * positions(region)[1][k]
        assert normal.points[0] == pytest.approx(tip)
        assert (normal.points[1] - tip) / square == pytest.approx(abs(normal.points[1] - tip))
        assert (angle.centre, str(angle.text)) == (pytest.approx(tip), limit)
        both = {direction(angle.start), direction(angle.end)}
        assert min(abs(each - square) for each in both) < EXACT
        along = direction(complex((lines.ends - lines.starts)[moving.index(k)]))
        assert min(min(abs(each - along), abs(each + along)) for each in both) < EXACT
        assert angle.end - angle.start == pytest.approx(math.radians(float(limit[:-1])))


@over_all("name", ["built-in", *(name for name in BOARDS if name != REACH)])
def test_in_the_dwells_the_lines_lie_on_the_other_side_of_the_normal(name):
    region, steps = steps_of(name, "minimum_radius")
    step = titled(steps, "Lines at the limit in the dwells")
    top, permitted = names_of(region)[int(np.argmax(motion(region)[0]))], region.givens.limits
    limits_ = [permitted.rise, *([] if permitted.return_ is None else [permitted.return_])]
    assert f"from the end {top} of the highest arm" in str(step.caption)
    families = marks(step, Segments)
    assert str(step.caption).startswith("In a dwell D is the end of the arm. ")
    for lines, limit, part in zip(families, limits_, step.parts, strict=True):
        degrees = f"{math.degrees(limit):.6g}°"
        told = rf"at {degrees} to the normal downwards, turned from it (.*)\. A must lie on the side (.*)\."
        turn, way = re.search(told, str(part.caption)).groups()
        kept_side(lines, way, turn)
        for n, (place, row) in enumerate(zip(("B₀", top), part.rows, strict=True)):
            assert str(row.caption) == f"From {place}: {degrees}."
            assert list(draws(row).values()) == [[n]]


def test_without_the_limits_in_the_dwells_the_arms_are_produced():
    region, steps = steps_of(REACH, "minimum_radius")
    step, top = titled(steps, "The arm extended"), names_of(region)[int(np.argmax(motion(region)[0]))]
    below = (
        f"extend CB₀ beyond B₀; A must lie below it. Extend the highest arm, {top}, beyond its end; A must lie below it"
    )
    assert below in str(step.caption)
    assert [draws(part) for part in step.parts] == [{"limits: reach": [0]}, {"limits: reach": [1]}]


def from_edge(place: complex, corners: np.ndarray) -> float:
    """How far a place lies from the edge of a polygon."""
    found = []
    for a, b in zip(corners, np.roll(corners, -1), strict=True):
        way = b - a
        t = 0.0 if way == 0 else min(1.0, max(0.0, ((place - a) * way.conjugate()).real / abs(way) ** 2))
        found.append(abs(place - a - t * way))
    return min(found)


@over_all("name", ["built-in", *(name for name in BOARDS if name != REACH)])
def test_the_cam_centre_lies_on_the_edge_of_the_region_that_no_line_cuts(name):
    region, steps = steps_of(name, "minimum_radius")
    _, outward, _, tips = positions(region)
    (shaded,), (centre,) = (
        marks(titled(steps, "The permitted region"), Region),
        marks(titled(steps, "The minimum prime radius"), Dots),
    )
    corners, place = shaded.boundary, complex(centre.points[0])
    assert from_edge(place, corners) < 1e-6
    adopted = complex(marks(titled(steps_of(name, "pressure_angle")[1], "The cam centre"), Dots)[1].points[0])
    assert corners.imag.min() == pytest.approx(min(place.imag, adopted.imag) - 14)
    at, sigma = directions(region), sense(region)
    drives = np.where(at > 0, region.givens.limits.rise, region.givens.limits.return_ or math.nan)
    for corner in corners:
        # Seen from every D, no corner is farther from the arm's normal than is permitted to the driven side.
        alpha = sigma * at * np.angle((corner - tips) / (1j * outward))
        seen = np.abs(corner - tips) > 1e-6
        assert np.all((alpha <= drives + 1e-7)[seen & ~np.isnan(drives)])


@EVERY
@over_all("pencil", [None, TREMBLING])
def test_the_least_radius_and_the_distance_are_as_long_as_their_dimensions_say(name, pencil):
    region, steps = steps_of(name, "minimum_radius", pencil)
    step, mu, given = titled(steps, "The minimum prime radius"), region.givens.mu_l.per_mm, region.givens.distance
    (*_, to_start), (to_pivot,) = marks(step, Line, Role.LIMIT), marks(step, Line, Role.AXIS)
    start, place = (complex(each) for each in to_start.points)
    assert abs(start + region.givens.arm / mu) < (MANY * SIGMA if pencil else EXACT)
    assert_allclose(to_pivot.points, [0, place], atol=EXACT)
    assert_allclose(marks(step, Dots)[0].points, [place], atol=EXACT)
    assert (labels(step)["A₀"].at, labels(step)["A₀"].towards) == (pytest.approx(place), -1j)
    radius, distance = marks(step, Dimension)
    assert (radius.start, radius.end, distance.start, distance.end) == pytest.approx((start, place, place, 0))
    assert radius.aside == distance.aside == -8
    r0, c = mu * abs(place - start), mu * abs(place)
    assert (str(radius.text), str(distance.text)) == (f"min r₀ = {r0:.2f}", f"c = {c:.2f}")
    assert (radius.of.name, distance.of.name) == ("prime_radius", "distance")
    *arc_said, found, joined = step.parts
    for caption in (step.caption, joined.caption):
        said = numbers(caption, r"A₀B₀ = ([\d.]+) mm, so r₀ = ([\d.]+) mm, and A₀C = ([\d.]+) mm, so c = ([\d.]+) mm")
        assert said == pytest.approx([abs(place - start), r0, abs(place), c], abs=0.0051)
    assert draws(joined) == {"prime radius": [0], "line of centres": [0]}
    assert set(draws(found)) == {"lines that bind", "centre"}
    assert len(arc_said) == len(marks(step, Arc)) == (given is not None)
    if given is not None:
        (arc,), (part,) = marks(step, Arc), arc_said
        assert on_arc(arc, place)
        assert abs(arc.radius - given / mu) < (MANY * SIGMA if pencil else EXACT)
        assert f"Draw an arc of {given / mu:.1f} mm about C with the compass, for c = {given:g} mm." == str(
            part.caption
        )
        assert c == pytest.approx(given, abs=MANY * SIGMA * mu if pencil else 1e-9)


LIMITED = r"(rise|return), \d+′*(–\d+′*)?|dwell, (B₀|\d+′*)|arm (B₀|\d+′*)"
WHERE = {
    "built-in": "the point of the arc nearest to B₀ in the hatched region, "
    "where the arc meets the line of the dwell from B₀",
    "force, ccw": "the corner of the hatched region nearest to B₀, "
    "between the lines of the rise and the line of the dwell from B₀",
    "force, cw": "the point of the hatched region nearest to B₀, "
    "the foot of the perpendicular to the lines of the rise",
}


@EVERY
def test_the_lines_that_bind_are_named_and_the_centre_lies_on_them(name):
    region, steps = steps_of(name, "minimum_radius")
    step = titled(steps, "The minimum prime radius")
    (place,), (*bind, _) = marks(step, Dots)[0].points, marks(step, Line, Role.LIMIT)
    for start, end in (line.points for line in bind):
        share = (place - start) / (end - start)
        assert share.imag == pytest.approx(0, abs=1e-6)
        assert -EXACT <= share.real <= 1 + EXACT
    said = re.search(r"Mark A₀, (.*?)\. Join", str(step.caption)).group(1)
    assert said == WHERE.get(name, said)
    (length, outward, _, tips), permitted, at = positions(region), region.givens.limits, directions(region)
    sigma, seen = sense(region), np.angle((place - tips) / (1j * outward))
    if "the lines of the rise" in said:
        assert np.max(sigma * seen[at > 0]) == pytest.approx(permitted.rise, abs=2e-2)
    if "the lines of the return" in said:
        assert np.max(-sigma * seen[at < 0]) == pytest.approx(permitted.return_, abs=2e-2)
    for start in re.findall(r"the line of the dwell from (B₀|\d+′*)", said):
        top = -length if start == "B₀" else tips[int(np.argmax(motion(region)[0]))]
        rest = abs(cmath.phase((place - top) / (1j * top)))
        assert min(abs(rest - limit) for limit in (permitted.rise, permitted.return_ or 9)) < 1e-6
    if "foot of the perpendicular" in said:
        across = np.diff(bind[0].points)[0] * (place + length).conjugate()
        assert abs(across.real) < 1e-6 * length
    assert re.search("the lines? of the (rise|return|dwell|arm)", said)
    named = [label for text, label in labels(step).items() if text != "A₀"]
    assert [label.at for label in named] == [line.points[1] for line in bind]
    assert all(re.fullmatch(LIMITED, str(label.text)) for label in named)
    assert len(named) == len(set(re.findall("the lines? of the (?:rise|return|dwell|arm)[^,]*?(?= and |$)", said)))
    assert f"Mark A₀, {said}." in [str(part.caption) for part in step.parts]


# --- the pressure angle ----------------------------------------------------------------------------------------------

MECHANISM, PLAN = r"The mechanism at station \d+′*", r"Velocity plan at station \d+′*"


def mechanism(steps: list[Step]) -> tuple[complex, complex, complex, complex]:
    """A, B, C and D as they are plotted."""
    a, b, c, d = (complex(dots.points[0]) for dots in marks(titled(steps, MECHANISM), Dots))
    return a, b, c, d


def shown_at(measured: Construction, steps: list[Step]) -> tuple[int, float]:
    """The station of the plan, and the scale of the plan [mm/mm]."""
    numerator, denominator = numbers(titled(steps, MECHANISM).caption, r"At ([\d.]+):([\d.]+) draw AC")
    name = str(titled(steps, MECHANISM).title).split()[-1]
    assert str(titled(steps, PLAN).title).split()[-1] == name
    return station(measured, name), denominator / numerator


@EVERY
@over_all("pencil", [None, TREMBLING])
def test_the_cam_centre_is_where_the_arcs_of_the_two_sizes_cross_below_the_arm(name, pencil):
    measured, steps = steps_of(name, "pressure_angle", pencil)
    step, mu = titled(steps, "The cam centre"), measured.givens.mu_l.per_mm
    (about_c, about_b), (ends, dots) = marks(step, Arc), marks(step, Dots)
    if pencil is None:
        assert_allclose(ends.points, positions(measured)[3], atol=EXACT)
    (radius,), (line,) = marks(step, Line, Role.LIMIT), marks(step, Line, Role.CONSTRUCTION)
    c, r0, arm, place = (
        measured.givens.distance,
        measured.givens.prime_radius,
        measured.givens.arm,
        complex(dots.points[0]),
    )
    near = MANY * SIGMA if pencil else EXACT
    assert (about_c.centre, about_b.centre) == (pytest.approx(0, abs=near), pytest.approx(-arm / mu, abs=near))
    assert (about_c.radius, about_b.radius) == pytest.approx((c / mu, r0 / mu), abs=near)
    assert on_arc(about_c, place)
    assert on_arc(about_b, place)
    assert place.imag < 0
    assert radius.points[1] == line.points[1] == pytest.approx(place)
    assert labels(step)[f"A (r₀ = {r0:g}, c = {c:g})"].at == pytest.approx(place)
    (angle,) = marks(step, AngleMark)
    psi0 = math.degrees(float(measured.first("psi0")))
    assert str(angle.text) == f"ψ₀ = {psi0:.2f}°"
    if pencil is None:
        assert psi0 == pytest.approx(math.degrees(angle_at_pivot(measured)))
        assert direction(angle.start) == pytest.approx(-1)
        assert direction(angle.end) == pytest.approx(place / abs(place))
    assert numbers(step.caption, r"ψ₀ = ([\d.]+)°") == [round(psi0, 2)]
    _, first, second, third = step.parts
    assert f"With the compass draw an arc of {c / mu:.1f} mm about C below the arm, for c = {c:g} mm" in str(
        first.caption
    )
    assert f"{r0 / mu:.1f} mm about B₀, for r₀ = {r0:g} mm" in str(second.caption)
    assert f"ψ₀ = {psi0:.2f}°" in str(third.caption)
    assert [set(draws(part)) for part in step.parts] == [
        {"start", "tips"},
        {"circle of the centre"},
        {"prime circle", "centre", "prime radius"},
        {"line of centres"},
    ]


@EVERY
def test_the_plans_mechanism_is_the_one_of_the_sizes_and_the_displacement(name):
    """C A B by the law of cosines, the line of centres level, the cam centre at the origin."""
    measured, steps = steps_of(name, "pressure_angle")
    step, (k, scale) = titled(steps, MECHANISM), shown_at(measured, steps)
    (s, v), arm, c = motion(measured), measured.givens.arm / scale, measured.givens.distance / scale
    b = c - arm * cmath.exp(-1j * (angle_at_pivot(measured) + s[k]))
    d = b + sense(measured) * v[k] * (b - c)
    assert mechanism(steps) == pytest.approx((0, b, c, d), abs=1e-9)
    sides = [tuple(line.points) for line in marks(step, Line)]
    assert np.array(sides) == pytest.approx(np.array([(0, c), (c, b), (b, d), (0, b)]), abs=1e-9)
    roles = [line.role for line in marks(step, Line)]
    assert roles == [Role.AXIS, Role.CURVE, Role.RESULT, Role.CONSTRUCTION]
    named = labels(step)
    assert {key: label.at for key, label in named.items()} == pytest.approx({"A": 0, "B": b, "C": c, "D": d}, abs=1e-9)
    assert [named[key].towards for key in "ABCD"] == [-1 - 1j, 1 + 1j, 1 - 1j, -1 + 1j]


@EVERY
@over_all("pencil", [None, TREMBLING])
def test_from_the_numbers_of_the_parts_alone_the_mechanism_is_drawn_again(name, pencil):
    """AC level, the angle at C, the arm, and the velocity along it: each to the printed digits, whoever drew before."""
    measured, steps = steps_of(name, "pressure_angle", pencil)
    step, (k, scale) = titled(steps, MECHANISM), shown_at(measured, steps)
    level, swung, _, laid_off = (str(part.caption) for part in step.parts)
    (ac,) = numbers(level, r"AC horizontally, ([\d.]+) mm long")
    psi0, s, psi, cb = numbers(swung, r"ψ₀ \+ s = ([\d.]+)° \+ (-?[\d.]+)° = ([\d.]+)°, upwards .* CB = ([\d.]+) mm")
    v, factor, bd = numbers(laid_off, r"dividers: ([\d.]+) mm × ([\d.]+) = ([\d.]+) mm")
    b = ac - cb * cmath.exp(-1j * math.radians(psi))
    d = b + (b - ac) / abs(b - ac) * (bd if "away from C" in laid_off else -bd)
    assert mechanism(steps) == pytest.approx((0, b, ac, d), abs=0.3)
    assert (psi0 + s, v * factor) == (pytest.approx(psi, abs=0.0151), pytest.approx(bd, rel=1e-3, abs=0.051))
    assert psi0 == pytest.approx(math.degrees(float(measured.first("psi0"))), abs=0.0051)
    assert s == pytest.approx(math.degrees(measured.givens.integrated.value("s")[k]), abs=0.0051)
    assert v == pytest.approx(abs(measured.givens.integrated.first("v")[k]), abs=0.0051)
    assert factor == pytest.approx(
        measured.givens.arm / scale * measured.givens.integrated.readings["v"].per_mm, rel=1e-3
    )
    for number in (ac, psi0, s, psi, cb, v, factor, bd):
        assert f"{number:g}" in str(step.caption)
    assert [sorted(draws(part)) for part in step.parts] == [["A", "C"], ["B", "CB"], ["AB"], ["BD", "D"]]


@EVERY
@over_all("pencil", [None, TREMBLING])
def test_the_velocity_plan_is_square_to_the_mechanisms_triangle(name, pencil):
    measured, steps = steps_of(name, "pressure_angle", pencil)
    (a, b, c, d), step = mechanism(steps), titled(steps, PLAN)
    v1, v2, v21 = marks(step, Arrow)
    pole = v1.start
    assert (v2.start, v21.start, v21.end) == pytest.approx((pole, v1.end, v2.end))
    assert pole == pytest.approx(c.real + 0.6 * abs(b) + 12)  # clear of the mechanism
    turn = 1j * sense(measured)
    assert v1.end - pole == pytest.approx(turn * (b - a))  # the cam's point goes round A in the sense of the rotation
    assert d - b == pytest.approx(turn * (v2.end - pole))  # BD is v₂, turned in the sense of the rotation
    assert (v21.end - v21.start) == pytest.approx(-turn * (d - a))  # across the profile's normal D A
    named = labels(step)
    halves = {"v₁": (pole + v1.end) / 2, "v₂": (pole + v2.end) / 2, "v₂₁": (v1.end + v2.end) / 2, "p": pole}
    assert {key: label.at for key, label in named.items()} == pytest.approx(halves)
    assert named["p"].towards == -1 - 1j
    for key, side in (("v₁", v1), ("v₂", v2), ("v₂₁", v21)):
        out, inner = complex(named[key].towards), (pole + v1.end + v2.end) / 3
        assert out.real * (side.end - side.start).real + out.imag * (side.end - side.start).imag == pytest.approx(0)
        assert ((inner - halves[key]) * out.conjugate()).real < 0, key  # outside of the plan
    lengths = [abs(each.end - each.start) for each in (v1, v2, v21)]
    texts = (
        r"v₁ = AB = ([\d.]+) mm, square to AB",
        r"v₂ = BD = ([\d.]+) mm, square to the arm",
        r"v₂₁ measures ([\d.]+) mm",
    )
    said = [numbers(part.caption, text)[0] for part, text in zip(step.parts, texts, strict=True)]
    assert said == pytest.approx(lengths, abs=0.051)
    turns = [sense_caption(way) for way in ("ccw", "cw")][:: sense(measured)]
    assert [f"turned by 90° {way}" in str(part.caption) for way, part in zip(turns, step.parts, strict=False)] == [
        True,
        True,
    ]
    assert [sorted(draws(part)) for part in step.parts] == [["p", "v₁"], ["v₂"], ["v₂₁"]]
    assert abs(((v2.end - pole) * (b - c).conjugate()).real) < 1e-6  # v₂ across the arm


@EVERY
@over_all("pencil", [None, TREMBLING])
def test_the_pressure_angle_that_is_printed_is_the_one_between_da_and_the_arms_normal(name, pencil):
    measured, steps = steps_of(name, "pressure_angle", pencil)
    (a, b, c, d), step = mechanism(steps), titled(steps, "The pressure angle")
    (ray,), (normal,) = marks(step, Line, Role.LIMIT), marks(step, Line, Role.CONSTRUCTION)
    (arc,), square = marks(step, AngleMark), 1j * (b - c) / abs(b - c)
    assert tuple(ray.points) == pytest.approx((d, a), abs=1e-9)
    assert tuple(normal.points) == pytest.approx((d, d + 0.7 * abs(d) * square), abs=1e-9)
    alpha = cmath.phase((a - d) / square)
    assert (arc.centre, arc.radius) == (pytest.approx(d), pytest.approx(0.6 * abs(d)))
    first, last = (cmath.phase(square), cmath.phase(square) + alpha)[:: 1 if alpha > 0 else -1]
    assert cmath.exp(1j * arc.start) == pytest.approx(cmath.exp(1j * first))
    assert arc.end - arc.start == pytest.approx(last - first)
    assert str(arc.text) == f"α = {math.degrees(alpha):.1f}°"
    k, _ = shown_at(measured, steps)
    near = 0.05 if pencil else EXACT  # another hand's drawing of the same arm
    assert measured.first("alpha")[k] == pytest.approx(alpha, abs=near)
    assert measured.first("transmission")[k] == pytest.approx(math.pi / 2 - abs(alpha), abs=near)
    said = numbers(
        step.caption, r"angle at station \d+′* is (-?[\d.]+)°, and the transmission angle 90° − \|α\| = ([\d.]+)°"
    )
    assert said == pytest.approx([math.degrees(alpha), 90 - abs(math.degrees(alpha))], abs=0.0051)
    at = f"at station {str(titled(steps, PLAN).title).split()[-1]} is {math.degrees(alpha):.2f}°"
    assert at in str(step.parts[1].caption)
    assert [sorted(draws(part)) for part in step.parts] == [["normal"], ["DA"]]


@EVERY
@over_all("pencil", [None, TREMBLING])
def test_all_rays_run_from_the_ends_d_to_the_cam_centre_each_with_its_normal_and_its_angle(name, pencil):
    measured, steps = steps_of(name, "pressure_angle", pencil)
    step, place = (
        titled(steps, "The pressure angle at every station"),
        complex(marks(titled(steps, "The cam centre"), Dots)[1].points[0]),
    )
    normals, rays = marks(step, Segments)
    assert_allclose(rays.ends, place, atol=EXACT)
    alpha = np.angle((rays.ends - rays.starts) / (normals.ends - normals.starts))
    if pencil is None:
        _, outward, _, tips = positions(measured)
        assert_allclose(rays.starts, tips, atol=EXACT)
        assert_allclose(normals.starts, tips, atol=EXACT)
        lengths = np.where(np.arange(tips.size) == shown_at(measured, steps)[0], 39.6, 9.0)
        assert_allclose((normals.ends - normals.starts) / outward, 1j * lengths, atol=EXACT)
        dots, centre = marks(step, Dots)
        assert_allclose(dots.points, tips, atol=EXACT)
        assert_allclose(centre.points, [place], atol=EXACT)
    assert step.view.name != titled(steps, "The cam centre").view.name
    near = MANY * 0.004 if pencil else EXACT  # by the protractor
    assert_allclose(measured.first("alpha"), alpha, atol=near)
    names, told = names_of(measured), np.degrees(measured.first("alpha"))
    apart, *each = step.places
    assert draws(apart) == {"tips": list(range(len(names))), "centre": [0]}
    for n, (part, text) in enumerate(zip(each, names, strict=True)):
        assert numbers(part.caption, rf"^Station {text}: (-?[\d.]+)°\.$") == pytest.approx([told[n]], abs=0.0051)
        assert draws(part) == {"normals": [n], "rays": [n]}
    k, _ = shown_at(measured, steps)
    worst = int(np.argmax(np.abs(told)))
    assert f"Station {names[k]}: {told[k]:.2f}°." in str(step.caption)
    assert f"= {90 - abs(told[worst]):.2f}°, at station {names[worst]}." in str(step.caption)
    (angle,) = marks(step, AngleMark)
    assert (angle.centre, str(angle.text)) == (pytest.approx(rays.starts[k]), f"α = {told[k]:.1f}°")
    assert angle.end - angle.start == pytest.approx(abs(alpha[k]))


# --- the inversion ---------------------------------------------------------------------------------------------------


def inverted_positions(inverted: Construction) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The pivots, where the arm at rest meets the prime circle, and the pitch points, on paper."""
    mu, phi = inverted.givens.mu_l.per_mm, inverted.givens.integrated.givens.stations.phi
    towards, psi = np.exp(-1j * sense(inverted) * phi), angle_at_pivot(inverted)
    pivots, arm = inverted.givens.distance / mu * towards, inverted.givens.arm / mu * towards
    return pivots, pivots - arm * np.exp(-1j * psi), pivots - arm * np.exp(-1j * (psi + motion(inverted)[0]))


@EVERY
def test_prime_circle_and_pivot_circle_have_the_sizes_that_are_told(name):
    inverted, steps = steps_of(name, "inversion")
    mu, c, r0 = inverted.givens.mu_l.per_mm, inverted.givens.distance, inverted.givens.prime_radius
    circles = [(circle.centre, circle.radius) for circle in marks(steps[0], Circle)]
    assert circles == [(0, pytest.approx(r0 / mu)), (0, pytest.approx(c / mu))]
    (radius,) = (mark for mark in marks(steps[0], Dimension) if mark.of_radius)
    assert (str(radius.text), radius.start) == (f"r₀ = R{r0:g}", 0)
    assert abs(radius.end) == pytest.approx(r0 / mu)
    prime, pivots = (str(part.caption) for part in steps[0].parts)
    assert prime.startswith(f"Set the compass to {r0 / mu:.1f} mm (r₀ = {r0:g} mm at {ratio(mu)}) and draw the prime")
    assert pivots.startswith(f"Set the compass to {c / mu:.1f} mm (c = {c:g} mm at {ratio(mu)}) and draw the circle of")


def against(drawn: Construction) -> str:
    """How the frame goes round the cam that is held still."""
    return str(sense_caption("cw" if drawn.givens.rotation == "ccw" else "ccw"))


@EVERY
def test_the_pivot_is_stepped_off_against_the_rotation(name):
    inverted, steps = steps_of(name, "inversion")
    step, (pivots, _, _) = steps[1], inverted_positions(inverted)
    assert_allclose(marks(step, Dots)[0].points, pivots, atol=EXACT)
    sigma, named = sense(inverted), labels(step)
    assert named.pop("C").at == pytest.approx(pivots[0])
    for text, label in named.items():
        k = station(inverted, text)
        assert (label.at, label.towards) == pytest.approx((pivots[k], pivots[k]))
    way, cam = against(inverted), sense_caption(inverted.givens.rotation)
    assert f"The cam turns {cam}; hold it still and step the pivot round A the other way, {way}." in str(step.caption)
    assert f"count {way} from the horizontal to the right of A, from station to station " in str(step.caption)
    k = station(inverted, re.search(r"so station (\S+) at", str(step.caption)).group(1))
    for n, (part, text) in enumerate(zip(step.places, names_of(inverted), strict=True)):
        turn = math.degrees(-sigma * cmath.phase(pivots[n])) % 360
        assert draws(part) == {"inverted positions": [n], "pivots": [n]}
        (said,) = numbers(part.caption, rf"^Station {text}: ([\d.]+)°\.$")
        assert said % 360 == pytest.approx(turn if turn > 1e-9 and 360 - turn > 1e-9 else 0, abs=0.0051)
        if n == k:
            assert numbers(step.caption, rf"so station {text} at ([\d.]+)°") == [said]
            on = math.degrees(-sigma * cmath.phase(pivots[n] / pivots[n - 1]))
            assert f"{round(on, 2):g}°" in str(step.caption)


@EVERY
def test_the_arcs_of_the_arm_cross_the_prime_circle_on_the_left(name):
    inverted, steps = steps_of(name, "inversion")
    step, (pivots, starts, pitch) = titled(steps, "Arcs of the arm"), inverted_positions(inverted)
    arm = inverted.givens.arm / inverted.givens.mu_l.per_mm
    assert_allclose(marks(step, Dots)[0].points, starts, atol=EXACT)
    for n, (arc, part, text) in enumerate(zip(marks(step, Arc), step.places, names_of(inverted), strict=True)):
        assert (arc.centre, arc.radius) == (pytest.approx(pivots[n]), pytest.approx(arm))
        assert on_arc(arc, starts[n])
        assert on_arc(arc, pitch[n])
        assert (starts[n] * pivots[n].conjugate()).imag > 0  # seen from the centre towards the pivot
        assert (str(part.caption), draws(part)) == (f"Station {text}.", {"arcs of the arm": [n], "starts": [n]})
    assert f"Set the compass to the arm, {arm:.1f} mm." in str(step.caption)
    assert "on the left as seen from A towards the pivot" in str(step.caption)


@EVERY
def test_the_angles_of_the_phases_are_marked_last_from_the_first_place_of_the_pivot(name):
    (inverted, _), (profile, steps) = steps_of(name, "inversion"), steps_of(name, "working_profile")
    step, (pivots, _, pitch) = steps[-1], inverted_positions(inverted)
    roller = profile.givens.roller_radius / inverted.givens.mu_l.per_mm
    sigma, phases = sense(inverted), inverted.givens.integrated.givens.motion.phases
    begin = cmath.phase(pivots[0]) + sigma * inverted.givens.integrated.givens.stations.phi[0]
    for arc, phase in zip(marks(step, AngleMark), phases, strict=True):
        assert arc.end - arc.start == pytest.approx(phase.angle)
        assert cmath.exp(1j * (arc.end if sigma > 0 else arc.start)) == pytest.approx(cmath.exp(1j * begin))
        assert str(arc.text).endswith(f" = {math.degrees(phase.angle):.6g}°")
        begin -= sigma * phase.angle
        # Outside the circle of the pivots, and the roller where that reaches farther; on a smaller sheet nearer.
        paper, farthest = inverted.givens.paper, np.nanmax(np.abs(pitch))
        room = max(farthest + 9, min(paper.width, paper.height) / 2 - 13) if paper.bounded else np.inf
        assert min(abs(pivots[0]) + 2, room) - 0.01 < arc.radius < max(abs(pivots[0]), farthest + roller) + 2.01
    angles = ", ".join(f"{math.degrees(phase.angle):.6g}°" for phase in phases)
    assert angles in str(step.parts[-1].caption)
    assert str(step.parts[-1].caption) in str(step.caption)


TURN_AND_CHORD = TURNED + r", a chord of ([\d.]+) mm"


@EVERY
def test_from_every_pivot_the_arm_is_turned_by_the_displacement(name):
    inverted, steps = steps_of(name, "inversion")
    step, (pivots, starts, pitch) = titled(steps, "Arms turned by the displacement"), inverted_positions(inverted)
    (arms,), (dots,) = marks(step, Segments), marks(step, Dots)
    assert_allclose(arms.starts, pivots, atol=EXACT)
    assert_allclose(arms.ends, pitch, atol=EXACT)
    assert_allclose(dots.points, pitch, atol=EXACT)
    for text, label in labels(step).items():
        k = station(inverted, text)
        assert (label.at, label.towards) == pytest.approx((pitch[k], pitch[k] / abs(pitch[k])))
    s, turns = ordinates(inverted)[0], np.degrees(-np.angle((pitch - pivots) / (starts - pivots)))
    k = example_of(step, inverted)
    assert "away from A (clockwise on the paper), with the protractor or, with dividers, by the chord" in str(
        step.caption
    )
    for n, (part, text) in enumerate(zip(step.places, names_of(inverted), strict=True)):
        caption, chord = str(part.caption), abs(pitch[n] - starts[n])
        assert draws(part) == {"arms": [n], "pitch": [n]}
        assert caption.startswith(f"Station {text}: ")
        if chord < 0.005:
            assert caption.endswith(": 0°.")
            continue
        paper, factor, angle, across = numbers(caption, TURN_AND_CHORD)
        assert (paper, angle, across) == pytest.approx((s[n], turns[n], chord), abs=0.0051)
        assert factor == pytest.approx(turns.max() / s.max(), rel=1e-3)
        if n == k:
            assert numbers(step.caption, TURN_AND_CHORD) == [paper, factor, angle, across]
            assert f"from B₀{text} along the arc about C{text} " in str(step.caption)
    # What moves is square to the arm, away from the cam.
    away = (pivots - pitch) / np.abs(pivots - pitch) * 1j
    assert_allclose(inverted.points["motion"], away, atol=EXACT)


@EVERY
def test_the_pitch_curve_is_closed_once_round_the_centre_through_all_its_points(name):
    inverted, steps = steps_of(name, "inversion")
    _, _, pitch = inverted_positions(inverted)
    (curve,) = marks(titled(steps, "Pitch curve"), Line)
    assert curve.closed
    assert np.abs(curve.points[:, None] - pitch).min(axis=0).max() < EXACT
    turns = np.angle(np.roll(curve.points, -1) / curve.points).sum() / (2 * math.pi)
    assert turns == pytest.approx(-sense(inverted))


def test_a_hands_arms_reach_from_the_pivot_circle_to_their_length():
    inverted, steps = steps_of("built-in", "inversion", TREMBLING)
    circle = marks(steps[0], Circle)[1]
    pivots, (arms,) = marks(steps[1], Dots)[0].points, marks(titled(steps, "Arms turned .*"), Segments)
    assert_allclose(np.abs(pivots - circle.centre), circle.radius, atol=EXACT)
    assert_allclose(arms.starts, pivots, atol=EXACT)
    length = inverted.givens.arm / inverted.givens.mu_l.per_mm
    assert 0.1 * SIGMA < np.abs(np.abs(arms.ends - arms.starts) - length).max() < MANY * 2 * SIGMA


def test_numbers_stand_only_where_their_points_can_be_told_apart():
    """Where an arm hardly moves its ends and those of its velocities crowd, though they stand far apart elsewhere."""
    board = arm_board(arm_motion("cycloidal"), FREE, limits=FORM)
    region = Chain(board)["minimum_radius"]
    ends, tips = region.acts["ends"].shown, region.acts["tips"].shown
    for step, points in zip(region.steps()[:2], (ends, tips), strict=True):
        at = [m.at for m in step.marks if isinstance(m, Label) and str(m.text)[:1].isdigit()]
        assert 1 < len(at) < len(points)
        for phase in region.givens.integrated.givens.stations.phases:
            own = [p for p in at if np.abs(points[phase] - p).min() < EXACT]
            assert all(abs(p - q) >= 4.5 for p, q in combinations(own, 2))
        if points is tips:
            assert all(np.abs(ends - p).min() >= 4.5 for p in at)


def phase(kind: str, angle: float, lift: float = 0.0) -> dict:
    return {"kind": kind, "angle": angle} | ({"lift": lift, "law": "rectangular"} if lift else {})


SHORT_RETURN = {
    "rotation": "ccw",
    "motion": {
        "phases": [
            phase("rise", 75, 15),
            phase("dwell", 80),
            phase("return", 5, 15),
            phase("dwell", 50),
            phase("rise", 50, 7.5),
            phase("return", 50, 7.5),
            phase("dwell", 50),
        ]
    },
    "follower": {"kind": "oscillating", "arm": 125, "distance": 150, "lift": "angle"},
    "cam": {"prime_radius": 60},
}


@pytest.mark.parametrize("angle", [2, 5, 10])
@pytest.mark.parametrize("pencil", [None, Pencil.of(0.2), Pencil.of(0.5), TREMBLING])
def test_the_worked_arm_moves_the_way_that_is_told(angle, pencil):
    said = copy.deepcopy(SHORT_RETURN)
    said["motion"]["phases"][2]["angle"], said["motion"]["phases"][1]["angle"] = angle, 85 - angle
    drawn = gc.solve(task_from(said), pencil).chain["minimum_radius"]
    integrated = drawn.givens.integrated
    directions = lift_directions(integrated)
    for direction in (1, -1):
        assert directions[example_station(integrated, drawn.acts["tips"], direction)] == direction
    assert [part for step in drawn.steps() for part in step.parts]
