"""What a construction says of itself is all that its consumers go by: a toy in one file, added in one line.

The toy lies in this file alone: no room of graphcam knows its name.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import pytest
from over_all import fast_first
from replay import followed

import graphcam as gc
from graphcam.bench.bench_followers import scene
from graphcam.bench.convergence import series_of
from graphcam.drafting.euclid import RIGHT
from graphcam.drafting.hand import Hand, distance_between
from graphcam.drafting.ink import Construction, Part, Step, View, say
from graphcam.drafting.marks import Role
from graphcam.drafting.meaning import ComparedReading, Meaning, ReadingConvergence, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.errors import DesignError
from graphcam.exercises.definition.drawn_answers import drawn_answer, per_mm, with_own_answers
from graphcam.exercises.definition.exercise import AskedAnswer
from graphcam.notebooks.notebook_folder import notebook_of
from graphcam.report.documents import contents_of, drawing_of, note_of, sheet_of
from graphcam.report.note import comparison_file
from graphcam.report.step_player import player_of, slides
from graphcam.sheets.model import Text

# --- the toy ---------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class ToyGivens:
    """A drawing from which the greatest velocity was read."""

    source: Construction


MEANING = Meaning(
    "toy",
    say("The toy's chapter"),
    say("The greatest velocity is carried over once more, because this is a toy."),
    {
        "length": ReadingMeaning(
            say("the toy's length"),
            "t",
            "lift/rad",
            (ComparedReading("toy_length", say("length of the toy"), exact="max_v"),),
            ReadingConvergence("length of the toy", "max_v"),
        )
    },
)
VIEW = View("toy", say("A line for the toy"), across="toy x", up="toy y")


def toy(source: Construction, pencil: Pencil) -> Construction[ToyGivens]:
    """Carry the greatest velocity over to a level line with dividers, and read it."""
    hand, origin = Hand(pencil, MEANING, source.readings["max_v"].unit.partition("/")[0]), 0j
    start = hand.given("start", origin)
    end = hand.lay_off("end", start, RIGHT, hand.carry(source.readings["max_v"]))
    hand.read("length", distance_between(start, end), source.readings["max_v"].scale)
    return hand.finished(ToyGivens(source), draw, {"end": end})


def draw(drawn: Construction[ToyGivens]) -> list[Step]:
    """One step."""
    said = say("The dividers are set to {mm:.2f} mm.", mm=float(drawn.first("length")))
    line = drawn.acts["end"].line_from(0j, Role.RESULT)
    return [Step(say("The toy's step"), (Part(said),), VIEW, (line,), reads=("length",))]


# --- added in one line -----------------------------------------------------------------------------------------------

SOURCES = {"coursework": "integration", "arcs": "arc_diagrams", "arm": "integration", "flat": "integration"}


@pytest.fixture(scope="module", params=fast_first(SOURCES, 2))
def solution(request):
    task = gc.builtin_arcs_task() if request.param == "arcs" else gc.builtin_task(request.param)
    solved, source = gc.solve(task), SOURCES[request.param]
    return replace(solved, chain=solved.chain.adding(MEANING, lambda chain: toy(chain[source], chain.pencil)))


def test_it_is_drawn_last_and_once(solution):
    assert list(solution.drawn)[-1] == "toy"
    assert solution.drawn["toy"] is solution.drawn["toy"]


def test_a_board_that_knows_its_acts_alone_lands_on_its_reading(solution):
    if "integration" in solution.drawn:  # the drawing of arcs is followed where it is drawn by acts itself
        (length,) = followed(solution.drawn["toy"])[0]["length"]
        assert length == pytest.approx(solution.drawn["toy"].readings["length"].paper, abs=1e-9)


def test_the_sheet_shows_it_and_may_end_with_it(solution):
    for sheet in (sheet_of(solution), sheet_of(solution, "toy")):
        told = [each.text for page in sheet.pages for group in page.groups for each in group.entities if is_text(each)]
        assert "A line for the toy" in told
    assert ("toy", "The toy's step") in [(name, str(step.title)) for _, name, step in contents_of(solution).steps]


def is_text(entity) -> bool:
    return isinstance(entity, Text)


def test_the_player_tells_it_with_its_reading(solution):
    contents = contents_of(solution)
    (slide,) = (slide for slide in slides(contents)[0] if slide.chapter == "The toy's chapter")
    assert (slide.title, slide.why) == ("The toy's step", str(MEANING.why))
    assert [reading.title for reading in slide.readings] == ["the toy's length"]
    assert str(MEANING.why) in player_of(contents, drawing_of(contents))


def test_the_note_has_a_chapter_on_it(solution):
    before, _, chapter = note_of(solution).partition(
        f". The toy's chapter\n\n{MEANING.why}\n\n**{len(solution.drawn)}.1. The toy's step.** The dividers are set to "
    )
    assert before.rstrip("0123456789").endswith("## ")
    assert "length of the toy" in chapter


def test_the_notebook_shows_its_steps(solution):
    cells = [cell.source for cell in notebook_of(solution).cells]
    at = cells.index(f"## {len(solution.drawn)}. The toy's chapter\n\n{MEANING.why}")
    assert cells[at + 1] == 'show_steps(solution.drawn["toy"], within=solution)'


def test_it_is_compared_with_its_exact_counterpart(solution):
    q, greatest = (solution.comparison.quantities[name] for name in ("toy_length", "max_v"))
    assert (q.exact, q.unit) == (greatest.exact, greatest.unit)
    assert q.drawn == pytest.approx(greatest.drawn, rel=1e-12)
    assert abs(q.error_paper) <= q.tolerance_paper
    assert "length of the toy" in comparison_file(solution)
    assert solution.to_dict()["quantities"]["toy_length"]["drawn"] == q.drawn


def test_a_hand_errs_in_it_and_the_bound_grows_with_the_hand(solution):
    hand = replace(solution, chain=replace(solution.chain, pencil=Pencil(dividers=0.2, seed=1)))
    q, perfect = (each.comparison.quantities["toy_length"] for each in (hand, solution))
    assert q.drawn != hand.comparison.quantities["max_v"].drawn
    assert q.tolerance_paper > perfect.tolerance_paper


def test_an_exercise_may_ask_for_it():
    chain = gc.solve(gc.builtin_task()).chain
    chain = chain.adding(MEANING, lambda chain: toy(chain.integration, chain.pencil))
    asked = AskedAnswer("t", "How long is the toy?", "toy", reading="length", unit="mm/rad")
    assert drawn_answer(chain, asked) == chain.integration.readings["max_v"].value
    assert per_mm(chain, asked) == chain.integration.readings["max_v"].per_mm
    gone_on = with_own_answers(chain, asked, drawn_answer(chain, asked) + 1)
    assert drawn_answer(gone_on, asked) == pytest.approx(drawn_answer(chain, asked) + 1, abs=1e-12)


def test_the_bench_follows_its_error_over_the_number_of_parts():
    where = scene("translating", "cycloidal")
    chains = {
        n: where.chain(n).adding(MEANING, lambda chain: toy(chain.integration, chain.pencil)) for n in (6, 12, 24)
    }
    found = {series.quantity: series for series in series_of(where, chains)}
    assert found["length of the toy"].construction == "toy"
    assert found["length of the toy"].errors == pytest.approx(found["maximum velocity"].errors, abs=1e-12)


# --- what is said wrongly is named -----------------------------------------------------------------------------------


def test_an_exact_counterpart_that_nobody_computes_is_refused_by_its_name():
    said = ComparedReading("toy_length", say("length of the toy"), exact="beauty")
    meaning = replace(MEANING, readings={"length": replace(MEANING.readings["length"], compared=(said,))})
    solved = gc.solve(gc.builtin_task())
    wrong = solved.chain.adding(meaning, lambda chain: replace(toy(chain.integration, chain.pencil), meaning=meaning))
    with pytest.raises(DesignError, match=r"exact counterpart is 'beauty', but must be one of max_v, max_a"):
        _ = replace(solved, chain=wrong).comparison.quantities
    assert math.isfinite(solved.comparison.quantities["max_v"].exact)
