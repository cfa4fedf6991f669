"""A sweep into a folder of parts: the same rows for any number of workers, whatever dies on the way."""

from __future__ import annotations

import hashlib
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from functools import partial
from pathlib import Path

import pandas as pd
import pytest
from pyarrow import dataset as arrow_dataset
from typer.testing import CliRunner

from graphcam.cli import app
from graphcam.cli.shared import INPUT_ERROR_STATUS
from graphcam.files import OutputError
from graphcam.sweeps import dataset
from graphcam.sweeps.dataset import MANIFEST_FILE, parts_of, sweep_to_file, sweep_to_folder, write_part
from graphcam.sweeps.design_space import load_space
from graphcam.sweeps.shared_folder import SharedFolder
from graphcam.workers import WorkerPool, worker_pool

pytestmark = pytest.mark.slow

SPACE = """
rotation = ["ccw", "cw"]
[motion]
lift = 30
rise_angle = { start = 60, stop = 120, count = 4 }
return_angle = 90
rise_law = ["cycloidal", "rectangular"]
[cam]
prime_radius = [10, 50]
offset = 12
"""
LARGE = """
[motion]
lift = 30
rise_angle = { start = 60, stop = 120, count = 80 }
return_angle = 90
[cam]
prime_radius = { start = 40, stop = 90, count = 4000 }
offset = 12
"""
"""320,000 designs: seconds of work."""
PART_OF_LARGE = 16_384


@pytest.fixture
def space(tmp_path: Path) -> Path:
    path = tmp_path / "space.toml"
    path.write_text(SPACE)
    return path


@pytest.fixture
def small_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    """32 designs in seven parts, of one block each."""
    monkeypatch.setattr(dataset, "MAX_PART_DESIGNS", 5)
    monkeypatch.setattr(dataset, "BLOCK_DESIGNS", 5)


def threads(n: int) -> WorkerPool:
    return WorkerPool(partial(ThreadPoolExecutor, n), n)


def run(*arguments: object):
    return CliRunner().invoke(app, ["sweep", *map(str, arguments)])


def manifest(folder: Path) -> dict:
    return json.loads((folder / MANIFEST_FILE).read_text())


def sums(folder: Path) -> dict[str, str]:
    """The checksums of the parts that a reader of the folder finds."""
    found = {Path(file).name: Path(file).read_bytes() for file in arrow_dataset.dataset(folder).files}
    return {name: hashlib.sha256(content).hexdigest() for name, content in sorted(found.items())}


def recorded(folder: Path) -> dict[str, str]:
    return {part["file"]: part["sha256"] for part in manifest(folder)["parts"] if part["whole"]}


@pytest.mark.usefixtures("small_parts")
def test_the_parts_hold_the_rows_of_one_file_in_its_order(space, tmp_path):
    found = sweep_to_folder(load_space(space), str(tmp_path / "out"), threads(2))
    sweep_to_file(load_space(space), tmp_path / "one.parquet")
    one = pd.read_parquet(tmp_path / "one.parquet")
    pd.testing.assert_frame_equal(arrow_dataset.dataset(tmp_path / "out").to_table().to_pandas(), one, check_exact=True)
    pd.testing.assert_frame_equal(pd.read_parquet(tmp_path / "out"), one, check_exact=True)
    assert one["max_pressure_angle_rise_deg"].isna().sum() == 16  # the prime radius of 10 mm, under the offset
    assert (found.designs, found.parts) == (32, 7)
    assert found.feasible == one["feasible"].sum() > 0
    assert found.ranges["max_v"] == [one["max_v"].min(), one["max_v"].max()]
    assert found.bytes == sum(path.stat().st_size for path in (tmp_path / "out").glob("*.parquet"))


@pytest.mark.usefixtures("small_parts")
def test_the_manifest_says_what_the_parts_are(space, tmp_path):
    sweep_to_folder(load_space(space), str(tmp_path / "out"), threads(1))
    said = manifest(tmp_path / "out")
    assert said["whole"]
    assert [(part["first"], part["stop"]) for part in said["parts"]] == [(k, min(k + 5, 32)) for k in range(0, 32, 5)]
    assert recorded(tmp_path / "out") == sums(tmp_path / "out")
    assert said["space"]["motion"]["rise_angle"] == {"start": 60, "stop": 120, "count": 4}
    assert said["summary"]["designs"] == said["designs"] == 32
    assert sum(part["feasible"] for part in said["parts"]) == said["summary"]["feasible"]


@pytest.mark.usefixtures("small_parts")
def test_the_bits_do_not_depend_on_the_number_of_workers(space, tmp_path):
    for n in (1, 2, 3):
        sweep_to_folder(load_space(space), str(tmp_path / str(n)), threads(n))
    assert sums(tmp_path / "1") == sums(tmp_path / "2") == sums(tmp_path / "3")


@pytest.mark.usefixtures("small_parts")
def test_a_run_that_was_stopped_goes_on_with_the_parts_that_are_missing(space, tmp_path):
    designs, out = load_space(space), tmp_path / "out"
    sweep_to_folder(designs, str(tmp_path / "whole"), threads(1))

    def stop(done: int) -> None:
        if done >= 15:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep_to_folder(designs, str(out), threads(1), stop)
    half = manifest(out)
    assert not half["whole"]
    before = recorded(out)
    assert len(before) == 3
    times = {name: (out / name).stat().st_mtime_ns for name in before}
    done: list[int] = []
    sweep_to_folder(designs, str(out), threads(1), done.append)
    assert done == [20, 25, 30, 32]
    assert {name: (out / name).stat().st_mtime_ns for name in before} == times
    assert sums(out) == recorded(out) == sums(tmp_path / "whole")
    assert manifest(out)["summary"] | {"seconds": 0} == manifest(tmp_path / "whole")["summary"] | {"seconds": 0}


@pytest.mark.usefixtures("small_parts")
@pytest.mark.parametrize("harm", [lambda path: path.unlink(), lambda path: path.write_bytes(path.read_bytes()[:-1])])
def test_a_part_that_is_lost_or_cut_short_is_computed_again(space, tmp_path, harm):
    designs, out = load_space(space), tmp_path / "out"
    sweep_to_folder(designs, str(out), threads(1))
    whole = sums(out)
    harm(out / "part-00003.parquet")
    done: list[int] = []
    sweep_to_folder(designs, str(out), threads(1), done.append)
    assert done == [32]
    assert sums(out) == whole


@pytest.mark.usefixtures("small_parts")
def test_what_a_dead_worker_had_begun_is_passed_over_and_cleared_in_the_end(space, tmp_path):
    designs, out = load_space(space), tmp_path / "out"
    sweep_to_folder(designs, str(out), threads(1))
    whole, draft = sums(out), out / ".part-00003.parquet.0123456789"
    (out / "part-00003.parquet").rename(draft)
    draft.write_bytes(draft.read_bytes()[:100])
    assert set(whole) - set(sums(out)) == {"part-00003.parquet"}
    sweep_to_folder(designs, str(out), threads(1))
    assert not draft.exists()
    assert sums(out) == whole


@pytest.mark.usefixtures("small_parts")
def test_storage_without_folders_and_renames_holds_the_same(space, tmp_path):
    import fsspec

    sweep_to_folder(load_space(space), "memory://bucket/results", threads(1))
    sweep_to_folder(load_space(space), str(tmp_path / "out"), threads(1))
    memory = fsspec.filesystem("memory")
    held = {path.rpartition("/")[2]: memory.cat_file(path) for path in memory.ls("/bucket/results", detail=False)}
    memory.rm("/bucket", recursive=True)
    assert {
        name: hashlib.sha256(content).hexdigest() for name, content in held.items() if name != MANIFEST_FILE
    } == sums(tmp_path / "out")
    assert json.loads(held[MANIFEST_FILE])["whole"]


def test_a_small_space_has_parts_for_many_workers():
    assert len(parts_of(10**6)) == 31
    assert len(parts_of(10**8)) == pytest.approx(256, rel=0.05)


def test_a_million_million_designs_have_a_small_manifest_and_no_gap():
    parts = parts_of(10**12)
    assert len(parts) <= 10_000
    assert [part["first"] for part in parts[1:]] == [part["stop"] for part in parts[:-1]]
    assert (parts[0]["first"], parts[-1]["stop"]) == (0, 10**12)
    assert [part["file"] for part in parts] == sorted(part["file"] for part in parts)


# --- refused ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("lift = 30", "lift = 31", "space.motion.lift"),
        ("count = 4", "count = 5", "space.motion.rise_angle.count"),
        ("rotation =", 'quantities = ["max_v"]\nrotation =', "space.quantities"),
        ("offset = 12", "offset = 12\n[limits]\npressure_angle_rise = 40", "space.limits.pressure_angle_rise"),
    ],
)
def test_a_folder_of_another_space_is_refused_by_name(space, tmp_path, old, new, named):
    out = tmp_path / "out"
    sweep_to_folder(load_space(space), str(out), threads(1))
    before = (out / MANIFEST_FILE).read_bytes()
    space.write_text(SPACE.replace(old, new))
    result = run(space, "--out", out)
    assert (result.exit_code, len(result.stderr.splitlines())) == (INPUT_ERROR_STATUS, 1)
    assert f"of another sweep: {named} differs" in result.stderr
    assert (out / MANIFEST_FILE).read_bytes() == before


def test_a_folder_of_another_version_is_refused(space, tmp_path):
    out = tmp_path / "out"
    sweep_to_folder(load_space(space), str(out), threads(1))
    (out / MANIFEST_FILE).write_text(json.dumps(manifest(out) | {"graphcam": "0.0.1"}))
    result = run(space, "--out", out)
    assert (result.exit_code, len(result.stderr.splitlines())) == (INPUT_ERROR_STATUS, 1)
    assert "graphcam differs" in result.stderr


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("notes.txt", "mine", "it holds other files, such as notes.txt"),
        (MANIFEST_FILE, "{", "is no JSON"),
        (MANIFEST_FILE, "[]", "form"),
    ],
)
def test_a_folder_that_holds_something_else_is_left_alone(space, tmp_path, name, content, message):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / name).write_text(content)
    result = run(space, "--out", tmp_path / "out")
    assert (result.exit_code, len(result.stderr.splitlines())) == (INPUT_ERROR_STATUS, 1)
    assert message in result.stderr
    assert [(path.name, path.read_text()) for path in (tmp_path / "out").iterdir()] == [(name, content)]


@pytest.mark.parametrize(
    ("missing", "option", "message"),
    [
        ("fsspec.core", (), 'pip install ".[parquet]"'),
        ("distributed", ("--cluster", "tcp://127.0.0.1:9"), 'pip install ".[cluster]"'),
    ],
)
def test_what_is_not_installed_is_named_with_its_extra(space, tmp_path, monkeypatch, missing, option, message):
    monkeypatch.setitem(sys.modules, missing, None)
    result = run(space, "--out", tmp_path / "out", *option)
    assert (result.exit_code, len(result.stderr.splitlines())) == (INPUT_ERROR_STATUS, 1)
    assert message in result.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["space.toml"]


def test_a_worker_without_pyarrow_is_told(space, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(OutputError, match=r'no pyarrow; .*pip install "\.\[parquet\]"'):
        sweep_to_folder(load_space(space), str(tmp_path / "out"), threads(1))


@pytest.mark.filterwarnings("ignore")  # of the client that gives up
@pytest.mark.parametrize("address", ["tcp://127.0.0.1:9", "nowhere://there"])
def test_a_scheduler_that_does_not_answer_is_told_within_seconds(space, tmp_path, monkeypatch, address):
    monkeypatch.setattr("graphcam.workers.SCHEDULER_SECONDS", 0.5)
    result = run(space, "--out", tmp_path / "out", "--cluster", address)
    assert result.exit_code == INPUT_ERROR_STATUS
    assert f"no dask scheduler answers at '{address}'" in result.stderr
    assert not (tmp_path / "out").exists()


def test_a_cluster_writes_no_single_file(space, tmp_path):
    result = run(space, "--out", tmp_path / "out.csv", "--cluster", "tcp://127.0.0.1:9")
    assert (result.exit_code, len(result.stderr.splitlines())) == (INPUT_ERROR_STATUS, 1)
    assert "leave out the ending" in result.stderr


def test_a_worker_of_another_version_or_without_the_folder_writes_nothing(space, tmp_path):
    place, job = SharedFolder.open_folder(str(tmp_path / "out")), (0, "part-00000.parquet", 0, 5)
    assert "not 0.0.1" in str(write_part(load_space(space), place, "0.0.1", job))
    assert "all workers must share it" in str(write_part(load_space(space), place, dataset.__version__, job))
    assert list((tmp_path / "out").iterdir()) == []


def test_parts_whose_workers_died_are_told_and_missing(space, tmp_path, monkeypatch):
    monkeypatch.setattr(dataset, "results", lambda pool, function, jobs, batch: ((job, None) for job in jobs))
    with pytest.raises(OutputError, match=r"1 of 1 parts are missing.*start again"):
        sweep_to_folder(load_space(space), str(tmp_path / "out"), threads(1))
    assert not manifest(tmp_path / "out")["whole"]


# --- processes that are killed ---------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Path, dict[str, str]]]:
    """A large space, and the parts of a run that nothing happens to."""
    folder = tmp_path_factory.mktemp("large")
    (folder / "space.toml").write_text(LARGE)
    with pytest.MonkeyPatch.context() as patch:
        for name in ("MAX_PART_DESIGNS", "BLOCK_DESIGNS"):
            patch.setattr(dataset, name, PART_OF_LARGE)
        with closing(worker_pool(2, "")) as pool:
            sweep_to_folder(load_space(folder / "space.toml"), str(folder / "out"), pool)
        yield folder / "space.toml", sums(folder / "out")


def drafts(folder: Path) -> set[str]:
    return {path.name for path in folder.glob(".part-*")}


def until(ready: Callable[[], object], seconds: float = 60) -> None:
    end = time.monotonic() + seconds
    while not ready():
        assert time.monotonic() < end
        time.sleep(0.002)


@pytest.mark.filterwarnings("ignore")  # of the cluster's own closing
def test_a_worker_that_is_killed_twice_in_the_middle_of_a_part_changes_no_bit(undisturbed, tmp_path):
    from distributed import LocalCluster

    (space, whole), out, killed = undisturbed, tmp_path / "out", []
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        closing(worker_pool(1, cluster.scheduler_address)) as pool,
    ):

        def pid() -> int | None:
            """Of the first worker; None while it is started anew."""
            return getattr(cluster.workers[0].process.process, "pid", None)

        def kill() -> None:
            for dead in (0, 1):
                # What the dead had begun stays; now both are in the middle of another.
                until(lambda dead=dead: len(drafts(out)) >= 2 + dead and pid() not in (None, *killed))
                killed.append(pid())
                os.kill(killed[-1], signal.SIGKILL)

        with ThreadPoolExecutor(1) as killer:
            killing = killer.submit(kill)
            found = sweep_to_folder(load_space(space), str(out), pool)
            killing.result()
    assert len(set(killed)) == 2
    assert found.designs == 320_000
    assert sums(out) == recorded(out) == whole
    assert drafts(out) == set()
    assert len(arrow_dataset.dataset(out).to_table(columns=["feasible"])) == len(pd.read_parquet(out)) == 320_000


def test_a_run_that_is_killed_goes_on_and_ends_in_the_same_bits(undisturbed, tmp_path):
    (space, whole), out = undisturbed, tmp_path / "out"
    script = """
from graphcam.cli import main
from graphcam.sweeps import dataset

dataset.MAX_PART_DESIGNS = dataset.BLOCK_DESIGNS = 16_384
main()
"""
    command = [sys.executable, "-c", script, "sweep", str(space), "--out", str(out), "--workers", "2"]
    first = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    until(lambda: (out / MANIFEST_FILE).exists() and recorded(out))
    first.kill()
    first.wait()
    before = recorded(out)
    assert 0 < len(before) < len(whole)
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    assert "320000 designs" in done.stdout
    assert sums(out) == recorded(out) == whole
    assert before.items() <= whole.items()
