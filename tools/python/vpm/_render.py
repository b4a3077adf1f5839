"""Renders: until a stop rule is met, or pass by pass."""
from __future__ import annotations

import functools
import json
import os
from typing import Any, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from . import _vpm
from ._scene import Overrides, Scene
from ._vpm import InputError

Image = NDArray[np.float32]


def _read_only(picture: Image) -> Image:
    """What is written to a file is the render, and not the array: changes of that would be lost."""
    picture.setflags(write=False)
    return picture


class Interrupted(KeyboardInterrupt):
    """Ctrl-C while vpm rendered. `result` has the passes that were finished by then; it may have none."""

    def __init__(self, result: Result):
        super().__init__(f"interrupted after {result.passes} passes")
        self.result = result


class Result:
    """The passes of a render: a value, which further passes do not change.

    Pictures are arrays (height, width, 3), rows from the top, of float32 in linear sRGB.
    """

    def __init__(self, passes: _vpm.Passes):
        self._passes = passes

    def __reduce__(self) -> Any:
        raise TypeError("results of vpm are not pickled or copied: write() them, and read_exr() what is written")

    @property
    def passes(self) -> int:
        """How many passes there are."""
        return self._passes.count

    @property
    def seconds(self) -> float:
        """How long they took, s of wall clock."""
        return self._passes.seconds

    @property
    def seed(self) -> int:
        """Of all random numbers."""
        return self._passes.seed

    @functools.cached_property
    def radiance(self) -> Image:
        """The mean of the passes, W/(m^2 sr), read-only; black without any. Of a crop its pixels alone: `window`."""
        return _read_only(self._passes.radiance())

    @property
    def window(self) -> tuple[int, int, int, int]:
        """x0, y0, x1, y1: where the pictures are in the whole film, ends excluded."""
        return self._passes.window

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the whole film."""
        return self._passes.size

    @functools.cached_property
    def variance(self) -> Image | None:
        """The variance of that mean, (W/(m^2 sr))^2, read-only; None below two passes."""
        return self._passes.variance()

    @functools.cached_property
    def bias(self) -> Image | None:
        """The bias that the passes show of their kernels, W/(m^2 sr), read-only; None where there are none."""
        return self._passes.bias()

    @functools.cached_property
    def layers(self) -> dict[str, Image]:
        """The layers that a picture file of it has: what each technique finds, "combined.NAME.weighted" and the like,
        W/(m^2 sr), where the scene says integrator.layers = true; and what the camera sees, those of render.layers.
        Arrays (height, width, 3), or (height, width) where there is one channel, as of "depth"."""
        return {name: _read_only(layer) for name, layer in self._passes.layers().items()}

    @functools.cached_property
    def stated_error(self) -> dict[str, float] | None:
        """What the passes show of the relative MSE of their mean: "total", "variance" and "squared_bias" with their
        standard errors, and "highest", which total is below with a confidence of about 80 %. None below eight passes,
        which show too little."""
        return self._passes.stated_error()

    @property
    def error(self) -> float:
        """The relative MSE that the passes are estimated to have; nan below eight passes."""
        return self.stated_error["total"] if self.stated_error else float("nan")

    @property
    def notes(self) -> list[str]:
        """What a user should know of the scene, e.g. settings that were chosen."""
        return self._passes.notes

    @property
    def warnings(self) -> list[str]:
        """What went wrong without stopping the render, a sentence each."""
        return self._passes.warnings()

    @property
    def report(self) -> dict[str, Any]:
        """The report that the command line writes as JSON: provenance, times, counts, the energy ledger."""
        report: dict[str, Any] = json.loads(self._passes.report())
        return report

    def write(self, path: str | os.PathLike[str], *, exposure: float | None = None) -> None:
        """Writes what `vpm render -o PATH` writes: the EXR, its PNG preview and its JSON report beside it. `exposure`:
        stops by which the preview is exposed."""
        self._passes.write(os.fspath(path), exposure)

    def resume(self, *, passes: int | None = None, seconds: float | None = None, error: float | None = None,
               progress: bool = False) -> Result:
        """Goes on until there are so many passes, seconds in all, or so small an error: the same bits as of a render
        that was not interrupted. Without any of them, the stop rule is that of before."""
        return _finish(self._passes.until(*_limits(passes, seconds, error)), progress)

    def __repr__(self) -> str:
        height, width, _ = self.radiance.shape
        return f"Result({width} x {height} pixels, {self.passes} passes in {self.seconds:.1f} s)"


def render(scene: Scene | str | os.PathLike[str] | Mapping[str, Any], *, overrides: Overrides = None,
           passes: int | None = None, seconds: float | None = None, error: float | None = None,
           seed: int | None = None, auto: bool = False, progress: bool = False, together: bool = False) -> Result:
    """Renders a scene until its stop rule is met.

    scene: a `Scene`, or what makes one: a path or a dict, then with `overrides` and `auto`.
    passes: how many; or
    seconds: no pass is begun that would end much later, and one that is under way then is dropped; and, or,
    error: until the estimated relative MSE is no more than that. Without any of the three, the scene says.
    seed: of all random numbers; without one, the scene says.
    progress: show a bar on a terminal.
    together: share the passes among the processes that `mpiexec -n 8 python3 -m mpi4py SCRIPT` starts, all of which
        call this at once, with the same scene. All have the same result, of the same bits as that of one process, and
        go on together with its resume(); its write() is left to rank 0. One thread at a time may do so. Once such a
        call has raised, further ones do, too, and the end of this process ends all, with status 1: the others may wait
        for it. Takes a vpm that is built with MPI.

    Other threads of Python run meanwhile. Ctrl-C raises `Interrupted`, a KeyboardInterrupt whose `result` has the
    passes that were finished. Raises InputError for what the command line refuses, and NoPassFits, a TimeoutError,
    where not even one pass ends within twice `seconds`.
    """
    return _finish(_begin(scene, overrides, auto, _limits(passes, seconds, error), seed, together), progress)


def passes(scene: Scene | str | os.PathLike[str] | Mapping[str, Any], *, overrides: Overrides = None,
           passes: int | None = None, seconds: float | None = None, error: float | None = None,
           seed: int | None = None, auto: bool = False) -> Iterator[Result]:
    """The same pass by pass: yields what there is after each of them, until the stop rule is met or nobody asks.

    for so_far in vpm.passes("scenes/smoke.toml", passes=64):
        print(so_far.passes, so_far.error)
    """
    return _each(_begin(scene, overrides, auto, _limits(passes, seconds, error), seed))


def _begin(scene: Any, overrides: Overrides, auto: bool, limits: tuple[Any, Any, Any],
           seed: int | None, together: bool = False) -> _vpm.Passes:
    if not isinstance(scene, Scene):
        scene = Scene(scene, overrides, auto=auto)
    elif overrides is not None or auto:
        raise InputError("a Scene is made already: give overrides and auto to Scene(...)")
    return _vpm.begin(scene._job, *limits, _whole(seed, "seed", 0, 2**64 - 1), together)


def _finish(begun: _vpm.Passes, progress: bool) -> Result:
    done, interrupt = begun.advance(False, progress)
    if interrupt is not None:
        raise Interrupted(Result(done)) from interrupt
    return Result(done)


def _each(so_far: _vpm.Passes) -> Iterator[Result]:
    while True:
        done, interrupt = so_far.advance(True, False)
        if interrupt is not None:
            raise Interrupted(Result(done)) from interrupt
        if done.count == so_far.count:
            return
        so_far = done
        yield Result(so_far)


def _limits(passes: int | None, seconds: float | None, error: float | None) -> tuple[Any, Any, Any]:
    """The stop rule, checked as the command line checks its options."""
    if passes is not None and (seconds is not None or error is not None):
        raise InputError("passes excludes seconds and error")
    return (_whole(passes, "passes", 1, 1_000_000_000), _above_0(seconds, "seconds", "a number of seconds"),
            _above_0(error, "error", "a relative MSE"))


def _whole(number: int | None, name: str, lo: int, hi: int) -> int | None:
    if number is None:
        return None
    if isinstance(number, bool) or not isinstance(number, (int, np.integer)) or not lo <= number <= hi:
        raise InputError(f"{name}: {number} is not a whole number from {lo} to {hi}")
    return int(number)


def _above_0(number: float | None, name: str, what: str) -> float | None:
    if number is None:
        return None
    if not (0.0 < number < float("inf")):
        raise InputError(f"{name}: {number} is not {what} above 0")
    return float(number)
