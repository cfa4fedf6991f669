"""Web pages that need nothing but themselves; every word of a stranger in them is escaped."""

from __future__ import annotations

from functools import cache
from importlib import resources
from typing import TYPE_CHECKING, Any

from graphcam.exercises.definition.exercise import Exercise
from graphcam.words import Caption, say

if TYPE_CHECKING:
    from jinja2 import Environment
    from jinja2.runtime import Context


def page(template: str, exercise: Exercise, **values: Any) -> str:
    """A page about an exercise, of a template in ``data/grading``; its captions are said in the exercise's language."""
    from markupsafe import Markup

    style = Markup(_page_text("style.css"))
    written = _environment().get_template(template).render(values, exercise=exercise, style=style, say=say)
    # Without the halves of characters that a folder's name may hold and no file can.
    return written.encode("utf-8", "backslashreplace").decode()


@cache
def _environment() -> Environment:
    from jinja2 import Environment, FunctionLoader, StrictUndefined, pass_context

    @pass_context
    def told(context: Context, value: Any) -> Any:
        """A caption in the language of the page's exercise; other values as they are."""
        return context["exercise"].tell(value) if isinstance(value, Caption) else value

    loader = FunctionLoader(_page_text)
    return Environment(loader=loader, autoescape=True, undefined=StrictUndefined, trim_blocks=True, finalize=told)


def _page_text(name: str) -> str:
    return resources.files("graphcam").joinpath("data", "grading", name).read_text(encoding="utf-8")
