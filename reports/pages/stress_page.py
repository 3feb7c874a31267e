"""The stress test's two pages, ``stress.html`` and ``chain.html``: open from disk, fetch nothing, run nothing."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ...models.writers.whole_file import write_whole
from ...records.check import Header
from .check_page import TEMPLATES, environment
from .stress_drawings import Map, Picture, Plot, draw, draw_curves, draw_map

PAGE, CHAIN_PAGE = "stress.html", "chain.html"

Data = dict[str, Any]

HOLDS = "holds"
FRAMES = ("0.125", "0.25", "0.375", "0.5", "0.75", "1", "1.5", "2")  # [s] at which chains are pictured


def write_pages(folder: Path, summary: Data, header: Header) -> tuple[Path, Path]:
    """Write both into the folder; each is there whole or not at all."""
    return (
        write_whole(folder / PAGE, stress_page(summary, header)),
        write_whole(folder / CHAIN_PAGE, chain_page(summary, header)),
    )


def stress_page(summary: Data, header: Header) -> str:
    """Frontiers, conditions, steps, long runs and failures."""
    single = [f for f in summary["frontiers"] if not f["pair"]]
    engines = list(dict.fromkeys(f["engine"] for f in summary["frontiers"]))
    colours = {engine: i for i, engine in enumerate(engines)}
    return _render(
        "stress.html.j2",
        summary=summary,
        header=header,
        engines=engines,
        half=2.0**-26,
        rows=_by_axis(single, engines),
        pairs=[f for f in summary["frontiers"] if f["pair"] and f["status"] == "fails"],
        pairs_asked=sum(f["pair"] for f in summary["frontiers"]),
        pairs_closed=sum(f["pair"] and f["closed"] for f in summary["frontiers"]),
        curves=[plot for axis in _axes(single) if (plot := _curve(axis, single, colours))],
        condition=_condition(summary["condition"]),
        stresses=_stresses(summary["steps"]),
        maps=_maps(summary["steps"]),
        kinds=_kinds(summary["steps"]),
        long_runs=[run for run in summary["long runs"] if run["steps"]],
        drifts=_drifts(summary["long runs"]),
    )


def chain_page(summary: Data, header: Header) -> str:
    """Takeno's chain."""
    chain = summary["chain"]
    fine = [m for m in chain["motions"] if m["amplitude"] == 1.0 and m["tolerance"] <= 1e-12]
    return _render(
        "chain.html.j2",
        chain=chain,
        header=header,
        swings=[plot for data in chain["swings"] if (plot := _swings(data))],
        pictures=_pictures(fine),
        shown=[f"{m['n']} rods" for m in _few(fine)],
        speeds=draw(
            "Speed of the tip",
            {f"{m['n']} rods": _series(m["speed"], m["time"], 2.0) for m in _few(fine)},
            "time, s",
            "m/s",
        ),
        apart=draw(
            "How far the tips of n and 2n rods are apart",
            {
                f"{r['n']} and {2 * r['n']}": _series(r["series"], None, 2.0)
                for r in chain["convergence"]
                if r["amplitude"] == 1.0
            },
            "time, s",
            "m",
            log_y=True,
        ),
        steps=draw(
            "Largest step of the classical Runge-Kutta scheme",
            {"step": [(r["n"], r["step"]) for r in chain["usable step"]]},
            "rods",
            "s",
            log_x=True,
            log_y=True,
            marked=True,
        ),
        cost=draw(
            "Computing for one second of motion",
            {"seconds": [(m["n"], m["seconds"] / m["time"]) for m in fine]},
            "rods",
            "s",
            log_x=True,
            log_y=True,
            marked=True,
        ),
        memory=draw(
            "Memory",
            {"bytes": [(r["n"], r["bytes"]) for r in chain["memory"] if r["bytes"]]},
            "rods",
            "bytes",
            log_x=True,
            log_y=True,
            marked=True,
        ),
    )


def _render(template: str, **values: Any) -> str:
    from markupsafe import Markup

    templates = environment()
    style = "\n".join((TEMPLATES / name).read_text(encoding="utf-8") for name in ("style.css", "stress.css"))
    return templates.get_template(template).render(style=Markup(style), **values)


def _axes(frontiers: Sequence[Data]) -> list[str]:
    return list(dict.fromkeys(f["axis"] for f in frontiers))


def _by_axis(frontiers: Sequence[Data], engines: Sequence[str]) -> list[tuple[Data, list[Data | None]]]:
    """Each axis (any of its frontiers, for its words) and its frontier for each engine."""
    found = {(f["axis"], f["engine"]): f for f in frontiers}
    rows = []
    for axis in _axes(frontiers):
        cells = [found.get((axis, engine)) for engine in engines]
        rows.append((next(cell for cell in cells if cell), cells))
    return rows


def _curve(axis: str, frontiers: Sequence[Data], colours: dict[str, int]) -> Plot | None:
    of_axis = [f for f in frontiers if f["axis"] == axis]
    lines = {
        f["engine"]: [(p["value"], max(p["error"], 1e-17)) for p in f["curve"] if p["error"] is not None]
        for f in of_axis
    }
    return draw(
        f"{axis}: {of_axis[0]['says']}",
        {name: points for name, points in lines.items() if len(points) > 1},
        "",
        "typical relative error",
        log_x=True,
        log_y=True,
        marked=True,
        colours=colours,
    )


def _condition(rows: Sequence[Data]) -> Plot | None:
    return draw(
        "Condition of the mass matrix",
        {f"{row['posture']}, {row['coordinates']}": list(zip(row["n"], row["condition"], strict=True)) for row in rows},
        "links",
        "λ max / λ min",
        log_x=True,
        log_y=True,
        marked=True,
    )


def _stresses(steps: Sequence[Data]) -> list[tuple[str, str, list[float], list[tuple[str, list[Data | None]]]]]:
    """For each stress: its unit, its values, and for each engine and integrator what was found at each value."""
    found = []
    for stress in dict.fromkeys(s["stress"] for s in steps):
        of_stress = [s for s in steps if s["stress"] == stress]
        values = sorted({s["value"] for s in of_stress})
        at = {(s["engine"], s["integrator"], s["value"]): s for s in of_stress}
        rows = [
            (f"{engine} {integrator}", [at.get((engine, integrator, value)) for value in values])
            for engine, integrator in dict.fromkeys((s["engine"], s["integrator"]) for s in of_stress)
        ]
        found.append((stress, of_stress[0]["unit"], values, rows))
    return found


def _kinds(steps: Sequence[Data]) -> list[str]:
    return [HOLDS, *dict.fromkeys(c["failure"] for s in steps for c in s["cells"] if c["failure"])]


def _maps(steps: Sequence[Data]) -> list[Map]:
    """Step × links for each engine and integrator."""
    kinds = _kinds(steps)
    links = [s for s in steps if s["stress"] == "links" and s["cells"]]
    maps = []
    for engine, integrator in dict.fromkeys((s["engine"], s["integrator"]) for s in links):
        mine = [s for s in links if (s["engine"], s["integrator"]) == (engine, integrator)]
        columns = [
            (f"{s['value']:g}", {c["rung"]: kinds.index(c["failure"] or HOLDS) for c in s["cells"]}, s["rung"])
            for s in mine
        ]
        known = {c["rung"]: c["step"] for s in mine for c in s["cells"]}
        rung, step = next(iter(known.items()))
        rows = [f"{step * 2 ** ((row - rung) / 2):.1e} s" for row in range(25)]
        maps.append(draw_map(f"{engine} {integrator}", columns, rows, kinds))
    return maps


def _drifts(runs: Sequence[Data]) -> list[Plot]:
    plots = (
        draw(
            f"{run['engine']} {run['integrator']}",
            {"energy": [(i * run["steps"] / (len(run["drift"]) - 1), value) for i, value in enumerate(run["drift"])]},
            "steps",
            "ΔE / E",
        )
        for run in runs
        if len(run["drift"]) > 2
    )
    return [plot for plot in plots if plot]


def _swings(data: Data) -> Plot | None:
    return draw(
        f"{data['links']}: error of the k-th small swing",
        {
            f"k = {row['k']}": [(n, abs(e)) for n, e in zip(data["n"], row["errors"], strict=True)]
            for row in data["rows"]
            if row["k"] in (1, 2, 3, 5, 7, 10)
        },
        data["links"],
        "relative to Bernoulli's",
        log_x=True,
        log_y=True,
        marked=True,
    )


def _few(motions: Sequence[Data], most: int = 6) -> list[Data]:
    """At most so many motions, the ends among them."""
    if len(motions) <= most:
        return list(motions)
    return [motions[round(i * (len(motions) - 1) / (most - 1))] for i in range(most)]


def _pictures(motions: Sequence[Data]) -> list[Picture]:
    found = []
    for time in FRAMES:
        curves = {f"{m['n']} rods": m["curves"][time] for m in _few(motions) if time in m["curves"]}
        if curves:
            found.append(draw_curves(f"{time} s", curves, 1.05))
    return found


def _series(values: Sequence[float], time: float | None, most: float) -> list[tuple[float, float]]:
    """(t, value) of equally spaced values, up to so many seconds."""
    step = time / (len(values) - 1) if time else 1 / 320
    return [(i * step, value) for i, value in enumerate(values) if i * step <= most]
