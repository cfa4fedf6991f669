"""Executing a notebook: what stops it."""

from __future__ import annotations

import pytest
from nbformat.v4 import new_code_cell, new_notebook

from graphcam.notebooks.notebook_execution import NotebookError, execute

pytestmark = pytest.mark.slow


def notebook(*cells):
    return new_notebook(cells=[new_code_cell(cell) for cell in cells])


def test_outputs_come_from_a_clean_kernel():
    done = execute(notebook("x = 6", "print(7 * x)"))
    assert done.cells[1].outputs[0].text == "42\n"
    assert not notebook("x = 6").cells[0].outputs


@pytest.mark.parametrize(
    "said", ["1 / 0", "import warnings; warnings.warn('x')", "import sys; print(1, file=sys.stderr)"]
)
def test_a_cell_that_fails_or_warns_stops_it(said):
    with pytest.raises(NotebookError) as caught:
        execute(notebook("print('before')", said, "print('after')"))
    assert caught.value.cell == said
