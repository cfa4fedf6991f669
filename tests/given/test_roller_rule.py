from __future__ import annotations

import pytest

from graphcam.errors import DesignError
from graphcam.given.roller_rule import DEFAULT_RULE, NAMED_RULES, roller_rule


@pytest.mark.parametrize(
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


@pytest.mark.parametrize(
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


@pytest.mark.parametrize("name", NAMED_RULES)
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
