"""A question of PrairieLearn: a folder with the page, the variants, and the code that draws one for each student.

The page asks for every number with ``pl-number-input``, which marks it with the variant's tolerance.  What students can
load lies in ``clientFilesQuestion``: the worksheets.  Keys stand in ``variants.json``, which stays on the server.
"""

import json
from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import Any

from graphcam.exercises.course.handouts import instructions
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.exports import prairielearn_server
from graphcam.exercises.exports.question_parts import (
    PRINT_ADVICE,
    SEPARATE_HAND_IN,
    WRONG_FEEDBACK,
    IssuedVariant,
    check_numbers,
    identifier_of,
    mistaken,
    question_body,
    variant_identifier,
    whole_marks,
    worksheet_pdf,
)
from graphcam.words import say

TOPIC_NAME = say("Cam mechanism")


def write_question(folder: Path, exercise: Exercise, issued: Sequence[IssuedVariant]) -> None:
    """Write the folder of a question that has these variants.

    Raises
    ------
    TaskError : no answer of the exercise is a number
    """
    check_numbers(exercise)
    worksheets = folder / "clientFilesQuestion"
    worksheets.mkdir(parents=True)
    variants = {variant_identifier(each): each for each in issued}
    for name, each in variants.items():
        (worksheets / f"{name}.pdf").write_bytes(worksheet_pdf(each))
    table = {
        "far": exercise.tell(WRONG_FEEDBACK),
        "variants": {name: _variant(exercise, each, f"{name}.pdf") for name, each in variants.items()},
    }
    files = {
        "info.json": _json(_info(exercise)),
        "question.html": question_html(exercise),
        "server.py": Path(prairielearn_server.__file__).read_text(encoding="utf-8"),
        "variants.json": _json(table),
    }
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8", newline="\n")


def _info(exercise: Exercise) -> dict[str, Any]:
    """The metadata of the question.

    A student keeps one variant, which is drawn on paper once; and its key is not shown, as others have the same.
    """
    return {
        "uuid": str(identifier_of("prairielearn", exercise.name, exercise.version, exercise.language)),
        "title": exercise.title,
        "topic": exercise.tell(TOPIC_NAME),
        "type": "v3",
        "singleVariant": True,
        "showCorrectAnswer": False,
    }


def question_html(exercise: Exercise) -> str:
    """The page, a template of Mustache: what differs between variants is a parameter, which Mustache escapes."""
    weights = whole_marks(exercise)
    link = '<a href="{{options.client_files_question_url}}/{{params.worksheet}}">' + _plain_html(
        exercise.tell(PRINT_ADVICE)
    )
    lines = ["<pl-question-panel>", "<p>{{params.task}}</p>", f"<p>{link}</a></p>", "</pl-question-panel>"]
    for asked in exercise.answers:
        text = "{{params.asked." + asked.name + "}}"
        if asked.kind != "number":
            lines.append(
                f"<pl-question-panel><p>{text} {_plain_html(exercise.tell(SEPARATE_HAND_IN))}</p></pl-question-panel>"
            )
            continue
        settings = {
            "answers-name": asked.name,
            "label": asked.name,
            "weight": str(weights[asked.name]),
            "comparison": "relabs",
            "rtol": "0",
            "atol": "{{params.tolerance." + asked.name + "}}",
            # An answer left out is wrong, and no reason to refuse the others.
            "allow-blank": "true",
            "blank-value": "",
            # They would tell the tolerance, and the key to whoever is right.
            "show-help-text": "false",
            "show-placeholder": "false",
            "show-correct-answer": "false",
        }
        said = " ".join(f'{name}="{value}"' for name, value in settings.items())
        lines.append(f"<pl-question-panel><p>{text}</p></pl-question-panel>")
        lines.append(f"<p><pl-number-input {said}></pl-number-input></p>")
    return "\n".join([*lines, ""])


def _variant(exercise: Exercise, issued: IssuedVariant, file: str) -> dict[str, Any]:
    """What the page shows of a variant, and what the server alone knows."""
    answer_key = issued.answer_key
    numbers = [asked for asked in exercise.answers if asked.kind == "number"]
    keys = {asked.name: answer_key.keys[asked.name] for asked in numbers}
    told = {
        asked.name: [
            (wrong.value, wrong.tolerance, exercise.tell(wrong.said)) for wrong in mistaken(exercise, answer_key, asked)
        ]
        for asked in numbers
    }
    return {
        "params": {
            "task": instructions(issued.variant),
            "worksheet": file,
            "asked": {asked.name: question_body(exercise, answer_key, asked) for asked in exercise.answers},
            "tolerance": {name: key.tolerance for name, key in keys.items()},
        },
        "keys": {name: key.expected.value for name, key in keys.items()},
        "mistakes": told,
    }


def _plain_html(text: str) -> str:
    """Text as HTML in which Mustache finds nothing to fill in.

    >>> _plain_html("a < {{b}}")
    'a &lt; &#123;&#123;b&#125;&#125;'
    """
    return escape(text).replace("{", "&#123;").replace("}", "&#125;")


def _json(said: dict[str, Any]) -> str:
    return json.dumps(said, indent=1, ensure_ascii=False, allow_nan=False) + "\n"
