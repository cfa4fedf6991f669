"""A slip in one answer is named where no catalogued mistake explains it and no other slip brings the same number."""

from __future__ import annotations

import pytest
from issued_variants import issued, key, marked


@pytest.mark.parametrize(
    ("name", "change", "told"),
    [
        ("v_2", lambda v: -v, "with the wrong sign"),
        ("v_2", lambda v: v * 0.0174533, "degrees for radians"),
        ("v_3", lambda v: v * 57.29578, "degrees for radians"),
        ("v_2", lambda v: 2 * v, "twice the answer"),
        ("v_2", lambda v: v / 2, "twice the answer"),
        ("v_2", lambda v: 10 * v, "decimal point"),
        ("v_2", lambda v: v / 100, "decimal point"),
        ("v_2", lambda v: 1.37 * v, "No usual mistake explains these answers"),
        ("v_2", lambda v: 0.0, "No usual mistake explains these answers"),
    ],
)
def test_a_slip_of_one_answer_is_named(name, change, told):
    # In her variant no two slips bring the same number.
    right = key(issued("differentiation", "Clara")[1])
    record = marked("differentiation", "Clara", **{name: change(right[name])})
    assert record.diagnosis is None
    assert told in record.feedback[-1]
    assert record.total < record.of


def test_the_number_of_another_answer_is_named_and_two_slips_are_not():
    right = key(issued("differentiation")[1])
    swapped = marked("differentiation", v_2=right["v_4"])
    assert "the same number for v_4" in swapped.feedback[-1]
    both = marked("differentiation", v_2=-right["v_2"], v_4=2 * right["v_4"])
    assert "No usual mistake" in both.feedback[-1]


def test_the_complement_of_an_angle_is_named():
    right = key(issued("pressure-angle", "Boris")[1])["alpha_8"]
    record = marked("pressure-angle", "Boris", alpha_8=90 - right if right > 0 else -90 - right)
    assert "complement" in record.feedback[-1]


def test_a_length_as_measured_on_paper_is_named_though_its_scale_is_right():
    _, answer_key = issued("integration")
    one = answer_key.keys["v_max"]
    record = marked("integration", v_max=one.expected.value * one.tolerance_paper / one.tolerance)
    assert "multiply it by its scale" in record.feedback[-1]
    assert [each.name for each in record.answers if each.outcome != "right"] == ["v_max"]
    # A length that is asked on paper has no scale to forget.
    assert "multiply it" not in marked("integration", s_5=1.37 * key(answer_key)["s_5"]).feedback[-1]
