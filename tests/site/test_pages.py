"""The how-tos are true: their commands run, their files exist, their code does what they say."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from mpmath import mp, mpf
from pages import HOW_TO, PAGES, ROOT, blocks, files, paths, rows, text_of

from graphcam.given import laws
from graphcam.mechanism import least_radius_translating as least_radius

WITH_COMMANDS = [page for page in HOW_TO if blocks(page, "bash")]
NAMED = "5-6-7-8-9"


def test_every_page_is_written_for_somebody_and_says_what_to_do():
    for page in (
        "sheets-for-my-group",
        "grade-a-group",
        "write-an-exercise",
        "check-my-drawing",
        "add-a-law",
        "add-a-language",
        "add-a-construction",
    ):
        assert f"how-to/{page}.md" in HOW_TO
    for page in HOW_TO:
        assert text_of(page).startswith("# ")
        assert blocks(page, "bash") or blocks(page, "sh"), page


@pytest.mark.parametrize("page", sorted(str(path.relative_to(PAGES)) for path in PAGES.rglob("*.md")))
def test_the_files_that_a_page_names_are_there(page):
    missing = [path for path in paths(page) if not (ROOT / path).exists()]
    assert missing == []


@pytest.mark.parametrize("page", [page for page in HOW_TO if rows(page)])
def test_what_a_table_says_of_a_file_stands_in_it(page):
    for path, names in rows(page).items():
        held = (ROOT / path).read_text(encoding="utf-8")
        assert [name for name in names if name not in held] == [], path


@pytest.mark.slow
@pytest.mark.parametrize("page", WITH_COMMANDS)
def test_the_commands_of_a_page_run_in_order(page, tmp_path):
    for name, text in files(page).items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    graphcam = f'graphcam() {{ "{sys.executable}" -W error::UserWarning -m graphcam "$@"; }}'
    script = "\n".join(["set -euo pipefail", graphcam, *blocks(page, "bash")])
    done = subprocess.run(
        ["bash", "-c", script], cwd=tmp_path, capture_output=True, text=True, check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "warning" not in done.stderr


def commands_for_developers() -> list[str]:
    return [line for page in HOW_TO for block in blocks(page, "sh") for line in block.splitlines()]


def test_developers_are_sent_to_tests_that_are_there():
    given = [line.split() for line in commands_for_developers()]
    assert given
    for program, *arguments in given:
        assert program in ("pytest", "graphcam", "pybabel", "mkdir")
        if program == "pytest":
            assert all((ROOT / path).exists() for path in arguments)


def test_the_commands_for_a_language_find_the_texts(tmp_path):
    """With the paths of the clone, and what they write laid into a folder of our own."""
    page = "how-to/add-a-language.md"
    script = "\n".join(line for block in blocks(page, "sh") for line in block.splitlines() if "pybabel" in line)
    script = script.replace("build/", f"{tmp_path}/").replace("-o graphcam/data/languages/", f"-o {tmp_path}/")
    # pybabel lies beside the interpreter, whether or not its environment is activated.
    environment = {**os.environ, "PATH": os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])}
    done = subprocess.run(
        ["bash", "-euc", script], cwd=ROOT, capture_output=True, text=True, check=False, env=environment
    )
    assert done.returncode == 0, done.stderr
    begun = (tmp_path / "de.po").read_text(encoding="utf-8")
    for told in ('msgid "Velocity plan', "msgctxt ", "msgid_plural "):
        assert told in begun


@pytest.fixture
def with_the_law(monkeypatch):
    """The law of the page, added as the page says."""
    formula, entry, closed_form = blocks("how-to/add-a-law.md", "python")
    names = dict(vars(laws))
    exec(formula, names)
    monkeypatch.setattr(laws, "_SYMMETRIC", laws._SYMMETRIC | eval(f"{{{entry}}}", names))
    monkeypatch.setattr(laws, "LAWS", (*laws.LAWS, NAMED))
    monkeypatch.setattr(least_radius, "_POLYNOMIALS", least_radius._POLYNOMIALS | eval(f"{{{closed_form}}}"))
    yield laws.law(NAMED)
    laws._built.cache_clear()


def test_the_law_of_the_page_is_the_polynomial_that_it_names(with_the_law):
    """Against the integral of 630 u^4 (1 - u)^4, term by term and at 50 digits."""
    terms = [(5, 126), (6, -420), (7, 540), (8, -315), (9, 70)]
    u = np.linspace(0, 1, 41)
    values = with_the_law(u)
    with mp.workdps(50):
        for k, value in enumerate(values):
            exact = [sum(c * mpf(math.perm(n, k)) * mpf(x) ** (n - k) for n, c in terms) for x in u]
            np.testing.assert_allclose(value, np.array(exact, dtype=float), rtol=1e-14, atol=1e-13 * 10**k)
    fine = with_the_law(np.linspace(0, 1, 100_001))
    assert fine[1].max() == pytest.approx(with_the_law.peak_velocity, rel=1e-9)
    assert np.abs(fine[2]).max() == pytest.approx(with_the_law.peak_acceleration, rel=1e-8)


@pytest.mark.parametrize("k", [0.05, 0.5, 3.0, 40.0])
def test_the_closed_form_of_the_page_is_the_steepest_line(with_the_law, k):
    f, df = with_the_law(np.linspace(0, 1, 200_001), derivatives=1)
    assert least_radius.steepest_line(with_the_law, k) == pytest.approx((df - f / k).max(), rel=1e-7)
