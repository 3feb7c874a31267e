"""Imports run one way, file by file, and engines are imported only by their adapters."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent
MAY_IMPORT = {
    "records": set(),
    "models": set(),
    "reference": {"models"},
    "engines": {"models", "records"},
    "diagnosis": {"models", "reference", "engines"},
    "checks": {"models", "records", "reference", "engines", "diagnosis"},
    "studies": {"models", "records", "reference", "engines", "checks"},
    "derivations": {"models", "reference"},
    "reports": {"models", "records", "studies", "reference"},
}
ENGINES = {"mujoco", "pinocchio", "exudyn"}
FILES = [path for folder in MAY_IMPORT for path in sorted((ROOT / folder).rglob("*.py"))]


def imported(path):
    """Folders of furiko and top-level packages that a file imports, relative imports resolved."""
    parts = path.relative_to(ROOT).parts
    depth = len(parts) - 1  # folders between the root and the file
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (name.name.split(".")[0] for name in node.names)
        elif isinstance(node, ast.Call) and node.args and ast.unparse(node.func).endswith("import_module"):
            if isinstance(node.args[0], ast.Constant) and not node.args[0].value.startswith("."):
                yield node.args[0].value.split(".")[0]
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            yield node.module.split(".")[0]
        elif isinstance(node, ast.ImportFrom):
            if node.level <= depth:
                yield parts[0]
            else:
                yield from [node.module.split(".")[0]] if node.module else (name.name for name in node.names)


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(ROOT)))
def test_imports_run_one_way(path):
    folder = path.relative_to(ROOT).parts[0]
    found = set(imported(path))
    assert found & {*MAY_IMPORT, "furiko"} <= MAY_IMPORT[folder] | {folder}
    assert "furiko" not in found, "inside the folders imports are relative"
    if folder != "engines":
        assert not found & ENGINES
