"""A photograph is read and marked, and what comes of it is held against what the simulator knows."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from bent_paper import Floats, Points
from curves_drawn import Lines
from hand import even
from scenes import BAD, RIGHT, Scene
from scipy.spatial import cKDTree

from graphcam.exercises.definition.exercise import Answers
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.marking import mark
from graphcam.exercises.marking.record import Record
from graphcam.exercises.photographs.corrections import StudentCorrections
from graphcam.exercises.photographs.counted_answers import settled_student
from graphcam.exercises.photographs.photo_reader import read_photograph
from graphcam.photo.drawn_curves import read_curve
from graphcam.photo.file_intake import Photograph, UnopenedFile, pictures_in
from graphcam.photo.pencil_ink import Ink, ink_of
from graphcam.photo.pictures import PhotographError
from graphcam.photo.plotted_points import read_points
from graphcam.photo.rectify import rectify
from graphcam.photo.registration import Registration, register
from graphcam.photo.straight_lines import Segment, crossing, read_lines
from graphcam.photo.tags import find_tags

QUANTILES = np.linspace(0.025, 0.975, 20)
"""Of the errors of a photograph these are kept: together they tell the quantiles of all photographs."""
FOUND = 0.6
"""A place of a line is read where a read point is so near, mm."""
SAME_MARK = 1.2
"""A mark is found where one was read so near, mm."""
RULE = 0.5
"""To so many mm the bars are measured."""
AT = 75.0
"""mm from the origin at which the scale is looked at."""
BESIDE = 4.0
"""mm about the room."""
LEAST_ANGLE = 30.0
"""Of crossings that are measured, degrees."""


@dataclass
class Peak:
    """How long a block took [s of CPU], and how much memory it took at most beside what was there before [MB]."""

    seconds: float = 0.0
    memory: float = 0.0


@contextmanager
def watched() -> Iterator[Peak]:
    """Watch time and memory of a block."""
    peak, status = Peak(), Path("/proc/self/status")
    # So the kernel forgets the highest so far.
    Path("/proc/self/clear_refs").write_text("5", encoding="ascii")
    before, start = _megabytes(status, "VmRSS"), time.process_time()
    yield peak
    peak.seconds = time.process_time() - start
    peak.memory = _megabytes(status, "VmHWM") - before


def _megabytes(status: Path, name: str) -> float:
    found = re.search(rf"{name}:\s+(\d+) kB", status.read_text(encoding="ascii"))
    return int(found[1]) / 1024 if found else float("nan")


def picture_of(jpeg: bytes, path: Path) -> Photograph:
    """The picture in a file that is written there, read as any file is, and removed."""
    path.write_bytes(jpeg)
    (picture,) = pictures_in([path])
    path.unlink()
    assert not isinstance(picture, UnopenedFile), picture
    return picture


def measured(scene: Scene, folder: Path) -> dict[str, Any]:
    """What is found out by a photograph, as JSON takes it."""
    found: dict[str, Any] = {
        "number": scene.number,
        "kind": scene.kind,
        "course": scene.course.kind.name,
        "pen": scene.pen,
        "megapixels": scene.megapixels,
        "bend": scene.bend,
        "print": scene.renderer,
        "made": scene.truth.made,
    }
    try:
        found |= _read_alone(scene, folder) if scene.kind in ("marks", "diagram") else _marked(scene, folder)
    except Exception as error:  # noqa: BLE001  # whatever breaks is a figure of the table
        found["crash"] = repr(error)[:300]
    return found


def _marked(scene: Scene, folder: Path) -> dict[str, Any]:
    """The photograph read and marked as the command does it."""
    key, asked = scene.course.key(scene.student), scene.course.drawn
    bars = tuple(
        round(abs(end - start) * part / RULE) * RULE
        for (start, end), part in zip(scene.page.bars, scene.shot.placing.stretched, strict=True)
    )
    corrections = StudentCorrections(bars={scene.page_number: (bars[0], bars[1])})
    with watched() as peak:
        picture = picture_of(scene.jpeg, folder / f"{scene.number}.jpg")
        photo, _ = read_photograph(scene.course.sheets, scene.course.exercise, picture, f"{scene.number:016x}", "p")
    found: dict[str, Any] = {"seconds": round(peak.seconds, 2), "memory": round(peak.memory)}
    found["whose"] = photo.student == scene.student and photo.page == scene.page_number
    if photo.why:
        return found | {"refused": "photo", "why": _bare(photo.why)}
    found |= {"paper": photo.kind, "residual": round(photo.residual, 3), "tags": [photo.tags, photo.expected]}
    found |= _registered(scene, picture, (bars[0], bars[1]))
    result = settled_student(scene.course.exercise, scene.student, [photo], key, corrections)
    answer = next(one for one in result.answers if one.asked.name == asked.name)
    read = photo.answers.get(asked.name)
    if read is not None:
        found["measures"] = dict(read.measures)
        found["share"] = round(read.share, 4)
    if answer.given is None:
        return found | {"refused": "answer", "why": _bare(str(answer.why))} | _typed(scene, key)
    points = np.asarray(answer.as_read, dtype=np.complex128)
    found |= _rollers(scene, points) if scene.kind == "rollers" else _compared(scene, points)
    return found | _typed(scene, key) | _by_photo(scene, key, np.asarray(answer.given))


def _bare(why: object) -> str:
    """A reason without its figures, so that like ones can be counted."""
    return re.sub(r"[\d.,]+", "#", str(why))[:120]


def _registered(scene: Scene, picture: Photograph, bars: tuple[float, float]) -> dict[str, Any]:
    """How far the registration is off within the view's room, and the scale by the measured bars."""
    registration = _registration(scene, picture)
    left, low, right, high = scene.view.room
    grid = np.linspace(left, right, 21) + 1j * np.linspace(low, high, 21)[:, None]
    off = np.abs(registration.millimetres(scene.shot.pixels(grid)) - grid)
    origin = scene.view.origin
    ring = AT * np.exp(2j * np.pi * np.arange(8) / 8)
    seen = registration.millimetres(scene.shot.pixels(origin + scene.shot.placing.by_hand(ring))) - origin
    across, up = (bar / abs(end - start) for bar, (start, end) in zip(bars, scene.page.bars, strict=True))
    scaled = np.abs(seen.real * across + 1j * seen.imag * up - ring)
    return {"off": _quantiles(off), "most off": round(float(off.max()), 4), "scale": _quantiles(scaled)}


def _registration(scene: Scene, picture: Photograph) -> Registration:
    tags = find_tags(cv2.cvtColor(picture.pixels, cv2.COLOR_BGR2GRAY))
    return register(tags, scene.page, picture.pixels.shape[1::-1], picture.focal)


def _quantiles(values: Floats) -> list[float]:
    return np.round(np.quantile(values, QUANTILES), 4).tolist()


def _compared(scene: Scene, points: Points) -> dict[str, Any]:
    """How far the read curve lies from what was drawn, and how much of what was drawn was read.

    points : (n,) mm of the page from the view's origin
    """
    drawn = [scene.shot.placing.by_hand(line) for line, _ in scene.truth.lines]
    if not drawn:
        return {}
    dense = np.concatenate([even(line, step=0.05) for line in drawn])
    read = even(points, step=0.25)
    apart = np.abs(np.diff(points))
    # Where nothing was read there is a step, and nothing on it.
    ends = np.flatnonzero(apart > 3.0)
    for k in ends.tolist():
        middle, half = (points[k] + points[k + 1]) / 2, apart[k] / 2 - 0.5
        read = read[np.abs(read - middle) > half]
    off = _distances(read, dense)
    seen = _distances(np.concatenate(drawn), read) < FOUND
    return {"curve": _quantiles(off), "most curve": round(float(off.max()), 3), "read": round(float(seen.mean()), 4)}


def _distances(points: Points, others: Points) -> Floats:
    tree = cKDTree(np.stack([others.real, others.imag], axis=-1))
    return np.asarray(tree.query(np.stack([points.real, points.imag], axis=-1))[0])


def _rollers(scene: Scene, points: Points) -> dict[str, Any]:
    wanted = scene.shot.placing.by_hand(np.array(scene.truth.marks["cross"]))
    return {"rollers": _quantiles(_distances(wanted, points))}


def _typed(scene: Scene, key: AnswerKey) -> dict[str, Any]:
    """The marks for the same drawing, measured without a photograph."""
    if scene.kind == "rollers":
        record = _record(scene, key, np.array(scene.truth.marks["cross"]))
    elif len(scene.truth.lines) == 1:
        record = _record(scene, key, _line(scene.truth.lines))
    else:
        return {"typed": _said(scene, _record(scene, key, None))}
    return {"typed": _said(scene, record)}


def _line(lines: Lines) -> Points:
    line, closed = lines[0]
    line = line[::4]
    return np.append(line, line[0]) if closed else line


def _by_photo(scene: Scene, key: AnswerKey, given: Points) -> dict[str, Any]:
    return {"photo": _said(scene, _record(scene, key, given))}


def _record(scene: Scene, key: AnswerKey, drawn: Points | None) -> Record:
    name = scene.course.drawn.name
    values = {other: value for other, value in scene.truth.work.answers.items() if other != name}
    return mark(scene.course.exercise, key, Answers(values if drawn is None else {**values, name: drawn}))


def _said(scene: Scene, record: Record) -> dict[str, Any]:
    answer = next(each for each in record.answers if each.name == scene.course.drawn.name)
    told = record.diagnosis
    name = "" if told is None else told.misconception
    if told is not None and scene.truth.made in told.alike:
        name = scene.truth.made
    return {"total": round(record.total, 3), "drawn": round(answer.marks, 3), "outcome": answer.outcome, "told": name}


def _read_alone(scene: Scene, folder: Path) -> dict[str, Any]:
    """What is drawn, read without any exercise that asks for it."""
    with watched() as peak:
        picture = picture_of(scene.jpeg, folder / f"{scene.number}.jpg")
        try:
            registration = _registration(scene, picture)
        except PhotographError as error:
            return {"refused": "photo", "why": _bare(error.why)}
        ink = _ink(scene, picture, registration)
        found = _diagram_read(scene, ink) if scene.kind == "diagram" else _marks_read(scene, ink)
    return found | {"seconds": round(peak.seconds, 2), "memory": round(peak.memory)}


def _diagram_read(scene: Scene, ink: Ink) -> dict[str, Any]:
    reading = read_curve(ink, scene.view)
    refusal = reading.refusal()
    found: dict[str, Any] = {
        "measures": {name: round(float(value), 4) for name, value in vars(reading.measures).items()}
    }
    if refusal:
        return found | {"refused": "answer", "why": _bare(refusal[0])}
    return found | _compared(scene, reading.points[np.isfinite(reading.points)])


def _marks_read(scene: Scene, ink: Ink) -> dict[str, Any]:
    """Plotted points and crossings of rays."""
    reading, lines = read_points(ink, scene.view), read_lines(ink, scene.view)
    by_hand = scene.shot.placing.by_hand
    wanted = by_hand(np.concatenate([np.array(places) for places in scene.truth.marks.values()]))
    off = _distances(wanted, reading.points) if reading.points.size else np.full(wanted.size, np.inf)
    false = _distances(reading.points, wanted) > SAME_MARK if reading.points.size else np.zeros(0, bool)
    found: dict[str, Any] = {"marks": wanted.size, "found": int((off < SAME_MARK).sum()), "false": int(false.sum())}
    found["point errors"] = np.round(off[off < SAME_MARK], 3).tolist()
    rays = [(complex(a), complex(b)) for a, b in (by_hand(np.array(ray)) for ray in scene.truth.rays)]
    matched = [_matched(ray, lines) for ray in rays]
    found |= {"rays": len(rays), "rays found": sum(one is not None for one in matched)}
    return found | _crossings(rays, matched)


def _ink(scene: Scene, picture: Photograph, registration: Registration) -> Ink:
    left, low, right, high = scene.view.room
    places = [complex(left, low), complex(right, high)]
    places += [corner + side * (1 + 1j) for corner in scene.page.patches for side in (0.0, scene.page.patch_side)]
    x, y = [place.real for place in places], [place.imag for place in places]
    box = (max(0, min(x) - BESIDE), max(0, min(y) - BESIDE))
    box = (*box, min(scene.page.width, max(x) + BESIDE), min(scene.page.height, max(y) + BESIDE))
    middle = complex(left + right, low + high) / 2
    ends = registration.pixels(middle + np.array([-1.0, 1.0]))
    return ink_of(rectify(picture.pixels, registration, box), scene.page, 2 / abs(ends[1] - ends[0]))


def _matched(ray: tuple[complex, complex], lines: list[Segment]) -> Segment | None:
    """The longest line that was read along a ray."""
    start, end = ray
    along = (end - start) / abs(end - start)
    near = [
        line
        for line in lines
        if max(abs(((z - start) * np.conj(along)).imag) for z in (line.start, line.end)) < 0.8
        # Not the ray on the other side of the centre.
        and 0 < (((line.start + line.end) / 2 - start) * np.conj(along)).real < abs(end - start)
        and abs(line.end - line.start) > 0.4 * abs(end - start)
    ]
    return max(near, key=lambda line: line.length, default=None)


def _crossings(rays: list[tuple[complex, complex]], matched: list[Segment | None]) -> dict[str, Any]:
    errors: list[float] = []
    for (one, seen), (other, also) in combinations(zip(rays, matched, strict=True), 2):
        ahead, across = one[1] - one[0], other[1] - other[0]
        angle = abs(np.degrees(np.angle(ahead / across))) % 180
        if seen is None or also is None or min(angle, 180 - angle) < LEAST_ANGLE:
            continue
        part = ((other[0] - one[0]) * np.conj(across)).imag / (ahead * np.conj(across)).imag
        place = one[0] + part * ahead
        # Beyond the ends of the rays nobody would look.
        if abs(place) < 0.5 * abs(ahead):
            try:
                errors.append(round(abs(crossing(seen, also) - place), 3))
            except PhotographError:
                continue
    return {"crossings": errors}


def is_right(record: Mapping[str, Any]) -> bool:
    """Whether the photograph shows a right drawing that can be read."""
    return record["kind"] in RIGHT and record["kind"] != "too bad"


def is_bad(record: Mapping[str, Any]) -> bool:
    """Whether it shows a drawing that must not be marked as right."""
    return record["kind"] in BAD
