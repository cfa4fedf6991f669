"""A photograph that cannot be read: why not, and what to do about it."""

from __future__ import annotations

from graphcam.errors import GraphcamError
from graphcam.words import Words


class PhotographError(GraphcamError):
    """A photograph, or what is drawn on it, that is not read; nothing of it is marked.

    why : a sentence without its full stop ("only 2 of 8 marks are seen")
    remedy : what to do about it ("take in the whole sheet")

    >>> print(PhotographError("the picture is blurred", "hold still"))
    the picture is blurred; hold still
    """

    def __init__(self, why: Words, remedy: Words) -> None:
        super().__init__(why, remedy)
        self.why = why
        self.advice = remedy

    @property
    def fault(self) -> Words:
        """Why it is not read."""
        return self.why
