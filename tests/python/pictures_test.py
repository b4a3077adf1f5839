"""Pictures of the Python package: the bits, layers and files of the command line."""
import copy
import json
import pickle

import numpy as np
import pytest
import vpm
from ball import BALL, BALL_FILE
from like_ball import command


def without_times(value):
    """A report without what differs from run to run: times, peaks of memory, and the place of the image."""
    if isinstance(value, dict):
        return {key: without_times(entry) for key, entry in value.items()
                if not any(word in key for word in ("second", "image", "times", "peak"))}
    return [without_times(entry) for entry in value] if isinstance(value, list) else value


def test_a_scene_file_gives_the_bits_of_the_command_line(ball_file, tmp_path):
    command("render", ball_file, "-o", tmp_path / "line.exr", "--passes", 3, "--seed", 5, "--set", "film.width=20")
    result = vpm.render(ball_file, overrides={"film.width": 20}, passes=3, seed=5)
    line = vpm.read_exr(tmp_path / "line.exr")
    assert result.radiance.shape == (16, 20, 3) and result.radiance.dtype == np.float32
    assert result.radiance.max() > 0
    assert np.array_equal(result.radiance, line.radiance)
    assert np.array_equal(result.variance, line.layers["variance"])
    assert np.array_equal(result.bias, line.layers["bias"])
    assert (result.passes, result.seed) == (3, 5)


def test_results_are_written_as_by_the_command_line(ball_file, tmp_path):
    assert command("--version")[0] == f"vpm {vpm.version()}\n", "build both: the targets vpm and vpm_python"
    (tmp_path / "line").mkdir()
    (tmp_path / "python").mkdir()
    command("render", ball_file, "-o", tmp_path / "line/a.exr", "--passes", 2, "--set", "film.width=20")
    result = vpm.render(ball_file, overrides=["film.width=20"], passes=2)
    result.write(tmp_path / "python/a.exr")
    for name in ("a.exr", "a.png"):
        assert (tmp_path / "line" / name).read_bytes() == (tmp_path / "python" / name).read_bytes()
    line, python = (json.loads((tmp_path / folder / "a.json").read_text()) for folder in ("line", "python"))
    assert line.keys() == python.keys() == result.report.keys()
    assert without_times(line) == without_times(python) and len(without_times(line)) > 5
    with pytest.raises(vpm.InputError, match="must end in .exr"):
        result.write(tmp_path / "a.png")
    (tmp_path / "ball.exr").symlink_to(ball_file)
    with pytest.raises(vpm.InputError, match="the scene is read from"):
        result.write(tmp_path / "ball.exr")
    assert ball_file.read_text() == BALL_FILE


def test_layers_are_those_of_the_file(ball_file, tmp_path):
    overrides = ["integrator.type=combined", "integrator.layers=true", 'render.layers=["depth", "normal", "samples"]']
    result = vpm.render(ball_file, overrides=overrides, passes=2)
    shape = result.radiance.shape
    assert result.layers["depth"].shape == result.layers["samples"].shape == shape[:2]
    assert result.layers["normal"].shape == result.layers["combined.points-3d.weighted"].shape == shape
    result.write(tmp_path / "a.exr")
    layers = vpm.read_exr(tmp_path / "a.exr").layers
    assert {"variance", *result.layers} <= set(layers) and len(result.layers) > 4
    for name, layer in result.layers.items():
        assert np.array_equal(layer, layers[name])


def test_a_crop_is_an_array_of_its_pixels_wherever_it_comes_from(ball_file, tmp_path):
    whole = vpm.render(ball_file, passes=2, seed=3)
    part = vpm.render(ball_file, overrides={"film.crop": [3, 2, 13, 9]}, passes=2)
    assert part.window == (3, 2, 13, 9) and part.radiance.shape == (7, 10, 3)
    part.write(tmp_path / "part.exr")
    picture = vpm.read_exr(tmp_path / "part.exr")
    assert picture.window == part.window and np.array_equal(picture.radiance, part.radiance)
    assert np.array_equal(picture.layers["variance"], part.variance)
    told = vpm.error(part.radiance, whole.radiance[2:9, 3:13])
    assert vpm.error(part, whole).relative_mse == vpm.error(picture, whole).relative_mse == told.relative_mse
    whole.write(tmp_path / "whole.exr")
    line = json.loads(command("error", tmp_path / "part.exr", tmp_path / "whole.exr", "--json")[0])
    assert line["relative_mse"]["value"] == told.relative_mse
    with pytest.raises(vpm.InputError, match="the picture has 10 x 7 pixels and the reference has 48 x"):
        vpm.error(part, vpm.render(ball_file, overrides={"film.width": 48}, passes=1))
    with pytest.raises(vpm.InputError, match="the picture has"):
        vpm.error(whole, vpm.render(ball_file, overrides={"film.width": 48}, passes=1))
    with pytest.raises(vpm.InputError, match="no pixel in common"):
        vpm.error(part, vpm.render(ball_file, overrides={"film.crop": [13, 2, 15, 9]}, passes=2))


def test_a_render_without_passes_has_no_layers():
    scene = vpm.Scene(BALL, ['render.layers=["depth"]'])
    before = vpm.Result(vpm._vpm.begin(scene._job, 1, None, None, None, False))
    assert before.passes == 0 and before.layers == {}


def test_what_would_be_lost_is_refused():
    result = vpm.render(BALL, passes=1)
    with pytest.raises(ValueError, match="read-only"):
        result.radiance[0, 0] = 1
    with pytest.raises(TypeError, match="write\\(\\) them"):
        pickle.dumps(result)
    with pytest.raises(TypeError, match="anew of their file"):
        copy.deepcopy(vpm.Scene(BALL))


def test_pictures_are_not_copied():
    result = vpm.render(BALL, passes=2)
    assert result.radiance is result.radiance and result.radiance.base is not None
    again = result._passes.variance()
    assert not result.variance.flags.writeable and not result.variance.flags.owndata
    assert again.__array_interface__["data"][0] == result.variance.__array_interface__["data"][0]
    variance = result.variance
    kept = variance.copy()
    del result, again
    assert np.array_equal(variance, kept)  # the memory lives as long as the array


def test_below_two_passes_there_is_no_variance():
    result = vpm.render(BALL, passes=1)
    assert result.variance is None and result.bias is None and result.stated_error is None
    assert np.isnan(result.error)
