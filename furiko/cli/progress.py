"""Progress of long commands on a terminal's standard error; nothing is shown where it is no terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..checks.plan import Plan
    from ..records.check import Result
    from ..stress import Progress


@contextmanager
def check_progress() -> Iterator[Callable[[Plan, Result], None] | None]:
    """A progress bar over the planned checks: a function to call with each result, or None."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    from ..reports.words import one_line

    columns = (TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("checking", total=None)
        seen: set[tuple[str, str, str]] = set()

        def watch(plan: Plan, result: Result) -> None:
            settled = {(r.scene, r.engine, r.check) for r in plan.settled}
            # An engine has one trajectory result for each integrator: they count as the one check that was planned.
            seen.add((result.scene, result.engine, result.comparison))
            total = sum(len(t.checks) for t in plan.tasks) + len(settled)
            now = one_line(f"{result.scene} {result.engine}", 80)
            bar.update(task, completed=min(len(seen), total), total=total, description=now)

        yield watch


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
def stress_progress() -> Iterator[Callable[[Progress], None] | None]:
    """Cases done, questions open, and the case that runs now: a function to call with each state, or None."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, TextColumn, TimeElapsedColumn
    from rich.progress import Progress as Bar

    from ..reports.words import one_line

    columns = (
        TextColumn("{task.fields[done]} cases, {task.fields[open]} questions open"),
        BarColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.description}", markup=False),
    )
    with Bar(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("starting", total=None, done=0, open="?")

        def watch(now: Progress) -> None:
            total = now.done + now.open  # every open question takes at least one more case
            bar.update(
                task, completed=now.done, total=total, description=one_line(now.now, 80), done=now.done, open=now.open
            )

        yield watch
