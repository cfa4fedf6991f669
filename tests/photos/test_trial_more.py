"""Another twenty photographs of a trial: tests of one file run one after the other, so these stand in another one."""

from __future__ import annotations

import pytest
from trial_goals import check_goals, photographs, shared_scratch

pytestmark = pytest.mark.slow


def test_twelve_more_photographs(tmp_path_factory: pytest.TempPathFactory) -> None:
    check_goals(photographs(range(20, 32), shared_scratch(tmp_path_factory)))
