"""graphcam's docstrings for Sphinx: lists of names as lists, formulas kept from being taken for markup.

A docstring is written to be read in a terminal: ``name : meaning`` a line, |a| for a magnitude, and headings that
numpy's style underlines.
"""

from __future__ import annotations

import ast
import re
from importlib import import_module
from pathlib import Path
from pydoc import locate
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx

import graphcam

HEADINGS = {"Parameters", "Attributes", "Raises", "Returns"}
NAMED = re.compile(r"(?P<names>\w+(?:, \w+)*) : (?P<meaning>.*)")
MARKUP = re.compile(r"(``.+?``|:\w+:`[^`]+`|(?<![\w*])\*\w[^*]*\*(?![\w*]))")


def public_names() -> dict[str, str]:
    """The module in which each public name stands, by the one list of them.

    >>> public_names()["Cam"]
    'graphcam.mechanism.cam'
    """
    stub = ast.parse(Path(graphcam.__file__).with_suffix(".pyi").read_text(encoding="utf-8"))
    imports = [node for node in stub.body if isinstance(node, ast.ImportFrom)]
    return {alias.name: f"graphcam.{node.module}" for node in imports for alias in node.names}


def plain(text: str) -> str:
    r"""A line in which only literals, references and emphasis are markup.

    >>> print(plain("nu = |a1|/|a2|, the *ratio*, C_ and 2*x, ``|x|``"))
    nu = \|a1\|/\|a2\|, the *ratio*, C\_ and 2\*x, ``|x|``
    """
    parts = MARKUP.split(text)
    return "".join(part if k % 2 else re.sub(r"([|*`\\]|_(?!\w))", r"\\\1", part) for k, part in enumerate(parts))


def as_rst(lines: list[str]) -> list[str]:
    """A docstring's lines as reStructuredText.

    >>> print("\\n".join(as_rst(["Slides.", "", "Raises", "------", "ValueError : it", "    sticks"])))
    Slides.
    <BLANKLINE>
    **Raises**
    <BLANKLINE>
    ``ValueError``
        it
        sticks
    <BLANKLINE>
    """
    out: list[str] = []
    listed = example = False
    for line in lines:
        if re.fullmatch(r"-{3,}", line) and out and out[-1] in HEADINGS:
            out[-1:] = [f"**{out[-1]}**", ""]
            continue
        example = bool(line) and (example or line.startswith(">>>"))
        entries = [] if example else named(line)
        for names, meaning in entries:
            out += [", ".join(f"``{name}``" for name in names), f"    {plain(meaning)}"]
        if listed and not example and line.startswith("    "):
            out.append(f"    {plain(line.strip())}")
        elif not entries:
            # A list ends with an empty line.
            out += [""] * (listed and bool(line)) + [line if example else plain(line)]
            listed = False
        listed = listed or bool(entries)
    return [*out, ""]


def named(line: str) -> list[tuple[list[str], str]]:
    """The entries of a line of a list, names and meaning; some lists put two short ones in a line.

    >>> named("width : of the contact [mm];  young1, young2 : MPa")
    [(['width'], 'of the contact [mm]'), (['young1', 'young2'], 'MPa')]
    >>> named("width : least;  a design adds a margin")
    [(['width'], 'least;  a design adds a margin')]
    """
    found = [NAMED.fullmatch(part) for part in re.split(r";  (?=\w+(?:, \w+)* : )", line)]
    return [(each["names"].split(", "), each["meaning"]) for each in found if each] if all(found) else []


def _translate(app: Sphinx, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    lines[:] = as_rst(lines)


def _skip(app: Sphinx, what: str, name: str, thing: Any, skip: bool, options: Any) -> bool | None:
    return True if (getattr(thing, "__doc__", None) or "").startswith("Alias for field number") else None


def _find(app: Sphinx, env: Any, node: Any, text: nodes.TextElement) -> nodes.Node | None:
    """What a docstring refers to by the module where it stands: a public name's entry, else plain text.

    A name that is nowhere is left to Sphinx, which warns.
    """
    target = node["reftarget"]
    if node.get("refdomain") != "py":
        return None
    public = f"graphcam.{target.rpartition('.')[2]}"
    if target.startswith("graphcam.") and public.removeprefix("graphcam.") in graphcam.__all__ and target != public:
        domain = env.get_domain("py")
        return domain.resolve_xref(env, node["refdoc"], app.builder, node["reftype"], public, node, text)
    # A bare name is one of the module in which the docstring stands.
    here = any(hasattr(import_module(module), target) for module in set(public_names().values()))
    return text if here or locate(target) is not None else None


def setup(app: Sphinx) -> dict[str, bool]:
    """Called by Sphinx."""
    app.connect("autodoc-process-docstring", _translate)
    app.connect("autodoc-skip-member", _skip)
    app.connect("missing-reference", _find)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
