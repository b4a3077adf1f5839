"""What the Python package refuses: with the text of the command line."""
import numpy as np
import pytest
import vpm
from ball import BALL, BALL_FILE
from like_ball import PYRAMID, TILTED, changed, cloud, command, meshed, smoke


def test_errors_have_the_text_of_the_command_line(ball_file):
    ball_file.write_text(BALL_FILE.replace("sigma_a = 0.1", "sigma_a = -1"))
    _, told = command("render", ball_file, status=2)
    with pytest.raises(vpm.InputError) as error:
        vpm.render(ball_file)
    assert told == f"vpm: {error.value}\n" and isinstance(error.value, ValueError)
    _, told = command("render", ball_file, "--set", "film.width=0", status=2)
    with pytest.raises(vpm.InputError) as error:
        vpm.render(ball_file, overrides={"film.width": 0})
    assert told == f"vpm: {error.value}\n"


def refusal_of(scene):
    with pytest.raises(vpm.InputError) as error:
        vpm.Scene(scene)
    return str(error.value)


def test_errors_of_a_dict_show_the_line_of_the_file_that_it_is():
    scene = changed()
    scene["media"]["fog"]["sigma_a"] = -1
    line = vpm.Scene.text_of(scene).splitlines().index("sigma_a = -1") + 1
    assert refusal_of(scene).startswith(f"<dict>:{line}:11: 'sigma_a' of [media.fog]")
    assert f"{line} | sigma_a = -1" in refusal_of(scene)
    assert "did you mean 'camera'" in refusal_of({**BALL, "camra": {}})
    assert refusal_of(changed(film={"width": None})).startswith("film.width is None, of type NoneType")
    assert refusal_of({**BALL, 3: {}}) == "the scene has the key 3, which is no text"


@pytest.mark.parametrize("grid, text", [
    (np.full((3, 3, 3), -1), "the array has 27 negative values, the first (-1) at [0, 0, 0]; clamp_negative = true"),
    (np.full((2, 2, 2), np.nan), "the array has 8 NaN or infinite values, the first (nan) at [0, 0, 0]"),
    (np.zeros((2, 2, 2)), "the array has no value other than 0"),
    (np.ones((2, 2)), "media.smoke.grid: a grid is an array (nx, ny, nz) with voxels, not one of shape (2, 2)"),
    (np.ones((2, 2, 2), complex), "media.smoke.grid: the values of a grid must be real numbers"),
    (vpm.Grid(np.ones((2, 2, 2)), np.zeros((4, 4))), "the last row of the array's transform must be 0, 0, 0, 1"),
    (vpm.Grid(np.ones((2, 2, 2)), np.diag([1, 0, 1, 1])), "the array has a transform that flattens space"),
])
def test_arrays_that_are_no_density_are_refused(grid, text):
    told = refusal_of(smoke(grid=grid))
    assert text in told
    assert told.startswith("media.smoke.grid: ") or "grid = \"array of " in told  # the line that it is about


def test_negative_densities_are_read_as_0_on_request(tmp_path):
    grid = vpm.Grid(np.where(cloud() == 0, -1, cloud()), TILTED)
    grid.write(tmp_path / "cloud.vdb")
    of_array = vpm.render(smoke(grid=grid, clamp_negative=True), passes=1)
    of_file = vpm.render(smoke(path=tmp_path / "cloud.vdb", clamp_negative=True), passes=1)
    assert np.array_equal(of_array.radiance, of_file.radiance)
    assert of_array.notes == of_file.notes and "negative densities set to 0" in of_array.notes[0]


def test_keys_of_files_do_not_go_with_arrays():
    assert "unknown key 'path'" in refusal_of(smoke(grid=cloud(), path="cloud.vdb"))
    assert "from_level_set" in refusal_of(smoke(grid=cloud(), from_level_set=True))
    assert "path" in refusal_of(meshed(mesh=vpm.Mesh(*PYRAMID), path="a.ply"))
    assert "lacks the key 'path'" in refusal_of(smoke())


@pytest.mark.parametrize("vertices, faces, text", [
    (PYRAMID[0][:, :2], PYRAMID[1], "the vertices of a mesh are an array (n, 3)"),
    (PYRAMID[0], PYRAMID[1] + 1, "a face names vertex 4 (counted from 0), but there are only 4"),
    (PYRAMID[0], PYRAMID[1] - 1, "a face names vertex -1 (counted from 0)"),
    (PYRAMID[0], PYRAMID[1] * 1.0, "of integers"),
])
def test_arrays_that_are_no_mesh_are_refused(vertices, faces, text):
    with pytest.raises(vpm.InputError) as error:
        vpm.Mesh(vertices, faces)
    assert text in str(error.value)


def test_meshes_without_area_are_refused():
    told = refusal_of(meshed(mesh=vpm.Mesh(np.zeros((3, 3)), [[0, 1, 2]])))
    assert "no face of the mesh has an area" in told and 'mesh = "mesh of 3 vertices and 1 faces"' in told


@pytest.mark.parametrize("limits", [{"passes": 0}, {"passes": 1.5}, {"passes": True}, {"seconds": 0}, {"error": -1},
                                    {"passes": 1, "seconds": 1}, {"seed": -1}, {"seed": 2**64},
                                    {"seconds": float("nan")}])
def test_limits_out_of_range_are_refused(limits):
    with pytest.raises(vpm.InputError):
        vpm.render(BALL, **limits)
