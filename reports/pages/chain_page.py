"""The page on Takeno's chain, ``chain.html``: natural frequencies, motions, and how both converge with n."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...records.check import Header
from ...records.stress import ChainMotion, ChainSummary, SmallSwings, StressSummary, TipConvergence
from .chain_pictures import ChainPicture, draw_chains
from .plot import Plot, Points, draw, to_series
from .rendering import render_with_plots

INSTANTS = ("0.125", "0.25", "0.375", "0.5", "0.75", "1", "1.5", "2")  # [s] at which chains are pictured
LARGE = 1.0  # amplitude of the motions that are shown
FINE = 1e-12  # coarser motions only show what the integrator does
END = 2.0  # [s] of the plots over time
SWINGS = (1, 2, 3, 5, 7, 10)  # natural frequencies that are plotted
MOST_SHOWN = 6  # motions in one plot


def chain_page(summary: StressSummary, header: Header) -> str:
    """The whole page as text."""
    chain = summary.chain
    fine = [m for m in chain.motions if m.amplitude == LARGE and m.tolerance <= FINE]
    shown = _few(fine)
    return render_with_plots(
        "chain.html.j2",
        ("style.css", "stress.css"),
        chain=chain,
        header=header,
        swings=[plot for swings in chain.swings if (plot := _swings(swings))],
        pictures=_pictures(shown),
        shown=[_name(motion) for motion in shown],
        speeds=_speeds(shown),
        distances=_distances(chain.convergence, fine),
        costs=_costs(chain, fine),
    )


def _name(motion: ChainMotion) -> str:
    return f"{motion.n} rods"


def _few(motions: Sequence[ChainMotion]) -> list[ChainMotion]:
    """At most :data:`MOST_SHOWN` motions, the first and the last among them."""
    if len(motions) <= MOST_SHOWN:
        return list(motions)
    return [motions[round(i * (len(motions) - 1) / (MOST_SHOWN - 1))] for i in range(MOST_SHOWN)]


def _pictures(motions: Sequence[ChainMotion]) -> list[ChainPicture]:
    found = []
    for time in INSTANTS:
        curves = {_name(m): m.curves[time] for m in motions if time in m.curves}
        if curves:
            found.append(draw_chains(f"{time} s", curves))
    return found


def _speeds(motions: Sequence[ChainMotion]) -> Plot | None:
    lines = {_name(m): _over_time(m.speed, _interval(m)) for m in motions}
    return draw(to_series(lines), "time [s]", "speed [m/s]", title="Speed of the tip")


def _distances(rows: Sequence[TipConvergence], motions: Sequence[ChainMotion]) -> Plot | None:
    intervals = {m.n: _interval(m) for m in motions}
    lines = {
        f"{r.n} and {2 * r.n}": _over_time(r.series, intervals[r.n])
        for r in rows
        if r.amplitude == LARGE and r.n in intervals
    }
    title = "Distance between the tips of n and 2n rods"
    return draw(to_series(lines), "time [s]", "distance [m]", title=title, log_y=True)


def _interval(motion: ChainMotion) -> float:
    """Time between two samples of a motion [s]."""
    return motion.time / (len(motion.speed) - 1)


def _over_time(values: Sequence[float], interval: float) -> Points:
    """(t, value) of equally spaced values, until :data:`END`."""
    return [(i * interval, value) for i, value in enumerate(values) if i * interval <= END]


def _costs(chain: ChainSummary, motions: Sequence[ChainMotion]) -> list[Plot]:
    steps = [(s.n, s.step) for s in chain.usable_steps if s.step]
    computing = [(m.n, m.seconds / m.time) for m in motions]
    memory = [(m.n, m.bytes) for m in chain.memory if m.bytes]
    plots = (
        _against_rods({"step": steps}, "step [s]", "Largest stable step of the classical Runge-Kutta scheme"),
        _against_rods({"seconds": computing}, "time [s]", "Computing time for one second of motion"),
        _against_rods({"bytes": memory}, "memory [bytes]", "Memory"),
    )
    return [plot for plot in plots if plot]


def _swings(swings: SmallSwings) -> Plot | None:
    lines = {
        f"k = {row.k}": [(n, abs(error)) for n, error in zip(swings.n, row.errors, strict=True)]
        for row in swings.rows
        if row.k in SWINGS
    }
    return _against_rods(lines, "relative error", f"{swings.links}: error of the k-th natural frequency", swings.links)


def _against_rods(lines: Mapping[str, Points], y_label: str, title: str, x_label: str = "rods") -> Plot | None:
    return draw(to_series(lines, marked=True), x_label, y_label, title=title, log_x=True, log_y=True)
