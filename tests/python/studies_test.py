"""Exact solutions, errors and comparisons from Python: those of the command line."""
import json
from pathlib import Path

import numpy as np
import pytest
import vpm
from ball import BALL
from like_ball import command


def test_exact_solutions_are_those_of_the_command_line():
    told = json.loads(command("exact", "slab", "tau=2", "albedo=0.9", "g=0.75", "--json")[0])
    solved = vpm.exact("slab", tau=2, albedo=0.9, g=0.75)
    assert set(solved) == {quantity["name"] for quantity in told["quantities"]}
    for quantity in told["quantities"]:
        assert np.array_equal(np.atleast_1d(solved[quantity["name"]].value), quantity["values"])
        assert np.array_equal(np.atleast_1d(solved[quantity["name"]].error), quantity["errors"])
    at = vpm.exact("transmittance", profile="exponential", rate=2, t=np.array([0.25, 0.5]))
    assert any(np.array_equal(quantity.places, [0.25, 0.5]) for quantity in at.values())
    assert "slab" in vpm.exact_problems() and "tau" in vpm.exact_problems()["slab"]


@pytest.mark.parametrize("problem, keys", [("slob", {}), ("slab", {"tau": -1}), ("slab", {"tau": 1, "q": 2})])
def test_wrong_problems_have_the_text_of_the_command_line(problem, keys):
    _, told = command("exact", problem, *(f"{key}={float(value)!r}" for key, value in keys.items()), status=2)
    with pytest.raises(vpm.InputError) as error:
        vpm.exact(problem, **keys)
    assert told == f"vpm: {error.value}\n"


def test_errors_are_those_of_the_command_line(tmp_path):
    one, other = vpm.render(BALL, passes=3, seed=1), vpm.render(BALL, passes=4, seed=2)
    one.write(tmp_path / "one.exr")
    other.write(tmp_path / "other.exr")
    told = json.loads(command("error", tmp_path / "one.exr", tmp_path / "other.exr", "--json")[0])
    for errors in (vpm.error(one, other), vpm.error(tmp_path / "one.exr", tmp_path / "other.exr")):
        assert errors.mse == told["mse"]["value"] > 0
        assert errors.relative_mse == told["relative_mse"]["value"]
        assert errors.relative_mse_of_pbrt == told["relative_mse_of_pbrt"]["value"]
        assert errors.less_noise == pytest.approx(told["relative_mse"]["less_noise"], rel=1e-6)
        assert errors.standard_errors_of_means == pytest.approx(told["means"]["standard_error_of_difference"], rel=1e-6)
    of_arrays = vpm.error(one.radiance, other.radiance)
    assert of_arrays.relative_mse == told["relative_mse"]["value"] and of_arrays.noise == 0
    assert of_arrays.mse == pytest.approx(np.mean((one.radiance - other.radiance).astype(float) ** 2), rel=1e-6)
    with pytest.raises(vpm.InputError, match="has 24 x 16 pixels and the reference has 16 x 24"):
        vpm.error(one, other.radiance.swapaxes(0, 1))
    with pytest.raises(vpm.InputError, match="height, width, 3"):
        vpm.error(one.radiance[..., :2], one.radiance[..., :2])


def test_results_of_comparisons_are_columns(ball_file, tmp_path):
    (tmp_path / "experiment.toml").write_text(f"""
title = "ball"
unit = "passes"
budgets = [1, 2]
repetitions = 3
[reference]
error = 0.01
[[scenes]]
name = "ball"
file = "{ball_file}"
[[methods]]
name = "photon"
[[methods]]
name = "path"
[methods.set]
integrator.type = "path"
""")
    command("compare", tmp_path / "experiment.toml", "-o", tmp_path / "results")
    runs, methods, results = vpm.read_comparison(tmp_path / "results")
    assert len(runs["mse"]) == 2 * 2 * 3 and runs["mse"].dtype == float and runs["passes"].dtype.kind == "i"
    assert set(runs["method"]) == {"photon", "path"}
    assert list(methods["budget"]) == [1, 2, 1, 2] and np.all(methods["mse"] <= methods["mse_hi"])
    one = (runs["method"] == "path") & (runs["budget"] == 2)
    of_methods = (methods["method"] == "path") & (methods["budget"] == 2)
    assert methods["mse"][of_methods][0] == pytest.approx(runs["mse"][one].mean())
    assert results["title"] == "ball"
    with pytest.raises(vpm.InputError, match="not the folder of a finished comparison"):
        vpm.read_comparison(tmp_path)


def test_exact_solutions_have_the_names_that_the_documentation_says():
    readme = (Path(__file__).parents[2] / "tools/python/README.md").read_text()
    lines = [line.split("#")[0] for line in readme.splitlines() if line.startswith("vpm.exact(")]
    assert lines and all(0 < eval(line, {"vpm": vpm}) < 1 for line in lines)
