"""The texts of messages, found in the code for the tools of gettext.

An error is raised in English: ``DesignError("lift", 0, f"at most {most:g} mm")``.  Each of its texts stands in the
catalogs in the context "message", an f-string as a template with a named place for each value, "at most {most} mm".
:mod:`graphcam.messages` tells it in another language.
"""

from __future__ import annotations

import ast
import string
from collections.abc import Iterable, Iterator
from typing import IO, Any

CONTEXT = "message"
"""The context of these texts in a catalog."""
FEWEST_LETTERS = 3
"""Of a template's literal parts: fewer would fit too much."""
TEXTS = {
    "DesignError": (0, 1, 2, 3),
    "RowError": (0, 1, 2, 3),
    "TooLargeError": (0, 1, 2, 3),
    "TaskError": (1, 2, 3, 4),
    "MissingFileError": (1,),
    "Unquoted": (0,),
    "OutputError": (1, 2),
    "LevelError": (1,),
    "MissingExtraError": (0,),
    "OSError": (0,),
    "IsADirectoryError": (0, 1),
    "BadParameter": (0,),
    "_wrong": (0, 1, 2, 3),
    "wrong": (1, 2),
    "_refused": (0, 1, 2),
    "_error": (3,),
    "unreadable": (1, 2, 4),
    "student_lines": (1, 4, 5),
    "once": (2,),
    "other_file": (0, 1),
    "WrongType": (1,),
    "positive": (2,),
    "check_kind": (3, 4),
    "check_number": (0, 2, 3),
    "progress": (0,),
    "report": (0,),
    "plain": (0,),
    "echo": (0,),
    "tell": (0,),
    "progress_bar": (0,),
    "print_table": (0,),
}
"""Which of the arguments of a call are texts."""
KEYWORDS = {"limit", "expected", "remedy", "kind", "where", "title", "caption", "help"}
"""Arguments by name that are texts."""
NAMED = {"DesignError": 0, "RowError": 0, "TooLargeError": 0, "TaskError": 1, "_wrong": 0, "check_number": 0}
"""Which of them is a name; one word alone is that of a field, the same in every language."""
HELPED = {"Option", "Argument", "Typer"}
"""Calls of typer with a help."""
RETURN = {
    *("nearest", "meant", "missing", "_broken", "_sentence", "install_advice", "_remedy", "_turn_remedy", "_told"),
    "swing_remedy",
    *("_typography", "_comma", "_value"),
    *("key_remedy", "value_remedy", "missing_remedy", "_radius_remedy", "said"),
}
"""Functions that return texts; errors that say themselves do so too, and have texts as defaults."""


def extract(file: IO[bytes], keywords: Any, comment_tags: Any, options: Any) -> Iterator[Any]:
    """A method for ``pybabel extract``: what it finds in Python itself, and the texts of messages."""
    from babel.messages.extract import extract_python

    yield from extract_python(file, keywords, comment_tags, options)
    file.seek(0)
    for line, text in texts_of_messages(file.read().decode("utf-8")):
        yield line, "say_in", (CONTEXT, text), []


def texts_of_messages(code: str) -> Iterator[tuple[int, str]]:
    """Lines and texts.

    >>> code = 'raise DesignError("lift", 0, f"at most {limits.most:g} mm", "give the height" if low else "")'
    >>> [text for _, text in texts_of_messages(code)]
    ['at most {most} mm', 'give the height']
    """
    module = ast.parse(code)
    said = _Assigned(module)
    for node in ast.walk(module):
        if isinstance(node, ast.Call):
            for k, argument in _texts(node):
                yield from said.texts(argument, named=NAMED.get(_name(node.func)) == k)
        elif isinstance(node, ast.FunctionDef) and (summary := _summary(node)):
            yield node.lineno, summary
        elif isinstance(node, ast.FunctionDef) and node.name in RETURN:
            for inner in ast.walk(node):
                if isinstance(inner, ast.Return) and inner.value is not None:
                    yield from said.texts(inner.value)
        elif isinstance(node, ast.ClassDef) and node.name.endswith("Error"):
            for inner in node.body:
                if isinstance(inner, ast.FunctionDef) and inner.name == "__init__":
                    for argument, default in zip(inner.args.kwonlyargs, inner.args.kw_defaults, strict=True):
                        if argument.arg in KEYWORDS and default is not None:
                            yield from said.texts(default)
                if isinstance(inner, ast.FunctionDef) and inner.name == "__str__":
                    for last in ast.walk(inner):
                        if isinstance(last, ast.Return) and last.value is not None:
                            yield from said.texts(last.value)


def _summary(function: ast.FunctionDef) -> str:
    """The first sentences of a command's help; empty of any other function."""
    decorators = {_name(decorator) for decorator in function.decorator_list}
    docstring = ast.get_docstring(function) or ""
    if decorators & {"command", "callback"} or "[bold]Examples[/bold]" in docstring:
        return " ".join(docstring.partition("\n\n")[0].split())
    return ""


def _texts(call: ast.Call) -> Iterable[tuple[int, ast.expr]]:
    places = () if _of_typer(call.func) else TEXTS.get(_name(call.func), ())
    if not places and _name(call.func) not in HELPED:
        return []
    listed = [(k, argument) for k, argument in enumerate(call.args) if k in places or isinstance(argument, ast.Starred)]
    return [*listed, *((-1, keyword.value) for keyword in call.keywords if keyword.arg in KEYWORDS)]


def _of_typer(node: ast.expr) -> bool:
    """Whether it is typer's own echo, which says a text as it is."""
    return isinstance(node, ast.Attribute) and node.attr == "echo"


def _name(node: ast.AST) -> str:
    """The last name of what is called or shown."""
    match node:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name
        case ast.Call(func=ast.Attribute(attr="join")):
            return "names"
        case ast.Call(func=ast.Name(id="float" | "len" | "max" | "sum"), args=[inner, *_]):
            return _name(inner)
        case ast.Call(func=inner) | ast.Subscript(value=inner):
            return _name(inner)
        case _:
            return "value"


class _Assigned:
    """What names of a module stand for, wherever they are given it."""

    def __init__(self, module: ast.Module) -> None:
        self.values: dict[str, list[ast.expr]] = {}
        for node in ast.walk(module):
            match node:
                case ast.Assign(targets=[ast.Tuple(elts=targets)], value=ast.Tuple(elts=values)):
                    pairs = zip(targets, values, strict=False)
                case ast.Assign(targets=targets, value=value):
                    pairs = ((target, value) for target in targets)
                case ast.AnnAssign(target=target, value=ast.expr() as value):
                    pairs = [(target, value)]
                case ast.For(target=ast.Tuple(elts=targets), iter=ast.Tuple(elts=rows)):
                    tuples = [row.elts for row in rows if isinstance(row, ast.Tuple)]
                    pairs = [pair for values in tuples for pair in zip(targets, values, strict=False)]
                case _:
                    continue
            several = isinstance(node, ast.For)
            for target, value in pairs:
                # Among what is gone through are names of files and fields; a text has several words.
                if isinstance(target, ast.Name) and not (several and " " not in _template(value)):
                    self.values.setdefault(target.id, []).append(value)

    def texts(self, node: ast.expr, *, named: bool = False, deeper: int = 4) -> Iterator[tuple[int, str]]:
        """The texts that an expression can be."""
        if not deeper:
            return
        match node:
            case ast.Constant(value=str()) | ast.JoinedStr() | ast.BinOp():
                template = _template(node)
                if is_text(template) and not (named and " " not in template):
                    yield node.lineno, template
                if isinstance(node, ast.JoinedStr):
                    for part in node.values:
                        if isinstance(part, ast.FormattedValue) and isinstance(part.value, ast.Name | ast.IfExp):
                            yield from self.texts(part.value, named=True, deeper=deeper - 1)
                if isinstance(node, ast.BinOp):
                    for part in (node.left, node.right):
                        if not isinstance(part, ast.Constant | ast.JoinedStr):
                            yield from self.texts(part, named=named, deeper=deeper)
            case ast.IfExp(body=first, orelse=second):
                yield from self._all([first, second], named, deeper)
            case ast.BoolOp(values=values) | ast.Tuple(elts=values) | ast.Dict(values=values):
                yield from self._all(values, named, deeper)
            case ast.Starred(value=value):
                yield from self.texts(value, named=named, deeper=deeper)
            case ast.Name(id=name):
                yield from self._all(self.values.get(name, []), named, deeper - 1)
            case ast.Call(func=ast.Attribute(value=ast.Name(id=name), attr="get"), args=[_, default]):
                yield from self._all([*self.values.get(name, []), default], named, deeper - 1)
            case ast.Subscript(value=ast.Name(id=name)):
                yield from self._all(self.values.get(name, []), named, deeper - 1)
            case _:
                pass

    def _all(self, nodes: Iterable[ast.expr], named: bool, deeper: int) -> Iterator[tuple[int, str]]:
        for node in nodes:
            yield from self.texts(node, named=named, deeper=deeper)


def _template(node: ast.expr) -> str:
    """An expression as a template: its literal texts, and a place for each value."""
    parts: list[str] = []
    names: dict[str, int] = {}

    def place(value: ast.AST) -> str:
        """A place that no other has."""
        name = _name(value)
        count = names[name] = names.get(name, 0) + 1
        return f"{{{name}}}" if count == 1 else f"{{{name}{count}}}"

    def add(part: ast.expr) -> None:
        """Append what a part says."""
        match part:
            case ast.Constant(value=str() as text):
                parts.append(text.replace("{", "{{").replace("}", "}}"))
            case ast.JoinedStr(values=values):
                for value in values:
                    add(value)
            case ast.FormattedValue(value=value):
                parts.append(place(value))
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                add(left)
                add(right)
            case ast.IfExp():
                pass  # a text of its own
            case _:
                parts.append(place(part))

    add(node)
    return "".join(parts)


def is_text(template: str) -> bool:
    """Whether a template says anything in words; with places it needs a few letters to be recognised by.

    >>> is_text("mm"), is_text("{length} mm"), is_text("at most {length} mm"), is_text("arcs.{name}[{k}]")
    (True, False, True, False)
    """
    if " " not in template and "[" in template:
        return False  # a field
    pieces = list(string.Formatter().parse(template))
    letters = sum(sign.isalpha() for literal, *_ in pieces for sign in literal)
    return letters >= (FEWEST_LETTERS if any(place is not None for _, place, *_ in pieces) else 1)
