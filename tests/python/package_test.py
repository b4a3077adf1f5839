"""The Python package against the command line: the same bits, the same errors."""
import copy
import json
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
import vpm
from ball import BALL, BALL_FILE

PROGRAM = Path(os.environ["VPM_BUILD"]) / "vpm"


def changed(**parts):
    """The ball's scene with other parts."""
    return {**copy.deepcopy(BALL), **parts}


def command(*arguments, status=0):
    """What the command line prints, by stdout and stderr."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == status, done.stderr
    return done.stdout, done.stderr


@pytest.fixture
def ball_file(tmp_path):
    (tmp_path / "ball.toml").write_text(BALL_FILE)
    return tmp_path / "ball.toml"


def without_times(value):
    """A report without what differs from run to run: times, peaks of memory, and the place of the image."""
    if isinstance(value, dict):
        return {key: without_times(entry) for key, entry in value.items()
                if not any(word in key for word in ("second", "image", "times", "peak"))}
    return [without_times(entry) for entry in value] if isinstance(value, list) else value


# --- Pictures out

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
    overrides = ["render.integrator=combined", "combined.layers=true", 'render.layers=["depth", "normal", "samples"]']
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


# --- Scenes in

def test_a_dict_is_the_scene_that_the_same_file_is(ball_file):
    of_file, of_dict = vpm.Scene(ball_file), vpm.Scene(BALL)
    assert np.array_equal(vpm.render(of_file, passes=2).radiance, vpm.render(of_dict, passes=2).radiance)
    assert (of_dict.width, of_dict.height, of_dict.source) == (24, 16, "<dict>")


def test_numpy_values_stand_for_numbers_and_lists():
    scene = changed(film={"width": np.int32(24), "height": np.int64(16)})
    scene["media"]["fog"]["sigma_s"] = np.array([0.5, 0.6, 0.7])
    scene["photons"]["emitted"] = np.uint16(2000)
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


def cloud(shape=(13, 9, 17)):
    """Densities with empty borders, an empty middle, and no symmetry."""
    values = np.random.default_rng(1).random(shape, np.float32) * 4
    values[:2] = values[:, -1:] = values[5:7, 3:5] = 0
    return values


def smoke(**grid):
    return changed(media={"smoke": {"type": "grid", "sigma_t": 1.5, "albedo": 0.8, **grid}},
                   shapes=[BALL["shapes"][1]])


TILTED = np.array([[0.08, 0.02, 0, -0.5], [-0.02, 0.08, 0.01, -0.4], [0, 0.01, 0.06, -0.5], [0, 0, 0, 1]])


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


PYRAMID = (np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0], [0, 0, 1]], float), np.array([[0, 1, 3], [1, 2, 3], [2, 0, 3]]))


def meshed(**mesh):
    return changed(shapes=[*BALL["shapes"], {"name": "pyramid", "type": "mesh", "material": "white", **mesh}])


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


# --- Errors

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


def told_of(scene):
    with pytest.raises(vpm.InputError) as error:
        vpm.Scene(scene)
    return str(error.value)


def test_errors_of_a_dict_show_the_line_of_the_file_that_it_is():
    scene = changed()
    scene["media"]["fog"]["sigma_a"] = -1
    line = vpm.Scene.text_of(scene).splitlines().index("sigma_a = -1") + 1
    assert told_of(scene).startswith(f"<dict>:{line}:11: 'sigma_a' of [media.fog]")
    assert f"{line} | sigma_a = -1" in told_of(scene)
    assert "did you mean 'camera'" in told_of({**BALL, "camra": {}})
    assert told_of(changed(film={"width": None})).startswith("film.width is None, of type NoneType")
    assert told_of({**BALL, 3: {}}) == "the scene has the key 3, which is no text"


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
    told = told_of(smoke(grid=grid))
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
    assert "unknown key 'path'" in told_of(smoke(grid=cloud(), path="cloud.vdb"))
    assert "from_level_set" in told_of(smoke(grid=cloud(), from_level_set=True))
    assert "path" in told_of(meshed(mesh=vpm.Mesh(*PYRAMID), path="a.ply"))
    assert "lacks the key 'path'" in told_of(smoke())


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
    told = told_of(meshed(mesh=vpm.Mesh(np.zeros((3, 3)), [[0, 1, 2]])))
    assert "no face of the mesh has an area" in told and 'mesh = "mesh of 3 vertices and 1 faces"' in told


@pytest.mark.parametrize("limits", [{"passes": 0}, {"passes": 1.5}, {"passes": True}, {"seconds": 0}, {"error": -1},
                                    {"passes": 1, "seconds": 1}, {"seed": -1}, {"seed": 2**64},
                                    {"seconds": float("nan")}])
def test_limits_out_of_range_are_refused(limits):
    with pytest.raises(vpm.InputError):
        vpm.render(BALL, **limits)


# --- Passes, threads, interruptions

def test_passes_are_yielded_one_by_one_with_the_error_so_far():
    scene = vpm.Scene(BALL)
    all_of_them = list(vpm.passes(scene, passes=9, seed=3))
    assert [so_far.passes for so_far in all_of_them] == list(range(1, 10))
    for so_far in (all_of_them[1], all_of_them[8]):  # what was yielded stays what it was
        assert np.array_equal(so_far.radiance, vpm.render(scene, passes=so_far.passes, seed=3).radiance)
    assert [np.isnan(so_far.error) for so_far in all_of_them] == [True] * 7 + [False] * 2
    assert 0 < all_of_them[8].error < all_of_them[8].stated_error["highest"]
    assert all(one.seconds < next.seconds for one, next in zip(all_of_them, all_of_them[1:]))


def test_radii_of_pixels_go_on_from_pass_to_pass():
    overrides = {"surface.gather": "radius", "render.radii": "per-pixel"}
    *_, last = vpm.passes(BALL, overrides=overrides, passes=4)
    assert np.array_equal(last.radiance, vpm.render(BALL, overrides=overrides, passes=4).radiance)


def test_a_render_goes_on():
    scene = vpm.Scene(BALL)
    begun = vpm.render(scene, passes=2)
    assert np.array_equal(begun.resume(passes=5).radiance, vpm.render(scene, passes=5).radiance)
    assert begun.passes == 2 and begun.resume(passes=1).passes == 2


def test_a_process_by_itself_is_together_with_nobody(tmp_path):
    together = vpm.render(BALL, passes=2, together=True)
    assert np.array_equal(together.radiance, vpm.render(BALL, passes=2).radiance)
    together.write(tmp_path / "ball.exr")
    assert np.array_equal(vpm.read_exr(tmp_path / "ball.exr").radiance, together.radiance)


def test_several_processes_without_mpi_are_refused(monkeypatch):
    if "VPM_MPI:BOOL=ON" in (PROGRAM.parent / "CMakeCache.txt").read_text().splitlines():
        pytest.skip("vpm is built with MPI")
    monkeypatch.setenv("OMPI_COMM_WORLD_SIZE", "2")
    script = "import vpm; from ball import BALL; vpm.render(BALL, together=True)"
    done = subprocess.run([sys.executable, "-c", script], cwd=Path(__file__).parent, capture_output=True, text=True)
    assert done.returncode == 1
    assert "this vpm knows no MPI" in done.stderr


def test_stop_rules_end_a_render():
    assert vpm.render(BALL, error=0.5).stated_error["highest"] <= 0.5
    assert 0.2 <= vpm.render(BALL, seconds=0.2).seconds < 5
    assert len(list(vpm.passes(BALL, overrides={"render.passes": 3}))) == 3


def test_values_are_chosen_as_by_the_command_line(ball_file, tmp_path):
    command("render", ball_file, "-o", tmp_path / "line.exr", "--passes", 2, "--set", "volume.radius=auto")
    result = vpm.render(ball_file, overrides={"volume.radius": "auto"}, passes=2)
    assert np.array_equal(result.radiance, vpm.read_exr(tmp_path / "line.exr").radiance)
    assert any("chosen volume.radius" in note for note in result.notes)
    assert not vpm.render(vpm.Scene(ball_file), passes=1).notes


def test_a_scene_is_rendered_with_several_settings_at_once():
    scene = vpm.Scene(BALL)
    one, other = vpm.passes(scene, passes=3, seed=1), vpm.passes(scene, passes=3, seed=2)
    results = [result for pair in zip(one, other) for result in pair]
    for seed in (1, 2):
        assert np.array_equal(results[3 + seed].radiance, vpm.render(scene, passes=3, seed=seed).radiance)
        assert results[3 + seed].seed == seed


def test_other_threads_run_while_vpm_renders():
    """A thread that counts goes on in every fifth of the render's time, not only at its ends."""
    times, done = [], threading.Event()

    def count():
        while not done.is_set():
            times.append(time.monotonic())
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    begun = time.monotonic()
    vpm.render(BALL, seconds=0.5)
    ended = time.monotonic()
    done.set()
    counter.join()
    fifths = np.histogram(times, bins=5, range=(begun, ended))[0]
    assert ended - begun > 0.25 and fifths.min() > 2, fifths


def test_variances_that_are_not_finite_are_told_of():
    picture = vpm.render(BALL, passes=2)
    broken = vpm.Picture(picture.radiance, {"variance": np.full_like(picture.radiance, np.nan)}, {}, {}, picture.window,
                         picture.size)
    with pytest.warns(UserWarning, match="variances of the picture are not finite"):
        assert vpm.error(broken, picture).noise == 0


def test_ctrl_c_keeps_the_passes_that_are_finished():
    scene = vpm.Scene(BALL)
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt) as interrupt:
        vpm.render(scene, passes=1_000_000)
    assert isinstance(interrupt.value, vpm.Interrupted)
    result = interrupt.value.result
    assert 0 < result.passes < 1_000_000
    more = result.resume(passes=result.passes + 1)
    assert np.array_equal(more.radiance, vpm.render(scene, passes=result.passes + 1).radiance)


def test_ctrl_c_ends_an_iteration_over_passes():
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    last = None
    with pytest.raises(KeyboardInterrupt):
        for so_far in vpm.passes(BALL, passes=1_000_000):
            last = so_far
    assert last.passes > 0


def test_what_a_signal_handler_raises_ends_a_render():
    def refuse(*_):
        raise TimeoutError("enough")

    before = signal.signal(signal.SIGALRM, refuse)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with pytest.raises(TimeoutError, match="enough"):
            vpm.render(BALL, passes=1_000_000)
    finally:
        signal.signal(signal.SIGALRM, before)


# --- Studies

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
render.integrator = "path"
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


def test_threads_can_be_set():
    before = vpm.thread_count()
    vpm.set_threads(1)
    one = vpm.render(BALL, passes=1).radiance
    vpm.set_threads(0)
    assert np.array_equal(one, vpm.render(BALL, passes=1).radiance)
    assert vpm.thread_count() == before
    with pytest.raises(vpm.InputError):
        vpm.set_threads(-1)
