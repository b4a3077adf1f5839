"""Photons as arrays: those that a render stores, their flights, and photon maps of any photons."""
from __future__ import annotations

import json
import os
from typing import Any, Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _vpm
from ._render import _whole
from ._scene import Overrides, Scene, _rows
from ._vpm import InputError

#: What the numbers in the field "event" stand for.
EVENTS = tuple(_vpm.photon_events())


class Photons:
    """The photons that the maps of one pass store, those that a render gathers.

    array: structured, read-only, a row for each photon, with the fields
        position (m), direction (of travel, unit), power (W, red, green, blue; divided by the photons emitted),
        density (of a grid at the photon, relative to its largest; else 1: maps store power / density),
        number (of the photon among those emitted), place (its name is in `places`),
        scatterings (before it came there) and reflections (by mirrors and smooth glass), 65535 for all that are more,
        map (its name is in `maps`) and event (its name is in EVENTS).
    emitted: how many photons were. energy: where their power went, W: "emitted", "absorbed_in_media",
        "absorbed_on_surfaces", "escaped", "cut" (of photons that ended at render.max_events).

    Powers of the events "collision" and "hit" sum up to what arrived in a region. Those of the event "flight" stand for
    collisions that there are too few of where a grid is thin: they belong to sums of power / density alone.
    """

    def __init__(self, stored: _vpm.StoredPhotons):
        self._stored = stored
        self.array: NDArray[Any] = stored.array()
        self.maps, self.places, self.emitted, self.energy = stored.maps, stored.places, stored.emitted, stored.energy()

    def of(self, map: str | None = None, place: str | None = None, event: str | None = None) -> NDArray[Any]:
        """The rows of the map, of the medium or shape, and of the event, of that name."""
        chosen = np.ones(len(self.array), bool)
        if map is not None:
            chosen &= self.array["map"] == _number(map, self.maps, "map")
        if place is not None:
            chosen &= self.array["place"] == _number(place, self.places, "medium or shape")
        if event is not None:
            chosen &= self.array["event"] == _number(event, list(EVENTS), "event")
        return self.array[chosen]

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes a .ply or .csv file as `vpm photons` does, or an .npz: each field an array, and the lists of names."""
        _write(self._stored, os.fspath(path), self.array, maps=self.maps, places=self.places, events=EVENTS,
               emitted=self.emitted)

    def __len__(self) -> int:
        return len(self.array)

    def __repr__(self) -> str:
        return f"Photons({len(self)} stored of {self.emitted} emitted, in {' and '.join(self.maps) or 'no map'})"


class Flights:
    """All flights of the photons of one pass.

    array: structured, read-only, a row for each straight flight, photon by photon in the order of travel, with the
        fields start and end (m), power (W, on arrival), place (its name is in `places`; 2^32 - 1 where it escapes),
        number (of the photon), scatterings and reflections (before it arrives), event (its name is in EVENTS).
    """

    def __init__(self, flights: _vpm.PhotonFlights):
        self._flights = flights
        self.array: NDArray[Any] = flights.array()
        self.places, self.emitted = flights.places, flights.emitted

    def paths(self) -> list[NDArray[np.float32]]:
        """The corners of each path, an array (n, 3), m: where it begins, and the ends of its flights."""
        rows = self.array
        goes_on = (rows["number"][1:] == rows["number"][:-1]) & (rows["start"][1:] == rows["end"][:-1]).all(axis=1)
        parts = np.split(np.arange(len(rows)), np.flatnonzero(~goes_on) + 1) if len(rows) else []
        return [np.concatenate([rows["start"][part[:1]], rows["end"][part]]) for part in parts]

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes a .ply or .csv file as `vpm photons --paths` does, or an .npz."""
        _write(self._flights, os.fspath(path), self.array, places=self.places, events=EVENTS, emitted=self.emitted)

    def __len__(self) -> int:
        return len(self.array)

    def __repr__(self) -> str:
        return f"Flights({len(self)} of {self.emitted} photons)"


def photons(scene: Scene | str | os.PathLike[str] | Mapping[str, Any], *, overrides: Overrides = None,
            seed: int | None = None, number: int = 0) -> Photons:
    """The photons that pass `number`, from 0, of a render stores in its maps.

    scene: a `Scene`, or what makes one. Its integrator must be "photon-map".
    """
    return Photons(_vpm.stored_photons(*_asked(scene, overrides, seed, number)))


def flights(scene: Scene | str | os.PathLike[str] | Mapping[str, Any], *, overrides: Overrides = None,
            seed: int | None = None, number: int = 0) -> Flights:
    """All flights of the same photons, from the lights to where they end. As these are the photons of a pass of
    photon maps, the integrator must be "photon-map" here, too."""
    return Flights(_vpm.photon_flights(*_asked(scene, overrides, seed, number)))


class Field:
    """Fluence and absorbed power inside the media of a scene, in the cells of a box: means over passes and cells.

    fluence (W/m^2, of the part of a cell where there is a medium, over the whole cell), absorbed (W/m^3), and their
    standard errors fluence_error and absorbed_error (nan of a single pass): read-only arrays (nx, ny, nz, 3). flux and
    flux_error: net flux along x, y and z, W/m^2, in media as fluence is: arrays (3, nx, ny, nz, 3), None unless asked
    for. box: the corners, m. passes: how many. energy: where the power of all photons went, W, as of `Photons`.
    """

    def __init__(self, field: _vpm.FluenceField):
        self._field = field
        self.fluence, self.fluence_error = field.fluence(), field.fluence_error()
        self.absorbed, self.absorbed_error = field.absorbed(), field.absorbed_error()
        self.flux, self.flux_error = field.flux(), field.flux_error()
        self.box, self.passes, self.energy = field.box, field.passes, field.energy()

    @property
    def cell_volume(self) -> float:
        """m^3"""
        return float(np.prod(np.subtract(self.box[1], self.box[0]) / self.fluence.shape[:3]))

    def centers(self) -> list[NDArray[np.float64]]:
        """Where the cells' centers are along x, y and z, m."""
        return [lo + (np.arange(n) + 0.5) * (hi - lo) / n for lo, hi, n in zip(*self.box, self.fluence.shape)]

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the .npy or .vdb file that `vpm fluence` writes."""
        self._field.write(os.fspath(path))

    def __repr__(self) -> str:
        return f"Field({' x '.join(map(str, self.fluence.shape[:3]))} cells, {self.passes} passes)"


def fluence(scene: Scene | str | os.PathLike[str] | Mapping[str, Any], *, overrides: Overrides = None,
            box: ArrayLike | None = None, cells: int | tuple[int, int, int] = 64, passes: int = 16,
            time: float | None = None, flux: bool = False, seed: int | None = None) -> Field:
    """Fluence and absorbed power inside media, whatever the integrator: by the lengths of photons' flights, and by
    their collisions. The same bits on any number of threads.

    box: its corners ((x0, y0, z0), (x1, y1, z1)), m; that of all shapes unless given. cells: how many along its longest
    edge, in about cubes; or along each axis. passes: how many, each of as many photons as the scene says; time: as many
    as fit into so many seconds instead. flux: net flux, too.
    """
    job, seed, _ = _asked(scene, overrides, seed, 0)
    corners = None
    if box is not None:
        found = np.asarray(box, np.float64)
        if found.shape != (2, 3) or not np.isfinite(found).all() or not (found[0] < found[1]).all():
            raise InputError(f"box: {box} is not ((x0, y0, z0), (x1, y1, z1)) with the first corner below the second")
        corners = [float(x) for x in found.ravel()]
    if np.shape(cells) not in ((), (3,)):
        raise InputError(f"cells: {cells} is neither a number nor one for each axis")
    count = None if np.ndim(cells) == 0 else tuple(_whole(n, "cells", 1, 100_000) for n in cells)
    if cells is None:
        raise InputError("cells: a number, not None")
    resolution = _whole(cells, "cells", 1, 4096) if count is None else 1
    return Field(_vpm.fluence(job, seed, corners, resolution, count, *_until(passes, time), bool(flux)))


class Reading:
    """What one detector counted: power over passes, W, arrays of red, green, blue; and how many photons.

    Of surfaces: forward (to the side that the normal points to; outwards of spheres) and backward, their standard
    errors forward_error and backward_error (nan of a single pass), forward_count and backward_count; and the same in
    parts, arrays (cells along edge_u, cells along edge_v, angles, 3): forward_parts, forward_parts_error, .... Parts of
    angles are of equal solid angle, from the normal (or its opposite) on. Of media: absorbed, absorbed_error,
    absorbed_count (of collisions).
    """

    def __init__(self, reading: Mapping[str, Any]):
        self.name = reading["name"]
        for side in ("forward", "backward", "absorbed"):
            if side in reading:
                self._add(side, reading[side])

    def _add(self, side: str, found: Mapping[str, Any]) -> None:
        setattr(self, side, np.array(found["power_W"], float))
        setattr(self, side + "_error", np.array(found["standard_error_W"], float))
        setattr(self, side + "_count", found["count"])
        parts = found.get("parts", [])
        if parts:
            last = parts[-1]["cell"]
            shape = (last[0] + 1, last[1] + 1, -1, 3)
            for name, key in ((side + "_parts", "power_W"), (side + "_parts_error", "standard_error_W")):
                setattr(self, name, np.array([part[key] for part in parts], float).reshape(shape))

    def __repr__(self) -> str:
        return f"Reading({self.name!r})"


class Measurement:
    """Readings by name: measurement["top"].forward; and the energy of all photons, W.

    passes, photons: how many there were. emitted, absorbed_in_media, absorbed_on_surfaces, escaped and
    cut_at_max_events (of photons that ended at render.max_events): W, pairs of the value and its standard
    error. slab: where the scene is a plane layer under parallel light along its normal, a dict of "reflected",
    "transmitted" and "absorbed", each the shares of the light, their standard errors, and the exact ones; else None.
    """

    def __init__(self, measured: _vpm.Measured):
        found = json.loads(measured.json)
        self.passes, self.photons = found["passes"], found["photons"]
        self.readings = [Reading(reading) for reading in found["detectors"]]
        for name in ("emitted", "absorbed_in_media", "absorbed_on_surfaces", "escaped", "cut_at_max_events"):
            flux = found[name]
            setattr(self, name, (np.array(flux["power_W"], float), np.array(flux["standard_error_W"], float)))
        self.slab = measured.slab

    def __getitem__(self, name: str) -> Reading:
        names = [reading.name for reading in self.readings]
        return self.readings[_number(name, names, "detector")]

    def __repr__(self) -> str:
        return f"Measurement({', '.join(reading.name for reading in self.readings)}; {self.passes} passes)"


def measure(scene: Scene | str | os.PathLike[str] | Mapping[str, Any], *, overrides: Overrides = None,
            passes: int = 16, time: float | None = None, seed: int | None = None) -> Measurement:
    """Counts the power that passes the scene's detectors, as `vpm measure` does. passes, time: as of `fluence`."""
    job, seed, _ = _asked(scene, overrides, seed, 0)
    return Measurement(_vpm.measure(job, seed, *_until(passes, time)))


class PhotonMap:
    """A photon map of any photons, for questions about many points at once.

    photons: a structured array with the fields of `Photons.array`, of which power / density is gathered, as renders do;
        or `Photons`; or positions, an array (n, 3), m.
    powers: array (n, 3), W; 1 unless given. directions: array (n, 3), of travel, of any length but 0; up unless given.

    All are kept as float32: far from the origin, move photons and points there. Queries run on all threads
    (`set_threads`). Points side by side in an array are quickest side by side in space.
    """

    def __init__(self, photons: ArrayLike, powers: ArrayLike | None = None, directions: ArrayLike | None = None):
        rows = np.asarray(photons.array if isinstance(photons, Photons) else photons)
        if rows.dtype.names:
            missing = {"position", "direction", "power", "density"} - set(rows.dtype.names)
            if missing:
                raise InputError(f"an array of photons has the fields of Photons.array, but not {', '.join(missing)}")
            if powers is None:
                powers = rows["power"] / rows["density"][:, None]
            if directions is None:
                directions = rows["direction"]
            rows = rows["position"]
        positions = _finite(rows, "positions")
        powers = np.ones_like(positions) if powers is None else _finite(powers, "powers", len(positions))
        if powers.size and powers.min() < 0:
            raise InputError("powers must not be negative")
        if directions is None:
            directions = np.broadcast_to(np.float32([0, 1, 0]), positions.shape)
        self._size = len(positions)
        self._map = _vpm.PhotonQueries(positions, _unit(directions, "directions", len(positions)), powers)

    def __len__(self) -> int:
        return self._size

    def within(self, points: ArrayLike, radius: float, *, lists: bool = False) -> Any:
        """How many photons are nearer to each point than `radius`, m: an array of n counts. With `lists`: the arrays
        `first` and `numbers`; those of point i are numbers[first[i]:first[i + 1]], in rising order."""
        points = _finite(points, "points")
        return (self._map.within if lists else self._map.count_within)(points, _radius(radius))

    def nearest(self, points: ArrayLike, k: int) -> tuple[NDArray[np.uint32], NDArray[np.float32]]:
        """The numbers of the k nearest photons of each point, nearest first, and their distances, m: arrays (n, k)."""
        k = _whole(k, "k", 1, 1_000_000)
        if k > self._size:
            raise InputError(f"k: there are only {self._size} photons, not {k}")
        return self._map.nearest(_finite(points, "points"), k)

    def estimate(self, points: ArrayLike, radius: float, *, normals: ArrayLike | None = None,
                 directions: ArrayLike | None = None, g: float = 0.0, kernel: str = "epanechnikov"
                 ) -> NDArray[np.float32]:
        """The density of power at each point, an array (n, 3).

        With `normals`: the irradiance of a surface there, W/m^2, over discs, by photons that arrive on that side no
        farther from its plane than 0.05 of the radius and 0.3 of their distance: those of other surfaces are left out.
        With `directions`: what a medium scatters into that direction of travel, over its albedo, W/(m^3 sr), over
        balls, by the phase function of Henyey and Greenstein with mean cosine `g`.
        With neither: what collides, W/m^3, over balls.
        Of photons of a grid, whose power / density is gathered, the last two are what they would be at its largest
        density: times the density at the point, over the largest, is what is there.
        kernel: "constant", "cone", "epanechnikov", "biweight", "triweight" or "order-4".
        """
        points = _finite(points, "points")
        if normals is not None and directions is not None:
            raise InputError("give normals (of surfaces) or directions (in media), not both")
        if not -1.0 < g < 1.0:
            raise InputError(f"g: {g} is not a mean cosine above -1 and below 1")
        return self._map.estimate(points, _radius(radius), kernel,
                                  None if normals is None else _unit(normals, "normals", len(points)),
                                  None if directions is None else _unit(directions, "directions", len(points)), g)


def _until(passes: Any, time: Any) -> tuple[int, float | None]:
    if time is not None and not (np.isfinite(time) and time > 0):
        raise InputError(f"time: {time} is not a number of seconds above 0")
    if passes is None:
        raise InputError("passes: a number, not None")
    return _whole(passes, "passes", 1, 1_000_000_000) or 1, time


def _asked(scene: Any, overrides: Overrides, seed: int | None, number: int) -> tuple[_vpm.Job, int | None, int]:
    if not isinstance(scene, Scene):
        scene = Scene(scene, overrides)
    elif overrides is not None:
        raise InputError("a Scene is made already: give overrides to Scene(...)")
    number = _whole(number, "number", 0, 1_000_000_000) or 0
    return scene._job, _whole(seed, "seed", 0, 2**64 - 1), number


def _number(name: str, names: list[str], what: str) -> int:
    if name not in names:
        raise InputError(f"there is no {what} '{name}'; there are: {', '.join(names)}")
    return names.index(name)


def _write(data: Any, path: str, rows: NDArray[Any], **names: Any) -> None:
    if path.endswith(".npz"):
        try:
            with open(path, "wb") as file:
                np.savez(file, **{field: rows[field] for field in rows.dtype.names}, **names)
        except OSError as error:
            raise InputError(f"{path}: cannot be written: {error.strerror}") from None
    elif path.endswith((".ply", ".csv")):
        data.write(path)
    else:
        raise InputError(f"{path}: photons are written as .ply, .csv or .npz")


def _finite(values: ArrayLike, what: str, count: int | None = None) -> NDArray[np.float32]:
    array = _rows(values, 3, what)
    if count is not None and len(array) != count:
        raise InputError(f"there are {len(array)} {what}, not {count}")
    if not np.isfinite(array).all():
        raise InputError(f"{what} must be finite; row {np.flatnonzero(~np.isfinite(array).all(axis=1))[0]} is not")
    return array


def _unit(values: ArrayLike, what: str, count: int) -> NDArray[np.float32]:
    array = _finite(values, what, count)
    lengths = np.linalg.norm(array.astype(np.float64), axis=1, keepdims=True)
    if not (lengths > 0).all():
        raise InputError(f"{what} must not be 0; row {np.flatnonzero(lengths[:, 0] == 0)[0]} is")
    return (array / lengths).astype(np.float32)


def _radius(radius: float) -> float:
    if np.ndim(radius) != 0 or not 1e-10 <= radius <= 1e9:
        raise InputError(f"radius: {radius} is not a number of metres from 1e-10 to 1e9")
    return float(radius)
