"""The benchmark's page: one HTML file from the records of :mod:`furiko.records.bench`, nothing fetched, nothing run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from ...records.bench import Bench, Motion, Point, Reach, Speed
from ..words import SAME, batch, duration, figure, link_words, multiple, speed_words
from ..zigzags import zigzags
from .plot import KINDS, LARGE, Plot, Series, draw
from .rendering import render_with_plots

FURIKO = "furiko"
WORST = 1.0  # rad or rad/s: a larger error has nothing to do with the motion, and is not drawn
FINEST = 1e-18  # errors of zero are drawn here


@dataclass(frozen=True)
class MotionView:
    """One motion, as the page shows it."""

    motion: Motion

    @property
    def title(self) -> str:
        """The mechanism and the time."""
        return f"{link_words(self.motion.system, self.motion.n)}, {self.motion.duration:g} s"

    @cached_property
    def methods(self) -> list[tuple[str, str]]:
        """Engine and scheme of each."""
        return list(dict.fromkeys((reach.engine, reach.scheme) for reach in self.motion.reaches))

    @cached_property
    def errors(self) -> list[float]:
        """The errors for which times are given."""
        return list(dict.fromkeys(reach.error for reach in self.motion.reaches))

    @cached_property
    def series(self) -> list[Series]:
        """A line for each method: colours are engines, marks are schemes; dashed in a lighter context."""
        engines = list(dict.fromkeys(engine for engine, _ in self.methods))
        found = []
        for engine, scheme in self.methods:
            plain = scheme.partition(",")[0]
            schemes = list(dict.fromkeys(s.partition(",")[0] for e, s in self.methods if e == engine))
            points = sorted(_points(self.motion.points, engine, scheme), key=lambda point: point[1])
            found.append(
                Series(
                    f"{engine}, {scheme}",
                    tuple(points),
                    engines.index(engine) % KINDS,
                    schemes.index(plain) % KINDS,
                    plain != scheme,
                    engine,
                )
            )
        return found

    @cached_property
    def plot(self) -> Plot | None:
        """Time against error."""
        front = sorted(
            ((max(p.error, FINEST), p.median) for p in self.motion.points if p.front and p.error is not None),
            reverse=True,
        )
        shown = [(error, seconds) for error, seconds in front if error <= WORST]
        labels = ("error at the end, θ [rad] and ω [rad/s]", "time [s]")
        return draw(self.series, *labels, frame=LARGE, log_x=True, log_y=True, falling_x=True, front=shown)

    @cached_property
    def zigzags(self) -> list[str]:
        """Why curves turn back."""
        return zigzags(self.motion)

    def reach(self, method: tuple[str, str], error: float) -> Reach:
        """A method's time to come within an error."""
        return next(r for r in self.motion.reaches if (r.engine, r.scheme) == method and r.error == error)

    def on_front(self, method: tuple[str, str]) -> bool:
        """Whether one of its runs is on the Pareto front."""
        return any(point.front and (point.engine, point.scheme) == method for point in self.motion.points)


def _points(points: Sequence[Point], engine: str, scheme: str) -> list[tuple[float, float, str]]:
    return [
        (
            max(point.error, FINEST),
            point.median,
            f"{engine}, {scheme}: {point.by} {point.setting:.3g}: error {figure(point.error)} in "
            f"{duration(point.median)} (fastest {duration(point.minimum)}, timed {point.rounds}×)",
        )
        for point in points
        if (point.engine, point.scheme) == (engine, scheme) and point.error is not None and point.error <= WORST
    ]


@dataclass(frozen=True)
class SpeedView:
    """The accelerations of one kind of mechanism, as the page shows them."""

    system: str
    speeds: list[Speed]

    @property
    def title(self) -> str:
        """The mechanism, in words."""
        return {"n-leg": "N-leg pendulums", "rod-chain": "Chains of rods"}.get(self.system, "open mechanisms")

    @cached_property
    def sizes(self) -> list[tuple[str, list[Speed]]]:
        """Each size in words, and its rows."""
        return [
            (words, [speed for speed in self.speeds if speed_words(speed) == words])
            for words in dict.fromkeys(map(speed_words, self.speeds))
        ]

    @cached_property
    def series(self) -> list[Series]:
        """The plain calls on one thread, each once: furiko's own batch in the size nearest to what is asked."""
        calls = dict.fromkeys((s.engine, s.call, s.states == 1) for s in self.speeds if _plain(s))
        engines = list(dict.fromkeys(engine for engine, _, _ in calls))
        found = []
        for engine, call, single in calls:
            of_engine = [key for key in calls if key[0] == engine]
            rows = _largest(
                [s for s in self.speeds if (s.engine, s.call, s.states == 1) == (engine, call, single) and _plain(s)]
            )
            found.append(
                Series(
                    f"{engine}, {call}, {'one state' if single else 'many states'} a call",
                    tuple((float(s.n), s.median, _said(s)) for s in rows),
                    engines.index(engine) % KINDS,
                    of_engine.index((engine, call, single)) % KINDS,
                    group=engine,
                )
            )
        return found

    @cached_property
    def by_size(self) -> Plot | None:
        """Time a state against links; None for open mechanisms, whose size says little."""
        if self.system == "tree":
            return None
        return draw(self.series, "links", "time a state [s]", frame=LARGE, log_x=True, log_y=True)

    @cached_property
    def by_error(self) -> Plot | None:
        """Time a state against error: a point for each size, from the smallest mechanism to the largest."""
        rows = {id(s): [row for row in self.speeds if _said(row) in {p[2] for p in s.points}] for s in self.series}
        lines = [
            Series(
                s.name,
                tuple((max(r.error, FINEST), r.median, _said(r)) for r in rows[id(s)] if r.error is not None),
                s.colour,
                s.mark,
                group=s.group,
            )
            for s in self.series
        ]
        labels = ("largest error, relative to a state's largest acceleration", "time a state [s]")
        return draw(lines, *labels, frame=LARGE, log_x=True, log_y=True, falling_x=True)


def _plain(speed: Speed) -> bool:
    return speed.threads == 1 and "timer off" not in speed.call


def _largest(rows: Sequence[Speed], most: int = 4096) -> list[Speed]:
    """For each size the row with the largest batch up to ``most``."""
    best: dict[int, Speed] = {}
    for row in rows:
        if row.states <= most and (row.n not in best or row.states > best[row.n].states):
            best[row.n] = row
    return [best[n] for n in sorted(best)]


def _said(speed: Speed) -> str:
    return (
        f"{speed.engine}, {speed.call}: {speed_words(speed)}, {speed.states:,} states a call: "
        f"{duration(speed.median)} a state, error {figure(speed.error)}"
    )


def to_html(found: Bench) -> str:
    """The whole page as text."""
    kinds = dict.fromkeys(speed.system for speed in found.speeds)
    return render_with_plots(
        "bench.html.j2",
        bench=found,
        motions=[MotionView(motion) for motion in found.motions],
        speeds=[SpeedView(kind, [s for s in found.speeds if s.system == kind]) for kind in kinds],
        duration=duration,
        ratio=multiple,
        batch=batch,
        same=SAME,
    )
