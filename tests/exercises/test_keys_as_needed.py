"""The keys of a course are read as they are needed, and who has none is left out."""

from pathlib import Path

from issued_variants import SECRET

from graphcam.exercises.course.course_folder import AnswerKeys, KeysAsNeeded
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.key.key_making import issue


def test_who_has_no_key_that_can_be_read_is_left_out(tmp_path: Path):
    kept = AnswerKeys(tmp_path)
    _, key = issue(find_exercise("integration"), "Anna", SECRET)
    kept.keep("Anna", key.to_json())
    kept.keep("Ben", key.to_json()[:-9])
    needed = KeysAsNeeded(kept, ["Anna", "Ben", "Cora"])
    assert [*needed] == ["Anna"]
    assert len(needed) == 1
    assert (needed.get("Ben"), needed.get("Cora")) == (None, None)
    assert needed["Anna"].to_json() == key.to_json()
    # Nothing is held: what has changed meanwhile is read.
    kept.keep("Ben", key.to_json())
    assert [*needed] == ["Anna", "Ben"]
