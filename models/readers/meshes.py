"""Triangle meshes, and what a solid or shell of their shape weighs: STL (binary and text), OBJ, MuJoCo's MSH.

Files are bounded in size and number of triangles, and nothing but triangles is taken from them. Coordinates are single
precision, as MuJoCo loads them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import InvalidInput, library
from ..spatial import Inertial, from_quaternion
from .bounded_file import read_bytes, shown

Array = NDArray[np.float64]
Faces = NDArray[np.int64]

LARGEST_MESH = 64_000_000  # bytes
MOST_FACES = 500_000
MOST_CORNERS = 64  # of one face of an OBJ
LARGEST_COORDINATE = 2.0**30  # MuJoCo's own limit
LEAST = 1e-15  # m³ or m²: MuJoCo refuses a mesh with less volume or surface
MODES = ("convex", "exact", "legacy", "shell")
TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


@dataclass(frozen=True, eq=False)
class Mesh:
    """``vertices`` (n, 3) [m] and ``faces`` (m, 3), indices of each triangle's corners, counter-clockwise from outside.

    ``name``: what messages call it. No faces: the mesh is the convex hull of its vertices.
    """

    name: str
    vertices: Array
    faces: Faces


def read_mesh(path: Path) -> Mesh:
    """Read a mesh by its name's ending: ``.stl``, ``.obj`` or ``.msh``. Raises :class:`InvalidInput`."""
    readers = {".stl": _stl, ".obj": _obj, ".msh": _msh}
    name = shown(path)
    ending = path.suffix.lower()
    if ending not in readers:
        raise InvalidInput(f"{name}: a mesh in {ending or 'a format without ending'!r:.20}; STL, OBJ and MSH are read")
    try:
        vertices, faces = readers[ending](name, read_bytes(path, LARGEST_MESH))
    except (ValueError, IndexError, OverflowError) as error:
        raise error if isinstance(error, InvalidInput) else InvalidInput(f"{name}: not a mesh: {error}") from None
    if len(faces) > MOST_FACES:
        raise InvalidInput(f"{name}: {len(faces)} triangles; at most {MOST_FACES} are read")
    return checked_mesh(name, vertices, faces)


def checked_mesh(name: str, vertices: Array, faces: Faces) -> Mesh:
    """The mesh of ``vertices`` (n, 3) and ``faces`` (m, 3). Raises :class:`InvalidInput` where it is none."""
    if len(vertices) < 3:
        raise InvalidInput(f"{name}: {len(vertices)} vertices; a mesh needs more")
    if not np.abs(vertices).max() <= LARGEST_COORDINATE:
        raise InvalidInput(f"{name}: a coordinate that is no number, or beyond {LARGEST_COORDINATE:g} m")
    if len(faces) and not (faces.min() >= 0 and faces.max() < len(vertices)):
        raise InvalidInput(f"{name}: a face with a vertex that does not exist")
    return Mesh(name, np.asarray(vertices, dtype=np.float64), np.asarray(faces, dtype=np.int64))


def mesh_inertial(
    mesh: Mesh,
    mode: str = "legacy",
    scale: Sequence[float] = (1.0, 1.0, 1.0),
    refpos: Sequence[float] = (0.0, 0.0, 0.0),
    refquat: Sequence[float] = (1.0, 0.0, 0.0, 0.0),
) -> Inertial:
    """What a mesh of density one weighs: its mass is the volume [m³], or the surface [m²] where ``mode`` is ``shell``.

    ``mode`` is MJCF's ``<mesh inertia=>``, whose default is ``legacy``: pyramids from a point inside to every triangle,
    all counted positive, so that the volume of what is not convex is too large; ``exact``: counted with their sign;
    ``convex``: those of the convex hull. ``scale`` (3,) stretches the axes after ``refpos`` (3,) [m] has been taken off
    and the rotation ``refquat`` (4,) undone. Raises :class:`InvalidInput` where it weighs nothing, or less.
    """
    if mode not in MODES:
        raise InvalidInput(f"{mesh.name}: inertia={mode!r:.20}: one of {', '.join(MODES)} is needed")
    stretch = np.asarray(scale, dtype=np.float64)
    placed = (mesh.vertices - np.asarray(refpos)) @ from_quaternion(refquat) * stretch
    faces = mesh.faces
    mirrored = math.prod(scale) < 0
    if mode == "exact":
        _refuse_inconsistent(mesh)
    if mode == "convex" or not len(faces):
        faces, mirrored = _hull(mesh.name, placed), False
    corners = placed[faces[:, ::-1] if mirrored else faces]
    areas, middles = _areas(corners), corners.mean(axis=1)
    surface = float(areas.sum())
    if not surface >= LEAST:
        raise InvalidInput(f"{mesh.name}: its surface is {surface:g} m²; nothing so small is weighed")
    apex = areas @ middles / surface
    if mode == "shell":
        return _moments(corners - apex, areas, apex, 12.0)
    volumes = _pyramids(corners - apex, mode)
    volume = float(volumes.sum())
    if not volume >= LEAST:
        hint = "its triangles face inwards" if volume < -LEAST else "inertia='shell' weighs a surface"
        raise InvalidInput(f"{mesh.name}: its volume is {volume:g} m³; {hint}")
    centre = volumes @ (middles * 0.75 + apex * 0.25) / volume
    moved = corners - centre
    return _moments(moved, _pyramids(moved, mode), centre, 20.0)


def _refuse_inconsistent(mesh: Mesh) -> None:
    """Refuse a mesh in which two triangles have an edge in the same direction: one of them is turned over."""
    _, same = np.unique(mesh.vertices, axis=0, return_inverse=True)
    solid = mesh.faces[_areas(mesh.vertices[mesh.faces]) > math.sqrt(LEAST)]
    edges = same.reshape(-1)[np.concatenate([solid[:, [0, 1]], solid[:, [1, 2]], solid[:, [2, 0]]])]
    if len(np.unique(edges, axis=0)) < len(edges):
        raise InvalidInput(
            f"{mesh.name}: some triangles face inwards, others outwards; inertia='exact' needs one sense"
        )


def _areas(corners: Array) -> Array:
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return np.asarray(np.linalg.norm(cross, axis=1) / 2)


def _pyramids(corners: Array, mode: str) -> Array:
    """Volume of the pyramid from the origin to each triangle, (m,)."""
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    signed = np.einsum("ij,ij->i", corners.mean(axis=1), cross) / 6
    return np.asarray(np.abs(signed) if mode == "legacy" else signed)


def _moments(corners: Array, weights: Array, centre: Array, divisor: float) -> Inertial:
    """The inertial of pyramids from the origin (``divisor`` 20) or triangles (12); ``corners`` are about ``centre``.

    The second moment ∫ x xᵀ of either is weight/divisor · (Σ c cᵀ + (Σ c)(Σ c)ᵀ) over its three corners c.
    """
    sums = corners.sum(axis=1)
    second = np.einsum("i,ijk,ijl->kl", weights, corners, corners) + np.einsum("i,ik,il->kl", weights, sums, sums)
    second = second / divisor
    return Inertial(float(weights.sum()), np.asarray(centre), np.trace(second) * np.eye(3) - second)


def _hull(name: str, vertices: Array) -> Faces:
    """The triangles of the convex hull, counter-clockwise from outside."""
    spatial = library("scipy.spatial")  # 0.2 s, and few files need it

    try:
        hull = spatial.ConvexHull(vertices, qhull_options="Qt")
    except (spatial.QhullError, ValueError) as error:
        raise InvalidInput(f"{name}: no convex hull: {str(error).splitlines()[0][:120]}") from None
    corners = vertices[hull.simplices]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inwards = np.einsum("ij,ij->i", normals, hull.equations[:, :3]) < 0
    faces: Faces = hull.simplices.astype(np.int64)
    faces[inwards] = faces[inwards][:, ::-1]
    return faces


def _unnumbered(corners: Array) -> tuple[Array, Faces]:
    """Vertices and faces of triangles (m, 3, 3) that share nothing."""
    return corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3)


def _stl(name: str, content: bytes) -> tuple[Array, Faces]:
    count = int.from_bytes(content[80:84], "little") if len(content) >= 84 else -1
    if len(content) == 84 + 50 * count:
        if not 0 < count <= MOST_FACES:
            raise InvalidInput(f"{name}: {count} triangles; from 1 to {MOST_FACES} are read")
        triangles = np.frombuffer(content, TRIANGLE, count, 84)
        return _unnumbered(triangles["corners"].astype(np.float64))
    if not content.lstrip()[:5].lower() == b"solid":
        raise InvalidInput(f"{name}: its size is not that of the {count} triangles that its header says")
    words = [line.split() for line in content.lower().splitlines() if line.lstrip().startswith(b"vertex")]
    if not words or len(words) % 3 or len(words) > 3 * MOST_FACES:
        raise InvalidInput(f"{name}: {len(words)} lines with a vertex; three a triangle are needed")
    return _unnumbered(_singles([w[1:4] for w in words]).reshape(-1, 3, 3))


def _singles(rows: list[list[bytes]]) -> Array:
    return np.array([[float(word) for word in row] for row in rows]).astype(np.float32).astype(np.float64)


def _msh(name: str, content: bytes) -> tuple[Array, Faces]:
    counts = np.frombuffer(content, "<i4", 4) if len(content) >= 16 else np.full(4, -1)
    vertices, normals, texture, faces = map(int, counts)
    floats = 3 * vertices + 3 * normals + 2 * texture
    if min(counts) < 0 or len(content) != 16 + 4 * (floats + 3 * faces):
        raise InvalidInput(f"{name}: its size is not that of the vertices and faces that its header says")
    points = np.frombuffer(content, "<f4", 3 * vertices, 16).reshape(-1, 3)
    corners = np.frombuffer(content, "<i4", 3 * faces, 16 + 4 * floats).reshape(-1, 3)
    return points.astype(np.float64), corners.astype(np.int64)


def _obj(name: str, content: bytes) -> tuple[Array, Faces]:
    """All vertices, and the faces of the first object or group that has any: MuJoCo leaves out the others."""
    points: list[list[bytes]] = []
    polygons: list[list[int]] = []
    ended = False
    for line in content.splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == b"v":
            points.append(words[1:4])
        elif words[0] in (b"o", b"g"):
            ended = bool(polygons)
        elif words[0] == b"f" and not ended:
            if len(words) > MOST_CORNERS:
                raise InvalidInput(f"{name}: a face with {len(words) - 1} corners; at most {MOST_CORNERS} are read")
            # Indices start at one; negative ones count back from the vertex read last.
            indices = [int(word.split(b"/")[0]) for word in words[1:]]
            polygons.append([i - 1 if i > 0 else len(points) + i for i in indices])
    vertices = _singles(points)
    triangles = [triangle for polygon in polygons for triangle in _cut(vertices, polygon)]
    return vertices, np.array(triangles, dtype=np.int64).reshape(-1, 3)


def _cut(vertices: Array, polygon: list[int]) -> list[tuple[int, int, int]]:
    """A face in triangles: one with four corners is cut along its shorter diagonal, others from their first corner."""
    if len(polygon) == 4:
        a, b, c, d = polygon
        if math.dist(vertices[a], vertices[c]) >= math.dist(vertices[b], vertices[d]):
            return [(a, b, d), (b, c, d)]
    return [(polygon[0], polygon[i], polygon[i + 1]) for i in range(1, len(polygon) - 1)]
