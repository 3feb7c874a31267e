"""The notebooks: run them, keep what they print (``make notebooks``), and make pages of the documentation from them.

They are Jupyter notebooks with printed text as their only outputs, so that GitHub shows them whole and a test can hold
what they print against what is kept. Running them needs furiko and its engines, and nothing of Jupyter.
"""

import ast
import contextlib
import io
import json
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parent / "notebooks"


def cells(path: Path) -> list[dict[str, Any]]:
    """The cells of a notebook."""
    found: list[dict[str, Any]] = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return found


def shown(cell: dict[str, Any]) -> str:
    """What is kept of what a cell printed."""
    return "".join(line for output in cell.get("outputs", []) for line in output["text"])


def run(path: Path) -> Iterator[tuple[dict[str, Any], str]]:
    """Each code cell and what it prints now, in an empty folder; a last expression is printed, as Jupyter shows it."""
    names: dict[str, Any] = {"__name__": "__main__"}
    before = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            for cell in cells(path):
                if cell["cell_type"] == "code":
                    yield cell, _run(ast.parse("".join(cell["source"])), names)
        finally:
            os.chdir(before)


def _run(tree: ast.Module, names: dict[str, Any]) -> str:
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, "cell", "exec"), names)
        if isinstance(last, ast.Expr):
            value = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
            if value is not None:
                print(value)
    return printed.getvalue()


def keep(path: Path) -> None:
    """Run a notebook, and keep what it prints in it."""
    whole = json.loads(path.read_text(encoding="utf-8"))
    code = iter(cell for cell in whole["cells"] if cell["cell_type"] == "code")
    for number, (cell, (_, printed)) in enumerate(zip(code, run(path), strict=True), 1):
        cell["execution_count"] = number
        text = printed.splitlines(keepends=True)
        cell["outputs"] = [{"name": "stdout", "output_type": "stream", "text": text}] if text else []
    path.write_text(json.dumps(whole, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def page(path: Path) -> Iterator[str]:
    """A notebook as a page in Markdown."""
    for cell in cells(path):
        text = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            yield text
        else:
            yield f"```python\n{text}\n```"
            if shown(cell):
                yield f"```text\n{shown(cell).rstrip()}\n```"
        yield ""


if __name__ == "__main__":
    for notebook in sorted(FOLDER.glob("*.ipynb")):
        keep(notebook)
