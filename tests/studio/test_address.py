"""The state in an address: it comes back as it was, is short, and says so where it cannot be."""

from __future__ import annotations

import base64
import json
import zlib
from dataclasses import asdict, replace

import numpy as np
import pytest
from golden_random import random_arcs_task
from random_tasks import random_arm_task, random_flat_task, random_task

import graphcam as gc
from graphcam.studio.address import MAX_LENGTH, StudioPlace, address_of, place_of

KINDS = (random_task, random_arm_task, random_flat_task)


def plain(task: gc.Task | gc.ArcsTask) -> dict:
    """A task as a request has it: what JSON makes of its table."""
    said = task.to_dict()
    if isinstance(task, gc.Task) and task.motion.table is not None:
        said["motion"]["table"] = asdict(task.motion.table)
    return json.loads(json.dumps(said))


BUILT_IN = {name: plain(gc.builtin_task(name)) for name in ("coursework", "arm", "flat", "measured")}
BUILT_IN["arcs"] = plain(gc.builtin_arcs_task())


def random_place(seed: int) -> StudioPlace:
    """A random task, told from a random built-in one of another kind or its own, with or without what is shown."""
    random = np.random.default_rng([seed, 17])
    task = random_arcs_task(seed % 30) if seed % 10 == 9 else KINDS[seed % 3](seed)
    phi = round(random.uniform(0, 360), 1)
    shown = {"view": "combined", "step": "minimum_radius/the-minimum-prime-radius-2", "phi": phi, "mode": "predict"}
    kept = {name: value for name, value in shown.items() if random.integers(2)}
    pin = plain(KINDS[(seed + 1) % 3](seed)) if random.integers(2) else None
    return StudioPlace(plain(task), random.choice(list(BUILT_IN)).item(), **kept, pin=pin)


@pytest.mark.parametrize("block", range(10))
def test_500_random_tasks_come_back_as_they_were_in_a_short_address(block):
    for seed in range(50 * block, 50 * (block + 1)):
        place = random_place(seed)
        address = address_of(place, BUILT_IN)
        assert len(address) <= MAX_LENGTH
        assert place_of(address, BUILT_IN) == place


def test_an_address_needs_no_escaping():
    letters = set("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_")
    assert {letter for seed in range(50) for letter in address_of(random_place(seed), BUILT_IN)[3:]} <= letters


def test_an_address_says_what_differs_and_nothing_else():
    task = replace(gc.builtin_task(), follower=replace(gc.builtin_task().follower, offset=None))
    address = address_of(StudioPlace(plain(task)), BUILT_IN)
    packed = base64.urlsafe_b64decode(address[3:] + "==")
    assert json.loads(zlib.decompress(packed, -15)) == {"b": "coursework", "d": {"follower.offset": None}}
    assert len(address_of(StudioPlace(BUILT_IN["measured"], "measured"), BUILT_IN)) < 30


def test_a_new_phase_and_a_changed_angle():
    task = BUILT_IN["coursework"]
    longer = json.loads(json.dumps(task))
    longer["motion"]["phases"][0]["angle"] = 60
    longer["motion"]["phases"].append({"kind": "dwell", "angle": 20})
    place = StudioPlace(longer)
    assert place_of(address_of(place, BUILT_IN), BUILT_IN) == place


def of(state: object) -> str:
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    return "#1." + base64.urlsafe_b64encode(
        packer.compress(json.dumps(state).encode()) + packer.flush()
    ).decode().rstrip("=")


def test_what_nobody_knows_is_passed_over():
    state = {"b": "coursework", "new": {"x": 1}, "v": "profile", "p": "a", "s": 4, "m": None,
             "d": {"cam.prime_radius": 50, "motion.phases[9].angle": 1, "motion.phases[9]": {}, "": 3,
                   "rotation.cw": 1, "motion.phases.law": "x"}}  # fmt: skip
    place = place_of(of(state), BUILT_IN)
    expected = json.loads(json.dumps(BUILT_IN["coursework"]))
    expected["cam"] = {"prime_radius": 50}
    assert place == StudioPlace(expected, view="profile")


def test_the_built_in_task_stays_as_it_is():
    before = json.dumps(BUILT_IN)
    place_of(of({"d": {"motion.phases[0].angle": 1, "title.name": "x"}}), BUILT_IN)
    assert json.dumps(BUILT_IN) == before


@pytest.mark.parametrize(
    "address",
    ["", "#", "#2.abc", "#1.", "#1.$$$$", "#1.AAAA", "#t=abc", of([]), of({"b": "other"}), of({"b": 3}), of({"d": []}),
     "#1." + "A" * MAX_LENGTH, "#1.é"],
)  # fmt: skip
def test_what_is_no_address_is_told(address):
    with pytest.raises(gc.DesignError, match="must be an address of the studio; open the address as it was given"):
        place_of(address, BUILT_IN)


def test_a_task_too_long_for_an_address_is_to_be_saved():
    measured = json.loads(json.dumps(BUILT_IN["measured"]))
    random = np.random.default_rng(3)
    measured["motion"]["table"]["rows"] = random.uniform(0, 30, (361, 2)).tolist()
    with pytest.raises(gc.DesignError, match="must be at most 2000 characters; save the task file"):
        address_of(StudioPlace(measured, "measured"), BUILT_IN)


TWIN = """async (address) => { const { write, read } = addressOf(studio.config), found = await read(address);
    return [found, await write({ view: null, step: null, phi: USUAL_PHI, ...found })]; }"""


@pytest.mark.slow
def test_the_page_reads_and_writes_the_same(opened):
    page = opened()
    for seed in range(0, 500, 9):
        place = random_place(seed)
        found, address = page.evaluate(TWIN, address_of(place, BUILT_IN))
        assert found["task"] == place.task
        assert (found["name"], found["pin"]) == (place.built_in, place.pin)
        assert [found.get(name) for name in ("view", "step", "phi")] == [place.view or "", place.step, place.phi]
        assert found["mode"] == (place.mode or "play")
        # What it writes of that is read here.
        assert place_of(address, BUILT_IN) == place
