"""One photograph, read: whose page it is, where the paper lies in it, what is drawn there; the key is not known here.

A page on two taped sheets is read off two photographs, one of each sheet.  All this needs the libraries of the extra
``photo``, and is loaded by who reads photographs only.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import cv2
import numpy as np

from graphcam.exercises.course.sheet_code import SheetCode
from graphcam.exercises.definition.drawn_answers import board_chain, views_of
from graphcam.exercises.definition.exercise import AskedAnswer, Exercise
from graphcam.exercises.definition.variant import drawn
from graphcam.exercises.photographs.drawn_answer_reader import answers_on
from graphcam.exercises.photographs.page_owner import PrintedSheets
from graphcam.exercises.photographs.photographed_page import SeenPage
from graphcam.exercises.photographs.read_photo import KeptPicture, ReadPhoto
from graphcam.photo.pictures import Photograph, PhotographError
from graphcam.photo.printed_page import SIDE_NAMES, PrintedPage, Side
from graphcam.photo.qr_codes import codes_in
from graphcam.photo.registration import Registration, register
from graphcam.photo.tags import Tags, find_tags
from graphcam.photo.taped_tiles import Tile, joined_tiles, registered_tiles

Read = tuple[ReadPhoto, dict[str, bytes]]
"""A photograph, and the pictures of it that are kept, by the names of their files."""


@dataclass(frozen=True, eq=False)
class _FoundPage:
    """A photograph, the tags in it, and the page that it shows."""

    photograph: Photograph
    tags: Tags
    code: SheetCode
    page: PrintedPage


def read_photograph(
    sheets: PrintedSheets, exercise: Exercise, photograph: Photograph, digest: str, prefix: str
) -> Read:
    """What a photograph shows, and the pictures of it that are kept, by their names, which begin with a prefix.

    A photograph that cannot be read has its reason in place of answers; one of a half of a page says of which.
    """
    known, found = _identified_page(sheets, exercise, photograph, digest)
    if found is None:
        return known, {}
    try:
        if found.page.seam is None:
            rows, columns = photograph.pixels.shape[:2]
            registration = register(found.tags, found.page, (columns, rows), photograph.focal)
            seen = SeenPage.from_photograph(photograph, found.page, registration)
            return _read_page(sheets, exercise, _registered(known, registration), found.code, seen, prefix)
        tiles = registered_tiles(photograph.pixels, found.tags, found.page, photograph.focal)
        if len(tiles) == 1:
            side, tile = next(iter(tiles.items()))
            return replace(_registered(known, tile.registration), half=side), {}
    except PhotographError as error:
        return _refused_photo(known, error, exercise), {}
    return _of_tiles(sheets, exercise, known, found, tiles, prefix)


def read_halves(
    sheets: PrintedSheets, exercise: Exercise, photographs: Mapping[Side, Photograph], digest: str, prefix: str
) -> Read:
    """What photographs of the two sheets of a page show together; as for one photograph."""
    name = " + ".join(photographs[side].name for side in SIDE_NAMES)
    tiles: dict[Side, Tile] = {}
    known, found = ReadPhoto(name, digest), None
    for side in SIDE_NAMES:
        photograph = photographs[side]
        known, found = _identified_page(sheets, exercise, replace(photograph, name=name), digest)
        if found is None:
            return known, {}
        try:
            both = registered_tiles(photograph.pixels, found.tags, found.page, photograph.focal)
        except PhotographError as error:
            return _refused_photo(known, error, exercise), {}
        tiles |= {side: both[side]} if side in both else {}
    assert found is not None
    return _of_tiles(sheets, exercise, known, found, tiles, prefix)


def _identified_page(
    sheets: PrintedSheets, exercise: Exercise, photograph: Photograph, digest: str
) -> tuple[ReadPhoto, _FoundPage | None]:
    """Whose page it is; nothing is found where that is not known, and then the photograph is refused."""
    known = ReadPhoto(photograph.name, digest)
    grey = np.asarray(cv2.cvtColor(photograph.pixels, cv2.COLOR_BGR2GRAY), np.uint8)
    tags = find_tags(grey)
    known = replace(known, tags=len(tags.numbers))
    try:
        code, page = sheets.page(codes_in(grey, tags), tags=len(tags.numbers) > 0)
    except PhotographError as error:
        return _refused_photo(known, error, exercise), None
    across, up = (abs(end - start) for start, end in page.bars[:2])
    known = replace(known, student=code.student, page=code.page, expected=len(page.tags), bars=(across, up))
    return known, _FoundPage(photograph, tags, code, page)


def _refused_photo(known: ReadPhoto, error: PhotographError, exercise: Exercise) -> ReadPhoto:
    return replace(known, why=exercise.tell(error.why), remedy=exercise.tell(error.advice))


def _registered(known: ReadPhoto, registration: Registration) -> ReadPhoto:
    return replace(known, tags=registration.tags, residual=registration.residual, kind=registration.kind)


def _of_tiles(
    sheets: PrintedSheets,
    exercise: Exercise,
    known: ReadPhoto,
    found: _FoundPage,
    tiles: Mapping[Side, Tile],
    prefix: str,
) -> Read:
    """A page on two sheets, read; refused where one is missing, or where it is not seen how they lie."""
    try:
        together = joined_tiles(tiles, found.page)
        worse = max((tile.registration for tile in together.values()), key=lambda one: one.residual)
        tags = sum(tile.registration.tags for tile in together.values())
        known = replace(_registered(known, worse), tags=tags)
        return _read_page(sheets, exercise, known, found.code, SeenPage.of_tiles(together, found.page), prefix)
    except PhotographError as error:
        return _refused_photo(known, error, exercise), {}


def _read_page(
    sheets: PrintedSheets, exercise: Exercise, known: ReadPhoto, code: SheetCode, seen: SeenPage, prefix: str
) -> Read:
    """What is drawn on a page, and the pictures of it."""
    asked = _answers_on_page(exercise, seen.page, code, sheets.secret)
    answers = answers_on(seen, asked, exercise.tell)
    shown = dict(seen.shown_pictures())
    pictures = {name: KeptPicture(f"{prefix}{k}.jpg", box) for k, (name, (_, box)) in enumerate(shown.items())}
    files = {pictures[name].file: data for name, (data, _) in shown.items()}
    return replace(known, answers=answers, pictures=pictures), files


def _answers_on_page(
    exercise: Exercise, page: PrintedPage, code: SheetCode, secret: bytes
) -> dict[str, list[AskedAnswer]]:
    """The answers that are drawn on a page, by their view."""
    chain = board_chain(drawn(exercise, code.student, secret, code.draw).task)
    found: dict[str, list[AskedAnswer]] = {}
    for asked in exercise.answers:
        places = views_of(chain, asked) if asked.mark_form else set[str]()
        # One that may be drawn in several views says in which it is.
        if len(places) == 1 and (place := places.pop()) in page.views:
            found.setdefault(place, []).append(asked)
    return found
