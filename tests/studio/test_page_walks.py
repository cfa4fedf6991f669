"""A few random walks through the studio; ``walks.py`` takes more."""

from __future__ import annotations

import pytest
from walks import walk

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("seed", range(1, 6))
def test_form_picture_and_address_agree_at_every_rest(opened, served, seed):
    assert walk(opened(), served.asked, seed, 8) == []
