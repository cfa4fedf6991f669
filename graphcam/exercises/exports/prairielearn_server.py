"""The ``server.py`` of a question of PrairieLearn, which is copied into it as it stands: it needs Python alone.

PrairieLearn's number inputs mark; here the variant is drawn, and the mistake behind a wrong number is named.  Keys and
mistakes lie in ``variants.json`` beside this file, which PrairieLearn keeps on its server.
"""

import json
from pathlib import Path
from typing import Any


def generate(data: dict[str, Any]) -> None:
    """Give the student one of the variants, by the seed that PrairieLearn has drawn."""
    variants = _table(data)["variants"]
    names = list(variants)
    name = names[data["variant_seed"] % len(names)]
    data["params"].update(variants[name]["params"], variant=name)
    data["correct_answers"].update(variants[name]["keys"])


def grade(data: dict[str, Any]) -> None:
    """Name the usual mistake behind each number that is marked wrong."""
    table = _table(data)
    for name, mistakes in table["variants"][data["params"]["variant"]]["mistakes"].items():
        score, given = data["partial_scores"].get(name, {}), data["submitted_answers"].get(name)
        if score.get("score") == 0 and isinstance(given, int | float):
            told = (text for value, tolerance, text in mistakes if abs(given - value) <= tolerance)
            score["feedback"] = next(told, table["far"])


def _table(data: dict[str, Any]) -> dict[str, Any]:
    path = Path(data["options"]["question_path"]) / "variants.json"
    return json.loads(path.read_text(encoding="utf-8"))
