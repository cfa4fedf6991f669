"""Marking: right work is right, one slip costs its own step, a mistake is named, the key stays with the teacher."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st
from issued_variants import SECRET, issued, key, marked, outcomes

from graphcam.constructions.profile_view import piecewise_curve
from graphcam.drafting.pencil import Pencil
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import Answers
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.definition.student_hands import HandTable
from graphcam.exercises.definition.variant import drawn
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.answer_scatter import answers_of
from graphcam.exercises.key.expected_answers import distance_from_drawn
from graphcam.exercises.key.key_making import issue
from graphcam.exercises.marking.marking import mark

NAMES = ("acceleration-and-scales", "pressure-angle", "least-radius", "inversion-translating")


@pytest.mark.parametrize("name", NAMES)
def test_the_key_is_right_and_too_exact_to_be_drawn(name):
    record = marked(name)
    assert record.total == record.of
    assert set(outcomes(record).values()) == {"right"}
    assert record.diagnosis is None
    assert record.too_exact


def test_a_careful_hand_is_not_too_exact():
    exercise, answer_key = issued("pressure-angle")
    answers = {name: k.expected.value + 0.8 * k.expected.scatter for name, k in answer_key.keys.items()}
    record = mark(exercise, answer_key, Answers(answers))
    assert record.total == record.of
    assert not record.too_exact


@pytest.mark.parametrize("name", NAMES)
def test_the_tolerance_is_the_edge(name):
    exercise, answer_key = issued(name)
    for asked in exercise.answers:
        if asked.kind != "number":
            continue
        value, tolerance = answer_key.keys[asked.name].expected.value, answer_key.keys[asked.name].tolerance
        for side in (-1, 1):
            inside = marked(name, **{asked.name: value + side * 0.99 * tolerance})
            outside = marked(name, **{asked.name: value + side * 1.01 * tolerance})
            assert outcomes(inside)[asked.name] == "right"
            assert outcomes(outside)[asked.name] == "wrong"


def test_the_scatter_is_that_of_the_pencil():
    # The certificate's own random numbers are not those of a plain pencil; the scatter of two thousand hands is.
    hand = HandTable(line=0.2, dividers=0.2, division=0.5, protractor_deg=0.5, stretch=0.0)
    exercise = replace(find_exercise("acceleration-and-scales"), hand=hand)
    variant, answer_key = issue(exercise, "Anna", SECRET)
    task = variant.task
    pencil = Pencil(0.2, 0.2, 0.5, math.radians(0.5), samples=2000, seed=9)
    s = board_chain(task, pencil).integration.readings["s"].paper[:, 12]
    key = answer_key.keys["s_max"]
    assert key.expected.scatter == pytest.approx(np.std(s), rel=0.1)
    assert key.tolerance == pytest.approx(answer_key.bound * np.std(s), rel=0.1)
    assert key.tolerance_paper == key.tolerance


def test_one_slip_costs_its_own_step_only():
    # The lift divided by a wrong ordinate, and everything after that done right with it: independent of how the
    # construction is drawn again, mu_v = mu_s/(mu_phi H2) and mu_a = mu_v/(mu_phi H1).
    _, answer_key = issued("acceleration-and-scales")
    task = drawn(issued("acceleration-and-scales")[0], "Anna", SECRET, answer_key.draw).task
    own = 1.3 * answer_key.keys["mu_s"].expected.value
    mu_phi, (first, second) = math.radians(1), task.drawing.poles
    mu_v = own / (mu_phi * second)
    mu_a = mu_v / (mu_phi * first)
    v_max = answer_key.keys["v_max"].expected.value * 1.3
    record = marked("acceleration-and-scales", mu_s=own, mu_v=mu_v, mu_a=mu_a, v_max=v_max)
    found = outcomes(record)
    assert found["mu_s"] == "wrong"
    assert {found[name] for name in ("mu_v", "mu_a", "v_max")} == {"follow-through"}
    lost = next(asked.marks for asked in issued("acceleration-and-scales")[0].answers if asked.name == "mu_s")
    assert record.total == record.of - lost
    # And the check can fail: the later answers as they follow from the right scale are right, not follow-through;
    # as they follow from another wrong one they are wrong.
    assert outcomes(marked("acceleration-and-scales", mu_s=own))["mu_v"] == "right"
    assert outcomes(marked("acceleration-and-scales", mu_s=own, mu_v=0.5 * mu_v))["mu_v"] == "wrong"


def test_follow_through_draws_again_where_no_formula_is_linear():
    # tan(alpha) = (v - sigma e)/(s0 + s), from the student's own v.
    exercise, answer_key = issued("pressure-angle")
    variant = drawn(exercise, "Anna", SECRET, answer_key.draw)
    task, right = variant.task, key(answer_key)
    sigma = 1 if task.rotation == "ccw" else -1
    e, r0 = task.follower.offset, task.cam.prime_radius
    s = board_chain(task).integration.value("s")[4]
    for factor in (0.75, 1.25, 1.6):
        v = factor * right["v_4"]
        alpha = math.degrees(math.atan2(v - sigma * e, math.sqrt(r0**2 - e**2) + s))
        found = outcomes(marked("pressure-angle", v_4=v, D_4=factor * right["D_4"], alpha_4=alpha))
        assert found["v_4"] == "wrong"
        assert found["D_4"] == "follow-through"
        assert found["alpha_4"] == "follow-through"


@pytest.mark.parametrize("name", NAMES)
def test_nothing_follows_from_nought(name):
    """From a scale of nought every later value is nought, which nobody needs to draw."""
    exercise, answer_key = issued(name)
    numbers = {asked.name: answer_key.keys[asked.name].expected for asked in exercise.answers if asked.kind == "number"}
    for small in (0.0, -0.0, 1e-9, -1e-6, 1e-3):
        record = mark(exercise, answer_key, Answers(dict.fromkeys(numbers, small)))
        # But for what is nought itself within its tolerance.
        earned = {answer.name for answer in record.answers if answer.marks}
        assert earned <= {key for key, one in numbers.items() if abs(one.value) <= answer_key.bound * one.scatter}


def test_the_tolerance_of_an_angle_does_not_grow_with_it():
    # An angle that follows from the own v and is several times the right one is not so much more uncertain.
    answer_key = issued("pressure-angle")[1]
    right = key(answer_key)
    own = {"v_4": 3.0 * right["v_4"], "D_4": 3.0 * right["D_4"]}
    dependence = answer_key.dependences["alpha_4"]
    # D follows from v.
    alpha = dependence.expected(right["alpha_4"], own | {"D_4": right["D_4"]})
    tolerance = answer_key.bound * min(dependence.scatter, float(answer_key.keys["alpha_4"].expected.scatter))
    assert abs(alpha) > 4 * abs(right["alpha_4"])
    assert outcomes(marked("pressure-angle", **own, alpha_4=alpha + 0.9 * tolerance))["alpha_4"] == "follow-through"
    assert outcomes(marked("pressure-angle", **own, alpha_4=alpha + 1.5 * tolerance))["alpha_4"] == "wrong"


def test_a_slip_beside_a_mistake_is_not_excused_by_it():
    # What the mistake leaves right is a slip of its own where it is wrong, also when it is not far off.
    exercise, answer_key = issued("pressure-angle")
    at = [asked.name for asked in exercise.answers].index("alpha_8")
    mistaken = answer_key.hypotheses["offset-sign"]
    answers = {asked.name: each.value for asked, each in zip(exercise.answers, mistaken, strict=True)}
    slip = mistaken[at].value + 1.5 * answer_key.bound * mistaken[at].scatter
    found = outcomes(mark(exercise, answer_key, Answers(answers)))
    assert found["alpha_8"] == "follow-through"
    assert outcomes(mark(exercise, answer_key, Answers(answers | {"alpha_8": slip})))["alpha_8"] == "wrong"


@pytest.mark.parametrize("name", NAMES)
def test_every_mistake_is_named_and_costs_something(name):
    exercise, answer_key = issued(name)
    for mistake, values in answer_key.hypotheses.items():
        answers = {asked.name: each.value for asked, each in zip(exercise.answers, values, strict=True)}
        record = mark(exercise, answer_key, Answers(answers))
        assert record.diagnosis is not None
        together = {record.diagnosis.misconception, *record.diagnosis.alike}
        assert together == {mistake} | answer_key.inseparable_from(mistake)
        assert record.diagnosis.confidence * len(together) > 0.95
        assert record.total < record.of
        assert str(misconception(mistake).said) in record.feedback


def test_mistakes_that_the_answers_do_not_tell_are_both_named():
    exercise, answer_key = issued("pressure-angle")
    # Only the angle is given: both mistakes mirror the offset, and give the same angle.
    values = answer_key.hypotheses["offset-sign"]
    at = [asked.name for asked in exercise.answers].index("alpha_4")
    record = mark(exercise, answer_key, Answers({"alpha_4": values[at].value}))
    assert record.diagnosis is not None
    named = {record.diagnosis.misconception, *record.diagnosis.alike}
    assert named >= {"offset-sign", "rotation-sense"}


@pytest.mark.parametrize("name", NAMES)
def test_feedback_never_discloses_the_key(name):
    exercise, answer_key = issued(name)
    records = [mark(exercise, answer_key, Answers({}))]
    for values in answer_key.hypotheses.values():
        answers = {asked.name: each.value for asked, each in zip(exercise.answers, values, strict=True)}
        records.append(mark(exercise, answer_key, Answers(answers)))
    answers = {n: 3 * k.expected.value + 7 for n, k in answer_key.keys.items()}
    records.append(mark(exercise, answer_key, Answers(answers)))
    numbers = {
        f"{abs(k.expected.value):.{decimals}f}"
        for k in answer_key.keys.values() if not isinstance(k.expected.value, np.ndarray) for decimals in range(1, 5)
    }  # fmt: skip
    text = " ".join(sentence for record in records for sentence in record.feedback)
    # Marks are no secret, and may happen to be written as a key is.
    text = re.sub(r"earns (at most )?[\d.]+ of [\d.]+ marks", "", text)
    assert not numbers & set(re.findall(r"\d+[.,]\d+", text))
    # No number at all, but those in the names of answers, a right angle, and the number of a point.
    for asked in exercise.answers:
        text = text.replace(asked.name, "")
    assert set(re.findall(r"(?<!point )\b\d+(?:\.\d+)?", text)) <= {"90"}


HOSTILE = [
    float("nan"), float("inf"), -float("inf"), 1e999, 10**400, -(10**30), True, None, "12", b"12", [], [1, 2], {}, 1j,
    np.array([]), np.array([np.nan + 0j]), np.zeros((2, 2)), np.array(["x"]),
]  # fmt: skip


@pytest.mark.parametrize("value", HOSTILE, ids=repr)
def test_whatever_is_handed_in_gives_one_record_and_no_marks(value):
    exercise, answer_key = issued("inversion-translating")
    record = mark(exercise, answer_key, Answers({asked.name: value for asked in exercise.answers}))
    assert record.total == 0
    assert {answer.outcome for answer in record.answers} <= {"unreadable", "wrong", "missing"}
    json.dumps(record.to_dict(), allow_nan=False)


def test_what_could_not_be_read_is_said():
    exercise, answer_key = issued("integration")
    record = mark(exercise, answer_key, Answers({}, {"s_5": "The line holds no number."}))
    assert outcomes(record)["s_5"] == "unreadable"
    assert outcomes(record)["mu_v"] == "missing"
    assert any("The line holds no number." in sentence for sentence in record.feedback)


def test_a_stored_certificate_marks_the_same():
    exercise, answer_key = issued("inversion-translating")
    stored = AnswerKey.from_json(answer_key.to_json())
    assert stored.to_json() == answer_key.to_json()
    task = drawn(exercise, "Anna", SECRET, answer_key.draw).task
    chain = board_chain(task, exercise.hand.pencil(20, seed=5))
    hands = answers_of(exercise, misconception("offset-sign").change(chain))
    for row in range(20):
        answers = Answers(
            {
                a.name: v[row] if a.kind == "curve" else float(v[row])
                for a, v in zip(exercise.answers, hands, strict=True)
            }
        )
        assert mark(exercise, stored, answers) == mark(exercise, answer_key, answers)


def test_issuing_again_gives_the_same_certificate():
    exercise, answer_key = issued("integration")
    assert issue(exercise, "Anna", SECRET)[1].to_json() == answer_key.to_json()


def test_a_curve_is_marked_by_its_distance_and_shows_the_worst_place():
    pitch = issued("inversion-translating")[1].keys["pitch"].expected.value
    # More points on the same curve change nothing.
    dense = np.interp(np.arange(0, pitch.size - 0.5, 0.5), np.arange(pitch.size), pitch)
    assert outcomes(marked("inversion-translating", pitch=dense))["pitch"] == "right"
    bent = pitch.copy()
    bent[7] *= 1.1
    record = marked("inversion-translating", pitch=bent)
    answer = next(each for each in record.answers if each.name == "pitch")
    assert answer.outcome == "partial"
    assert answer.station == 7
    assert answer.given == [[z.real, z.imag] for z in bent]
    assert answer.off_paper == pytest.approx(0.1 * abs(pitch[7]), rel=0.5)


def test_a_curve_without_its_dwells_earns_the_part_that_is_drawn():
    # The stations of the moving phases, joined by chords: those across the dwells lie far off the arcs.
    exercise, answer_key = issued("inversion-translating")
    chain = board_chain(drawn(exercise, "Anna", SECRET, answer_key.draw).task)
    chords, whole = chain.inversion.points["pitch"], key(answer_key)["pitch"]
    record = marked("inversion-translating", pitch=chords)
    pitch = next(each for each in record.answers if each.name == "pitch")
    assert pitch.outcome == "partial"
    assert pitch.off_paper > 20
    # Of the true curve as much is there as does not belong to a dwell.
    stations = chain.board.stations
    inside = np.delete(np.abs(np.diff(chords)), stations.last[:-1]).sum()
    share = inside / np.abs(np.diff(np.append(whole, whole[0]))).sum()
    assert 0 <= 4 * share - pitch.marks < 0.1
    # And every place on a dwell's arc is looked at: one arc alone missing is a loss as well.
    arc = np.flatnonzero(np.isin(whole, chords))[stations.last[0]]
    assert (
        outcomes(marked("inversion-translating", pitch=np.delete(whole, slice(arc + 1, arc + 5))))["pitch"] == "partial"
    )


def test_an_open_curve_earns_the_part_that_is_drawn():
    whole = key(issued("inversion-translating")[1])["pitch"]
    length = np.abs(np.diff(np.append(whole, whole[0])))
    for count in (20, 25, 30):
        record = marked("inversion-translating", pitch=whole[:count])
        pitch = next(each for each in record.answers if each.name == "pitch")
        assert pitch.outcome == "partial"
        assert 0 <= 4 * length[: count - 1].sum() / length.sum() - pitch.marks < 0.1
    # Less than half earns nothing: with the offset to the wrong side the dwells lie on the right circles as well.
    assert outcomes(marked("inversion-translating", pitch=whole[:10]))["pitch"] == "wrong"


def drawn_curves() -> dict[str, tuple[np.ndarray, str]]:
    """Ways to draw the pitch curve of the variant, each with what it is worth."""
    exercise, answer_key = issued("inversion-translating")
    chain = board_chain(drawn(exercise, "Anna", SECRET, answer_key.draw).task)
    points, smooth = (
        key(answer_key)["pitch"],
        piecewise_curve("pitch curve", chain.inversion, chain.inversion.acts["pitch"]).whole.points,
    )
    closed = np.append(smooth, smooth[0])
    out_and_back = np.concatenate([smooth[:60], [smooth[59] * 1.15], smooth[60:]])
    # Through every station in another order, so that only the way between them is wrong.
    scribble = np.concatenate([points[::2], points[1::2], points[::5], points])
    across = np.append(points, [1.5j * points[0], points[3]])
    half = 3 * len(points) // 5
    return {
        "points joined by chords": (points, "right"),
        "closed by a chord": (np.append(points, points[0]), "right"),
        "a smooth curve, closed": (closed, "right"),
        "drawn backwards": (closed[::-1], "right"),
        "drawn twice": (np.concatenate([closed, closed]), "right"),
        "begun elsewhere": (np.roll(smooth, 50), "right"),
        "scribbled through everything": (scribble, "partial"),
        "a line ruled back and forth over the sheet": (zigzag(1.3 * float(np.abs(points).max()), 0.5), "wrong"),
        "one spike": (out_and_back, "partial"),
        "a line drawn across": (across, "partial"),
        "a dwell bulging out": (np.concatenate([smooth, 1.2 * dwell(smooth, points)]), "partial"),
        "half of it": (points[:half], "partial"),
        "a single point": (points[:1], "wrong"),
        "one point many times": (np.repeat(points[:1], 30), "wrong"),
        "as far as numbers go": (np.append(points, 1e15 + 0j), "wrong"),
    }


def zigzag(reach: float, apart: float) -> np.ndarray:
    heights = np.arange(-reach, reach, apart)
    ends = np.tile([-reach, reach, reach, -reach], heights.size // 2 + 1)[: 2 * heights.size]
    return ends + 1j * np.repeat(heights, 2)


def dwell(smooth: np.ndarray, points: np.ndarray) -> np.ndarray:
    """The arc from the last station back to the first."""
    return smooth[int(np.argmin(np.abs(smooth - points[-1]))) :]


def test_a_curve_is_right_only_if_all_of_it_is():
    for way, (curve, worth) in drawn_curves().items():
        assert outcomes(marked("inversion-translating", pitch=curve))["pitch"] == worth, way


def test_a_scribble_is_nobodys_mistake_either():
    # What a mistake brings earns its marks as follow-through; a line over all of the sheet passes near that as well.
    exercise, answer_key = issued("inversion-translating")
    scribble = drawn_curves()["a line ruled back and forth over the sheet"][0]
    for values in answer_key.hypotheses.values():
        answers = {asked.name: each.value for asked, each in zip(exercise.answers, values, strict=True)}
        record = mark(exercise, answer_key, Answers(answers | {"pitch": scribble}))
        assert outcomes(record)["pitch"] == "wrong"
        assert outcomes(mark(exercise, answer_key, Answers(answers)))["pitch"] in ("right", "follow-through")


def test_the_place_of_an_excursion_is_said():
    spike = drawn_curves()["one spike"][0]
    pitch = key(issued("inversion-translating")[1])["pitch"]
    record = marked("inversion-translating", pitch=spike)
    answer = next(each for each in record.answers if each.name == "pitch")
    assert answer.off_paper == pytest.approx(0.15 * abs(spike[59]), rel=0.1)
    assert abs(pitch[answer.station] - spike[59]) < 2 * np.abs(np.diff(pitch)).max()


@given(st.floats(0.05, 6.2), st.floats(0.2, 3.0), st.floats(0, 2 * math.pi))
def test_the_distance_from_an_arc_is_that_from_its_circle(angle, far, direction):
    # Two stations on the unit circle, counter-clockwise: outside the arc the nearest place is on the ray to the centre.
    stations = 50 * np.exp(1j * np.array([0.0, angle]))
    place = 50 * (1 + far) * np.exp(1j * angle * direction / (2 * math.pi))
    distance, _ = distance_from_drawn(np.array([place]), stations, np.array([math.tan(angle / 4)]))
    assert distance[0] == pytest.approx(50 * far, rel=1e-6)
    # Between chord and arc nothing is wrong.
    inside = (stations.mean() + 50 * np.exp(1j * angle / 2)) / 2
    assert distance_from_drawn(np.array([inside]), stations, np.array([math.tan(angle / 4)]))[0][0] == 0


PLACES = st.complex_numbers(max_magnitude=100, allow_nan=False)


@given(
    st.lists(PLACES, min_size=3, max_size=8), st.lists(st.floats(-3, 3), min_size=8, max_size=8), PLACES, st.booleans()
)
def test_the_distance_from_a_curve_is_that_from_its_nearest_part(stations, bulges, place, closed):
    # Also where the stations lie anyhow and the arcs are greater than half a turn.
    parts = len(stations) - (not closed)
    around, bulge, at = np.array([*stations, stations[0]]), np.array(bulges[:parts]), np.array([place])
    alone = [distance_from_drawn(at, around[k : k + 2], bulge[k : k + 1])[0][0] for k in range(parts)]
    distance, part = distance_from_drawn(at, np.array(stations), bulge)
    assert distance[0] == pytest.approx(min(alone), abs=1e-9)
    assert alone[part[0]] == pytest.approx(min(alone), abs=1e-9)
