"""The roller radius by the rule of the school, laid off beside the least radius of curvature."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from graphcam.constructions.curvature import Curved, detail_of
from graphcam.constructions.views import PROFILE
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, calculated_setting, distance_between
from graphcam.drafting.ink import Caption, Construction, Part, Step, View, Words, say
from graphcam.drafting.marks import Mark, Role
from graphcam.drafting.meaning import R0, RHO, ComparedReading, Formula, Meaning, ReadingMeaning, Symbol, Values
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.telling import introduced_parts
from graphcam.given.laws import Floats
from graphcam.given.roller_rule import Candidate
from graphcam.words import sequence


@dataclass(frozen=True, eq=False)
class RollerGivens:
    """What lies on the board; see :func:`roller_radius`."""

    curved: Curved
    rule: tuple[Candidate, ...]
    given: float | None


Rolled = Construction[RollerGivens]


def _terms(rolled: Construction[RollerGivens]) -> list[Caption]:
    givens = rolled.givens
    return [say("given")] if givens.given is not None else [term.formula_caption for term in givens.rule]


def _by_rule(rolled: Construction[RollerGivens]) -> Values:
    """The formula's values: the rule's terms and the radius by each, where the task does not give the radius."""
    if rolled.givens.given is None:
        radii = [say("{radius:.2f}", radius=r) for r in rolled.value("candidates").tolist() if np.isfinite(r)]
        terms = sequence([_in_tex(term) for term in rolled.givens.rule], r";\ ")
        yield {"terms": terms, "radii": sequence(radii, r";\ "), "r": float(rolled.value("roller_radius"))}


def _in_tex(term: Candidate) -> Caption:
    of = r"\,\rho" if term.of == "rho" else r"\,r_0"
    less = [say(" - {margin:g}", margin=term.margin)] if term.margin else []
    return sequence([*([] if less else [say("{factor:g}", factor=term.factor)]), of, *less], "")


FORMULAS = (
    Formula(
        r"r \le \min(<terms>)",
        r"r \le \min(<radii>) = <r:.2f>\ \text{<mm>}",
        _by_rule,
        (Symbol("r", say("the roller radius"), "mm"), RHO, R0),
        of="roller_radius",
    ),
)


MEANING = Meaning(
    "roller",
    say("Roller radius"),
    say("The roller radius must be smaller than the minimum radius of curvature; it is chosen by a rule."),
    {
        "candidates": ReadingMeaning(say("proposals"), "r", "mm", over=_terms, judged="least"),
        "roller_radius": ReadingMeaning(
            say("roller radius r"),
            "r",
            "mm",
            (ComparedReading("roller_radius", say("proposed roller radius"), "candidates"),),
        ),
    },
    FORMULAS,
)


def roller_radius(curved: Curved, rule: tuple[Candidate, ...], given: float | None, pencil: Pencil) -> Rolled:
    """The roller radius that the rule proposes from the minimum radius of curvature and the prime radius: the smallest.

    given : the roller radius [mm] where the task gives one, which is then taken, or None
    """
    hand, inverted = Hand(pencil, MEANING), curved.givens.inverted
    mu_l, centre = inverted.givens.mu_l.per_mm, hand.given("cam centre")
    if given is None:
        prime_radius = distance_between(centre, hand.earlier_places(inverted, "starts")[0])
        proposed = calculated_setting(partial(_proposed, rule, mu_l), hand.carry(curved.readings["rho"]), prime_radius)
    else:
        proposed = calculated_setting(np.atleast_1d, hand.at_scale(given, inverted.readings["radius"]))
    # The compass is set to each; where nothing is convex there is nothing to set it to.
    set_to, own = (
        hand.lay_off("roller", centre, RIGHT, calculated_setting(_finite, proposed)),
        proposed.amount.shape[-1],
    )
    which = np.where(np.isinf(proposed.amount), own, np.arange(own))
    laid_off = hand.take("proposals", set_to, hand.given("far away", [np.inf]), which=which)
    candidates = distance_between(centre, laid_off, RIGHT)
    hand.read("candidates", candidates, mu_l, rounded=False)
    # Where no bend is readable, rho limits nothing.
    hand.read("roller_radius", calculated_setting(partial(np.fmin.reduce, axis=-1), candidates), mu_l, rounded=False)
    return hand.finished(RollerGivens(curved, rule, given), _draw, {})


def _proposed(rule: tuple[Candidate, ...], mu_l: float, rho: Floats, prime_radius: Floats) -> Floats:
    """The radius by each term of the rule, (..., k), all on paper."""
    return np.stack([t.factor * (rho if t.of == "rho" else prime_radius) - t.margin / mu_l for t in rule], axis=-1)


def _finite(radii: Floats) -> Floats:
    """The radii, 0 in place of what is infinite."""
    return np.where(np.isinf(radii), 0.0, radii)


# --- the steps -------------------------------------------------------------------------------------------------------

MAX_PROPOSAL_FACTOR = 1.5
"""A proposal is shown on OB, if it is not longer than so many times OB."""


def _draw(rolled: Rolled) -> list[Step]:
    rule, given, candidates = rolled.givens.rule, rolled.givens.given, rolled.value("candidates")
    taken, rho = float(rolled.value("roller_radius")), float(rolled.givens.curved.value("rho"))
    r0 = rolled.givens.curved.givens.inverted.givens.prime_radius
    if given is None:
        terms = [_proposal(term, radius) for term, radius in zip(rule, candidates, strict=True)]
        known = say("r₀ = {r0:g} mm", r0=r0)
        if np.isfinite(rho):
            known = say("ρ = {rho:.2f} mm and r₀ = {r0:g} mm", rho=rho, r0=r0)
        caption = say("With {known} the rule proposes {proposed}; take the smallest, {taken:.2f} mm.")
        caption = caption.with_values(known=known, proposed=sequence(terms), taken=taken)
        if rule and rule[0].source:
            caption = sequence([caption, say("Source of the rule: {source}.", source=rule[0].source)], " ")
    elif given:
        caption = say("The task gives a roller of {taken:g} mm; the rule is not applied.", taken=taken)
        caption = sequence([caption, _beside_rho(taken, rho)], " ") if np.isfinite(rho) else caption
    else:
        caption = say("The task gives a knife edge, which has no roller; the rule is not applied.")
    why = say(
        "Where the pitch curve has the radius ρ the working profile has ρ − r: a roller larger than ρ would "
        "cut the cam away."
    )
    names = [term.formula_caption for term in rule] if given is None else ["r"]
    view, marks, parts = laid_off_on_ob(rolled, names, candidates)
    return [
        Step(
            say("Roller radius"),
            introduced_parts(caption, parts),
            view,
            marks,
            ("candidates", "roller_radius"),
            why=why,
        )
    ]


def _proposal(term: Candidate, radius: float) -> Caption:
    if np.isfinite(radius):
        return say("{term} = {radius:.2f} mm", term=term.formula_caption, radius=radius)
    return say("{term}, which cannot be read", term=term.formula_caption)


def _beside_rho(radius: float, rho: float) -> Caption:
    """A sentence on what a roller leaves of the minimum radius of curvature."""
    if radius < rho:
        return say("It leaves ρ − r = {left:.2f} mm at B.", left=rho - radius)
    return say("It is not smaller than ρ = {rho:.2f} mm: the profile is undercut at B.", rho=rho)


def laid_off_on_ob(
    rolled: Rolled, names: Sequence[Words], radii: Floats
) -> tuple[View, tuple[Mark, ...], tuple[Part, ...]]:
    """The view, marks and parts of radii [mm] laid off from B towards the centre of curvature, where it is known."""
    detail = detail_of(rolled.givens.curved)
    if detail is None:
        return PROFILE, (), ()
    b, hub, marks, parts = detail.triple[1], detail.hub, list[Mark](), list[Part]()
    ob = detail.hand.join("OB", b, hub)
    for name, radius in zip(names, radii.tolist(), strict=True):
        paper = radius / detail.per_mm
        if not 0 < paper <= MAX_PROPOSAL_FACTOR * abs(hub.place):  # nor where there is none
            continue
        end = detail.hand.lay_off("roller beside OB", b, ob, paper)
        label = say("{name} = {radius:.4g}", name=name, radius=radius)
        # What is taken stands on the other side of OB than what the terms of the rule propose.
        marks += [end.dots(Role.CONSTRUCTION), end.label(label, (UP if name == "r" else -UP) * hub.place)]
        said = say("Lay off {name} = {radius:.2f} mm from B towards O: {paper:.1f} mm.")
        parts.append(Part(said.with_values(name=name, radius=radius, paper=paper), (end,)))
    return detail.view, tuple(marks), tuple(parts)
