"""Output is there whole or not at all."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest

from graphcam.files import OutputError, digest, whole_file, whole_folder, write_new


def everything(folder: Path) -> list[str]:
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


def test_files_arrive_when_all_are_written(tmp_path):
    with whole_folder(tmp_path / "a" / "b") as draft:
        (draft / "one").write_text("1")
        (draft / "two").write_text("2")
        assert not (tmp_path / "a" / "b" / "one").exists()
    assert everything(tmp_path) == ["a", "a/b", "a/b/one", "a/b/two"]


def test_an_error_leaves_no_folder_that_was_not_there(tmp_path):
    (tmp_path / "a").mkdir()

    def fail() -> None:
        with whole_folder(tmp_path / "a" / "b" / "c") as draft:
            (draft / "one").write_text("1")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        fail()
    assert everything(tmp_path) == ["a"]


def test_an_error_leaves_what_was_there_as_it_was(tmp_path):
    (tmp_path / "one").write_text("old")

    def fail() -> None:
        with whole_folder(tmp_path) as draft:
            (draft / "one").write_text("new")
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        fail()
    assert everything(tmp_path) == ["one"]
    assert (tmp_path / "one").read_text() == "old"


def test_a_second_run_replaces_its_files_and_keeps_the_others(tmp_path):
    (tmp_path / "mine").write_text("mine")
    for text in ("first", "second"):
        with whole_folder(tmp_path) as draft:
            (draft / "one").write_text(text)
    assert everything(tmp_path) == ["mine", "one"]
    assert (tmp_path / "one").read_text() == "second"


def test_new_files_are_as_readable_as_any(tmp_path):
    (tmp_path / "plain").write_text("")
    with whole_folder(tmp_path) as draft:
        (draft / "one").write_text("")
    assert (tmp_path / "one").stat().st_mode == (tmp_path / "plain").stat().st_mode


def test_a_folder_in_the_place_of_a_file(tmp_path):
    (tmp_path / "two").mkdir()

    def write() -> None:
        with whole_folder(tmp_path) as draft:
            (draft / "one").write_text("1")
            (draft / "two").write_text("2")

    with pytest.raises(OutputError, match="two is a folder"):
        write()
    assert everything(tmp_path) == ["two"], "not even the first file has moved"


@pytest.mark.parametrize(
    "place", ["file", "file/out", "file/out/deeper", "/dev/null", "/dev/null/x", "/proc/out", "a\0b"]
)
def test_a_folder_that_cannot_be(place, tmp_path):
    (tmp_path / "file").write_text("")

    def write() -> None:
        with whole_folder(tmp_path / place):
            pytest.fail("there is nowhere to write")

    with pytest.raises(OutputError, match="choose another place") as caught:
        write()
    assert str(tmp_path / place) in str(caught.value)
    assert everything(tmp_path) == ["file"]


def test_a_new_file_is_new(tmp_path):
    write_new(tmp_path / "cam.toml", "é")
    assert (tmp_path / "cam.toml").read_bytes() == b"\xc3\xa9"
    with pytest.raises(OutputError, match="it already exists"):
        write_new(tmp_path / "cam.toml", "other")
    assert (tmp_path / "cam.toml").read_text(encoding="utf-8") == "é"


@pytest.mark.parametrize("place", ["nowhere/cam.toml", "file/cam.toml", "a\0b"])
def test_a_new_file_that_cannot_be(place, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="choose another place"):
        write_new(tmp_path / place, "")


def test_a_folder_without_a_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(OutputError, match=r"'\.' is the current one"), whole_folder(""):
        pytest.fail("nobody has said where")
    with whole_folder(".") as draft:
        (draft / "one").write_text("1")
    assert everything(tmp_path) == ["one"]


def test_former_files_go_with_the_new_ones_unless_somebody_has_changed_them(tmp_path):
    for name in ("kept", "gone", "changed"):
        (tmp_path / name).write_text("old")
    known = digest(tmp_path / "kept")
    (tmp_path / "changed").write_text("mine")
    with whole_folder(tmp_path, dict.fromkeys(["kept", "gone", "changed", "never there"], known)) as draft:
        (draft / "kept").write_text("new")
        assert (tmp_path / "gone").exists()
    assert everything(tmp_path) == ["changed", "kept"]
    assert (tmp_path / "kept").read_text() == "new"


def test_an_exchange_that_stops_halfway_is_undone(tmp_path, monkeypatch):
    """A disk may fail between two renames, and Ctrl-C may come there."""
    for name in ("one", "three", "two"):
        (tmp_path / name).write_text("old")
    known, rename, calls = digest(tmp_path / "three"), Path.replace, []

    def replace(source: Path, target: Path) -> Path:
        calls.append(source)
        if len(calls) == 5:
            raise KeyboardInterrupt
        return rename(source, target)

    monkeypatch.setattr(Path, "replace", replace)

    def write() -> None:
        with whole_folder(tmp_path, {"three": known}) as draft:
            (draft / "one").write_text("new")
            (draft / "two").write_text("new")

    with pytest.raises(KeyboardInterrupt):
        write()
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == dict.fromkeys(("one", "two", "three"), "old")


@pytest.mark.parametrize(
    ("number", "remedy"),
    [
        (errno.ENOSPC, "make room on the disk, or choose a folder on another one"),
        (errno.EDQUOT, "delete some of your files there"),
        (errno.EROFS, "choose a folder on a disk that can be written to"),
        (errno.ENAMETOOLONG, "choose a shorter name"),
        (errno.EACCES, "choose a folder in which you may write"),
    ],
)
def test_an_error_of_the_disk_names_the_path_and_what_to_do(tmp_path, number, remedy):
    """Of a write it names no file, of an opening one in the draft."""

    def fail(*named: str) -> None:
        with whole_folder(tmp_path / "out") as draft:
            (draft / "one").write_text("1")
            raise OSError(number, os.strerror(number), *(str(draft / name) for name in named))

    for named in ((), ("two",)):
        with pytest.raises(OutputError) as caught:
            fail(*named)
        said = f"the output '{tmp_path}/out' cannot be written ({os.strerror(number)}); {remedy}"
        assert str(caught.value).startswith(said)
        assert "\n" not in said
    assert everything(tmp_path) == []


@contextmanager
def small_disk(place: Path):
    """A disk of 64 KB, which takes the rights of root."""
    place.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", place], capture_output=True)
    if mounted.returncode:
        pytest.skip("no disk can be mounted here")
    try:
        yield
    finally:
        subprocess.run(["umount", place], check=True)


def test_a_full_disk_is_left_as_it_was(tmp_path):
    with small_disk(tmp_path / "disk"):
        (tmp_path / "disk" / "mine").write_text("mine")

        def write() -> None:
            with whole_folder(tmp_path / "disk") as draft:
                (draft / "mine").write_text("new")
                (draft / "large").write_bytes(bytes(100_000))

        def write_file() -> None:
            with whole_file(tmp_path / "disk" / "large") as draft:
                draft.write_bytes(bytes(100_000))

        def write_once() -> None:
            write_new(tmp_path / "disk" / "large", "0" * 100_000)

        for each in (write, write_file, write_once):
            with pytest.raises(OutputError, match=r"No space left on device\); make room"):
                each()
            assert everything(tmp_path / "disk") == ["mine"]
            assert (tmp_path / "disk" / "mine").read_text() == "mine"


def test_an_error_of_another_place_is_its_own(tmp_path):
    def fail() -> None:
        with whole_folder(tmp_path / "out"):
            (tmp_path / "no such file").read_text()

    with pytest.raises(FileNotFoundError):
        fail()


WRITING = """
import sys, time
from graphcam.files import whole_folder
with whole_folder(sys.argv[1]) as draft:
    (draft / "one").write_text("half of it")
    print("writing", flush=True)
    time.sleep(60)
"""


@contextmanager
def another_run(folder: Path):
    """A run that is writing into the folder."""
    with subprocess.Popen([sys.executable, "-c", WRITING, folder], stdout=subprocess.PIPE, text=True) as run:
        assert run.stdout is not None
        assert run.stdout.readline() == "writing\n"
        try:
            yield run
        finally:
            run.kill()


def test_the_next_run_clears_what_a_killed_one_left(tmp_path):
    with another_run(tmp_path) as run:
        run.send_signal(signal.SIGKILL)
        run.wait()
        (left,) = tmp_path.iterdir()
        with whole_folder(tmp_path) as draft:
            (draft / "two").write_text("2")
            assert not left.exists()
    assert everything(tmp_path) == ["two"]


def test_a_run_that_is_alive_keeps_its_draft(tmp_path):
    with another_run(tmp_path):
        (draft_of_the_other,) = tmp_path.iterdir()
        with whole_folder(tmp_path) as draft:
            (draft / "two").write_text("2")
        assert (draft_of_the_other / "new" / "one").read_text() == "half of it"


def test_only_drafts_are_cleared(tmp_path):
    (tmp_path / ".graphcam-notes").mkdir()
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / ".graphcam-draft-link").symlink_to(tmp_path / "elsewhere")
    (tmp_path / ".graphcam-draft-file").write_text("mine")
    before = everything(tmp_path)
    with whole_folder(tmp_path):
        pass
    assert everything(tmp_path) == before
