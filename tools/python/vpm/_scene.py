"""Scenes: from files and from dicts, with arrays where a scene file names grids and meshes."""
from __future__ import annotations

import dataclasses
import os
from typing import Any, Iterable, Mapping, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _vpm
from ._toml import text_of_scene, text_of_value
from ._vpm import InputError

Overrides = Union[Mapping[str, Any], Iterable[str], None]


class Grid:
    """A density grid: values on a lattice, and where it lies.

    values: array (nx, ny, nz) of densities >= 0, of no unit; a medium multiplies them by its coefficients, which are
        those at density 1. Values are read as float32, without a copy where they are; between voxels they are
        interpolated, and outside the array the density is 0.
    transform: array (4, 4) that takes the index (i, j, k, 1) of a voxel, whose value sits at its center, to its
        position (x, y, z, 1) in m. Without one, voxels are 1 m apart, and the first is at the origin. The key
        `transform` of the medium is applied after it.
    """

    def __init__(self, values: ArrayLike, transform: ArrayLike | None = None):
        self.values: NDArray[np.float32] = np.require(_real(values, "the values of a grid"), np.float32, "A")
        if self.values.ndim != 3 or self.values.size == 0:
            raise InputError(f"a grid is an array (nx, ny, nz) with voxels, not one of shape {self.values.shape}")
        self.transform = np.array(np.eye(4) if transform is None else _real(transform, "the transform"), np.float64)
        if self.transform.shape != (4, 4):
            raise InputError(f"the transform of a grid is an array (4, 4), not one of shape {self.transform.shape}")

    @classmethod
    def in_box(cls, values: ArrayLike, lo: ArrayLike, hi: ArrayLike) -> Grid:
        """The grid whose first voxel is at `lo` and whose last voxel is at `hi` (m): corners of a box."""
        grid = cls(values)
        lo, hi = np.asarray(lo, np.float64), np.asarray(hi, np.float64)
        cells = np.array(grid.values.shape) - 1
        if lo.shape != (3,) or hi.shape != (3,) or not np.all(cells > 0) or not np.all(hi > lo):
            raise InputError("a grid in a box has two voxels at least along each axis, and lo = (x, y, z) < hi")
        grid.transform[np.arange(3), np.arange(3)] = (hi - lo) / cells
        grid.transform[:3, 3] = lo
        return grid

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the grid `density` of a .vdb file, which gives a scene the same bits as the array itself."""
        _vpm.write_grid(os.fspath(path), self.values, self.transform)

    def __repr__(self) -> str:
        return f"array of {' x '.join(map(str, self.values.shape))} voxels"


class Mesh:
    """Triangles, counter-clockwise as seen from outside.

    vertices: array (n, 3), m. faces: array (m, 3) of numbers of vertices, from 0. normals: array (n, 3), of vertices,
    for shading; of any length but 0. uvs: array (n, 2), texture coordinates of vertices.
    """

    def __init__(self, vertices: ArrayLike, faces: ArrayLike, normals: ArrayLike | None = None,
                 uvs: ArrayLike | None = None):
        self.vertices = _rows(vertices, 3, "the vertices of a mesh")
        self.normals = None if normals is None else _rows(normals, 3, "the normals of a mesh")
        self.uvs = None if uvs is None else _rows(uvs, 2, "the uvs of a mesh")
        numbers = np.asarray(faces)
        if numbers.ndim != 2 or numbers.shape[1] != 3 or not np.issubdtype(numbers.dtype, np.integer):
            raise InputError(f"the faces of a mesh are an array (m, 3) of integers, not {_kind(numbers)}")
        if numbers.size and not 0 <= numbers.min() <= numbers.max() < len(self.vertices):
            wrong = int(numbers.min() if numbers.min() < 0 else numbers.max())
            raise InputError(f"a face names vertex {wrong} (counted from 0), but there are only {len(self.vertices)}")
        self.faces = numbers.astype(np.uint32)

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes a .ply file, which gives a scene the same bits as the arrays themselves."""
        _vpm.write_mesh(os.fspath(path), self.vertices, self.faces, self.normals, self.uvs)

    def __repr__(self) -> str:
        return f"mesh of {len(self.vertices)} vertices and {len(self.faces)} faces"


class Scene:
    """A scene, read and checked; it can be rendered often, and does not change.

    source: the path of a scene file (.toml), or a dict with the keys of one. In the dict, a medium of the type "grid"
        may have a `grid` that is a `Grid`, or an array of one whose voxels are 1 m apart, in the place of `path`; a
        shape of the type "mesh" may have a `mesh` that is a `Mesh`. Files that a dict names are relative to the
        current folder.
    overrides: what `--set` takes on the command line: a dict {"film.width": 64, "shapes.ball.radius": 2.0}, or a
        list of texts "key.path=value".
    auto: choose what is left out, and all of `[integrator]` where no override names one, as `vpm render --auto` does.

    Raises InputError for what is not right, with the text of the command line. Of a dict it names the line in the text
    of a scene file that says the same; `Scene.text_of(source)` is that text.
    """

    def __init__(self, source: str | os.PathLike[str] | Mapping[str, Any], overrides: Overrides = None, *,
                 auto: bool = False):
        options = _options(overrides)
        if isinstance(source, Mapping):
            parts = _without_arrays(source)
            self._job = _vpm.load_text("<dict>", parts.text, parts.grids, parts.meshes, options, auto)
        else:
            self._job = _vpm.load_file(os.fspath(source), options, auto)

    def __reduce__(self) -> Any:
        raise TypeError("scenes of vpm are not pickled or copied: make them anew of their file or dict")

    @staticmethod
    def text_of(source: Mapping[str, Any]) -> str:
        """The dict as the text of a scene file, in which arrays are only described."""
        return _without_arrays(source).text

    @property
    def width(self) -> int:
        """Of the picture, pixels."""
        return self._job.width

    @property
    def height(self) -> int:
        """Of the picture, pixels."""
        return self._job.height

    @property
    def source(self) -> str:
        """The path of the scene file; "<dict>" of a dict."""
        return self._job.source

    @property
    def hash(self) -> str:
        """Identifies this scene and its settings, 16 hex digits; arrays and the bytes of files count."""
        return self._job.hash

    @property
    def files(self) -> list[str]:
        """Paths of the files that the scene names."""
        return self._job.files

    def __repr__(self) -> str:
        return f"Scene({self.source!r}, {self.width} x {self.height} pixels)"


@dataclasses.dataclass
class _Parts:
    """A scene's text, and the arrays that it leaves out."""
    text: str
    grids: list[tuple[str, str, NDArray[np.float32], NDArray[np.float64]]]  # of media, in a role
    meshes: list[tuple[int, Any, Any, Any, Any]]  # of shapes, by number


def _without_arrays(source: Mapping[str, Any]) -> _Parts:
    scene = dict(source)
    parts = _Parts("", [], [])
    if isinstance(scene.get("media"), Mapping):
        scene["media"] = {name: _medium(name, table, parts) for name, table in scene["media"].items()}
    if isinstance(scene.get("shapes"), (list, tuple)):
        scene["shapes"] = [_shape(number, table, parts) for number, table in enumerate(scene["shapes"])]
    parts.text = text_of_scene(scene)
    return parts


def _medium(name: str, table: Any, parts: _Parts) -> Any:
    table = _with_named_grid(name, "density", table, f"media.{name}", parts)
    emission = table.get("emission") if isinstance(table, Mapping) else None
    if not isinstance(emission, Mapping):
        return table
    emission = _with_named_grid(name, "emission", emission, f"media.{name}.emission", parts)
    temperature = emission.get("temperature")
    if isinstance(temperature, Mapping):
        place = f"media.{name}.emission.temperature"
        emission = {**emission, "temperature": _with_named_grid(name, "emission", temperature, place, parts)}
    return {**table, "emission": emission}


def _with_named_grid(medium: str, role: str, table: Any, place: str, parts: _Parts) -> Any:
    """The table with a name in the place of the array that is its grid."""
    grid = table.get("grid") if isinstance(table, Mapping) else None
    if grid is None or isinstance(grid, str):
        return table
    try:
        grid = grid if isinstance(grid, Grid) else Grid(grid)
    except InputError as error:
        raise InputError(f"{place}.grid: {error}") from None
    parts.grids.append((medium, role, grid.values, grid.transform))
    return {**table, "grid": repr(grid)}


def _shape(number: int, table: Any, parts: _Parts) -> Any:
    mesh = table.get("mesh") if isinstance(table, Mapping) else None
    if not isinstance(mesh, Mesh):
        return table
    parts.meshes.append((number, mesh.vertices, mesh.faces, mesh.normals, mesh.uvs))
    return {**table, "mesh": repr(mesh)}


def _options(overrides: Overrides) -> list[str]:
    if overrides is None:
        return []
    if isinstance(overrides, Mapping):
        return [f"{key}={value if isinstance(value, str) else text_of_value(value, key)}"
                for key, value in overrides.items()]
    if isinstance(overrides, str):
        raise InputError(f"overrides are a dict or a list of texts, not the text {overrides!r}")
    return list(overrides)


def _kind(array: NDArray[Any]) -> str:
    return f"one of shape {array.shape} and type {array.dtype}"


def _real(values: ArrayLike, what: str) -> NDArray[Any]:
    array = np.asarray(values)
    if array.dtype.kind not in "biuf":
        raise InputError(f"{what} must be real numbers, not {_kind(array)}")
    return array


def _rows(values: ArrayLike, width: int, what: str) -> NDArray[np.float32]:
    array = _real(values, what)
    if array.ndim != 2 or array.shape[1] != width:
        raise InputError(f"{what} are an array (n, {width}), not {_kind(array)}")
    return np.ascontiguousarray(array, np.float32)
