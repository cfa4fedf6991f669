"""Which student of a roster a text means: by id, by e-mail address, by name."""

import unicodedata
from collections.abc import Collection, Iterable
from difflib import get_close_matches
from itertools import permutations

from graphcam.exercises.course.roster import Student

MAX_NAME_PARTS = 4
"""Parts of a name that may stand in any order; of a longer one the order counts."""

MIN_LIKENESS = 0.75
"""How much of two texts must agree for the one to be a slip of the other."""


class Recognition:
    """The students of a roster by whatever may stand for them.

    >>> roster = Recognition([Student("s1", "Anna Berg", "a.berg@uni.edu"), Student("s2", "Ben Berg")])
    >>> roster.meant(["S 1"]), roster.meant(["berganna"]), roster.meant(["A.Berg@uni.edu"]), roster.meant(["Berg"])
    (['s1'], ['s1'], ['s1'], [])
    """

    def __init__(self, students: Iterable[Student]) -> None:
        self.ids = {student.id: student for student in students}
        self._by_text: dict[str, set[str]] = {}
        self._by_name: dict[str, set[str]] = {}
        for student in self.ids.values():
            for text in filter(None, map(_normalised, (student.id, student.email))):
                self._by_text.setdefault(text, set()).add(student.id)
            for name in _spellings(student.name):
                self._by_name.setdefault(name, set()).add(student.id)

    def meant(self, texts: Iterable[str]) -> list[str]:
        """The ids of all students whom one of the texts may mean."""
        found: set[str] = set()
        for text in texts:
            found |= self._by_text.get(_normalised(text), set()) | self._by_name.get(_letters(text), set())
        return sorted(found)

    def nearest(self, text: str, among: Collection[str]) -> Student | None:
        """The student of some ids whose id or name is most like a text; None where none is like it.

        >>> Recognition([Student("s1", "Eva Müller"), Student("s2", "Ben Berg")]).nearest("Mueller_E", ["s1", "s2"]).id
        's1'
        """
        spelled = {_normalised(student): student for student in among}
        spelled |= {name: one for one in sorted(among) for name in _spellings(self.ids[one].name)}
        close = get_close_matches(_letters(text), spelled, n=1, cutoff=MIN_LIKENESS)
        return self.ids[spelled[close[0]]] if close else None


def _normalised(text: str) -> str:
    """The text without what differs between systems: capitals, spaces, how an accent is coded."""
    return "".join(unicodedata.normalize("NFKC", text).casefold().split())


def _letters(text: str) -> str:
    """Letters and digits alone, without accents.

    >>> _letters("Müller, Anna")
    'mulleranna'
    """
    return "".join(letter for letter in unicodedata.normalize("NFKD", text.casefold()) if letter.isalnum())


def _spellings(name: str) -> set[str]:
    """A name with its parts in every order, since some systems put the last name first."""
    parts = [part for part in map(_letters, name.split()) if part]
    orders = permutations(parts) if len(parts) <= MAX_NAME_PARTS else [parts]
    return {"".join(order) for order in orders} - {""}
