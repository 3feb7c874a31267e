"""The package's imports, read from its source: which file imports which, and the picture of the rooms made from it."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parent.parent
ROOMS = ("models", "records", "reference", "engines", "diagnosis", "checks", "studies", "derivations", "reports")


def files() -> list[Path]:
    """Every module of the rooms and of furiko/ itself, relative to the root; links are not entered twice."""
    own = [path for path in (ROOT / "furiko").rglob("*.py") if not _linked(path)]
    return sorted(
        path.relative_to(ROOT) for path in [*own, *(p for room in ROOMS for p in (ROOT / room).rglob("*.py"))]
    )


def _linked(path: Path) -> bool:
    return any(parent.is_symlink() for parent in path.relative_to(ROOT).parents if (ROOT / parent).is_symlink()) or any(
        (ROOT / parent).is_symlink() for parent in path.relative_to(ROOT).parents
    )


def module_of(path: Path) -> str:
    """``checks/plan.py`` → ``checks.plan``; a folder's ``__init__.py`` is the folder; furiko/ itself keeps its name."""
    parts = path.with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {module_of(path): path for path in files()}


@cache
def parsed(path: Path) -> ast.Module:
    """The syntax tree of a file of the package."""
    return ast.parse((ROOT / path).read_text(encoding="utf-8"))


@cache
def imports(path: Path, *, lazy: bool = True) -> tuple[str, ...]:
    """Modules of furiko that a file imports; those of functions as well, unless ``lazy`` is False.

    What only type checkers see is no import.
    """
    return tuple(_imports(path, lazy))


def _imports(path: Path, lazy: bool) -> Iterator[str]:
    package = module_of(path).split(".")
    package = package if path.name == "__init__.py" else package[:-1]
    inside = package if package[:1] == ["furiko"] else ["furiko", *package]
    tree = parsed(path)
    typing_only = {
        id(inner)
        for node in ast.walk(tree)
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"
        for inner in ast.walk(node)
    }
    nodes = ast.walk(tree) if lazy else iter(tree.body)
    for node in nodes:
        if not isinstance(node, ast.ImportFrom) or id(node) in typing_only:
            continue
        if node.level:
            base = inside[: len(inside) - node.level + 1] + (node.module.split(".") if node.module else [])
        elif (node.module or "").split(".")[0] == "furiko":
            base = node.module.split(".")
        else:
            continue
        for name in node.names:
            for dotted in (".".join([*base, name.name]), ".".join(base)):
                known = dotted if dotted in MODULES else dotted.removeprefix("furiko.")
                if known in MODULES and known != module_of(path):
                    yield known
                    break


def room(module: str) -> str:
    """The folder at the root."""
    return module.split(".", maxsplit=1)[0]


def folder(module: str) -> str:
    """Room and subfolder, ``checks.comparisons``; a file at the top of a room belongs to the room itself."""
    parts = module.split(".")
    is_folder = MODULES[module].name == "__init__.py"
    return ".".join(parts if is_folder else parts[:-1])[:200]


def between(of) -> dict[str, set[str]]:
    """Which room (or folder) imports which others."""
    found: dict[str, set[str]] = {}
    for module, path in MODULES.items():
        found.setdefault(of(module), set())
        for other in imports(path):
            if of(other) != of(module):
                found[of(module)].add(of(other))
    return found


def circles(graph: dict[str, set[str]]) -> list[list[str]]:
    """Groups of nodes that reach each other (Tarjan's strongly connected components of more than one node)."""
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found: list[list[str]] = []

    def visit(node: str) -> None:
        index[node] = low[node] = len(index)
        stack.append(node)
        for other in graph.get(node, ()):
            if other not in index:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], index[other])
        if low[node] == index[node]:
            group = []
            while True:
                group.append(stack.pop())
                if group[-1] == node:
                    break
            if len(group) > 1:
                found.append(sorted(group))

    for node in graph:
        if node not in index:
            visit(node)
    return found


def picture() -> str:
    """The rooms and their arrows, as a Mermaid graph; an arrow that longer ways already say is left out."""
    graph = between(room)

    def reaches(start: str, end: str, without: tuple[str, str]) -> bool:
        seen, waiting = set(), [start]
        while waiting:
            node = waiting.pop()
            for other in graph.get(node, ()):
                if (node, other) != without and other not in seen:
                    if other == end:
                        return True
                    seen.add(other)
                    waiting.append(other)
        return False

    lines = [
        f"    {start} --> {end}"
        for start in sorted(graph)
        for end in sorted(graph[start])
        if not reaches(start, end, (start, end))
    ]
    return "\n".join(["```mermaid", "graph TD", *lines, "```"])


if __name__ == "__main__":
    target = ROOT / "docs" / "architecture.md"
    before, _, rest = target.read_text(encoding="utf-8").partition("<!-- rooms -->\n")
    _, _, after = rest.partition("<!-- /rooms -->")
    target.write_text(f"{before}<!-- rooms -->\n{picture()}\n<!-- /rooms -->{after}", encoding="utf-8")
