from __future__ import annotations

import pytest
from over_all import over_all

from graphcam.errors import DesignError
from graphcam.given.roller_rule import DEFAULT_RULE, NAMED_RULES, roller_rule


@over_all(
    ("rule", "radii"),
    [  # at rho = 85.34, r0 = 134.8, the numbers of a printed coursework
        ("0.4 r0", [53.92]),
        ("0.65 rho", [55.471]),
        ("min(0.65 rho, 0.4 r0)", [55.471, 53.92]),
        ("rho - 4", [81.34]),
        (" min( 0.8 rho , rho-2.5,0.4*r0 ) ", [68.272, 82.84, 53.92]),
        (DEFAULT_RULE, [59.738, 53.92]),
    ],
)
def test_terms_of_a_rule_in_the_order_written(rule, radii):
    terms = roller_rule(rule)
    assert [term(rho=85.34, r0=134.8) for term in terms] == pytest.approx(radii)
    assert all(term.text in rule for term in terms)


@over_all(
    "rule", ["", "0.4", "rho", "0.4 r1", "-0.4 r0", "r0 - 3", "min()", "min(0.4 r0", "0.4 r0, 0.7 rho", "nan rho"]
)
def test_what_is_no_rule_is_named(rule):
    with pytest.raises(DesignError, match=r"roller rule is .*'K rho', 'K r0', 'rho - MM', min.* or the name of a rule"):
        roller_rule(rule)


NAMED = {  # at rho = 85.34, r0 = 134.8, the numbers of a printed coursework, which takes 53.92 of 55.47 and 53.92
    "coursework": [55.471, 53.92],
    "coursework-prime-radius": [60.66],
    "gorbenko": [59.738],
    "least-profile-radius": [80.34],
    "norton": [28.1622],
}


@over_all("name", NAMED_RULES)
def test_the_rules_of_the_schools_have_names_and_sources(name):
    terms = roller_rule(name)
    assert [term(rho=85.34, r0=134.8) for term in terms] == pytest.approx(NAMED[name])
    assert all(term.source == NAMED_RULES[name].source for term in terms)
    assert all(term.source == "" for term in roller_rule(NAMED_RULES[name].rule))


def test_a_mistyped_name_is_told():
    with pytest.raises(DesignError, match="did you mean 'gorbenko'"):
        roller_rule("gorbenco")
    with pytest.raises(DesignError, match="known are coursework, coursework-prime-radius, gorbenko"):
        roller_rule("xyz")


@over_all(
    "written",
    [
        "min(0.7rho, 0.4r0)", "min(0.7rho,0.4r0)", "min(0,7ρmin; 0,4 r0)", "min(0,7 ρ_min, 0,4 r₀)",
        "min(0.7·rho_min; 0.4·r_0)", "min( 0.7ρ ; 0,4r₀ )", "min(0,7 rho,0,4 r0)",
    ],
)  # fmt: skip
def test_a_rule_may_be_written_as_in_a_textbook(written):
    assert [(term.of, term.factor) for term in roller_rule(written)] == [("rho", 0.7), ("r0", 0.4)]


def test_a_comma_parts_terms_where_these_have_a_meaning():
    assert [str(term.formula_caption) for term in roller_rule("min(rho - 5,0.4 r0)")] == ["ρ − 5 mm", "0.4 r₀"]
    assert [str(term.formula_caption) for term in roller_rule("min(rho − 3,5; 0.4 r0)")] == ["ρ − 3.5 mm", "0.4 r₀"]


@over_all(("rule", "term"), [("min(0,7р; 0,4 r0)", "0,7р"), ("0.7 roh", "0.7 roh"), ("min(0.7 rho, 0.4)", "0.4")])
def test_a_term_that_is_none_is_quoted_whole_with_what_to_write(rule, term):
    with pytest.raises(DesignError) as caught:
        roller_rule(rule)
    assert caught.value.remedy == f"in place of '{term}' write a term such as 0.7 rho, 0.4 r0 or rho - 5"
