"""Tasks at random, of every kind that a task file knows, solved by the command with all files and any of its options.

``python tests/solving/whole_tasks.py --cases 100 --seed 0`` prints what became of each, with the sentence of a refusal;
``--only SEED`` keeps the task file and what was written of one case in the folder that ``--out`` names.
"""

from __future__ import annotations

import argparse
import json
import math
import re
import sys
import tempfile
import traceback
import warnings
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import tomli_w
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app

PLACEHOLDER = re.compile(r"\{[a-z_]+(:[^}]*)?\}|\b(nan|None|inf)\b")
"""What no text for a reader holds."""
FORMULA = re.compile(r"\$\$.*?\$\$|\$.*?\$", re.DOTALL)


class Chance:
    """Choices at random: one of several, a number of a span, to some figures."""

    def __init__(self, seed: int) -> None:
        self.random = np.random.default_rng([11, seed])

    def of(self, *values: Any) -> Any:
        """One of these."""
        return values[int(self.random.integers(len(values)))]

    def maybe(self, share: float) -> bool:
        """Whether something happens that happens so often."""
        return bool(self.random.random() < share)

    def size(self, low: float, high: float, figures: int = 2) -> float:
        """A number of the span to so many significant figures."""
        return float(f"{self.random.uniform(low, high):.{figures}g}")

    def some(self, share: float, **keys: Any) -> dict[str, Any]:
        """Each of these keys as often as the share says."""
        return {key: value for key, value in keys.items() if self.maybe(share)}


def law(chance: Chance) -> dict[str, Any]:
    """A law of motion with the keys that it takes."""
    name = chance.of(*gc.LAWS)
    keys: dict[str, Any] = {"law": name}
    if name == "constant-velocity":
        keys["blends"] = chance.of([0, 0], [0.1, 0.1], [0.02, 0.2], [0.25, 0.25])
    elif chance.maybe(0.2) and name in ("rectangular", "cycloidal", "modified-sine", "triangular"):
        keys["ratio"] = chance.of(0.5, 1.5, 2)
    return keys


def turn(chance: Chance, lift: float) -> list[dict[str, Any]]:
    """Phases that close: one stroke or two, in one stage or several, with dwells or without."""
    moves = []
    for _ in range(chance.of(1, 1, 1, 2)):
        stages = chance.of([1.0], [1.0], [1.0], [0.4, 0.6])
        moves += [{"kind": "rise", "lift": round(share * lift, 3), **law(chance)} for share in stages]
        moves.append({"kind": "return", "lift": lift, **law(chance)})
    phases = []
    for move in moves:
        phases += [move, *([{"kind": "dwell"}] if chance.maybe(0.7) else [])]
    if chance.maybe(0.15):
        phases = phases[-1:] + phases[:-1]
    weights = [5.0 if "lift" in phase else 2.0 for phase in phases]
    angles = np.round(chance.random.dirichlet(weights) * (360 - 8 * len(phases)) + 8)
    angles[int(np.argmax(angles))] += 360 - angles.sum()
    return [{**phase, "angle": float(angle)} for phase, angle in zip(phases, angles, strict=True)]


def rows_of(phases: list[dict[str, Any]], chance: Chance, column: str) -> str:
    """A table of a motion by these phases as an instrument gives it."""
    names = {"rise": gc.Rise, "return": gc.Return}
    made = []
    for phase in phases:
        angle = math.radians(phase["angle"])
        one = "cycloidal" if phase.get("law") == "constant-velocity" else phase.get("law")
        made.append(gc.Dwell(angle) if one is None else names[phase["kind"]](phase["lift"], angle, one))
    step, figures = chance.of(1, 2, 5), chance.of(2, 3, 4)
    phi = np.arange(0, 360, step)
    s = gc.Motion(made)(np.radians(phi)).s + chance.of(0, 0, 0.005) * chance.random.standard_normal(phi.size)
    return "\n".join([f"phi_deg,{column}", *(f"{p},{v:.{figures}f}" for p, v in zip(phi, s, strict=True))]) + "\n"


def outline(chance: Chance) -> str:
    """Points of an outline: a circle whose radius rises and falls."""
    angle = np.arange(0, 360, chance.of(1, 2, 5))
    base, lift = chance.size(25, 45), chance.size(3, 10)
    radius = base + lift * 0.5 * (1 - np.cos(np.radians(angle))) ** chance.of(1, 1.5)
    return "\n".join(["angle_deg,radius_mm", *(f"{a},{r:.4f}" for a, r in zip(angle, radius, strict=True))]) + "\n"


def radii(chance: Chance) -> dict[str, Any]:
    """Radii that make a cam, a flank that is round, straight or hollow, or an eccentric disc."""
    base = chance.size(20, 40)
    keys = {"base_radius": base, "lift": chance.size(4, 14)}
    kind = chance.of("round", "straight", "hollow", "disc")
    if kind != "disc":
        flank = {"round": chance.size(2, 6) * base, "straight": "straight", "hollow": -chance.size(3, 6) * base}[kind]
        further = chance.of({"nose_radius": chance.size(4, 12)}, {"ascent": chance.of(60, 70, 80)})
        keys |= {"flank_radius": flank, **further}
        keys |= chance.some(0.3, dwell=chance.of(10, 20))
    return keys


def follower(chance: Chance, lift: float) -> tuple[dict[str, Any], dict[str, Any]]:
    """A follower and the prime radius that goes with it."""
    kind = chance.of("translating", "translating", "oscillating", "flat-faced", "oscillating-flat")
    prime = round(lift * chance.size(2, 4), 0)
    roller = chance.some(0.7, roller_radius=chance.of(0, 0.2, 0.3, 0.4) * prime)
    cam: dict[str, Any] = chance.some(0.5, prime_radius=prime)
    if kind == "translating":
        return {"kind": kind, **chance.some(0.7, offset=chance.of(0, 0.2, -0.2, 0.4) * prime), **roller}, cam
    if kind == "oscillating":
        arm = round(lift * chance.size(3, 5), 0)
        sizes = {"arm": arm, **chance.some(0.7, distance=round(math.hypot(arm, prime), 0)), "lift": "arc"}
        return {"kind": kind, **sizes, **roller}, cam
    if kind == "flat-faced":
        return {"kind": kind, **chance.some(0.5, face_margin=5)}, cam
    distance, offset = round(prime * chance.size(2, 4), 0), chance.some(0.4, face_offset=chance.of(-5, 5))
    return {"kind": kind, "distance": distance, **offset}, cam


def further(chance: Chance, kind: str) -> dict[str, Any]:
    """Tables that a task may have besides."""
    swings = kind.startswith("oscillating")
    tables: dict[str, Any] = {"rotation": chance.of("cw", "ccw"), **chance.some(0.6, speed_rpm=chance.of(60, 200, 600))}
    if "speed_rpm" in tables and chance.maybe(0.4):
        body = {"inertia": chance.size(100, 5000)} if swings else {"mass": chance.size(0.1, 2)}
        spring = {"stiffness": chance.size(1, 30) * (1000 if swings else 1)}
        spring |= chance.some(0.4, preload=chance.size(10, 200) * (50 if swings else 1), friction=chance.of(0.05, 0.1))
        tables["spring"] = body | spring | chance.some(0.3, damping=chance.size(1, 20))
        if chance.maybe(0.6):
            tables["material"] = {"width": chance.size(8, 20)} | chance.some(0.5, permitted_stress=chance.of(600, 1200))
    if chance.maybe(0.2):
        tables["tolerances"] = {"waviness": [0.01, 0.02], "harmonics": [2, 3]}
    if chance.maybe(0.2):
        tables["part"] = {"bore": chance.of(12, 16, 20)} | chance.some(0.5, keyway="din6885", width=15.0)
    limits = chance.some(0.3, pressure_angle_rise=chance.of(25, 30, 40), pressure_angle_return=chance.of(30, 45, 60))
    limits = {} if kind.endswith(("flat", "faced")) else limits
    limits |= chance.some(0.15, min_curvature_radius=chance.size(2, 12))
    if limits:
        tables["limits"] = limits
    drawing = chance.some(0.15, divisions=chance.of(6, 12, 18), jerk=True, whole_turn=True, frame="iso", ordinate=60)
    drawing |= chance.some(0.3, language=chance.of("ru", "vi", "zh")) | {"format": chance.of("A1", "A2", "A3", "A4")}
    return tables | {"drawing": drawing}


def random_task(seed: int) -> tuple[dict[str, Any], dict[str, str], list[str]]:
    """A task, the tables beside it by their names, and the options of the command."""
    chance = Chance(seed)
    lift = chance.size(5, 40)
    held, cam = follower(chance, lift)
    source = chance.of("phases", "phases", "phases", "table", "radii", "outline")
    files: dict[str, str] = {}
    task: dict[str, Any] = {}
    degrees = held["kind"] == "oscillating-flat"
    phases = turn(chance, chance.size(5, 20) if degrees else lift)
    if source == "phases":
        task["motion"] = {"phases": phases}
    elif source == "table":
        held.pop("lift", None)
        column = "s_deg" if held["kind"].startswith("oscillating") else "s_mm"
        task["motion"], files["lift.csv"] = {"table": "lift.csv"}, rows_of(phases, chance, column)
    else:
        held.pop("lift", None)
        cam = {}
        if held["kind"] == "oscillating":
            held |= {"arm": 80.0, "distance": 95.0}
        if held["kind"] in ("translating", "oscillating"):
            held = {"roller_radius": 10.0, **held}
        task |= {"arcs": radii(chance)} if source == "radii" else {"outline": {"file": "cam.csv"}}
        if source == "outline":
            files["cam.csv"] = outline(chance)
    task |= {"follower": held, **({"cam": cam} if cam else {}), **further(chance, held["kind"])}
    options: list[str] = chance.of(
        [], [], ["--pencil", "0.2"], ["--worksheet"], ["--per-construction"], ["--dxf", "cad"]
    )
    if chance.maybe(0.1):
        options = ["--upto", chance.of("integration", "inversion", "2")]
    if "part" in task and not {"--worksheet", "--upto"} & {*options}:  # which would tell the answers
        options = [*options, "--working-drawing"]
    return task, files, options


def outcome(seed: int, folder: Path) -> str:
    """What became of a case: "solved", "refused: ..." or "fault: ..."."""
    task, files, options = random_task(seed)
    (folder / "cam.toml").write_text(tomli_w.dumps(task), encoding="utf-8")
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    out = folder / "out"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ran = CliRunner().invoke(app, ["solve", str(folder / "cam.toml"), "--out", str(out), *options])
    if ran.exit_code == 2:
        said = " ".join(ran.stderr.split()).split("cam.toml: ")[-1]
        return f"fault: half written, {said}" if out.exists() else f"refused: {said}"
    if ran.exit_code != 0:
        assert ran.exc_info is not None
        last = traceback.extract_tb(ran.exc_info[2])[-1]
        return f"fault: {ran.exception!r} in {Path(last.filename).name}:{last.lineno}"
    for path in [*sorted(out.glob("*.md")), out / "solution.json"]:
        text = FORMULA.sub("", path.read_text(encoding="utf-8"))
        if path.suffix == ".json":
            json.loads(text, parse_constant=_refuse)
        elif found := PLACEHOLDER.search(text):
            return f"fault: {path.name} holds {text[max(0, found.start() - 60) : found.end() + 40]!r}"
    return "solved"


def _refuse(name: str) -> float:
    raise ValueError(f"{name} in solution.json")


def main(arguments: list[str] | None = None) -> int:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0, help="the first one")
    parser.add_argument("--only", type=int, help="the seed of one case")
    parser.add_argument("--out", type=Path, default=Path("case"))
    asked = parser.parse_args(arguments)
    if asked.only is not None:
        asked.out.mkdir(parents=True, exist_ok=True)
        sys.stdout.write(f"{outcome(asked.only, asked.out)}\n")
        return 0
    found: Counter[str] = Counter()
    for seed in range(asked.seed, asked.seed + asked.cases):
        with tempfile.TemporaryDirectory() as folder:
            said = outcome(seed, Path(folder))
        found[said.split(":")[0]] += 1
        if said != "solved":
            sys.stdout.write(f"{seed}: {said}\n")
            sys.stdout.flush()
    sys.stdout.write(f"{dict(found)}\n")
    return int(found["fault"] > 0)


if __name__ == "__main__":
    sys.exit(main())
