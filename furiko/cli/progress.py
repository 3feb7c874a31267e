"""Progress of long commands on a terminal's standard error; nothing is shown where it is no terminal."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..bench import Doing
    from ..checks.plan import Plan
    from ..records.check import Result
    from ..stress import Progress
    from ..sweep import Doing as SweepDoing
    from .remaining import Place, Size

EVERY = 0.5  # [s] between two looks at what is left: a large run has a hundred results in a second


@contextmanager
def check_progress() -> Iterator[Callable[[Plan, Result], None] | None]:
    """A progress bar over the planned checks, with what is left: a function to call with each result, or None."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    from ..reports.words import one_line
    from .remaining import Cells, about

    begun = time.monotonic()
    columns = (
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.fields[left]}"),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("checking", total=None, left="")
        seen: set[tuple[str, str, str]] = set()
        cells: list[Cells] = []
        total = 0
        looked = [begun]

        def watch(plan: Plan, result: Result) -> None:
            nonlocal total
            # An engine has one trajectory result for each integrator: they count as the one check that was planned.
            seen.add((result.scene, result.engine, result.comparison))
            now = one_line(f"{result.scene} {result.engine}", 80)
            if not cells:  # the plan stays as it is: counting it again at each result would be quadratic
                settled = {(r.scene, r.engine, r.check) for r in plan.settled}
                total = sum(len(t.checks) for t in plan.tasks) + len(settled)
                cells.append(Cells(_planned(plan)))
            cells[0].took((result.scene, result.engine, result.comparison), result.seconds)
            bar.update(task, completed=min(len(seen), total), total=total, description=now)
            if (clock := time.monotonic()) - looked[0] > EVERY:
                looked[0] = clock
                bar.update(task, left=about(cells[0].remaining(clock - begun)))

        yield watch


def _planned(plan: Plan) -> Iterator[tuple[Place, Size]]:
    for task in plan.tasks:
        system = task.scene.system
        yield from (((task.scene.name, task.engine, check), (system.kind, system.n)) for check in task.checks)


@contextmanager
def status_line() -> Iterator[Callable[[str], None]]:
    """One line that says what runs now: a function to call with each new text."""
    if not sys.stderr.isatty():
        yield lambda _: None
        return
    from rich.console import Console
    from rich.markup import escape

    from ..reports.words import one_line

    with Console(stderr=True).status("") as status:
        yield lambda words: status.update(escape(one_line(words)))


@contextmanager
def bench_progress() -> Iterator[Callable[[Doing], None]]:
    """One line that says what runs now and, once a part is done, how long the others take."""
    if not sys.stderr.isatty():
        yield lambda _: None
        return
    from rich.console import Console
    from rich.text import Text

    from ..reports.words import one_line
    from .remaining import Parts, about

    begun = time.monotonic()
    said: list[str] = [""]
    parts: list[Parts] = []

    class Line:
        """Written anew whenever the line is: what is left goes down between two calls, too."""

        def __rich__(self) -> Text:
            left = about(parts[0].remaining(time.monotonic() - begun)) if parts else ""
            return Text("; ".join(filter(None, (one_line(said[0]), left))))

    with Console(stderr=True).status(Line()):

        def watch(now: Doing) -> None:
            if not parts and now.planned:
                parts.append(Parts(now.planned))
            if parts:
                parts[0].begins(now.part, time.monotonic() - begun)
            said[0] = now.words

        yield watch


@contextmanager
def stress_progress(budget: float) -> Iterator[Callable[[Progress], None] | None]:
    """Cases done, questions open, time left, the case that runs now: a function to call with each state, or None.

    How many more cases a question takes is not known, so that the time is that of ``budget`` [s]: at most so much.
    """
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, TextColumn, TimeElapsedColumn
    from rich.progress import Progress as Bar

    from ..reports.words import one_line
    from .remaining import about

    begun = time.monotonic()
    columns = (
        TextColumn("{task.fields[done]} cases, {task.fields[open]} questions open"),
        BarColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.fields[left]}"),
        TextColumn("{task.description}", markup=False),
    )
    with Bar(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("starting", total=None, done=0, open="?", left="")

        def watch(now: Progress) -> None:
            total = now.done + now.open  # every open question takes at least one more case
            left = about(max(budget - (time.monotonic() - begun), 0.0)).replace("about", "at most")
            bar.update(
                task,
                completed=now.done,
                total=total,
                description=one_line(now.now, 80),
                done=now.done,
                open=now.open,
                left=left,
            )

        yield watch


@contextmanager
def sweep_progress() -> Iterator[Callable[[SweepDoing], None]]:
    """A bar over the planned cells, with what is left by the pace of this run: a function to call after each chunk."""
    if not sys.stderr.isatty():
        yield lambda _: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeElapsedColumn
    from rich.progress import Progress as Bar

    from .remaining import about

    begun = time.monotonic()
    columns = (
        TextColumn("cells"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.fields[left]}"),
        TextColumn("{task.fields[said]}"),
    )
    with Bar(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("cells", total=None, left="", said="")

        def watch(now: SweepDoing) -> None:
            pace = (time.monotonic() - begun) / now.here if now.here else None
            left = about(None if pace is None else pace * (now.of - now.cells))
            said = ", ".join(f"{n:,} {what}" for n, what in ((now.differs, "differ"), (now.errors, "failed")) if n)
            bar.update(task, completed=now.cells, total=now.of, left=left, said=said)

        yield watch
