"""What pictures are measured against: exact solutions, other pictures, experiments."""
from __future__ import annotations

import csv
import json
import os
import warnings
from pathlib import Path
from typing import Any, Iterable, NamedTuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _vpm
from ._render import Image, Result
from ._vpm import InputError


class Quantity(NamedTuple):
    """A quantity of an exact solution, with its error bounds: one value, or one at each of several places."""
    value: Any  # float, or array (n,); nan where there is no such place
    error: Any  # |value - truth| is no more than this; float, or array (n,)
    unit: str
    places: NDArray[np.float64] | None = None  # (n,), or (n + 1,): edges of bins
    place: str = ""  # what they are
    place_unit: str = ""


def exact(problem: str, **keys: Any) -> dict[str, Quantity]:
    """Solves a problem of `vpm exact` exactly; lists and arrays where it takes several values.

    vpm.exact("slab", tau=2, albedo=0.9, g=0.75)["reflected"].value

    `exact_problems()` lists the problems and their keys. Raises InputError as `vpm exact` does.
    """
    given = [f"{key}={_text(value)}" for key, value in keys.items()]
    return {name: _quantity(rest) for name, *rest in _vpm.exact(problem, given)}


def exact_problems() -> dict[str, dict[str, str]]:
    """The problems that `exact` solves: of each the keys that it takes, with what they mean."""
    def meaning(text: str, otherwise: str, required: bool) -> str:
        return text + (" [required]" if required else f" [{otherwise}]" if otherwise else "")
    return {name: {key: meaning(text, otherwise, required) for key, text, otherwise, required in keys}
            for name, _, keys in _vpm.exact_problems()}


class Picture(NamedTuple):
    """What an EXR file holds. Of a crop these are the pixels of `window` alone."""
    radiance: Image  # (height, width, 3)
    layers: dict[str, Image]  # (height, width, 3), or (height, width) of one channel, by name: "variance", "depth", ...
    planes: dict[str, NDArray[np.float32]]  # (height, width), every channel by its name: "R", "variance.R", ...
    metadata: dict[str, str]
    window: tuple[int, int, int, int]  # x0, y0, x1, y1: where the pixels are in the whole picture, ends excluded
    size: tuple[int, int]  # width and height of the whole


def read_exr(path: str | os.PathLike[str], layer: str = "") -> Picture:
    """Reads an EXR file: its picture, as `vpm error` does, or that of the layer named; layers are those that have
    channels NAME.R, .G and .B, or .X, .Y and .Z, or one, as depth.Z: arrays (height, width, 3) or (height, width).
    Warns where the colours were converted to Rec. 709, and where layers of statistics are left out as they were made
    for other pixels."""
    whole, whole_planes, metadata, window, notes, misfit = _vpm.read_exr(os.fspath(path), layer)
    for note in notes:
        warnings.warn(f"{os.fspath(path)}: {note}", stacklevel=2)
    if misfit:
        warnings.warn(f"{os.fspath(path)}: its layers of statistics are left out: {misfit}", stacklevel=2)
    x0, y0, x1, y1 = window
    radiance = whole[y0:y1, x0:x1]
    planes = {name: plane[y0:y1, x0:x1] for name, plane in whole_planes.items()}
    letters: dict[str, set[str]] = {}
    for plane in planes:
        name, _, letter = plane.rpartition(".")
        letters.setdefault(name, set()).add(letter)
    layers = {}
    for name, given in letters.items():
        if name and len(given) == 1:
            layers[name] = planes[f"{name}.{min(given)}"]
        for three in ("RGB", "XYZ"):
            if name and given == set(three):
                layers[name] = np.stack([planes[f"{name}.{c}"] for c in three], axis=-1)
    if misfit:
        layers = {name: layer for name, layer in layers.items() if name.split(".")[-1] not in ("variance", "bias")}
    return Picture(radiance, layers, planes, metadata, window, (whole.shape[1], whole.shape[0]))


Pictured = Union[Result, Picture, str, "os.PathLike[str]", ArrayLike]


class Errors(NamedTuple):
    """How far a picture I is from a reference R; means are over pixels and channels."""
    mse: float  # mean of (I - R)^2
    relative_mse: float  # mean of (I - R)^2 / (R^2 + 0.01 mean(R)^2), mean(R) over the channel
    relative_mse_of_pbrt: float  # mean of (I - R)^2 / (R + 0.01)^2
    means: tuple[float, float, float]  # of the channels of I
    means_of_reference: tuple[float, float, float]
    difference_of_means: tuple[float, float, float]
    standard_errors_of_means: tuple[float, float, float]  # of that difference; 0 where no variance is known
    less_noise: float  # the relative MSE less what the variances of both pictures make of it, as far as they are known
    standard_error: float  # of that
    noise: float  # what the variance of I makes of it; 0 where it is not known
    noise_of_reference: float  # what that of R does


def error(picture: Pictured, reference: Pictured) -> Errors:
    """How far a picture is from a reference, as `vpm error` prints it. Both are results of renders, EXR files (paths,
    or what `read_exr` returns) or arrays (height, width, 3). All but arrays have their noise, too. Where one is a crop,
    they are compared in the pixels that both have."""
    one, other = _in_common(_noisy(picture), _noisy(reference))
    (height, width), (to_height, to_width) = one.image.shape[:2], other.image.shape[:2]
    if (height, width) != (to_height, to_width) or (one.size and other.size and one.size != other.size):
        raise InputError(f"the picture has {width} x {height} pixels and the reference has {to_width} x {to_height}")
    return Errors(**_vpm.difference(one[:3], other[:3]))


class Comparison(NamedTuple):
    """What `vpm compare -o FOLDER` has written."""
    runs: dict[str, NDArray[Any]]  # columns of results.csv, a row for each run
    methods: dict[str, NDArray[Any]]  # a row for each scene, method and budget: means, with intervals as NAME_lo, _hi
    results: dict[str, Any]  # all of results.json


def read_comparison(folder: str | os.PathLike[str]) -> Comparison:
    """Reads the folder that `vpm compare` has written. Columns are arrays of numbers, or of texts."""
    at = Path(folder)
    try:
        results = json.loads((at / "results.json").read_text())
        with open(at / "results.csv", newline="") as file:
            rows = list(csv.DictReader(file))
    except (OSError, ValueError) as wrong:
        raise InputError(f"{at}: not the folder of a finished comparison: {wrong}") from None
    return Comparison(_columns(rows), _columns(list(_method_rows(results))), results)


_INTERVALS = ("mse", "relative_mse", "bias", "squared_bias", "efficiency")


def _method_rows(results: dict[str, Any]) -> Iterable[dict[str, Any]]:
    for scene in results["scenes"]:
        for method in scene["methods"]:
            for budget, of_budget in zip(results["budgets"], method["budgets"]):
                row = {"scene": scene["name"], "method": method["name"], "budget": budget}
                for name in _INTERVALS:
                    interval = of_budget[name]
                    row.update({name: interval["value"], f"{name}_lo": interval["lo"], f"{name}_hi": interval["hi"]})
                row["variance"] = of_budget["variance"]
                for cost in ("wall_seconds", "cpu_seconds", "passes"):
                    values = [run[cost] for run in of_budget["runs"] if cost in run]
                    if values:
                        row[cost] = sum(values) / len(values)
                yield row


_TEXTS = ("scene", "method", "vpm", "scene_hash", "settings", "processor")
_WHOLE = ("repetition", "seed", "passes", "photons", "threads")


def _columns(rows: list[dict[str, Any]]) -> dict[str, NDArray[Any]]:
    return {name: _column(name, [row.get(name) for row in rows]) for name in (rows[0] if rows else {})}


def _column(name: str, values: list[Any]) -> NDArray[Any]:
    """Texts or numbers, nan where one is not known."""
    if name in _TEXTS:
        return np.array(values, str)
    if name in _WHOLE and all(str(value).isdecimal() for value in values):
        return np.array([int(value) for value in values])
    return np.array([float("nan") if value is None else float(value) for value in values])


def _text(value: Any) -> str:
    if isinstance(value, str):
        return value
    return ",".join(repr(float(number)) for number in np.atleast_1d(np.asarray(value, np.float64)))


def _quantity(found: list[Any]) -> Quantity:
    unit, place, place_unit, places, values, errors = found
    if not place:
        return Quantity(float(values[0]), float(errors[0]), unit)
    return Quantity(values, errors, unit, places, place, place_unit)


class _Noisy(NamedTuple):
    """A picture, and the variances of its pixels and of its channels' means; None where they are not known."""
    image: Any
    variance: Any = None
    of_means: Any = None
    window: tuple[int, int, int, int] | None = None  # where it is in the whole; None of arrays
    size: tuple[int, int] | None = None  # of the whole


def _noisy(picture: Pictured) -> _Noisy:
    if isinstance(picture, Result):
        return _Noisy(picture.radiance, picture.variance, picture._passes.variance_of_means(), picture.window,
                      picture.size)
    if isinstance(picture, (str, os.PathLike)):
        picture = read_exr(picture)
    if isinstance(picture, Picture):
        variance = picture.layers.get("variance")
        means = picture.metadata.get("vpm.varianceOfMeans", "").split()
        broken = 0 if variance is None else np.count_nonzero(~np.isfinite(variance).all(axis=-1))
        if broken:
            warnings.warn(f"{broken} variances of the picture are not finite, so that none of them is used", stacklevel=3)
        if variance is None or broken:
            return _Noisy(picture.radiance, window=picture.window, size=picture.size)
        of_means = tuple(map(float, means)) if len(means) == 3 else None
        return _Noisy(picture.radiance, variance, of_means, picture.window, picture.size)
    return _Noisy(np.asarray(picture, np.float32))


def _in_common(one: _Noisy, other: _Noisy) -> tuple[_Noisy, _Noisy]:
    """Both in the pixels that both have, where they are crops of films of one size."""
    if one.window is None or other.window is None or one.window == other.window or one.size != other.size:
        return one, other
    x0, y0 = max(one.window[0], other.window[0]), max(one.window[1], other.window[1])
    x1, y1 = min(one.window[2], other.window[2]), min(one.window[3], other.window[3])
    if x0 >= x1 or y0 >= y1:
        raise InputError("the picture and the reference have no pixel in common: they are crops")

    def part(noisy: _Noisy) -> _Noisy:
        left, top, right, bottom = noisy.window or (0, 0, 0, 0)
        if (left, top, right, bottom) == (x0, y0, x1, y1):
            return noisy
        rows, columns = slice(y0 - top, y1 - top), slice(x0 - left, x1 - left)
        return _Noisy(noisy.image[rows, columns], None if noisy.variance is None else noisy.variance[rows, columns])

    return part(one), part(other)
