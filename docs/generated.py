"""Pages made from the code when the documentation is built: equations, engines, checks, causes, mistakes, schemas."""

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import notebooks  # type: ignore[import-not-found]  # beside this file

from furiko.checks.registry import CHECKS
from furiko.derivations.audit.audit import audit
from furiko.derivations.audit.audit_record import JudgedEquation
from furiko.diagnosis.finding import CAUSES
from furiko.engines import engine_info, engine_names, names_on_request
from furiko.models import find_scenes
from furiko.records.schema import SCHEMAS, schema
from furiko.reference import EQUATIONS


def write(folder: Path) -> None:
    """Write every page."""
    folder.mkdir(exist_ok=True)
    pages = {"equations": equations, "engines": engines, "checks": checks, "causes": causes, "scenes": scenes}
    texts = {name: "\n".join(page()) for name, page in {**pages, "schemas": schemas}.items()}
    texts |= {path.stem: "\n".join(notebooks.page(path)) for path in notebooks.FOLDER.glob("*.ipynb")}
    for name, text in texts.items():
        path = folder / f"{name}.md"
        if not path.is_file() or path.read_text(encoding="utf-8") != f"{text}\n":
            path.write_text(f"{text}\n", encoding="utf-8")


def equations() -> Iterator[str]:
    """Every numbered equation of both documents."""
    verdicts = {(row.document, row.number): _judged(row) for row in audit().equations}
    yield "# Every equation"
    yield ""
    yield "What each says in furiko's words, and what `furiko audit` makes of it. A misprint stands here as corrected."
    for document in dict.fromkeys(equation.document for equation in EQUATIONS):
        yield f"\n## {document.title()}\n"
        rows = [
            (f"({e.number})", e.says, e.formula, verdicts[e.document, e.number])
            for e in EQUATIONS
            if e.document == document
        ]
        yield from table(("", "says", "equation", "holds"), rows)


def _judged(row: JudgedEquation) -> str:
    if row.printed:
        return f"misprint: {row.correction}"
    return f"if {row.condition}" if row.condition else "yes"


def engines() -> Iterator[str]:
    """What each engine gives, and which versions were tested."""
    yield "# Engines"
    yield ""
    yield "`furiko engines` has the same, with the versions that are installed."
    yield "\\* runs only where it is named: `-e NAME`."
    yield ""
    always = engine_names()
    infos = [engine_info(name) for name in (*always, *names_on_request())]
    yield from table(
        ("engine", "formulation", "package", "tested with", "integrators", "does not give"),
        [
            (
                info.name + ("" if info.name in always else " *"),
                info.formulation,
                info.package,
                ", ".join(info.tested),
                ", ".join(i.name for i in info.integrators) or "–",
                "; ".join(f"{what}: {why}" for what, why in info.missing.items()) or "–",
            )
            for info in infos
        ],
    )


def checks() -> Iterator[str]:
    """What each check means."""
    yield "# Checks"
    yield ""
    yield from table(
        ("check", "what it means", "where its bound comes from"),
        [(check.name, check.meaning, check.bound) for check in CHECKS.values()],
    )


def causes() -> Iterator[str]:
    """The codes in brackets."""
    yield "# Causes"
    yield ""
    yield "The code that stands in brackets behind a cause, or before it in `furiko diagnose`."
    yield ""
    yield from table(("code", "what it means"), [(f"`{code}`", said) for code, said in sorted(CAUSES.items())])


def scenes() -> Iterator[str]:
    """The catalogue."""
    yield "# Scenes"
    yield ""
    found = find_scenes(None)
    rows = [(f"`{s.name}`", s.system.kind, str(s.system.n), f"{s.duration:g}", s.description) for s in found]
    yield from table(("scene", "system", "degrees of freedom", "seconds", "description"), rows)


def schemas() -> Iterator[str]:
    """The schema of everything that is printed or written as JSON."""
    yield "# JSON schemas"
    yield ""
    yield "Of everything that furiko prints or writes as JSON (JSON Schema 2020-12), as in `furiko/records/schemas/`."
    for name, (title, _) in SCHEMAS.items():
        yield f"\n## {name}\n\n{title}.\n"
        yield f"```json\n{schema(name)}```"


def table(heading: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    """A Markdown table."""
    yield f"| {' | '.join(heading)} |"
    yield f"|{'---|' * len(heading)}"
    for row in rows:
        yield f"| {' | '.join(_cell(text) for text in row)} |"


def _cell(text: str) -> str:
    escaped = text if text.startswith("`") else text.replace("*", "\\*").replace("_", "\\_").replace("<", "&lt;")
    return escaped.replace("|", "\\|").replace("\n", " ")
