"""The square tags along the edges of a printed page: the first ones of the family AprilTag 36h11.

A tag is 8 x 8 cells: a black border of one cell about 6 x 6 cells that say its number.  About it the paper is white.
"""

import numpy as np
from numpy.typing import NDArray

CELLS_PER_SIDE = 8
"""The number of cells of a tag in either direction, its border included."""
TAG_COUNT = 48
"""The number of known tags, which are numbered from 0."""
_INNER_CELLS = CELLS_PER_SIDE - 2
_TAG_CODES = (
    *(0x21A146BAB, 0x92D18FE9B, 0x7089014BB, 0x193979E27, 0x44153D3D7, 0x35CD5B8CF),
    *(0xA10BA56A0, 0x2B874A608, 0xB57FB8D44, 0x4E20B5A64, 0x61D897F2C, 0xAB3469FFC),
    *(0x594CA45C2, 0xFA1C2D2E2, 0x97C24B972, 0x75928624A, 0x1CAAFE99A, 0x3236DDC16),
    *(0x884E527D6, 0x5771A8C7E, 0xF52925B81, 0x2E59CC1A1, 0x7FA58AB31, 0xEB43384F9),
    *(0x3913D5345, 0xD79B1A3B5, 0x0DFBE768D, 0x5CD7A031D, 0xB9C8F7A4B, 0x46987E06B),
    *(0x6E0C5D527, 0x5BC567BB4, 0x1E6302BC2, 0x8AC7D046A, 0xA65FE2326, 0x5400EB616),
    *(0xF7A066836, 0x2DD0AFDF6, 0x3B9CB60B1, 0xAD6A1CAF9, 0x93B62EFB5, 0xBB210D93D),
    *(0xDEE55094B, 0xA0CD1479B, 0x2A23ABB27, 0x4F67F4B5F, 0x58A815818, 0x743427D64),
)
"""The white cells inside the border by tag: row by row from the upper left, the first in the highest of 36 bits."""


def dark_cells(number: int) -> NDArray[np.bool_]:
    """Flags (8, 8) of the black cells of a tag, the top row first.

    Raises
    ------
    IndexError : there is no tag of that number

    >>> dark_cells(0)[1].astype(int).tolist()
    [1, 1, 1, 0, 1, 1, 1, 1]
    """
    if not 0 <= number < TAG_COUNT:
        raise IndexError(number)
    code = _TAG_CODES[number]
    white = [code >> (_INNER_CELLS**2 - 1 - k) & 1 for k in range(_INNER_CELLS**2)]
    cells = np.ones((CELLS_PER_SIDE, CELLS_PER_SIDE), dtype=np.bool_)
    cells[1:-1, 1:-1] = np.reshape(white, (_INNER_CELLS, _INNER_CELLS)) == 0
    return cells
