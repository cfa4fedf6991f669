"""Files as they are typed in a first hour: what is wrong is told in one sentence, with what to write."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import graphcam as gc

TASK = """rotation = "cw"
speed_rpm = 120
[motion]
phases = [
  { kind = "rise", angle = 80, lift = 30, law = "rectangular" },
  { kind = "dwell", angle = 45 },
  { kind = "return", angle = 60, lift = 30, law = "rectangular" },
  { kind = "dwell", angle = 175 },
]
[follower]
kind = "translating"
offset = -10
"""


def told(tmp_path: Path, text: str) -> str:
    path = tmp_path / "cam.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(gc.TaskError) as error:
        gc.load_task(path)
    return str(error.value).removeprefix(f"{path}: ")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("angle = 80", "angle = 160/2", "line 5: the number is 160/2, but must be worked out; write 80"),
        (
            "speed_rpm = 120",
            "частота = 120",
            "line 2: the key is частота, .* Latin letters; did you mean 'speed_rpm'",
        ),
        ("[motion]", "[движение]", "line 3: the key is движение, .* Latin letters; did you mean 'motion'"),
        (
            "[motion]",
            "[motion # of the follower",
            r"line 3: the table is \[motion, .* closed by \]; write \] behind its end",
        ),
        (
            'kind = "translating"',
            'kind = "translating", # a stem',
            'line 11: the value is "translating", but .*delete the comma',
        ),
        (
            "angle = 45 }",
            "angle = 45",
            'line 6: the entry is { kind = "dwell", angle = 45, but must be closed by }; write } behind its end, on',
        ),
        ("angle = 45 },", "angle = 45 }", r"line 6: the entry is .* followed by a comma; write a comma behind its }"),
        ("lift = 30", 'lift = "25,5 мм"', 'lift of phase 1 .*; write "25.5 mm"'),
        ("speed_rpm = 120", 'speed_rpm = "2 Гц"', 'speed_rpm .*; write "2 Hz"'),
        ("[follower]", "[[answers]]\n[follower]", "the file is an exercise, .*; 'graphcam exercise make' takes it"),
        (
            '"cw"',
            '"cw" // clockwise',
            "line 1: the comment is // clockwise, .* begun with #; write # clockwise",
        ),
        ('"rise"', '"rise', 'line 5: the text is "rise, but must be closed by a quotation mark; write "rise"'),
        ("]\n[follower]", "[follower]", r"line 4: the list is open, but must be closed by \]"),
        ("lift = 30", "Hub = 30", "Hub of phase 1 is an unknown key, .*did you mean 'lift'"),
        ('"rise"', '"дальнее стояние"', "kind of phase 1 is 'дальнее стояние', .*did you mean 'dwell'"),
        ('"rise"', '"Rast"', "kind of phase 1 is 'Rast', .*did you mean 'dwell'"),
        ('"rise"', '"远休止"', "kind of phase 1 is '远休止', .*did you mean 'dwell'"),
        ('"translating"', '"Rollenstößel"', "follower.kind is 'Rollenstößel', .*did you mean 'translating'"),
        ('"translating"', '"摆动从动件"', "follower.kind is '摆动从动件', .*did you mean 'oscillating'"),
        ('"rectangular"', '"sinus law"', "law of phase 1 is 'sinus law', .*did you mean 'cycloidal'"),
        ('"cw"', '"顺时针"', "rotation is '顺时针', .*did you mean 'cw'"),
        ('"cw"', '"links"', "rotation is 'links', .*did you mean 'ccw'"),
        (
            "offset = -10",
            "offset = -10\n[spring]\nc = 3\nmass = 1",
            "spring.c is an unknown key, .*did you mean 'stiffness'",
        ),
        ("offset = -10", "offset = -10\n[drawing]\npoles = 40", "drawing.poles is 40, but must be a list of 2"),
    ],
)
def test_a_slip_is_told_with_what_to_write(tmp_path: Path, old: str, new: str, message: str):
    assert old in TASK
    said = told(tmp_path, TASK.replace(old, new, 1))
    assert "\n" not in said
    assert re.search(message, said), said


@pytest.mark.parametrize(
    ("word", "law"), [("Bestehorn", "cycloidal"), ("равнопеременный", "rectangular"), ("polynomial 5", "3-4-5")]
)
def test_a_law_by_its_name_in_a_textbook(word: str, law: str):
    assert gc.Rise(30, 1.0, word).normalised.name == gc.law(law).name


@pytest.mark.parametrize(
    ("spring", "said"),
    [
        ("stiffness = 3000\nmass = 0.2", "spring.stiffness = 3000 N/mm looks like N/m: if so, give 3, in N/mm"),
        ("stiffness = 3\nmass = 200", "spring.mass = 200 kg looks like g: if so, give 0.2, in kg"),
    ],
)
def test_a_spring_in_other_units_is_asked_about(tmp_path: Path, spring: str, said: str):
    path = tmp_path / "cam.toml"
    path.write_text(f"{TASK}[spring]\n{spring}\n")
    assert any(said in str(warning) for warning in gc.solve(gc.load_task(path)).warnings)
