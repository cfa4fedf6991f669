"""Formulas as MathML, which browsers draw without a script: as on the pages of ``graphcam notebook`` and in ``note.html``."""

from __future__ import annotations

from typing import Any

from docutils import nodes
from sphinx.application import Sphinx

from graphcam.report.documents import mathml


def _inline(page: Any, node: nodes.math) -> None:
    page.body.append(mathml(node.astext()))
    raise nodes.SkipNode


def _block(page: Any, node: nodes.math_block) -> None:
    page.body.append(mathml(node.astext(), "block"))
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    """Called by Sphinx."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
