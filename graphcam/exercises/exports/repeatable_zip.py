"""Zip files whose bytes depend on what is in them alone."""

import zipfile
from collections.abc import Mapping
from pathlib import Path

EARLIEST = (1980, 1, 1, 0, 0, 0)
"""Date of all files, the first that a zip can tell: the same files make the same zip."""


def write_zip(path: Path, files: Mapping[str, bytes]) -> None:
    """Write files, by their names in it, into a zip."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            file = zipfile.ZipInfo(name, EARLIEST)
            file.external_attr = 0o644 << 16
            archive.writestr(file, data, zipfile.ZIP_DEFLATED)
