"""Write the notebooks of the course as Jupyter opens them by a double click: NAME.ipynb of every NAME.py, without outputs.

    python notebooks/pair.py

The scripts are what is edited and read in a diff; the notebooks follow them, and a test says when this was forgotten.
"""

from pathlib import Path

import jupytext
import nbformat

FOLDER = Path(__file__).parent


def notebook_text(script: Path) -> str:
    """The notebook of a script, the same for every run: its cells are numbered."""
    notebook = jupytext.read(script)
    # Else Jupytext would take the two for one and write both.
    notebook.metadata.pop("jupytext", None)
    for number, cell in enumerate(notebook.cells, 1):
        cell["id"] = f"cell-{number}"
    nbformat.validate(notebook)
    return nbformat.writes(notebook, indent=1, ensure_ascii=False, sort_keys=True) + "\n"


if __name__ == "__main__":
    for script in sorted(FOLDER.glob("[0-9][0-9]_*.py")):
        script.with_suffix(".ipynb").write_text(notebook_text(script), encoding="utf-8", newline="\n")
