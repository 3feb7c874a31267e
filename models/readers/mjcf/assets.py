"""The assets that have mass: meshes, which are loaded when a body is weighed by one, and height fields."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path, PurePosixPath

import numpy as np

from ...spatial import Inertial
from ..attributes import Array, numbers
from ..folders import Folders
from ..meshes import Mesh, checked_mesh, mesh_inertial, read_mesh
from ..placement import NO_ROTATION
from ..xml_file import Element
from .defaults import Defaults
from .options import Compiler

MOST_NUMBERS = 1_000_000  # of a mesh that is written out in the document


class Assets:
    """A document's assets, by kind and name."""

    def __init__(self, compiler: Compiler, defaults: Defaults, folders: Folders) -> None:
        self._compiler = compiler
        self._defaults = defaults
        self._folders = folders
        self._meshes: dict[str, Element] = {}
        self._fields: dict[str, Element] = {}
        self._weighed: dict[str, Inertial] = {}

    def read(self, sections: Iterable[Element]) -> None:
        """Take note of the assets of every ``<asset>``. Nothing is loaded. Raises :class:`InvalidInput`."""
        for section in sections:
            for element in section.children:
                if element.tag in ("mesh", "hfield"):
                    known = self._meshes if element.tag == "mesh" else self._fields
                    name = element.get("name") or PurePosixPath(element.get("file").replace("\\", "/")).stem
                    if name in known:
                        raise element.wrong(f"a second {element.tag} called {name[:60]!r}; names must be unique")
                    known[name] = element

    def unit_mesh(self, geom: Element) -> Inertial:
        """What the mesh that ``geom`` names weighs, in the mesh's own frame, with density one.

        Its mass is the volume [m³], or the surface [m²] where the mesh is a shell. Raises :class:`InvalidInput`.
        """
        name = geom.get("mesh")
        if name not in self._weighed:
            if name not in self._meshes:
                raise geom.wrong(f"mesh={name[:60]!r}: no <mesh> of that name in an <asset>")
            self._weighed[name] = self._weigh(self._defaults.applied(self._meshes[name], "main"))
        return self._weighed[name]

    def field_box(self, geom: Element) -> Array:
        """Half sizes (3,) [m] of the box by which MuJoCo weighs the height field that ``geom`` names."""
        found = self._fields.get(geom.get("hfield"))
        if found is None:
            raise geom.wrong(f"hfield={geom.get('hfield')[:60]!r}: no <hfield> of that name in an <asset>")
        x, y, top, base = numbers(found, "size", 4, (0.0,) * 4)
        return np.array([x, y, top / 4 + base / 2])

    def _weigh(self, mesh: Element) -> Inertial:
        for name in ("builtin", "plugin"):
            if mesh.get(name) or mesh.first(name) is not None:
                raise mesh.wrong(f"{name}: a mesh that MuJoCo makes itself is not weighed; give the body an <inertial>")
        how = (
            mesh.get("inertia", "legacy"),
            tuple(numbers(mesh, "scale", 3, (1.0, 1.0, 1.0)).tolist()),
            tuple(numbers(mesh, "refpos", 3, (0.0, 0.0, 0.0)).tolist()),
            tuple(numbers(mesh, "refquat", 4, NO_ROTATION.tolist()).tolist()),
        )
        if not mesh.get("file"):
            return mesh_inertial(_written_out(mesh), *how)
        path = self._path(mesh)
        now = path.stat()
        return _weighed(path, (now.st_mtime_ns, now.st_size), *how)

    def _path(self, mesh: Element) -> Path:
        name = mesh.get("file").replace("\\", "/")
        if self._compiler.strip_path:
            name = Path(name).name
        return self._folders.find(mesh, name, self._compiler.mesh_folder, mesh=True)


@lru_cache(maxsize=512)
def _weighed(path: Path, version: tuple[int, int], mode: str, *how: tuple[float, ...]) -> Inertial:
    """A mesh of a file, which is weighed once though the document is read again with each mistake."""
    return mesh_inertial(read_mesh(path), mode, *how)


def _written_out(mesh: Element) -> Mesh:
    vertices = numbers(mesh, "vertex", (9, MOST_NUMBERS))
    faces = numbers(mesh, "face", (3, MOST_NUMBERS), ()) if "face" in mesh.attributes else np.zeros(0)
    if len(vertices) % 3 or len(faces) % 3 or not len(vertices):
        raise mesh.wrong("vertex and face: three numbers each, of at least three vertices, or a file are needed")
    # MuJoCo keeps vertices in single precision.
    single = vertices.astype(np.float32).astype(np.float64)
    return checked_mesh(str(mesh), single.reshape(-1, 3), faces.astype(np.int64).reshape(-1, 3))
