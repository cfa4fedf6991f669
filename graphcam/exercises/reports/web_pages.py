"""Web pages that need nothing but themselves; every word of a stranger in them is escaped."""

from __future__ import annotations

from functools import cache
from importlib import resources
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from jinja2 import Environment


def page(template: str, **values: Any) -> str:
    """A page of a template in ``data/grading``."""
    style = _read("style.css")
    from markupsafe import Markup

    return _environment().get_template(template).render(style=Markup(style), **_clean(values))


@cache
def _environment() -> Environment:
    from jinja2 import Environment, FunctionLoader, StrictUndefined

    return Environment(loader=FunctionLoader(_read), autoescape=True, undefined=StrictUndefined, trim_blocks=True)


def _read(name: str) -> str:
    return resources.files("graphcam").joinpath("data", "grading", name).read_text(encoding="utf-8")


def _clean(value: Any) -> Any:
    """Without the halves of characters that a folder's name may hold and no file can."""
    if isinstance(value, str):
        return value.encode("utf-8", "backslashreplace").decode()
    if isinstance(value, dict):
        return {key: _clean(each) for key, each in value.items()}
    if isinstance(value, list):
        return [_clean(each) for each in value]
    return value
