"""What people write from their textbooks and programs is answered with what graphcam calls it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.errors import TaskError
from graphcam.given.follower import FOLLOWERS_BY_KIND
from graphcam.given.laws import KNOWN_LAWS, canonical_law, law_of_return
from graphcam.language import language, languages
from graphcam.tasks.motion_tables import RiseTable
from graphcam.tasks.task_file import builtin_task, builtin_text, load_task
from graphcam.tasks.task_writer import task_files
from graphcam.typed_words import meant, plain, table

LAW_SYNONYMS, SENSE_SYNONYMS = table()["laws"], table()["senses"]
TASK = builtin_text("coursework")
RISE = 'law = "rectangular" },\n  { kind = "dwell", angle = 45'
LAST = '  { kind = "dwell", angle = 175 },\n'
ROLLER = "# roller_radius = 12"


LENGTH = "a number of mm (without quotes), or text with its unit: mm, cm, m, um, in, mil, thou, ft"


def refusal(tmp_path: Path, before: str, after: str, *more: tuple[str, str]) -> TaskError:
    """What is said of the coursework with something else in it."""
    text = TASK
    for old, new in ((before, after), *more):
        assert old in text
        text = text.replace(old, new, 1)
    path = tmp_path / "q.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(TaskError) as caught:
        load_task(path)
    return caught.value


@pytest.mark.parametrize(
    ("called", "name"),
    [
        ("cicloidal", "cycloidal"),
        ("simple harmonics", "cosine"),
        ("равноускоренная", "rectangular"),
    ],
)
def test_a_mistyped_law_is_suggested_and_not_taken(called, name, tmp_path):
    error = refusal(tmp_path, RISE, RISE.replace("rectangular", called))
    assert (error.value, error.remedy) == (called, f"did you mean '{name}'?")
    with pytest.raises(gc.DesignError, match=re.escape(f"did you mean '{name}'?")):
        gc.law(called)


@pytest.mark.parametrize(
    ("called", "name"),
    [
        ("simple harmonic", "cosine"),
        ("SHM", "cosine"),
        ("shm", "cosine"),
        ("косинусный", "cosine"),
        ("余弦加速度（简谐）", "cosine"),
        ("Cycloid", "cycloidal"),
        ("Parabolic", "rectangular"),
        ("UARM", "rectangular"),
        ("gravity", "rectangular"),
        ("Равноускоренный", "rectangular"),
        ("double harmonic", "double-harmonic"),
        ("linearly decreasing acceleration", "2-3"),
        ("Equally decreasing acceleration", "2-3"),
        ("linearly (equally) decreasing acceleration", "2-3"),
        ("равномерно убывающее ускорение", "2-3"),
        ("линейно убывающее ускорение", "2-3"),
        ("видоизмененный синусоидальный", "modified-sine"),
        ("3–4–5", "3-4-5"),
        ("uniform velocity", "constant-velocity"),
        ("Constant Velocity", "constant-velocity"),
        *((word, name) for name, words in LAW_SYNONYMS.items() for word in words),
    ],
)
def test_a_law_is_known_by_its_names_and_told_by_its_own(called, name):
    assert gc.law(called) == gc.law(name)
    assert gc.Rise(30, 1.0, called) == gc.Rise(30, 1.0, name)
    table = RiseTable(120.0, 30.0, called)
    assert (table.law, table) == (name, RiseTable(120.0, 30.0, name))
    assert law_of_return(called) == law_of_return(name)


def test_a_task_file_says_a_law_as_a_textbook_and_is_told_by_graphcam(tmp_path):
    path = tmp_path / "q.toml"
    path.write_text(TASK.replace("rectangular", "UARM"), encoding="utf-8")
    task = load_task(path)
    assert task == builtin_task("coursework")
    assert "UARM" not in task_files(task)["task.toml"]


@pytest.mark.parametrize("spoken", [name for name in languages() if name != "en"])
def test_the_caption_of_every_law_suggests_the_law(spoken):
    captions = {name: language(spoken).catalog.translation(name, "") for name in LAW_SYNONYMS}
    assert {name: said for name, said in captions.items() if said not in {name, *LAW_SYNONYMS[name]}} == {}


def test_the_words_for_laws_are_those_of_laws_and_no_two_laws_share_one():
    assert {*LAW_SYNONYMS} == {*KNOWN_LAWS}
    words = [(plain(word), name) for name, called in LAW_SYNONYMS.items() for word in called]
    assert len(set(words)) == len({word for word, _ in words})
    assert [canonical_law(word) for word, _ in words] == [name for _, name in words]


@pytest.mark.parametrize(("called", "name"), [(word, name) for name, words in SENSE_SYNONYMS.items() for word in words])
def test_a_sense_in_words_is_told_as_its_value(called, name, tmp_path):
    assert refusal(tmp_path, '"cw"', f'"{called}"').remedy == f"did you mean '{name}'?"


PHASES, FOLLOWERS, SENSES = ["rise", "dwell", "return"], [*FOLLOWERS_BY_KIND], ["ccw", "cw"]


@pytest.mark.parametrize(
    ("known", "typed", "name"),
    [
        *((SENSES, word, "ccw") for word in ["ACW", "acw", "Anti-Clockwise", "против часовой", "逆时针"]),
        *((PHASES, word, "rise") for word in ["up", "Lift", "подъём", "Подъем", "удаление", "推程", "Anstieg", "rize"]),
        *((PHASES, word, "dwell") for word in ["rest", "выстой", "дальнее стояние", "远休止", "dừng", "Rast", "dwel"]),
        *((PHASES, word, "return") for word in ["fall", "DOWN", "возвращение", "приближение", "回程", "hạ", "retrun"]),
        *((FOLLOWERS, word, "flat-faced") for word in ["flat", "тарельчатый", "平底", "đáy bằng", "Tellerstößel"]),
        *((FOLLOWERS, word, "translating") for word in ["roller", "knife-edge", "толкатель", "直动", "Rollenstößel"]),
        *((FOLLOWERS, word, "oscillating") for word in ["arm", "rocker", "swinging", "rotating", "коромысло", "摆动"]),
        *((KNOWN_LAWS, word, "constant-velocity") for word in ["linear", "линейный", "直线"]),
        *((KNOWN_LAWS, word, "cycloidal") for word in ["hình sin", "Zykloide", "cicloidal"]),
        *((KNOWN_LAWS, word, "2-3") for word in ["линейно убывающая", "равноубывающий"]),
        *((KNOWN_LAWS, word, "") for word in ["2-3-4", "3-4-5-6", "4-5-6", "linea", "spline", "polynomial", "uniform"]),
        *((PHASES, word, "") for word in ["step", "turn", "fast", "raste"]),
        (["start", "stop", "count"], "step", "count"),
        (["start", "stop", "count"], "spot", ""),
    ],
)  # fmt: skip
def test_a_word_means_what_the_table_says_or_nothing(known, typed, name):
    assert meant(typed, known) == name


def test_no_word_of_the_table_stands_for_two_words_of_one_section():
    for section in ("phases", "followers", "senses", "laws", "quantities", "units"):
        words = [(plain(word), name) for name, called in table()[section].items() for word in called]
        meanings = {word: {name for other, name in words if other == word} for word, _ in words}
        assert {word: names for word, names in meanings.items() if len(names) > 1} == {}, section
        names = {plain(name) for name in table()[section]}
        assert {word for word, name in words if word in names and plain(name) != word} == set(), section


@pytest.mark.parametrize(
    ("before", "after", "remedy"),
    [
        ('"A1"', '"a3"', "did you mean 'A3'?"),
        ('"A1"', '"А1"', "its letter 'А' is Cyrillic: type 'A1' in Latin letters"),
        ('"A1"', '"а3"', "its letter 'а' is Cyrillic: type 'A3' in Latin letters"),
        ('"gost"', '"GOST"', "did you mean 'gost'?"),
        ('"gost"', '"ISO"', "did you mean 'iso'?"),
        ('"gost"', '"ГОСТ"', "did you mean 'gost'?"),
        ('"cw"', '"CCW"', "did you mean 'ccw'?"),
        ('"cw"', '"сw"', "its letter 'с' is Cyrillic: type 'cw' in Latin letters"),
        ('kind = "translating"', 'kind = "Translating"', "did you mean 'translating'?"),
        ('language = "en"', 'language = "RU"', "did you mean 'ru'?"),
    ],
)
def test_letters_of_another_case_or_alphabet_are_named(before, after, remedy, tmp_path):
    assert refusal(tmp_path, before, after).remedy == remedy


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("offset = -10", 'offset = "auto"'),
        (ROLLER, 'roller_radius = "auto"'),
        ("[limits]", '[cam]\nprime_radius = "auto"\n[limits]'),
    ],
)
def test_a_size_that_is_to_be_found_is_left_out(before, after, tmp_path):
    error = refusal(tmp_path, before, after)
    assert error.expected == LENGTH
    assert error.remedy == "or leave it out to let it be found"


def test_a_key_for_force_closure_says_how_it_is_asked_for(tmp_path):
    error = refusal(tmp_path, "[limits]", '[limits]\nclosure = "force"')
    assert error.field == "limits.closure"
    assert error.remedy == "leave out limits.pressure_angle_return for force closure, give it for form closure"
    # As the task without the limit is: the return does not limit the radius.
    assert gc.builtin_task().limits().return_ is None


SUM = "graphcam takes the prime radius, of the pitch curve: prime_radius = base_radius"


@pytest.mark.parametrize(
    ("roller", "remedy"),
    [
        ("roller_radius = 15", f"{SUM} + roller_radius = 95"),
        ("roller_radius = 15.5", f"{SUM} + roller_radius = 95.5"),
        ("roller_radius = 0", SUM),
        (ROLLER, f"{SUM} + roller_radius"),
    ],
)
def test_the_base_radius_leads_to_the_prime_radius(roller, remedy, tmp_path):
    added = ("[limits]", "[cam]\nbase_radius = 80\n[limits]")
    assert refusal(tmp_path, ROLLER, roller, added).remedy == remedy


def test_the_sum_is_that_of_the_cam():
    """A cam of that prime radius and roller has the base radius that was asked for."""
    motion = gc.builtin_task().motion()
    cam = gc.Cam(motion, gc.Translating(offset=0, roller_radius=15), prime_radius=95, rotation="cw")
    assert abs(complex(*cam.profile(0.0))) == pytest.approx(80)


def test_of_a_flat_face_the_base_radius_is_the_prime_radius(tmp_path):
    path = tmp_path / "q.toml"
    path.write_text(builtin_text("flat") + "\n[cam]\nbase_radius = 80\n", encoding="utf-8")
    with pytest.raises(TaskError) as caught:
        load_task(path)
    assert caught.value.remedy == SUM


def test_what_is_said_of_the_offset_and_the_rotation_is_true():
    motion = gc.builtin_task().motion()
    assert 'greater than 0 lowers the pressure angle of the rise with "ccw"' in _of_rotation()

    def greatest(rotation: str, offset: float) -> float:
        cam = gc.Cam(motion, gc.Translating(offset=offset), prime_radius=50, rotation=rotation)
        return cam.extremes().pressure_angle_rise[0]

    assert greatest("ccw", 10) < greatest("ccw", -10)
    assert greatest("cw", -10) < greatest("cw", 10)


def _of_rotation() -> str:
    from graphcam.tasks.task_remedies import missing_remedy

    return str(missing_remedy("rotation", {"follower": {"kind": "translating"}}))


@pytest.mark.parametrize(
    ("before", "after", "remedy"),
    [
        (LAST, "", '175 deg are missing: add { kind = "dwell", angle = 175 } at the end, or lengthen a dwell'),
        ("angle = 175", "angle = 170", "5 deg are missing: lengthen a dwell"),
        ("angle = 175", "angle = 180.5", "5.5 deg are too many: shorten a dwell"),
        (
            '  { kind = "dwell", angle = 45 },\n', "",
            "45 deg are missing: lengthen a dwell",
        ),
    ],
)  # fmt: skip
def test_missing_degrees_are_given_to_a_dwell_that_is_there(before, after, remedy, tmp_path):
    assert refusal(tmp_path, before, after).remedy == remedy


def test_without_any_dwell_one_is_added_or_a_phase_lengthened(tmp_path):
    error = refusal(tmp_path, LAST, "", ('  { kind = "dwell", angle = 45 },\n', ""))
    assert error.remedy == '220 deg are missing: add { kind = "dwell", angle = 220 } at the end, or lengthen a phase'


def test_what_does_not_fit_the_sheet_is_told_with_its_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = TASK.replace("ordinate = 50", "ordinate = 400")
    Path("q.toml").write_text(text, encoding="utf-8")
    refused = CliRunner().invoke(app, ["solve", "q.toml", "--out", "out"], env={"LANGUAGE": "en"})
    said = refused.stderr.splitlines()[-1]
    assert said.startswith("graphcam: q.toml: drawing.ordinate is 400 mm, but must be at most ")
    assert said.endswith(" mm on A1 landscape; take larger poles or a larger format, or leave it out")
    Path("q.toml").write_text(text.replace('language = "en"', 'language = "ru"'), encoding="utf-8")
    refused = CliRunner().invoke(app, ["solve", "q.toml", "--out", "out"], env={"LANGUAGE": "en"})
    said = refused.stderr.splitlines()[-1]
    assert re.fullmatch(
        r"graphcam: q\.toml: drawing\.ordinate: 400 мм, а должно быть: не больше \S+ мм на листе A1 \(горизонтально\); "
        r"возьмите полюсные расстояния больше или больший формат, или не указывайте",
        said,
    )
    assert not Path("out").exists()


def test_a_wrong_choice_of_the_command_is_no_fault_of_the_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("q.toml").write_text(TASK, encoding="utf-8")
    refused = CliRunner().invoke(app, ["solve", "q.toml", "--out", "out", "--dxf", "nix"], env={"LANGUAGE": "en"})
    assert refused.stderr.splitlines()[-1].startswith("graphcam: --dxf is 'nix', but must be one of ")
