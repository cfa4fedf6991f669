"""Output is there whole or not at all."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphcam.files import OutputError, whole_folder, write_new


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
    with pytest.raises(OutputError, match="there already"):
        write_new(tmp_path / "cam.toml", "other")
    assert (tmp_path / "cam.toml").read_text(encoding="utf-8") == "é"


@pytest.mark.parametrize("place", ["nowhere/cam.toml", "file/cam.toml", "a\0b"])
def test_a_new_file_that_cannot_be(place, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="choose another place"):
        write_new(tmp_path / place, "")
