"""Measures every character of the two faces that each machine has: ``python tests/sheets/measured_glyphs.py``."""

from __future__ import annotations

import json
from typing import Any

from graphcam.sheets.typefaces import GLYPHS_FILE, design, font, lettering_file, shipped


def measured_glyphs() -> dict[str, Any]:
    """What the table must say."""
    faces: list[dict[str, tuple[int, ...]]] = []
    for face in shipped():
        there = sorted(map(chr, font(face).get_charmap()))
        faces.append({letter: tuple(design(face, letter)) for letter in there if not any(letter in f for f in faces)})
    ems = {font(face).units_per_EM for face in shipped()}
    assert len(ems) == 1
    return {"ems": ems.pop(), "capital": design(lettering_file(), "H").top, "faces": faces}


if __name__ == "__main__":
    text = json.dumps(measured_glyphs(), ensure_ascii=False, separators=(",", ":"))
    lettering_file().with_name(GLYPHS_FILE).write_text(text + "\n", encoding="utf-8")
