"""The page of the studio: layout, words and scripts in one text, with nothing that it would have to fetch.

The templates stand in ``data/studio``; what the step player has already (boards, the mechanism, inks) is taken from
``data/player``.
"""

from __future__ import annotations

import base64
import hashlib
import json
import re
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from graphcam.language import ENGLISH, Language, language, languages
from graphcam.sheets.player import PAGE_CAPTIONS as PLAYER_WORDS
from graphcam.sheets.player_svg import roles_css
from graphcam.sheets.typefaces import font_faces
from graphcam.studio.address import FIELDS
from graphcam.words import Caption, say, say_in

if TYPE_CHECKING:
    from jinja2 import Template
    from markupsafe import Markup

MODE_WORDS: Mapping[str, Caption] = {
    "locked": say("Sizes and values are locked in this mode."),
    "mm": say("mm"),
    "predict_what": say("What do you predict?"),
    "predict_how": say(
        "Move the dashed amber mark to where you expect it: drag it, use the arrow keys, or type the number below."
    ),
    "guess": say("Your guess"),
    "guess_along": say("Your guess, along its line"),
    "guess_across": say("Your guess, across"),
    "guess_down": say("Your guess, down"),
    "construct": say("Construct"),
    "construct_next": say("Next step (→)"),
    "try_again": say("Try again"),
    "next_variant": say("Next variant"),
    "on_paper": say("on paper"),
    "of_the_machine": say("of the machine"),
    "nothing_to_predict": say("This task has nothing to predict: choose another one in Play mode."),
    "constructing": say("The construction, step by step: {step}", step="{step}"),
    "tours": say("Tours"),
    "card_of": say("Card {card} of {cards}", card="{card}", cards="{cards}"),
    "all_tours": say("All tours"),
    "right": say("Right."),
    "not_right": say("Not that one."),
    "done_it": say("Done."),
    "do_it": say("Or try it in the drawing; the card will notice."),
    "do_it_only": say("Do it in the drawing or with the sizes; the card will notice."),
    "finish_tour": say_in("a tour", "Finish"),
    "next_card": say_in("a tour", "Next card"),
    "previous_card": say_in("a tour", "Previous card"),
    "seen": say_in("a tour", "seen"),
    "no_exercise": say(
        "In an exercise a part of the construction is given. You draw the rest on paper and type what you read; the "
        "page says what is right. The link that came with your handout opens your own."
    ),
    "try_exercise": say("Try one about this cam"),
    "check": say("Check"),
    "answers": say("Answers"),
    "answer_right": say_in("an answer", "right"),
    "answer_wrong": say_in("an answer", "not right"),
    "not_a_number": say("Write a number."),
    "draw_it": say("Draw it and hand it in with your answers; it is not checked here."),
    "decimals": say("decimals: {count}", count="{count}"),
    "no_checks": say("Answers are not checked here. Hand them in as your course says."),
    "practice": say("For practice only: marks are given for what you hand in."),
    "checked": say("{right} of {checked} right.", right="{right}", checked="{checked}"),
}
"""Captions by the names that ``predict.js``, ``tour.js`` and ``exercise.js`` ask for."""


PLAYER_NAMES = (
    "mechanism", "readings", "drawing", "closer", "farther", "steps", "step", "step_of", "part_of", "part_by_part",
    "whole_step", "why", "previous", "next", "theme", "all_values", "place", "paper", "value", "play", "pause",
    "angle", "pressure_angle", "displacement", "velocity",
)  # fmt: skip
"""The words that the page shares with the step player."""
PAGE_CAPTIONS: Mapping[str, Caption] = {
    **{name: PLAYER_WORDS[name] for name in PLAYER_NAMES},
    "studio": say("Studio"),
    "mode": say("Mode"),
    "play_mode": say("Play"),
    "predict": say("Predict"),
    "tour": say("Tour"),
    "exercise": say("Exercise"),
    "tools": say("Page"),
    "undo": say("Undo (Ctrl Z)"),
    "redo": say("Redo (Ctrl Shift Z)"),
    "pin": say("Pin this cam to compare (P)"),
    "unpin": say("Unpin the cam (P)"),
    "link": say("Copy a link to this state"),
    "link_copied": say("The link is copied."),
    "link_too_long": say("This state is too long for a link; save the task file and share that instead."),
    "sizes": say("Sizes"),
    "values": say("Values"),
    "what_if": say("What if"),
    "panel": say("Panel"),
    "views": say("Views"),
    "all_views": say("All views (A)"),
    "fit": say("Fit (0)"),
    "panes": say("Two panes (B)"),
    "beside": say("Second pane"),
    "beside_usual": say_in("the second pane", "What belongs to it"),
    "beside_diagrams": say("Diagrams over φ"),
    "handles": say("Handles in the drawing"),
    "slider_2d": say("2D slider"),
    "type_a_number": say("Type a number"),
    "ok": say("OK"),
    "files": say("Files"),
    "start_from": say("Start from"),
    "save": say("Save task.toml"),
    "open": say("Open a task file"),
    "saved": say("task.toml is saved."),
    "write_sheet": say("Write the sheet"),
    "write_note": say("Write the note"),
    "write_notebook": say("Write the notebook"),
    "write_working_drawing": say("Write the working drawing"),
    "writing": say("Writing ..."),
    "written": say("Written to {folder}: {files}", folder="{folder}", files="{files}"),
    "others_there": say(
        "{folder} has files that this page did not write: {files}. Nothing is written.",
        folder="{folder}",
        files="{files}",
    ),
    "replace_them": say("Write all the same"),
    "live_exact": say("Exact values. Beside the cursor of a diagram stands what is drawn there."),
    "colouring": say("Profile in colour"),
    "colour_none": say_in("a colour", "none"),
    "curvature_radius": say("Radius of curvature ρ"),
    "straight": say_in("a profile", "straight"),
    "found": say_in("a size", "found"),
    "given": say_in("a size", "given"),
    "none": say_in("a size", "none"),
    "no_number": say("This is not a number."),
    "phases": say("Phases"),
    "choose_a_phase": say("Choose a phase to change it, or drag a border."),
    "border": say("Border between"),
    "phase_dwell": say("Add a dwell after it"),
    "phase_step": say("Split it"),
    "phase_remove": say("Remove it"),
    "limits_kept": say("All limits are satisfied"),
    "not_drawn": say("Not drawn: see the field"),
    "pinned_cam": say("Pinned: {sizes}", sizes="{sizes}"),
    "pinned": say("Pinned"),
    "now": say("Now"),
    "quantity": say("Quantity"),
    "drawn": say_in("a value", "Drawn"),
    "exact": say("Exact"),
    "bound": say("Bound"),
    "drawn_about": say("Drawn: measured on the drawing, times the scale."),
    "bound_about": say("Bound: the largest drawing error, in mm of paper."),
    "over": say("Over the size"),
    "sweeping": say("Computing the curve ..."),
    "not_rounded": say("exact, not rounded: {value}", value="{value}"),
    "side_by_side": say("Side by side"),
    "pin_about": say("Pin the current cam, then change a size: both are shown, in the drawing and in a table."),
    "starting": say("Starting the engine: {state}", state="{state}"),
    "lost": say("The engine does not answer. The state is kept in the address."),
    "again": say("Start again"),
    "ended": say(
        "If 'graphcam studio' has ended, run it again and open its address with '&' and what stands behind '#' here."
    ),
    "noscript": say("The studio needs JavaScript."),
    **MODE_WORDS,
}
"""What the page itself says."""
SHARED_SCRIPT_FILES = ("gestures.js", "board.js", "lights.js", "mechanism.js")
SCRIPT_FILES = (
    "elements.js", "speaking.js", "wire.js", "state.js", "address.js", "stage.js", "handles.js", "phases.js",
    "sizes.js", "panel.js", "what_if.js", "strip.js", "walk.js", "colouring.js", "cam_angle.js", "asking.js",
    "following.js", "changing.js", "picture.js", "files.js", "modes.js", "guess.js", "predict.js", "tour.js",
    "exercise.js", "studio.js",
)  # fmt: skip
"""The scripts in order; later ones use functions of earlier ones, and a mode's script is left out where none is."""
LIBRARY_FILES = ("lit-html.js", "directive.js", "directive-helpers.js", "live.js", "repeat.js")
"""lit-html 3.3.3 in order: files of its package as they are, in ``vendor``; those of a newer one take their place."""
CONTENT_POLICY = (
    "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; connect-src 'self'; font-src data:; "
    "img-src data:; base-uri 'none'; form-action 'none'"
)
"""What the page may do where nothing else is said: nothing but ask where it came from."""


SCRIPT_PATTERN = re.compile(r"<script>(.*?)</script>", re.DOTALL)


def script_names(page: str) -> str:
    """The sums of a page's own scripts, for ``script-src``.

    >>> script_names("<script>let a = 1;</script>")
    "'sha256-xY6QKfH9PRsQnLz56nj6MBwiK5oHg+im1Jkpdp1x/Ck='"
    """
    sums = (hashlib.sha256(script.encode()).digest() for script in SCRIPT_PATTERN.findall(page))
    return " ".join(f"'sha256-{base64.b64encode(total).decode()}'" for total in sums)


def page(config: Mapping[str, Any], policy: str = CONTENT_POLICY, scripts: tuple[str, ...] = ()) -> str:
    """The page as HTML.

    config : plain data that the page reads: ``transport``, ``task``, ``name``, ``builtin``, ``language``, ``first``,
        ``writes`` and ``exercise``; the page's own words are put into it
    policy : the content security policy, none if empty
    scripts : texts of scripts that stand before those of the page

    >>> import graphcam as gc
    >>> task = gc.builtin_task().to_dict()
    >>> text = page({"transport": "server", "task": task, "name": "coursework", "builtin": {"coursework": task}})
    >>> "<title>Studio</title>" in text, "https://" in text
    (True, False)
    """
    from markupsafe import Markup

    spoken = language(config.get("language", ENGLISH.name))
    # An address may ask for another language.
    every = {name: (_words(language(name)), language(name).remark) for name in languages()}
    words, _ = every[spoken.name]
    characters = [text for said, remark in every.values() for text in (remark, *said.values())]
    others = {name: {"words": said, "remark": remark} for name, (said, remark) in every.items()}
    usual: dict[str, Any] = {"language": spoken.name, "first": None, "writes": [], "exercise": None}
    data: dict[str, Any] = {**usual, **config, "words": words, "spoken": others, "address": FIELDS}
    builtin: Mapping[str, Any] = data["builtin"]
    return _template().render(
        language=spoken.name,
        remark=spoken.remark,
        words=words,
        builtin={name: task.get("title", {}).get("name", name) for name, task in builtin.items()},
        writes=data["writes"],
        policy=policy,
        style=_shared_script("player.css")
        + Markup(roles_css())
        + _page_script("studio.css")
        + _page_script("modes.css"),
        scripts=[*map(Markup, scripts), *_scripts()],
        fonts=Markup(font_faces([DRAWING_CHARACTERS, *characters])),
        # No text of a task may end the script that holds it.
        config=Markup(json.dumps(data, ensure_ascii=False, allow_nan=False).replace("<", "\\u003c")),
    )


def _words(spoken: Language) -> dict[str, str]:
    """What the page itself says, in a language."""
    return {name: spoken.text(said) for name, said in PAGE_CAPTIONS.items()}


DRAWING_CHARACTERS = "₀₁₂₃₄₅₆₇₈₉ₐₑₒₓₕₖₗₘₙₚₛₜ′″°±×÷·−–…≤≥≈√∞∠⊥∥→←↑↓²³⁴½"
"""What drawings have besides the alphabets: indices, primes, signs."""


def _scripts() -> list[Markup]:
    """The scripts of the page, in order; those of the step player that it shares stand first."""
    own = files("graphcam") / "data" / "studio"
    return [
        _library(),
        *map(_shared_script, SHARED_SCRIPT_FILES),
        *(_page_script(name) for name in SCRIPT_FILES if (own / name).is_file()),
    ]


def _library() -> Markup:
    """The library as a plain script: what its modules export is put into ``lit``, and they take it from there."""
    from markupsafe import Markup

    text = "\n".join(f"{{{_page_file('studio/vendor', name)}}}" for name in LIBRARY_FILES)
    text = re.sub(r"import\{(.*?)\}from.*?;", lambda found: f"const{{{found[1].replace(' as ', ':')}}}=lit;", text)
    text = re.sub(r"([^{,]+) as ([$\w]+)(?=[^{}]*\};)", r"\2:\1", text)
    return Markup('"use strict";const lit={};\n' + re.sub(r"export(\{.*?\});", r"Object.assign(lit,\1);", text))


def _page_script(name: str) -> Markup:
    return _page_file("studio", name)


def _shared_script(name: str) -> Markup:
    return _page_file("player", name)


def _page_file(room: str, name: str) -> Markup:
    from markupsafe import Markup

    return Markup((files("graphcam") / "data" / room / name).read_text(encoding="utf-8"))


@cache
def _template() -> Template:
    """The page's template, which is compiled once."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    loader = PackageLoader("graphcam", "data/studio")
    environment = Environment(autoescape=True, loader=loader, undefined=StrictUndefined)
    environment.trim_blocks = environment.lstrip_blocks = True
    return environment.get_template("page.html")
