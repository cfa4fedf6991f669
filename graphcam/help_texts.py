"""The extractor of the command line's help texts, for the tools of gettext.

Typer takes them as plain text: what an option, an argument or a group of commands says as its ``help``, and the first
paragraph of a command's docstring.  Each stands in the catalogs as a whole, and is told as one when the help is shown.
"""

import ast
import re
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any

from graphcam.words import Caption

HELP_CALLS = {"Option", "Argument", "Typer", "path_option", "path_argument"}
"""The calls that have a parameter ``help`` of typer's."""


def help_text(text: str) -> Caption:
    """The caption of a help text, its white space folded as in the catalogs.

    >>> str(help_text("Where the files\\n  go."))
    'Where the files go.'
    """
    return Caption(" ".join(text.split()).replace("{", "{{").replace("}", "}}"))


def extract(file: IO[bytes], keywords: Any, comment_tags: Any, options: Any) -> Iterator[Any]:
    """An extractor for ``pybabel extract``: what pybabel finds in Python itself, and the texts of the help."""
    from babel.messages.extract import extract_python

    yield from extract_python(file, keywords, comment_tags, options)
    file.seek(0)
    code = file.read().decode("utf-8")
    texts = texts_of_tables if Path(file.name).parent.name == "tasks" else texts_of_help
    for line, text in texts(code):
        yield line, "say", help_text(text).template, []


FIELD_PATTERN = re.compile(r"(\w+(?:, \w+)*) : (.*)")
HEAD_PATTERN = re.compile(r"\[\w+\](?: of kind \"[\w-]+\")?[:,] ")
"""How the docstring of a table of a file begins: with its name and kind, which a file says by itself."""


def table_texts(docstring: str) -> tuple[str, dict[str, str]]:
    """What the docstring of a table says of it, and of its fields by their names.

    >>> table_texts("``[cam]``: its size.\\n\\nradius, bore : mm,\\n    of the disk\\n\\nRaises\\n------")
    ('its size', {'radius': 'mm, of the disk', 'bore': 'mm, of the disk'})
    """
    prose, fields, names = list[str](), dict[str, str](), list[str]()
    for line in docstring.replace("``", "").splitlines():
        if line == "Raises" or line.startswith(">>>") or (names and not line):
            break
        if found := FIELD_PATTERN.fullmatch(line):
            names = found[1].split(", ")
            fields |= dict.fromkeys(names, found[2])
        elif names:
            fields |= {name: f"{fields[name]} {line.strip()}" for name in names}
        else:
            prose.append(line)
    about = " ".join(" ".join(prose).split()).removesuffix(".")
    head = HEAD_PATTERN.match(about)
    return about[head.end() if head else 0 :], fields


def texts_of_tables(code: str) -> Iterator[tuple[int, str]]:
    """The texts about tables of task files and their fields in a module's code, each with its line number.

    >>> list(texts_of_tables('class CamTable:\\n    "``[cam]``: its size.\\\\n\\\\n    radius : mm"'))
    [(1, 'its size'), (1, 'mm')]
    """
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.ClassDef) and node.name.endswith(("Table", "Task", "SpringPlace")):
            docstring = ast.get_docstring(node) or ""
            about, fields = table_texts(docstring)
            # Of a table without a head of its own only the keys are told.
            told = (about, *fields.values()) if HEAD_PATTERN.match(docstring.replace("``", "")) else fields.values()
            yield from ((node.lineno, text) for text in dict.fromkeys(told))


def texts_of_help(code: str) -> Iterator[tuple[int, str]]:
    """The help texts in a module's code, each with its line number.

    >>> code = '@app.command()\\ndef solve(out=Option(help="The folder.")):\\n    "Draw a cam.\\\\n\\\\nMore."'
    >>> [text for _, text in texts_of_help(code)]
    ['Draw a cam.', 'The folder.']
    """
    module = ast.parse(code)
    named: dict[str, ast.expr] = {}
    for node in module.body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            named[node.targets[0].id] = node.value
    for node in ast.walk(module):
        if isinstance(node, ast.FunctionDef) and (docstring := ast.get_docstring(node)):
            if "[bold]Examples[/bold]" in docstring or any("command" in ast.unparse(d) for d in node.decorator_list):
                yield node.lineno, docstring.partition("\n\n")[0]
        elif isinstance(node, ast.Call) and ast.unparse(node.func).rpartition(".")[2] in HELP_CALLS:
            for text in (each.value for each in node.keywords if each.arg == "help"):
                match named.get(text.id) if isinstance(text, ast.Name) else text:
                    case ast.Constant(value=str() as said):
                        yield node.lineno, said
                    case _:
                        pass
