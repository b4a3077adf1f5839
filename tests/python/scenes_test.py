"""Scenes of dicts and arrays: those that the same files are."""
from pathlib import Path

import numpy as np
import pytest
import vpm
from ball import BALL
from like_ball import PYRAMID, TILTED, changed, cloud, meshed, smoke


def test_a_dict_is_the_scene_that_the_same_file_is(ball_file):
    of_file, of_dict = vpm.Scene(ball_file), vpm.Scene(BALL)
    assert np.array_equal(vpm.render(of_file, passes=2).radiance, vpm.render(of_dict, passes=2).radiance)
    assert (of_dict.width, of_dict.height, of_dict.source) == (24, 16, "<dict>")


def test_numpy_values_stand_for_numbers_and_lists():
    scene = changed(film={"width": np.int32(24), "height": np.int64(16)})
    scene["media"]["fog"]["sigma_s"] = np.array([0.5, 0.6, 0.7])
    scene["integrator"]["photons"]["emitted"] = np.uint16(2000)
    scene["shapes"] = tuple(scene["shapes"])
    assert vpm.Scene(scene).hash == vpm.Scene(BALL).hash


def test_all_values_come_back_from_the_text_of_a_scene():
    tomllib = pytest.importorskip("tomllib")  # of Python 3.11
    scene = {"numbers": [1 / 3, 1e-300, -1e22, 2.0, 2**53 + 1, float("inf")], "flags": [True, np.bool_(False)],
             "text": 'quotes ", \\ and \n, \x7f, \u00e9, \U0001f32b', "path": Path("a/b"), "none": [],
             "media": {"a b.c": {"phase": {"type": "x", "deep": [{"g": 0.1}, {}]}, "sigma": np.float32(0.1)}, "é": {}},
             "shapes": [{"transform": [{"scale": 2}, {"rotate": {"axis": np.eye(3)[1], "degrees": 30}}]}, {"a": {}}]}
    read = tomllib.loads(vpm.Scene.text_of(scene))
    assert read["numbers"] == scene["numbers"] and [*map(type, read["numbers"])] == [*map(type, scene["numbers"])]
    assert read["text"] == scene["text"] and read["path"] == "a/b" and read["flags"] == [True, False]
    assert read["media"] == {"a b.c": {"phase": scene["media"]["a b.c"]["phase"], "sigma": float(np.float32(0.1))},
                             "é": {}}
    assert read["shapes"][0]["transform"][1] == {"rotate": {"axis": [0, 1, 0], "degrees": 30}}
    assert read["shapes"][1] == {"a": {}} and read["none"] == []


@pytest.mark.parametrize("interpolation", ["trilinear", "nearest"])
def test_an_array_is_the_grid_that_its_file_is(tmp_path, interpolation):
    grid = vpm.Grid(cloud(), TILTED)
    grid.write(tmp_path / "cloud.vdb")
    keys = {"interpolation": interpolation, "transform": [{"translate": [0.1, 0, 0]}], "density_scale": 1.2}
    of_array = vpm.render(smoke(grid=grid, **keys), passes=2)
    of_file = vpm.render(smoke(path=tmp_path / "cloud.vdb", **keys), passes=2)
    assert np.array_equal(of_array.radiance, of_file.radiance)
    without = vpm.render(changed(media={}, shapes=[BALL["shapes"][1]]), passes=2)
    assert not np.array_equal(of_array.radiance, without.radiance)


def test_an_array_of_any_layout_is_read_in_place():
    values = cloud()
    wide = np.zeros((26, 9, 17), np.float32)
    wide[::2] = values
    fields = np.zeros(values.shape, [("byte", "i1"), ("density", "f4")])  # strides that are no multiple of 4
    fields["density"] = values
    layouts = [np.asfortranarray(values), wide[::2], np.flip(np.flip(values, 1).copy(), 1), fields["density"],
               values.astype(">f4")]
    expected = vpm.render(smoke(grid=vpm.Grid(values, TILTED)), passes=1).radiance
    for layout in layouts:
        assert np.array_equal(vpm.render(smoke(grid=vpm.Grid(layout, TILTED)), passes=1).radiance, expected)
    assert vpm.Grid(wide[::2]).values.base is wide


def test_a_grid_in_a_box_has_its_outermost_voxels_on_the_faces():
    grid = vpm.Grid.in_box(np.ones((3, 5, 2)), [-1, 0, 2], [1, 1, 3])
    assert np.allclose(grid.transform @ [2, 4, 1, 1], [1, 1, 3, 1])
    assert np.allclose(grid.transform @ [0, 0, 0, 1], [-1, 0, 2, 1])
    assert vpm.Scene(smoke(grid=np.ones((2, 2, 2)))).width == 24  # an array by itself
    with pytest.raises(vpm.InputError, match="lo = "):
        vpm.Grid.in_box(np.ones((3, 5, 1)), [-1, 0, 2], [1, 1, 3])


def test_arrays_tell_scenes_apart():
    values = cloud()
    hashes = {vpm.Scene(smoke(grid=vpm.Grid(values, TILTED))).hash}
    hashes.add(vpm.Scene(smoke(grid=vpm.Grid(values, 2 * TILTED - np.diag([0, 0, 0, 1])))).hash)
    values[3, 3, 3] += 1
    hashes.add(vpm.Scene(smoke(grid=vpm.Grid(values, TILTED))).hash)
    assert len(hashes) == 3


def test_a_mesh_of_arrays_is_the_mesh_that_its_file_is(tmp_path):
    normals = PYRAMID[0] + [0, 0, 1]
    mesh = vpm.Mesh(*PYRAMID, normals=normals, uvs=PYRAMID[0][:, :2])
    mesh.write(tmp_path / "pyramid.ply")
    keys = {"transform": [{"scale": 0.5}, {"translate": [0, 0, 1]}]}
    of_arrays = vpm.render(meshed(mesh=mesh, **keys), passes=2).radiance
    of_file = vpm.render(meshed(path=tmp_path / "pyramid.ply", **keys), passes=2).radiance
    assert np.array_equal(of_arrays, of_file)
    assert not np.array_equal(of_arrays, vpm.render(meshed(mesh=vpm.Mesh(*PYRAMID), **keys), passes=2).radiance)
    assert not np.array_equal(of_arrays, vpm.render(BALL, passes=2).radiance)
