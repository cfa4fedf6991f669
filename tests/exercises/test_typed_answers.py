"""Whatever a sheet prints of units, signs and numbers, in any language, is read back from an answer."""

from __future__ import annotations

import pytest

from graphcam.drafting.scale import UNITS, plain_unit
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.reading.submission_files import from_files
from graphcam.language import language, languages

ANSWERS = find_exercise("pressure-angle").answers
NUMBERS = {
    37.1: ["37.1", "37,1", "+37.1", "37.1;", "３７.１", "\u200b37.1", "37.1\u200b", " 37.1 ", "037.1", "+ 37.1"],
    37.0: ["37.", "37"],
    0.5: [".5", "0,5", "+.5"],
    -37.1: ["-37.1", "−37.1", "–37,1", "—37.1", "— 37.1", "‑37.1"],
}
"""Numbers, as keyboards and word processors write them."""
DEGREES = [
    "deg",
    "°",
    " °",
    " degrees",
    "Deg",
    "град",
    "град.",
    " градусов",
    "º",
    " độ",
    "度",
    " Grad",
    "\xa0град",
    "\u202fdeg",
    " [deg]",
    " градуса",
]
LENGTHS = ["mm", "mm.", "мм", " MM", " millimetres", "毫米", "\xa0mm", "\u2009мм", " миллиметра", " [мм]", "公厘"]
PER_RADIAN = [
    "mm/rad",
    "мм/рад",
    " mm per rad",
    " mm/rad.",
    "毫米/弧度",
    " mm·rad⁻¹",
    " mm rad^-1",
    "mm / rad",
    " мм на радиан",
    "毫米每弧度",
    "[mm/rad]",
]


def read(answer: str, text: str) -> list[float | None]:
    """What two files say of an answer: one of TOML, one of CSV."""
    files = {"answers.toml": f"{answer} = {text}\n"}, {"answers.csv": f"answer;value\n{answer};{text}\n"}
    found = [from_files(ANSWERS, {name: said.encode() for name, said in each.items()}) for each in files]
    return [each.values.get(answer) for each in found]


@pytest.mark.parametrize(("number", "typed"), [(number, text) for number, said in NUMBERS.items() for text in said])
def test_a_number_is_read_as_people_type_it(number, typed):
    from_csv = read("s0", typed)[1] if ";" not in typed else number
    assert [read("s0", typed)[0], from_csv] == [number, number]


@pytest.mark.parametrize(
    ("answer", "unit"),
    [
        *(("alpha_4", unit) for unit in DEGREES),
        *(("s0", unit) for unit in LENGTHS),
        *(("v_4", unit) for unit in PER_RADIAN),
    ],
)
def test_a_unit_is_read_as_people_type_it(answer, unit):
    assert read(answer, f"25.3{unit}") == [25.3, 25.3]
    assert read(answer, f"–25,3{unit}") == [-25.3, -25.3]


@pytest.mark.parametrize("spoken", languages())
def test_every_unit_that_a_sheet_prints_is_read_back(spoken):
    for name, caption in UNITS.items():
        assert plain_unit(language(spoken).text(caption)) == plain_unit(name), name


@pytest.mark.parametrize(
    ("answer", "typed"),
    [("alpha_4", "0.44 rad"), ("alpha_4", "25 рад"), ("s0", "3.71 cm"), ("v_4", "25 mm"), ("s0", "25 град")],
)
def test_another_unit_than_the_one_asked_for_is_told(answer, typed):
    found = from_files(ANSWERS, {"answers.toml": f"{answer} = {typed}\n".encode()})
    assert answer not in found.values
    assert "but is asked in" in str(found.problems[answer])
