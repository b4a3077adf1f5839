"""vpm: volumetric photon mapping, measured.

    import vpm
    result = vpm.render("scenes/smoke.toml", passes=4)
    result.radiance                     # array (height, width, 3), float32, W/(m^2 sr)
    result.write("smoke.exr")           # what `vpm render` writes

`Scene`, `Grid` and `Mesh` make scenes; `render` and `passes` render them; `photons` and `flights` are what renders are
made of, `PhotonMap` gathers them, `fluence` is what they do inside media, and `measure` what passes detectors; `error`,
`exact` and `read_comparison` say how good pictures are. Lengths are in m, coefficients in 1/m, radiance in W/(m^2 sr).
"""
from ._photons import (
    EVENTS, Field, Flights, Measurement, PhotonMap, Photons, Reading, flights, fluence, measure, photons)
from ._render import Interrupted, Result, passes, render
from ._scene import Grid, Mesh, Scene
from ._study import (Comparison, Errors, Picture, Quantity, error, exact, exact_problems, read_comparison, read_exr)
from ._vpm import InputError, NoPassFits, set_threads, thread_count, version

__all__ = [
    "Comparison", "EVENTS", "Errors", "Field", "Flights", "Grid", "InputError", "Interrupted", "Measurement", "Mesh",
    "NoPassFits", "PhotonMap", "Photons", "Picture", "Quantity", "Reading", "Result", "Scene", "error", "exact",
    "exact_problems", "flights", "fluence", "measure", "passes", "photons", "read_comparison", "read_exr", "render",
    "set_threads", "thread_count", "version",
]
__version__ = version().split()[0]
