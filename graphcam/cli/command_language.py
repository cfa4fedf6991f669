"""The language of the command line: what ``--language`` says, else that of the task, else of the machine.

A language whose catalog has no messages is not spoken here: half a sentence of it would be English.

A task that names no language is English, as is one that names English: there the machine's counts, which is found as
gettext finds it, in the first of LANGUAGE, LC_ALL, LC_MESSAGES and LANG that is set.
"""

import os
import re
from collections.abc import Mapping
from contextlib import suppress
from contextvars import ContextVar
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from graphcam.errors import GraphcamError
from graphcam.help_texts import help_text
from graphcam.language import ENGLISH, Language, language, languages
from graphcam.words import Caption, Words

_LANGUAGE_PATTERN = re.compile(r"^[^#\n]*\blanguage\s*=\s*[\"']([\w-]+)[\"']", re.MULTILINE)
"""The language key of a task file, which only the table ``[drawing]`` has."""
LANGUAGE_VARIABLES = ("LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG")


def language_of_machine(variables: Mapping[str, str] = os.environ) -> Language:
    """The language that the variables of a machine name; English where graphcam has none of theirs.

    >>> language_of_machine({"LANG": "ru_RU.UTF-8"}).name, language_of_machine({"LANG": "C.UTF-8"}).name
    ('ru', 'en')
    >>> language_of_machine({"LANGUAGE": "xx:ru:en", "LANG": "en_US.UTF-8"}).name
    'ru'
    """
    named = next((value for name in LANGUAGE_VARIABLES if (value := variables.get(name, ""))), "")
    for locale in named.split(":"):
        name = locale.partition(".")[0].partition("@")[0]
        for known in (name, name.partition("_")[0]):
            if known in languages() and language(known).has_messages:
                return language(known)
    return ENGLISH


@dataclass
class Voice:
    """The language in which a command tells its texts; it may become known only while the command runs.

    chosen : the language that was asked for; empty where none was
    """

    chosen: str = ""
    language: Language = field(default_factory=language_of_machine)

    def choose(self, name: str | None) -> None:
        """Tell texts in the language of that name from now on; the command itself refuses an unknown one."""
        if name in languages():
            self.chosen = str(name)
            self.language = language(self.chosen) if language(self.chosen).has_messages else ENGLISH

    def adopt_language(self, name: str) -> None:
        """Tell texts in the language of a task or course, unless one was asked for or it is English."""
        if not self.chosen and name in languages() and name != ENGLISH.name and language(name).has_messages:
            self.language = language(name)

    def translate(self, words: Words | GraphcamError) -> str:
        """The text, or the caption of the error, in the chosen language."""
        return self.language.text(words.caption if isinstance(words, GraphcamError) else words)


_voice: ContextVar[Voice] = ContextVar("voice")


def use_machine_language() -> None:
    """Tell texts in the machine's language until a command knows better."""
    _voice.set(Voice())


def voice() -> Voice:
    """The voice of the command that is run."""
    if _voice.get(None) is None:
        use_machine_language()
    return _voice.get()


def translated(words: Words | GraphcamError) -> str:
    """A text in the language of the command that is run; see :meth:`Voice.translate`."""
    return voice().translate(words)


_helped: dict[str, Caption] = {}


def help_text_of(caption: Caption) -> str:
    """A help text with its values put in, registered so that it can be translated when the help is shown."""
    _helped[str(caption)] = caption
    return str(caption)


def in_language_of_machine(command: Any) -> Any:
    """The command of click, its help and that of its subcommands translated into the machine's language."""
    spoken = language_of_machine()
    if spoken != ENGLISH:
        _translate_help(command, spoken)
    return command


def _translate_help(command: Any, spoken: Language) -> None:
    first, found, rest = (command.help or "").partition("\n\n")
    command.help = spoken.text(help_text(first)) + found + rest
    for parameter in command.params:
        if getattr(parameter, "help", None):
            parameter.help = spoken.text(_helped.get(parameter.help) or help_text(parameter.help))
    for inner in getattr(command, "commands", {}).values():
        _translate_help(inner, spoken)


def language_in(path: Path) -> str:
    """The language that a file names, whether or not the rest of it is a task, or TOML; empty where it names none."""
    with suppress(OSError, ValueError):
        found = _LANGUAGE_PATTERN.search(path.read_bytes().decode("utf-8", errors="replace"))
        return found[1] if found else ""
    return ""
