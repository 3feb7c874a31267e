"""One run of ``furiko map``: the scene, its map, the page."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from .models import InvalidInput, Scene, find_scene
from .models.writers.whole_file import replace_file, write_whole

if TYPE_CHECKING:
    from .studies.maps.starts import Map

KINDS = ("flips", "stretching", "lyapunov")


def draw(
    scene: str,
    kind: str = "flips",
    *,
    until: float = 10.0,
    points: int = 200,
    links: tuple[int, int] = (1, 2),
    threads: int | None = None,
) -> Map:
    """A map of ``kind`` ("flips", "stretching", "lyapunov") for ``points`` × ``points`` starts, followed to ``until``.

    ``scene``: a name of the catalogue or a TOML file of a document's system; ``links``: whose angles vary across and
    up, from 1. Raises :class:`InvalidInput`.
    """
    from .studies.maps.starts import draw_map

    found = find_scene(scene)
    if not isinstance(found, Scene):
        raise InvalidInput(f"scene {scene!r}: it is an open mechanism; maps are of the documents' systems")
    if kind not in KINDS:
        raise InvalidInput(f"kind: one of {', '.join(KINDS)} is needed, got {kind!r:.60}")
    return draw_map(found, kind, until, points, (links[0] - 1, links[1] - 1), threads)  # type: ignore[arg-type]


def write(folder: Path, found: Map) -> Path:
    """Write ``map.html``, ``map.png`` and ``map.csv`` into the folder; returns the page's path."""
    from .reports.pages.map_page import map_page, picture

    try:
        replace_file(folder / "map.png", picture(found.record, found.values))
    except OSError as error:
        raise InvalidInput(f"{folder / 'map.png'}: cannot be written: {error.strerror or error}") from None
    rows = "".join(",".join(f"{value:.12g}" for value in row) + "\n" for row in found.values[::-1].tolist())
    write_whole(folder / "map.csv", rows)
    return write_whole(folder / "map.html", map_page(found.record, found.values))
