"""Python for browsers, found in a folder and each file of a known sum, and the engine as an archive beside it.

A page carries these files to everybody who opens it, so none goes into it unchecked: what graphcam was tested with is
known here by its SHA-256, the NumPy of such a release by the list that Pyodide itself keeps, and anything else only by
a file ``SHA256SUMS`` of the user's own.

The archives are not compressed: what carries them compresses the whole, which is smaller and is unpacked faster.
"""

from __future__ import annotations

import ast
import hashlib
import io
import json
import re
import tarfile
import zipfile
from collections.abc import Iterator, Mapping
from importlib.metadata import distribution
from importlib.resources import files
from pathlib import Path, PurePosixPath

from graphcam.errors import MissingFileError, TaskError
from graphcam.words import bare_caption, or_list, say

LOADER_FILE, GLUE_FILE, BINARY_FILE = "pyodide.js", "pyodide.asm.js", "pyodide.asm.wasm"
STANDARD_LIBRARY_FILE, LOCK_FILE = "python_stdlib.zip", "pyodide-lock.json"
CORE_FILES = (LOADER_FILE, GLUE_FILE, BINARY_FILE, STANDARD_LIBRARY_FILE, LOCK_FILE)
"""The files of Pyodide itself."""
NUMPY_FILE = "numpy.zip"
"""NumPy as the page carries it."""
KNOWN_SUMS: Mapping[str, str] = {
    LOADER_FILE: "b4cb23a53aba19c221659b9fb40a2f18281d685691dc06647fb0afd0681baf98",
    GLUE_FILE: "6b4c90de5b7172873f04f21884d0e9d2274e305fe32116558fe3e4fbe3618d51",
    BINARY_FILE: "a50dd1843f805a0b7c45b61037ee0d7b26dfe85efe0e18ef95a34ad24e401f5f",
    STANDARD_LIBRARY_FILE: "16611534726e5d8ac2bd8f926410b2dcb8d6f49aa24913463533b457a2115c16",
    LOCK_FILE: "9c45b916001a750f4102fc287494f3eab215909c7535c626a20db80fd6333e2c",
    "numpy-2.0.1-py312h4e66579_0.tar.gz": "608a8525a002505e620f9264738a9f95710de52d577276b37ccb881d662be6d6",
}
"""SHA-256 of what graphcam was tested with: npm's pyodide 0.27.7 and @emscripten-forge/numpy 2.0.1."""
PACKING_COMMAND = say("npm pack pyodide@0.27.7 @emscripten-forge/numpy@2.0.1-py312h4e66579-0")
SUMS_FILE = "SHA256SUMS"
"""A user's own file of sums, as ``sha256sum`` writes it."""
_NUMPY_PATTERN = re.compile(r"numpy-[^-]+-.*\.(whl|tar\.gz)")


UNUSED_FOLDERS = frozenset(
    {
        *("tests", "testing", "f2py", "include", "_examples", "_pyinstaller", "pkgconfig"),
        *("fft", "doc"),
    }
)
UNUSED_ENDINGS = (".pyi", ".pxd", ".pyx", ".h", ".c", ".a", "RECORD")
UNUSED_MODULES = (
    *("_multiarray_tests.", "_simd.", "_umath_tests.", "_rational_tests.", "_struct_ufunc_tests.", "_operand"),
    *("lapack_lite.", "mtrand.", "_mt19937.", "_philox.", "_sfc64.", "_pickle."),
    *("hermite.", "hermite_e.", "laguerre."),
)
"""Of NumPy what is for tests, compilers, type checkers or installers, and what no drawing needs."""
OTHER_MODULES: Mapping[str, bytes] = {
    **dict.fromkeys(("numpy/_core/_add_newdocs.py", "numpy/_core/_add_newdocs_scalars.py"), b""),
    "numpy/polynomial/__init__.py": b"from . import chebyshev, legendre, polynomial\n",
    "numpy/random/__init__.py": b"from ._generator import Generator, default_rng\n",
}
"""What stands in modules of NumPy in place of what they have: those that only say what it does are empty, and of the
random numbers and of polynomials there are the kinds that a cam needs."""
UNUSED_LIBRARIES = frozenset(
    {
        *("multiprocessing", "unittest", "xml", "xmlrpc", "wsgiref", "pydoc.py", "doctest.py", "pdb.py", "bdb.py"),
        *("idlelib", "lib2to3", "difflib.py", "_pyio.py", "pickletools.py", "optparse.py", "imaplib.py", "mailbox.py"),
        *("smtplib.py", "nntplib.py", "ftplib.py", "telnetlib.py", "poplib.py", "cgi.py", "cgitb.py"),
        *("trace.py", "pstats.py", "profile.py", "cProfile.py", "aifc.py", "sunau.py", "wave.py", "modulefinder.py"),
        *("plistlib.py", "socketserver.py", "turtle.py", "tabnanny.py", "pyclbr.py", "zipapp.py"),
        *("shelve.py", "sndhdr.py", "pipes.py", "mailcap.py", "xdrlib.py", "crypt.py", "compileall.py", "timeit.py"),
        *("http", "email", "ctypes", "sqlite3", "curses", "dbm", "tkinter", "ensurepip", "venv", "pydoc_data"),
        *("tarfile.py", "argparse.py", "configparser.py", "zoneinfo", "uuid.py", "_pydatetime.py"),
        *("calendar.py", "_strptime.py", "mimetypes.py", "pprint.py", "cmd.py", "fileinput.py", "runpy.py", "code.py"),
        *("stringprep.py", "_markupbase.py", "filecmp.py", "symtable.py", "py_compile.py", "getopt.py"),
        *("urllib/request.py", "urllib/robotparser.py", "logging/handlers.py", "logging/config.py", "html/parser.py"),
    }
)
"""Of Python's own library what nothing here asks for."""
KEPT_CODECS = re.compile(
    r"encodings/(__init__|aliases|ascii|utf_\w+|latin_1|cp(437|866|125\d)|idna|punycode|raw_\w+)\.py"
)
"""Encodings of its files, and of those that somebody may open."""
ROOMS_ABOVE = frozenset({"__main__.py", "cli", "exercises", "notebooks", "bench", "plots", "photo", "sweeps"})
"""The rooms of graphcam that the studio does not need: above it, and sweeps and photographs beside it."""
UNREAD_FILES = frozenset(
    {
        *("hard_cases.toml", "space.toml"),
        *("matplotlib_renderer.py", "dxf_renderer.py", "cad_renderer.py", "output_folder.py", "sizing_files.py"),
        *("server.py", "local_studio.py", "widget.py", "studio_page.py", "worker_page.py", "pyodide_parts.py"),
        *("commented_task.py", "help_texts.py", "examples.toml"),
        *("working_drawing.py", "part_layout.py", "part_views.py", "part_contents.py", "part_symbols.py"),
        *("cutting_files.py", "cutter_path.py", "solid.py", "marked_paper.py", "fewer_sheets.py"),
        *("sizing.py", "sizing_limits.py", "sizing_design.py", "sizing_sheet.py", "size_sensitivity.py"),
        *("oscillator.py", "shock_response.py", "follower_train.py"),
    }
)
"""The data of such rooms; what needs Matplotlib, ezdxf, a server or a notebook, or makes the page; what writes a new
task file, or files for the workshop; the search for sizes, and the swinging of a spring."""
KEPT_ENDINGS = frozenset({".py", ".pyi", ".json", ".po", ".toml", ".csv"})
"""Kinds of files of graphcam that the engine reads; pages, scripts and fonts are not for it."""
ENGINE_LIBRARIES = ("lazy_loader", "tomli_w")
"""What the engine imports besides NumPy."""
ENTRY_DATE = (1980, 1, 1, 0, 0, 0)
"""The date of every file in an archive, so that the same files always make the same archive."""


def stored_zip(contents: Mapping[str, bytes]) -> bytes:
    """A zip of files by their names, in their order, not compressed.

    >>> stored_zip({"a.txt": b"a"}) == stored_zip({"a.txt": b"a"})
    True
    """
    written = io.BytesIO()
    with zipfile.ZipFile(written, "w", zipfile.ZIP_STORED) as archive:
        for name in sorted(contents):
            archive.writestr(zipfile.ZipInfo(name, ENTRY_DATE), contents[name])
    return written.getvalue()


def numpy_archive(name: str, content: bytes) -> bytes:
    """What a browser needs of a NumPy, its licences among it.

    name, content : a wheel, or a package of conda for Emscripten
    """
    packed = _of_wheel(content) if name.endswith(".whl") else _of_conda(content)
    used = {path: OTHER_MODULES.get(path, file) for path, file in packed if _is_used(PurePosixPath(path))}
    return stored_zip({path: without_words(file) if path.endswith(".py") else file for path, file in used.items()})


def _is_used(path: PurePosixPath) -> bool:
    unused = path.name.endswith(UNUSED_ENDINGS) or path.name.startswith(UNUSED_MODULES)
    return not (UNUSED_FOLDERS & set(path.parts[:-1]) or unused)


def library_archive(content: bytes) -> bytes:
    """What is needed of Python's own library, from its zip."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        names = [name for name in archive.namelist() if not {name, name.partition("/")[0]} & UNUSED_LIBRARIES]
        kept = [name for name in names if not name.startswith("encodings/") or KEPT_CODECS.fullmatch(name)]
        # What Pyodide says of its own functions is theirs when it starts.
        said = {name: name.endswith(".py") and not name.startswith("_pyodide/") for name in kept}
        return stored_zip({name: (without_words if said[name] else bytes)(archive.read(name)) for name in kept})


def lock_without_packages(content: bytes) -> bytes:
    """What Pyodide reads when it starts, without the packages that it could fetch."""
    return json.dumps(json.loads(content) | {"packages": {}}).encode()


def without_words(source: bytes) -> bytes:
    """A module without its comments and docstrings, which are half of it and nobody reads in a browser.

    What had a docstring has an empty one, for NumPy hands them on.  What is written for a newer Python than this one
    stays as it is.

    >>> without_words(b"number = 2  # always\\n'What it is.'")
    b'number = 2'
    """
    try:
        tree = ast.parse(source)
    except SyntaxError:
        return source
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            # A string that stands alone says something, also of the name before it.
            said = [one for one in node.body if isinstance(one, ast.Expr) and isinstance(one.value, ast.Constant)]
            said_first = [ast.Expr(ast.Constant(""))] if said[:1] == node.body[:1] else []
            node.body = [*said_first, *(one for one in node.body if one not in said)]
    return ast.unparse(tree).encode()


def _of_wheel(content: bytes) -> Iterator[tuple[str, bytes]]:
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        for name in archive.namelist():
            if not name.endswith("/"):
                yield name, archive.read(name)


def _of_conda(content: bytes) -> Iterator[tuple[str, bytes]]:
    """The files of a package of conda, by their places below the folder of Python's packages."""
    with tarfile.open(fileobj=io.BytesIO(content)) as archive:
        for member in archive:
            _, there, path = member.name.partition("/site-packages/")
            if there and member.isfile() and (file := archive.extractfile(member)) is not None:
                yield path, file.read()


def engine_archive() -> bytes:
    """The engine of the studio, and what it imports but NumPy."""
    contents = dict(_of_graphcam())
    for library in ENGINE_LIBRARIES:
        contents |= _of_library(library)
    return stored_zip(contents)


def _of_graphcam() -> Iterator[tuple[str, bytes]]:
    """The files of graphcam that the engine reads."""
    package = Path(str(files("graphcam")))
    for path in package.rglob("*"):
        inside = path.relative_to(package)
        if inside.parts[0] in ROOMS_ABOVE or path.name in UNREAD_FILES:
            continue
        if path.suffix in KEPT_ENDINGS and path.is_file():
            content = path.read_bytes()
            yield f"graphcam/{inside.as_posix()}", without_words(content) if path.suffix == ".py" else content


def _of_library(name: str) -> dict[str, bytes]:
    """The modules of an installed library, and its licence."""
    kept = (path for path in distribution(name).files or () if path.suffix == ".py" or "LICEN" in path.name)
    return {path.as_posix(): path.read_binary() for path in kept}


def pyodide_parts(folder: Path) -> dict[str, bytes]:
    """The files of :data:`CORE_FILES` and :data:`NUMPY_FILE`, whole and checked.

    folder : has the files themselves, or the packages of npm that they come in

    Raises
    ------
    TaskError : one is not there, or its sum is not known
    """
    found = dict(_contents(folder))
    for name in CORE_FILES:
        if name not in found:
            raise _missing_file_error(folder, name)
    own = _own_sums(found)
    for name in CORE_FILES:
        _check(folder, name, found[name], {KNOWN_SUMS[name], own.get(name)})
    lock = json.loads(found[LOCK_FILE])
    name = _numpy_for(folder, list(found), lock["info"]["python"])
    listed = lock["packages"].get("numpy", {})
    of_lock = listed.get("sha256") if listed.get("file_name") == name else None
    _check(folder, name, found[name], {KNOWN_SUMS.get(name), own.get(name), of_lock})
    return {**{core: found[core] for core in CORE_FILES}, NUMPY_FILE: numpy_archive(name, found[name])}


def _contents(folder: Path) -> Iterator[tuple[str, bytes]]:
    """The files that matter of a folder, and of the packages of npm in it, by their names."""
    if not folder.is_dir():
        raise _missing_file_error(folder, LOADER_FILE)
    try:
        for path in sorted(folder.iterdir()):
            if path.suffix == ".tgz":
                yield from _packed(path)
            elif _is_checked_name(path.name):
                yield path.name, path.read_bytes()
    except (OSError, tarfile.TarError, EOFError) as error:
        broken = say("not readable ({error})", error=str(error))
        what = say("a file there")
        raise TaskError(
            str(folder), what, broken, say("whole"), say("run there: {packing}", packing=PACKING_COMMAND)
        ) from None


def _packed(package: Path) -> Iterator[tuple[str, bytes]]:
    with tarfile.open(package) as archive:
        for member in archive:
            name = member.name.rpartition("/")[2]
            if member.isfile() and _is_checked_name(name) and (file := archive.extractfile(member)) is not None:
                yield name, file.read()


def _is_checked_name(name: str) -> bool:
    return name in CORE_FILES or name == SUMS_FILE or _NUMPY_PATTERN.fullmatch(name) is not None


def _own_sums(found: Mapping[str, bytes]) -> dict[str, str]:
    """The sums that the user states, by the names of the files."""
    lines = (line.split(maxsplit=1) for line in found.get(SUMS_FILE, b"").decode(errors="replace").splitlines())
    return {line[1].lstrip("*").strip(): line[0].lower() for line in lines if len(line) == 2}


def _check(folder: Path, name: str, content: bytes, known: set[str | None]) -> None:
    found = hashlib.sha256(content).hexdigest()
    if found not in known:
        trusted = sorted(each for each in known if each)
        sums = or_list(trusted) if trusted else say("a sum that graphcam has")
        remedy = say("take the files of '{packing}', or state the sums that you trust in a file {sums} there")
        remedy = remedy.with_values(packing=PACKING_COMMAND, sums=SUMS_FILE)
        raise TaskError(str(folder), say("the SHA-256 of {name}", name=name), found, sums, remedy)


def _numpy_for(folder: Path, names: list[str], python: str) -> str:
    """The one NumPy that is for a version of Python, by its name."""
    tag = "".join(python.split(".")[:2])
    fitting = [name for name in names if _NUMPY_PATTERN.fullmatch(name) and re.search(rf"-(cp|py){tag}(?!\d)", name)]
    if not fitting:
        raise MissingFileError(
            "numpy-*.whl or numpy-*.tar.gz",
            say("run there: {packing}", packing=PACKING_COMMAND),
            where=say("for Python {python} in {folder}", python=python, folder=folder),
        )
    if len(fitting) > 1:
        several = bare_caption(", ".join(fitting))
        raise TaskError(str(folder), "NumPy", several, say("one of them alone"), say("remove the others"))
    return fitting[0]


def _missing_file_error(folder: Path, name: str) -> TaskError:
    remedy = say("run there: {packing}", packing=PACKING_COMMAND)
    return MissingFileError(name, remedy, where=say("in the folder {folder}", folder=folder))
