"""Tours: cards with questions about a cam that changes under the hand, the studio's request "tours".

The cards stand in ``data/studio/tours.json``, beside the language catalogs, in English; each text is translated as a
whole.  A card has:

view, step : what it shows
changes : of the tour's built-in task, by paths, for this card;  phi : the cam angle at which it starts [degrees]
ask : the question, or what is to be done;  why : said when it is answered
choices, answer : of which one is right, if it is a question;  wrong : why each is not right, null for the right one
goal : what answers it by being done: a size that reaches a value, told as ``motion.phases[0].angle >= 90``
rests : by which quantity of a solved task the answer is found, for who checks the cards

What depends on the task stands in places of the texts: ``{sign}`` and ``{sense}``.
"""

import io
import json
import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from importlib import resources
from typing import Any

from graphcam.errors import DesignError
from graphcam.language import MINUS_SIGN, language
from graphcam.studio.sizes_form import SENSE_NAMES
from graphcam.studio.task_paths import changed_task, steps_of
from graphcam.tasks.task_file import builtin_task
from graphcam.words import Caption, Tell, Words, say

TEXT_KEYS = ("title", "about", "ask", "why", "choices", "wrong")
"""The keys under which texts stand that are translated."""


GOAL_PATTERN = re.compile(r"\s*([\w.\[\]]+)\s*(<=|>=|==|<|>)\s*(-?\d+(?:\.\d+)?)\s*")
OPERATORS = "<=", ">=", "==", "<", ">"


def goal_of(text: str) -> dict[str, Any]:
    """The goal that a text tells: a size at a ``path`` of the task, or ``phi``, compared with a number.

    Raises
    ------
    DesignError : it is not a path, an operator and a number

    >>> goal_of("follower.offset >= 0")
    {'path': 'follower.offset', 'operator': '>=', 'value': 0.0}
    """
    found = GOAL_PATTERN.fullmatch(text)
    if found is None:
        raise DesignError("goal", text, say("a path, one of {names} and a number", names=", ".join(OPERATORS)))
    path, operator, value = found.groups()
    steps_of(path)
    return {"path": path, "operator": operator, "value": float(value)}


@cache
def tours() -> list[dict[str, Any]]:
    """The tours as their file says them.

    >>> [tour["id"] for tour in tours()]
    ['offset', 'scales', 'angle', 'roller', 'face']
    """
    file = resources.files("graphcam").joinpath("data", "studio", "tours.json")
    return json.loads(file.read_text(encoding="utf-8"))["tours"]


def tours_answer(request: Mapping[str, Any]) -> dict[str, Any]:
    """The answer to a request "tours": all of them, in a language."""
    tell = language(str(request.get("language", "en"))).text
    return {"tours": [_tour(tour, tell) for tour in tours()]}


def _tour(tour: Mapping[str, Any], tell: Tell) -> dict[str, Any]:
    cards = [_card(card, str(tour["task"]), tell) for card in tour["cards"]]
    said = {name: tell(Caption(tour[name])) for name in ("title", "about")}
    return {"id": tour["id"], "name": tour["task"], **said, "cards": cards}


def _card(card: Mapping[str, Any], built_in: str, tell: Tell) -> dict[str, Any]:
    task = card_task(built_in, card)
    shown = {name: card[name] for name in ("view", "step", "answer") if name in card}
    said = {name: _told(card[name], tell, places_of(task)) for name in TEXT_KEYS if name in card}
    goal = goal_of(card["goal"]) if "goal" in card else None
    return {**shown, **said, "task": task, "phi": card.get("phi", 0.0), "goal": goal}


def places_of(task: Mapping[str, Any]) -> dict[str, Words]:
    """What stands in the places of texts: the sign before e in tan α = (v − σe)/(s₀ + s), and the sense of rotation.

    >>> places_of({"rotation": "cw"})["sign"], places_of({"rotation": "ccw"})["sign"]
    ('+', '−')
    """
    rotation = task["rotation"]
    return {"sign": {"cw": "+", "ccw": MINUS_SIGN}[rotation], "sense": SENSE_NAMES[rotation]}


def _told(texts: Any, tell: Tell, places: Mapping[str, Words]) -> Any:
    """A text of a card, or a list of them, translated and with its places filled; null stays."""
    if isinstance(texts, str):
        return tell(Caption(texts, places))
    return texts and [_told(text, tell, places) for text in texts]


def card_task(built_in: str, card: Mapping[str, Any]) -> dict[str, Any]:
    """The task that a card shows, as plain data."""
    return changed_task(builtin_task(built_in).to_dict(), card.get("changes", {}))


def texts_of(node: Any, within: bool = False) -> Iterator[str]:
    """All texts of the cards that are translated, in order.

    >>> list(texts_of({"ask": "Why?", "view": "plan", "choices": ["a", "b"]}))
    ['Why?', 'a', 'b']
    """
    if isinstance(node, str):
        if within:
            yield node
    elif isinstance(node, Mapping):
        for key, value in node.items():
            yield from texts_of(value, key in TEXT_KEYS)
    elif isinstance(node, Sequence):
        for value in node:
            yield from texts_of(value, within)


def extract(
    file: io.BufferedIOBase, keywords: Any, comment_tags: Any, options: Any
) -> Iterator[tuple[int, None, str, list[str]]]:
    """The texts of a file of tours, for ``pybabel extract``: line, function, text, comments."""
    lines = file.read().decode("utf-8").splitlines()
    for text in dict.fromkeys(texts_of(json.loads("\n".join(lines)))):
        quoted = json.dumps(text, ensure_ascii=False)
        yield next(k for k, line in enumerate(lines, 1) if quoted in line), None, text, []
