"""The words of the field, in all that a user reads: the style sheet of ``.github/CONTRIBUTING.md`` held over captions,
notebooks, exercises, the pages of the site, README, changelog, help texts and public docstrings, and the Russian one
over the Russian catalog."""

from __future__ import annotations

import doctest
import inspect
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import typer

import graphcam
from graphcam.cli import app
from graphcam.language import read_catalog

ROOT = Path(__file__).parent.parent
CATALOG = Path(graphcam.__file__).parent / "data" / "languages" / "ru.po"
INSTEAD = {
    r"\bgreatest\b|(?<!\bat )\bleast\b(?! squares)": "maximum, minimum",
    r"\brest line\b|\blow rest\b|\bat the rest\b|\brests\b|\bresting\b": "dwell, dwell line, lower dwell",
    r"\bscheme of the mechanism\b": "kinematic diagram",
    r"\bgauge\b": "scale bar",
    r"\b(?:perfect|careful) hands?\b|\bperfect pencil\b|\bhand without error\b": "ideal pencil, careful drawing",
    r"\bhand's (?:errors?|scatter)\b|\berrors? of the hand\b": "drawing error",
    r"\bhand-ins?\b": "submission",
    r"\bthe papers\b": "handouts",
    r"\bcertificates?\b": "answer key",
    r"\bfoot from\b": "foot of the perpendicular",
    r"\btouch points?\b|\bpoint of touch\b": "contact point, point of contact",
    r"\bin balance\b": "in equilibrium",
    r"\bbears the (?:follower|arm)\b": "pushes, supports",
    r"\bno bend\b|\bbend is readable\b": "the curvature cannot be read",
    r"\bupright\b": "vertical",
    r"\bshared? out\b|\btaken up by turning\b": "distributed, removed by rotating the base line",
    r"\blooks (?:drawn|laid off|taken|turned|given|exchanged|read)\b": "You seem to have ...",
    r"\bnought\b|\bshall\b|\bwhither\b|\ban own\b|\bforetell\b": "zero, is to, where, of their own, predict",
}
"""What is not written, as a pattern, and what is."""
IN_PROSE = {
    r"\bkeep(?:s|ing)? (?:the|its|their) limits?\b": "satisfy the limits",
    r"\bif left out\b|\bleft out takes?\b": "the default is, omitted values",
    r"\bgoes as\b": "is proportional to",
    r"\bhands? that (?:draws?|errs?|drew)\b|\bwith a hand\b|\bby hands\b": "drawing error, pencil",
    r"\bcrews?\b": "worker pool",
    r"\bone's own\b": "of your own",
    r"\bfor whoever\b|\bwho forgets\b|\bsuch who\b": "if you",
    r"\bupon\b|\bthereof\b|\bin consequence whereof\b": "on, of it",
}
"""The same where the sentences are not translated: README, changelog, pages and help."""
PROSE = (".github/CONTRIBUTING.md", "README.md", "CHANGELOG.md", "help", "notebooks/site", "exercises/README.md")
"""Of what these are the names, or their beginnings."""
RUSSIAN = {
    r"\b[Рр]ук(?:а|и|е|у|ой|ами)\b": "идеальное построение, погрешность построения",
    r"(?<!то )(?<!То )\bесть\b": "тире",
    r"(?:^|[,.] )[Зз]начит\b": "следовательно",
    r"\b[Нн]атяг": "предварительное поджатие",
    r"\bмм чертежа\b": "мм на чертеже",
    r"\bпоступательн(?:ый|ого|ому|ом) толкател": "поступательно движущийся толкатель",
    r"\bпоперёк движения\b": "перпендикулярно движению",
    r"\bнормаль коромысла\b": "нормаль к коромыслу",
    r"\bтеоретическ\w+ профил": "центровой профиль",
    r"\b[Оо]тсчёт(?:ы|ов)?\b": "измеренные величины",
    r"^(?:доказанная )?[Гг]раница(?:,| \(|$)": "предельная погрешность",
    r"^Рев\.$": "Ред.",
}
"""The same in Russian."""
MEANT = {"тире": r"\b(?:there|has|have|holds|with)\b", "измеренные величины": r"\bsample[sd]?\b"}
"""Where the English says this, the Russian word is right: "есть" says that there is something, a law has "отсчёты"."""


@pytest.fixture(scope="module")
def russian() -> list[tuple[str, str]]:
    """What the Russian catalog says, each with its English."""
    told = read_catalog(CATALOG.read_text(encoding="utf-8")).told.items()
    return [(english, form) for (_, english), forms in told for form in forms]


def captions() -> Iterator[str]:
    """The captions of the program, without what stands in their places and without names such as "rho-rule"."""
    for _, text in read_catalog(CATALOG.read_text(encoding="utf-8")).told:
        yield re.sub(r'\{[^}]*\}|"[\w-]+"', "", text)


def prose(page: str) -> str:
    """What is read on a page of Markdown: no code, no formulas, no addresses."""
    return re.sub(r"^```.*?^```|`[^`]*`|\$[^$]*\$|\]\([^)]*\)", " ", page, flags=re.DOTALL | re.MULTILINE)


def shown_code(page: str) -> str:
    """The texts in the code of a page: what is in quotes and more than one word."""
    blocks = re.findall(r"^```.*?^```", page, re.DOTALL | re.MULTILINE)
    return "\n".join(text for block in blocks for text in re.findall(r'"([^"]*)"', block) if " " in text.strip())


def helped(command: Any) -> Iterator[str]:
    """The help of a command, of its options, and of the commands below it, without the examples."""
    yield re.sub(r"^graphcam .*$", "", command.help or "", flags=re.MULTILINE)
    yield from (getattr(parameter, "help", None) or "" for parameter in command.params)
    for inner in getattr(command, "commands", {}).values():
        yield from helped(inner)


def docstrings() -> Iterator[str]:
    """The docstrings of all public names, and of what they have, without their examples."""
    for name in graphcam.__all__:
        thing = getattr(graphcam, name)
        inner = [member for key, member in vars(thing).items() if key[0] != "_"] if inspect.isclass(thing) else []
        for documented in (thing, *inner):
            if isinstance(documented, dict | tuple | str):
                continue
            said = inspect.getdoc(documented) or ""
            for example in doctest.DocTestParser().get_examples(said):
                said = said.replace(example.source, "").replace(example.want, "")
            yield prose(re.sub(r"``[^`]*`|:\w+:`[^`]*`|\"[^\"]*\"", " ", said))


def cells(notebook: str) -> str:
    """What is read in a notebook: its prose, and the texts of its figures, tables and questions."""
    lines, prosaic = [], False
    for line in notebook.splitlines():
        if line.startswith("# %%"):
            prosaic = "[markdown]" in line
        elif prosaic:
            lines.append(line.removeprefix("#").strip())
        else:
            lines += [re.sub(r"\{[^}]*\}", "", text) for text in re.findall(r'"([^"]*)"', line) if " " in text]
    return prose("\n".join(lines))


@pytest.fixture(scope="module")
def pages() -> dict[str, str]:
    """What is read, by the file in which it is."""
    written = [*ROOT.glob("notebooks/site/pages/**/*.md"), *ROOT.glob("notebooks/*.md"), ROOT / "exercises/README.md"]
    written += [ROOT / "README.md", ROOT / "CHANGELOG.md"]
    texts = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8") for path in written}
    # The tables of the style sheet name what is not written.
    rules = (ROOT / ".github" / "CONTRIBUTING.md").read_text(encoding="utf-8")
    texts[".github/CONTRIBUTING.md"] = re.sub(r"^\|.*$", "", rules, flags=re.MULTILINE)
    found = {name: f"{prose(text)}\n{shown_code(text) if '/how-to/' in name else ''}" for name, text in texts.items()}
    for path in ROOT.glob("notebooks/*.py"):
        found[path.name] = cells(path.read_text(encoding="utf-8"))
    for path in ROOT.glob("exercises/*.toml"):
        exercise = tomllib.loads(path.read_text(encoding="utf-8"))
        asked = [exercise["title"], exercise["text"], *(answer["text"] for answer in exercise["answers"])]
        found[path.name] = "\n".join(text["en"] for text in asked)
    found |= {"help": "\n".join(helped(typer.main.get_command(app))), "docstrings": "\n".join(docstrings())}
    return found | {"captions": "\n".join(captions())}


def said(pattern: str, text: str) -> list[str]:
    """The lines in which it is said."""
    text = " ".join(text.split())
    return [text[max(0, found.start() - 60) : found.end() + 20] for found in re.finditer(pattern, text, re.IGNORECASE)]


@pytest.mark.parametrize("pattern", INSTEAD, ids=INSTEAD.values())
def test_the_words_of_the_field_are_used(pages, pattern):
    assert {name: lines for name, text in pages.items() if (lines := said(pattern, text))} == {}


@pytest.mark.parametrize("pattern", IN_PROSE, ids=IN_PROSE.values())
def test_sentences_that_are_not_translated_avoid_calques(pages, pattern):
    written = {name: text for name, text in pages.items() if name.startswith(PROSE)}
    assert {"README.md", "CHANGELOG.md", "help"} < set(written)
    assert {name: lines for name, text in written.items() if (lines := said(pattern, text))} == {}


@pytest.mark.parametrize("pattern", RUSSIAN, ids=RUSSIAN.values())
def test_russian_is_written_as_lecturers_write_it(russian, pattern):
    meant = MEANT.get(RUSSIAN[pattern], "(?!)")
    assert [form for english, form in russian if re.search(pattern, form) and not re.search(meant, english)] == []


def test_a_word_that_is_not_used_would_be_found():
    name = "greatest v\nthe follower rests\nat least 3 mm, `least` and $least$"
    assert [bool(said(pattern, prose(name))) for pattern in INSTEAD][:2] == [True, True]
    assert said(next(iter(INSTEAD)), prose("at\nleast 3 mm, `least` and $least$, by least squares")) == []


def test_help_and_code_of_a_page_and_docstrings_are_read(pages):
    assert "Print the version and exit." in pages["help"]
    assert "The maximum ordinate of the return, on paper." in pages["notebooks/site/pages/how-to/write-an-exercise.md"]
    assert "The maximum normal force over the turn" in pages["docstrings"]
    assert "round(most.value" not in pages["docstrings"]
