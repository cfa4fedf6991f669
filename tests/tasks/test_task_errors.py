"""Every fault of a task file gets one message that names field, value, what is allowed and the remedy."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from over_all import fast_first
from russian import english_words
from typer.testing import CliRunner

from graphcam.cli import app
from graphcam.cli.shared import INPUT_ERROR_STATUS
from graphcam.errors import TaskError
from graphcam.given.laws import LAWS
from graphcam.language import language, languages
from graphcam.tasks.dataclass_reader import classes_of
from graphcam.tasks.file_faults import _keys as keys_of
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import builtin_text, load_task
from graphcam.tasks.units import UNITS

WHOLE = builtin_text("coursework") + "\n[cam]\nprime_radius = 50\n"
RISE = '{ kind = "rise", angle = 80, lift = 30, law = "rectangular" }'
DWELL = '{ kind = "dwell", angle = 175 }'
MOTION = WHOLE[WHOLE.index("[motion]") : WHOLE.index("[follower]")]
FOLLOWER = WHOLE[WHOLE.index("[follower]") : WHOLE.index("[limits]")]

RADIANS = """phases = [
  { kind = "rise", angle = 1.3963, lift = 30, law = "rectangular" },
  { kind = "dwell", angle = 0.7854 },
  { kind = "return", angle = 1.0472, lift = 30, law = "rectangular" },
  { kind = "dwell", angle = 3.0543 },
]

"""


def rise(**changes: str) -> tuple[str, str]:
    """The coursework's first phase with other values; an empty one leaves the key out."""
    keys = {"kind": '"rise"', "angle": "80", "lift": "30", "law": '"rectangular"'} | changes
    return RISE, "{ " + ", ".join(f"{key} = {value}" for key, value in keys.items() if value) + " }"


# What is replaced in the coursework's file and by what; the field and the words that the message must have.
FAULTS = {
    "a phase with a wrong kind": (rise(kind='"rize"'), "motion.phases[0].kind", "'rize' rise, dwell, return"),
    "a phase without a kind": (rise(kind=""), "motion.phases[0].kind", "missing rise, dwell, return"),
    "a kind that is a number": (rise(kind="3"), "motion.phases[0].kind", "3 rise, dwell, return"),
    "a lift in quotes": (rise(lift='"30"'), "motion.phases[0].lift", "'30' number quotes"),
    "a lift that is true": (rise(lift="true"), "motion.phases[0].lift", "true number"),
    "a lift that is a date": (rise(lift="2024-01-01"), "motion.phases[0].lift", "2024-01-01 number"),
    "a lift that is no number": (rise(lift="nan"), "motion.phases[0].lift", "nan finite"),
    "an infinite angle": (rise(angle="inf"), "motion.phases[0].angle", "inf finite"),
    "a lift of 400 digits": (rise(lift="9" * 400), "motion.phases[0].lift", "999... finite"),
    "a lift of 5000 digits": (rise(lift="9" * 5000), "the text", "TOML digits"),
    "a negative lift": (rise(lift="-1"), "motion.phases[0].lift", "-1 greater than 0"),
    "no lift at all": (rise(lift="0"), "motion.phases[0].lift", "0 greater than 0"),
    "a negative angle": (rise(angle="-80"), "motion.phases[0].angle", "-80 greater than 0 degrees"),
    "a rise without a lift": (rise(lift=""), "motion.phases[0].lift", "missing graphcam init"),
    "lifts that do not close": (rise(lift="31"), "motion.phases (sum of rises less returns)", "1 mm equal"),
    "angles short of a turn": (rise(angle="79.5"), "motion.phases (sum of the angles)", "359.5 360 0.5 missing"),
    "angles over a turn": (rise(angle="80.25"), "motion.phases (sum of the angles)", "360.25 360 0.25 too many"),
    "an unknown law": (rise(law='"rectangle"'), "motion.phases[0].law", "'rectangle' did you mean 'rectangular'"),
    "a law that is a number": (rise(law="345"), "motion.phases[0].law", "345 text quotes"),
    "a ratio for a law without": (rise(law='"cosine"', ratio="2"), "motion.phases[0].ratio", "2 rectangular"),
    "a ratio of zero": (rise(ratio="0"), "motion.phases[0].ratio", "0 greater than 0"),
    "a mistyped key of a phase": (rise(lift="", lfit="30"), "motion.phases[0].lfit", "unknown did you mean 'lift'"),
    "a dwell with a lift": (
        (DWELL, '{ kind = "dwell", angle = 175, lift = 1 }'), "motion.phases[3].lift", "1 left out dwell rise return",
    ),
    "a phase that is a number": ((RISE, "80"), "motion.phases[0]", "80 table"),
    "phases that are a number": ((MOTION, "[motion]\nphases = 4\n"), "motion.phases", "4 list"),
    "no phases": ((MOTION, "[motion]\nphases = []\n"), "motion.phases", "empty list rise return"),
    "an empty motion": ((MOTION, "[motion]\n"), "motion.phases", "missing graphcam init"),
    "no motion": ((MOTION, ""), "motion", "missing graphcam init"),
    "nothing but rest": (
        (MOTION, '[motion]\nphases = [{ kind = "dwell", angle = 360 }]\n'), "motion.phases", "rise return add",
    ),
    "an unknown follower": (('"translating"', '"mushroom"'), "follower.kind", "'mushroom' flat-faced"),
    "a follower without a kind": (('kind = "translating"', ""), "follower.kind", "missing translating"),
    "no follower": ((FOLLOWER, ""), "follower", "missing graphcam init"),
    "an arm without its length": (
        (FOLLOWER, '[follower]\nkind = "oscillating"\ndistance = 150\n'), "follower.arm", "missing",
    ),
    "an offset of an arm": (
        (FOLLOWER, '[follower]\nkind = "oscillating"\narm = 125\ndistance = 150\noffset = 10\n'), "follower.offset",
        "10 left out oscillating translating",
    ),
    "a decimal comma": (rise(lift="30,0"), "line 10: the number", "30,0 decimal point 30.0"),
    "a negative distance": (
        (FOLLOWER, '[follower]\nkind = "oscillating"\narm = 125\ndistance = -150\n'), "follower.distance", "-150 0 mm",
    ),
    "a mistyped key of the follower": (("offset", "ofset"), "follower.ofset", "unknown did you mean 'offset'"),
    "an offset at the prime radius": (("offset = -10", "offset = -50"), "follower.offset", "-50 less 50 smaller"),
    "an offset over the prime radius": (("offset = -10", "offset = 60"), "follower.offset", "60 less 50 smaller"),
    "a negative roller": (("# roller_radius = 12", "roller_radius = -5"), "follower.roller_radius", "-5 0 mm or more"),
    "a roller as large as the cam": (
        ("# roller_radius = 12", "roller_radius = 50"), "follower.roller_radius", "50 less smaller",
    ),
    "a bad roller rule": (("0.7 rho", "0.7 roh"), "follower.roller_rule", "'K rho' term '0.7 roh'"),
    "an unknown rotation": (('"cw"', '"clockwise"'), "rotation", "'clockwise' 'ccw' 'cw'"),
    "no rotation": (('rotation = "cw"', ""), "rotation", "missing write ccw offset greater than 0 lowers"),
    "a speed of zero": (("speed_rpm = 120", "speed_rpm = 0"), "speed_rpm", "0 greater than 0 rpm"),
    "a mistyped key of the file": (("speed_rpm", "speed_prm"), "speed_prm", "unknown did you mean 'speed_rpm'"),
    "a mistyped table": (("[limits]", "[limit]"), "limit", "unknown did you mean 'limits'"),
    "a mistyped table that is needed": (("[motion]", "[motoin]"), "motoin", "unknown did you mean 'motion'"),
    "a mistyped key of the cam": (("prime_radius", "prime_radus"), "cam.prime_radus", "did you mean 'prime_radius'"),
    "a prime radius of zero": (("prime_radius = 50", "prime_radius = 0"), "cam.prime_radius", "0 greater than 0 mm"),
    "a table for a length": (("[cam]\nprime_radius = 50", "[cam.prime_radius]"), "cam.prime_radius", "table number"),
    "a limit of 0": (("angle_rise = 30", "angle_rise = 0"), "limits.pressure_angle_rise", "0 between 90"),
    "a limit of 90": (("angle_rise = 30", "angle_rise = 90"), "limits.pressure_angle_rise", "90 between excluded"),
    "a limit beyond": (
        ("# pressure_angle_return = 60", "pressure_angle_return = 120"), "limits.pressure_angle_return", "120 between",
    ),
    "a rest that is a number": (("[limits]", "[limits]\nrest = 1"), "limits.rest", "1 true false"),
    "a title in two lines": (('"Cam mechanism"', '"Cam\\nmechanism"'), "title.name", "printable one line"),
    "a title that is a number": (('"Cam mechanism"', "7"), "title.name", "7 text quotes"),
    "no divisions": (("divisions = 12", "divisions = 0"), "drawing.divisions", "0 from 1 to 1000"),
    "a broken number of divisions": (("divisions = 12", "divisions = 12.5"), "drawing.divisions", "12.5 whole"),
    "an ordinate of zero": (("ordinate = 50", "ordinate = 0"), "drawing.ordinate", "0 greater than 0 mm"),
    "one pole": (("[40, 40]", "[40]"), "drawing.poles[1]", "missing"),
    "three poles": (("[40, 40]", "[40, 40, 40]"), "drawing.poles", "3 2"),
    "a negative pole": (("[40, 40]", "[40, -40]"), "drawing.poles[1]", "-40 greater than 0 mm"),
    "an unknown format": (('"A1"', '"A5"'), "drawing.format", "'A5' 'A1' 'A4'"),
    "an unknown frame": (('"gost"', '"din"'), "drawing.frame", "'din' 'gost' 'iso'"),
    "an unknown language": (('language = "en"', 'language = "xx"'), "drawing.language", "'xx' en, "),
    "a rounding of zero": (("[drawing]", "[drawing]\nrounding = 0"), "drawing.rounding", "0 greater than 0 mm"),
     "text without quotes": (rise(law="rectangular"), "line 10: the text", 'rectangular quotes "rectangular"'),
    "a law of digits without quotes": (rise(law="3-4-5"), "line 10: the text", '3-4-5 quotes "3-4-5"'),
    "a number with its unit": (rise(lift="30 mm"), "line 10: the number", "30 mm unit write 30"),
    "a switch as Python writes it": (("[limits]", "[limits]\nrest = True"), "line 23: the switch", "True write true"),
    "a typographic minus": (("-10 ", "−10 "), "line 18, column 10: the character", "'−' minus sign '-' editor"),
    "a dash for a minus": (("-10 ", "–10 "), "line 18, column 10: the character", "'–' en dash '-' editor"),
    "typographic quotes": (('"cw"', "“cw”"), "line 2, column 12: the character", "'“' left double quotation '\"'"),
    "angle quotes": (('"cw"', "«cw»"), "line 2, column 12: the character", "'«' left-pointing double angle '\"'"),
    "a wide equals sign": (("rotation =", "rotation ＝"), "line 2, column 10: the character", "'＝' fullwidth '='"),
    "a space that does not break": (
        ('= "cw"', '=\u00a0"cw"'), "line 2, column 11: the character", "invisible no-break space plain anew",
    ),
    "an invisible character": (
        ('= "cw"', '= \u200b"cw"'), "line 2, column 12: the character", "invisible zero width left out delete",
    ),
    "angles in radians": (
        (WHOLE[WHOLE.index("phases = ["): WHOLE.index("[follower]")], RADIANS), "motion.phases (sum of the angles)",
        "6.2832 360 degrees 2 pi radians",
    ),
    "not TOML": (("[limits]", "[[limits"), "line 22", "'[[limits' TOML graphcam init"),
}  # fmt: skip

NO_TEXT = {
    "empty": (b"", "the task file", "empty graphcam init"),
    "comments only": (b"# nothing yet\n", "the task file", "empty graphcam init"),
    "not UTF-8": ("# Кулачок\n".encode("cp1251"), "line 1", "UTF-8"),
    "not UTF-8 further down": (b'rotation = "cw"\n\n# M\xfcnchen\n', "line 3", "UTF-8"),
    "a picture": (b"\x89PNG\r\n\x1a\n\x00\x00", "the task file", "picture TOML"),
    "nested beyond all measure": (b"a = " + b"[" * 20_000, "the text", "TOML"),
}


def file_with(fault: str, folder: Path) -> Path:
    path = folder / "cam.toml"
    if fault in NO_TEXT:
        path.write_bytes(NO_TEXT[fault][0])
        return path
    before, after = FAULTS[fault][0]
    assert before in WHOLE
    path.write_text(WHOLE.replace(before, after), encoding="utf-8")
    return path


def check(message: str, field: str, words: str) -> None:
    assert field in message
    assert [word for word in words.split() if word not in message] == [], message
    # One sentence: what is, what must be, and what to do.
    assert message.count(", but must be ") == 1
    assert "; " in message.split(", but must be ")[1]
    assert "\n" not in message


@pytest.mark.parametrize("fault", [*FAULTS, *NO_TEXT])
def test_a_fault_is_named_with_its_remedy(fault, tmp_path):
    path = file_with(fault, tmp_path)
    _, field, words = (FAULTS | NO_TEXT)[fault]
    with pytest.raises(TaskError) as caught:
        load_task(path)
    assert (caught.value.path, caught.value.field) == (str(path), field)
    assert str(caught.value).startswith(f"{path}: {caught.value.place} is ")
    check(str(caught.value), field if field in (*NO_TEXT, "the text") else "", words)


@pytest.mark.parametrize("fault", [*FAULTS, *NO_TEXT])
def test_the_command_line_says_it_once_and_leaves_nothing(fault, tmp_path):
    path = file_with(fault, tmp_path)
    result = CliRunner().invoke(app, ["solve", str(path), "--out", str(tmp_path / "out")])
    assert result.exit_code == INPUT_ERROR_STATUS
    assert result.stdout == ""
    assert result.stderr == f"graphcam: {error_of(path)}\n"
    assert [entry.name for entry in tmp_path.iterdir()] == ["cam.toml"]


NAMES = {
    *(key for table in classes_of(Task).values() for key in keys_of(table)),
    *(step for place in classes_of(Task) for step in place),
    "cam", "ccw", "FILE", "graphcam", "inf", "init", "min", "nan", "rho", "TOML", "true", *LAWS,
    *(unit for units in UNITS.values() for unit in units),
    "True", "false", "lfit", "limit", "motoin", "ofset", "prime_radus", "speed_prm",
}  # fmt: skip
"""What a message about the coursework's file may say in Latin letters: keys, values and mistyped ones."""


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_is_told_in_russian_as_a_whole(fault, tmp_path):
    path = file_with(fault, tmp_path)
    said = language("ru").text(error_in(path).caption).replace(str(path), "")
    # What Unicode calls a letter and what a parser says stands in brackets, what somebody wrote in quotes.
    said = re.sub(r"(TOML|невидимый|'.') \(.*?\)(?=[,;])", "", said)
    assert english_words(re.sub(r"'[^']*'", "", said), sorted(NAMES, key=len, reverse=True)) == set(), said


LITERALS = re.compile(r"'[^']+'|\"[^\"]+\"|`[^`]+`|\\b[a-z]+(?:[_.\\[][\\w\\]]+)+|\\b[a-z_]{3,} = ")
"""What of a message is typed into a file: quoted words, keys with their tables, and assignments."""
ONE_OF = re.compile(r"one of ((?:[\w-]+, )*[\w-]+)")


@pytest.mark.parametrize("spoken", languages())
def test_what_must_be_typed_is_the_same_in_every_language(spoken, tmp_path):
    listed = 0
    for fault in [*FAULTS, *NO_TEXT]:
        error = error_in(file_with(fault, tmp_path))
        said, told = str(error), language(spoken).text(error.caption)
        kinds = [word for names in ONE_OF.findall(error.expected) for word in names.split(", ")]
        listed += bool(kinds)
        assert [word for word in (*LITERALS.findall(said), *kinds) if word not in told] == [], told
    assert listed >= 5


def error_in(path: Path) -> TaskError:
    with pytest.raises(TaskError) as caught:
        load_task(path)
    return caught.value


def error_of(path: Path) -> str:
    return str(error_in(path))


@pytest.mark.parametrize(
    ("name", "words"),
    [
        (".", "folder name"),
        ("cam.toml/cam.toml", "not readable name"),
        ("x" * 5000, "not readable"),
    ],
)
def test_a_path_that_is_no_file(name, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cam.toml").write_text(WHOLE)
    result = CliRunner().invoke(app, ["solve", name])
    assert result.exit_code == INPUT_ERROR_STATUS
    check(result.stderr.strip(), "the task file", words)
    assert [entry.name for entry in tmp_path.iterdir()] == ["cam.toml"]


def test_a_task_file_that_is_missing_is_named_with_what_makes_one(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(app, ["solve", "nowhere.toml"])
    assert (result.exit_code, result.stdout) == (INPUT_ERROR_STATUS, "")
    example = "'graphcam init FILE' writes a commented example"
    assert result.stderr == f"graphcam: there is no file nowhere.toml; check the name; {example}\n"
    assert list(tmp_path.iterdir()) == []


def test_a_limit_that_was_meant_in_radians_is_asked_about(tmp_path):
    path = tmp_path / "cam.toml"
    path.write_text(builtin_text("coursework").replace("angle_rise = 30", "angle_rise = 0.52"), encoding="utf-8")
    result = CliRunner().invoke(app, ["solve", str(path), "--out", str(tmp_path / "out")])
    assert result.exit_code == INPUT_ERROR_STATUS
    assert "permitted pressure angle on the rise is 0.52 degrees" in result.stderr
    assert result.stderr.endswith("; 0.52 rad would be 30 degrees: write 30, or give cam.prime_radius\n")


def test_what_a_word_processor_puts_into_texts_and_comments_is_no_fault(tmp_path):
    path = tmp_path / "cam.toml"
    path.write_text(WHOLE.replace('"Cam mechanism"', '"Кулачок «А» – № 1"  # “so” it\u00a0is'), encoding="utf-8")
    assert load_task(path).title.name == "Кулачок «А» – № 1"


def test_a_path_that_no_system_knows():
    with pytest.raises(TaskError, match="not readable"):
        load_task("a\0b.toml")


SEVERAL = """rotation = ACW
speed: 120;
[motion]
phases = [
  { kind = "подъём", angle = 80,5, lift = 30, law = "linear" },
  { kind = "rest", angel = 45 },
  { kind = "fall", angle = "60 grad", lift = 30, law = "hình sin" },
  { kind = "dwell", angle = 175 },
]
[folower]
kind = "arm"
[limit]
pressure_angle_rise = 30
"""
TOLD = """line 1: the text is ACW, but must be in quotes; write "ACW"
line 1: rotation is 'ACW', but must be 'ccw' or 'cw'; did you mean 'ccw'?
line 2: the key is speed:, but must be followed by an equals sign; write speed =
line 2: the value is 120;, but must be without a semicolon; delete the semicolon
line 2: speed is an unknown key, but must be a key of this table; did you mean 'speed_rpm'?
line 5: the number is 80,5, but must be written with a decimal point; write 80.5
line 5: kind of phase 1 is 'подъём', but must be one of rise, dwell, return; did you mean 'rise'?
line 6: kind of phase 2 is 'rest', but must be one of rise, dwell, return; did you mean 'dwell'?
line 7: kind of phase 3 is 'fall', but must be one of rise, dwell, return; did you mean 'return'?
line 10: folower is an unknown key, but must be a key of this table; did you mean 'follower'?
and 1 more"""


def test_all_faults_of_a_file_are_told_at_once_in_the_order_of_its_lines(tmp_path):
    path = tmp_path / "cam.toml"
    path.write_text(SEVERAL, encoding="utf-8")
    # The mistyped table is why the follower is missing: that is not told beside it.
    first, *lines = error_of(path).splitlines()
    assert first == f"{path} has 11 faults:"
    assert [line.strip() for line in lines] == TOLD.splitlines()
    result = CliRunner().invoke(app, ["solve", str(path), "--out", str(tmp_path / "out")])
    assert (result.exit_code, result.stderr) == (INPUT_ERROR_STATUS, f"graphcam: {error_of(path)}\n")


def test_a_key_of_a_phase_is_told_with_its_line_and_the_number_of_the_phase(tmp_path):
    path = file_with("a negative lift", tmp_path)
    assert error_in(path).field == "motion.phases[0].lift"
    assert str(error_in(path)).startswith(f"{path}: line 10: lift of phase 1 is -1, but must be ")


@pytest.mark.parametrize("fault", fast_first(["a lift that is no number", "angles over a turn", "not UTF-8"]))
def test_the_program_ends_with_one_line_and_status_2(fault, tmp_path):
    path = file_with(fault, tmp_path)
    done = subprocess.run(
        [sys.executable, "-m", "graphcam", "solve", path], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == INPUT_ERROR_STATUS
    assert done.stdout == ""
    assert done.stderr == f"graphcam: {error_of(path)}\n"
    assert [entry.name for entry in tmp_path.iterdir()] == ["cam.toml"]
