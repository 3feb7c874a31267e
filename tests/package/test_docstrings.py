"""Every folder of the package says what it is for and what it may import; no file and no folder grows without end."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent
PACKAGE = ["furiko", *sorted(path.name for path in (ROOT / "furiko").iterdir() if path.is_symlink())]
FILES = [path.relative_to(ROOT) for name in PACKAGE for path in sorted((ROOT / name).rglob("*.py"))]
FOLDERS = sorted({path.parent for path in FILES})

MOST_LINES = 450
# The documents' numbered equations, one function each, in the documents' order.
ANY_LENGTH = {Path("reference/documents/shiki.py"), Path("reference/documents/takeno.py")}

MOST_MODULES = 16
# One file an item: an engine's adapter, a comparison, a command.
ANY_NUMBER = {Path("engines"), Path("checks/comparisons"), Path("furiko/cli")}

A_SENTENCE = re.compile(r"[^\s.][^.]*[a-z)`][.:](\s|$)")
MAY_IMPORT = re.compile(r"\b(May import|Imports)\b")


@pytest.mark.parametrize("folder", FOLDERS, ids=str)
def test_a_folder_says_what_it_is_for_and_what_it_may_import(folder):
    path = ROOT / folder / "__init__.py"
    assert path.is_file()
    docstring = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
    purpose, *rest = MAY_IMPORT.split(docstring)
    assert A_SENTENCE.search(purpose), f"{folder}/__init__.py: one sentence on what the folder is for"
    assert rest, f'{folder}/__init__.py: one sentence that begins with "May import", on what it may import'


@pytest.mark.parametrize("path", FILES, ids=str)
def test_no_file_is_too_long(path):
    assert path in ANY_LENGTH or len((ROOT / path).read_text(encoding="utf-8").splitlines()) <= MOST_LINES


@pytest.mark.parametrize("folder", FOLDERS, ids=str)
def test_no_folder_holds_too_many_modules(folder):
    modules = [path for path in FILES if path.parent == folder and path.name != "__init__.py"]
    assert folder in ANY_NUMBER or len(modules) <= MOST_MODULES
