"""What a sweep finds, by quantity and as a table."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.sweeps.designs import Designs


class Swept(dict[str, NDArray[Any]]):
    """The quantities of a sweep by name, (n,) each; and with what differs from design to design, as a table."""

    def __init__(self, columns: Mapping[str, NDArray[Any]], designs: Designs) -> None:
        super().__init__(columns)
        self.designs = designs

    @property
    def array(self) -> NDArray[Any]:
        """(n,) a structured array: the sizes, laws and senses that differ, then the quantities."""
        columns = self.designs.varied | self
        kinds = [(name, column.dtype) for name, column in columns.items()]
        found = np.empty(len(self.designs), dtype=kinds)
        for name, column in columns.items():
            found[name] = column
        return found

    def frame(self) -> Any:
        """The same as a DataFrame of pandas, which must be installed."""
        import pandas

        return pandas.DataFrame(self.designs.varied | self)
