"""Photons as arrays: summed by brute force they give the pixels of a render, and the ledger its energy."""
import doctest
from pathlib import Path

import numpy as np
import pytest
import vpm

G, ALBEDO, SIGMA_T, REFLECTANCE = 0.3, 0.8, 0.9, 0.5
EYE, TARGET = np.array([0.3, -0.1, 0.9]), np.array([-0.2, -1.0, -0.3])
EPANECHNIKOV_LINE, EPANECHNIKOV_DISC, CONSTANT_BALL = 0.75, 2 / np.pi, 0.75 / np.pi


def room(integrator, fog=True, walls=True, fov=1e-6):
    """A cube of 2 m around a lamp, as one pixel sees it along a line."""
    reflectance = REFLECTANCE if walls else 0
    scene = {
        "camera": {"position": EYE, "target": TARGET, "fov": fov},
        "film": {"width": 1, "height": 1},
        "render": {"passes": 1},
        "shapes": [{"name": "room", "type": "box", "min": [-1, -1, -1], "max": [1, 1, 1],
                    "material": {"type": "lambertian", "reflectance": reflectance}}],
        "lights": [{"type": "point", "position": [0.1, 0.6, -0.1], "intensity": [1, 2, 3]}],
        "integrator": {"type": "photon-map", "photons": {"emitted": 20_000}, "direct": {"type": "photons"},
                       "radii": "constant", **integrator}}
    if fog:
        scene["media"] = {"fog": {"type": "homogeneous", "sigma_t": SIGMA_T, "albedo": ALBEDO,
                                  "phase": {"type": "henyey-greenstein", "g": G}}}
        scene["shapes"][0]["inside"] = "fog"
    return vpm.Scene(scene)


def pixel(scene):
    return vpm.render(scene).radiance[0, 0]


def henyey_greenstein(cosine):
    return (1 - G**2) / (4 * np.pi * (1 + G**2 - 2 * G * cosine)**1.5)


def view_ray():
    direction = (TARGET - EYE) / np.linalg.norm(TARGET - EYE)
    return direction, -(1 + EYE[1]) / direction[1]  # as far as the floor


def irradiance(rows, point, radius):
    """By the kernel's disc, of photons that come from above and lie near the floor's plane."""
    offset = rows["position"].astype(float) - point
    squared = (offset**2).sum(axis=1)
    near = (squared < radius**2) & (rows["direction"][:, 1] < 0)
    near &= np.abs(offset[:, 1]) <= 1e-3
    weight = EPANECHNIKOV_DISC / radius**2 * (1 - squared[near] / radius**2)
    return weight @ rows["power"][near].astype(float)


def test_a_pixel_of_a_surface_map_is_a_sum_over_photons():
    scene = room({"surface": {"type": "radius", "radius": 0.3}}, fog=False)
    direction, far = view_ray()
    rows = vpm.photons(scene).of("surface", "room")
    expected = REFLECTANCE / np.pi * irradiance(rows, EYE + far * direction, 0.3)
    assert pixel(scene) == pytest.approx(expected, rel=1e-5)


def test_a_pixel_of_the_nearest_photons_is_one():
    scene = room({"surface": {"type": "nearest", "count": 60, "radius": 1.0}}, fog=False)
    direction, far = view_ray()
    point = EYE + far * direction
    rows = vpm.photons(scene).array
    offset = rows["position"].astype(float) - point
    distance = np.linalg.norm(offset, axis=1)
    below = (rows["direction"][:, 1] < 0) & (np.abs(offset[:, 1]) <= 0.3 * distance)
    radius = np.sort(distance[below])[59]
    expected = REFLECTANCE / np.pi * irradiance(rows[below & (distance < radius)], point, radius)
    assert pixel(scene) == pytest.approx(expected, rel=1e-5)


def along_ray(rows, direction, far, radius):
    """What collisions near the ray weigh, by the kernel's disc across it, and which are near."""
    offset = rows["position"].astype(float) - EYE
    along = offset @ direction
    squared = (offset**2).sum(axis=1) - along**2
    near = (squared < radius**2) & (along >= 0) & (along < far)
    kernel = EPANECHNIKOV_DISC / radius**2 * (1 - squared[near] / radius**2)
    cosine = -rows["direction"][near].astype(float) @ direction
    return ALBEDO * kernel * henyey_greenstein(cosine) * np.exp(-SIGMA_T * along[near]), near


def test_a_pixel_of_points_along_a_ray_is_one():
    scene = room({"volume": {"type": "beam", "radius": 0.2, "boundary": "none"}}, walls=False)
    direction, far = view_ray()
    rows = vpm.photons(scene).of("volume", "fog")
    weight, near = along_ray(rows, direction, far, 0.2)
    assert pixel(scene) == pytest.approx(weight @ rows["power"][near].astype(float), rel=1e-5)


def test_a_pixel_of_photon_beams_is_a_sum_over_flights():
    scene = room({"volume": {"type": "photon-beams", "radius": 0.05, "boundary": "none", "flights": 0}}, walls=False)
    direction, far = view_ray()
    rows = vpm.flights(scene).array
    start, end = rows["start"].astype(float), rows["end"].astype(float)
    length = np.linalg.norm(end - start, axis=1)
    beam = (end - start) / length[:, None]
    cosine = beam @ direction
    sine2 = 1 - cosine**2
    between = start - EYE
    on_ray = ((between @ direction) - cosine * (between * beam).sum(axis=1)) / sine2
    on_beam = (cosine * (between @ direction) - (between * beam).sum(axis=1)) / sine2
    apart = np.linalg.norm(EYE + on_ray[:, None] * direction - start - on_beam[:, None] * beam, axis=1)
    near = (apart < 0.05) & (on_ray >= 0) & (on_ray < far) & (on_beam >= 0) & (on_beam < length)
    kernel = EPANECHNIKOV_LINE / 0.05 * (1 - (apart[near] / 0.05)**2)
    # Collisions beside the ray take part, by the balance heuristic: sizes of kernels of the same variance.
    line, disc = 5 / 3 * 0.05, 0.75 * np.pi * 0.05**2 * SIGMA_T
    weight = (ALBEDO * SIGMA_T * kernel * line / (line * np.sqrt(sine2[near]) + disc)
              * henyey_greenstein(-cosine[near]) * np.exp(-SIGMA_T * on_ray[near]))
    beams = weight @ rows["power"][near].astype(float)
    stored = vpm.photons(scene).of("volume", "fog")
    weight, near = along_ray(stored, direction, far, 0.05)
    sine = np.sqrt(1 - (stored["direction"][near].astype(float) @ direction)**2)
    points = (weight * disc / (line * sine + disc)) @ stored["power"][near].astype(float)
    assert points[0] > 1e-3 * beams[0]
    # Where two lines meet is only as exact as floats are.
    assert pixel(scene) == pytest.approx(beams + points, rel=2e-5)


def test_a_pixel_of_a_march_among_photons_is_one():
    """Of a thin sheet, as the march draws its place: a constant kernel, and all photons well within the ball."""
    scene = vpm.Scene({
        "camera": {"position": [0, 0, 1], "target": [0, 0, 0], "fov": 1e-6},
        "film": {"width": 1, "height": 1},
        "render": {"passes": 1},
        "media": {"sheet": {"type": "homogeneous", "sigma_t": 50, "albedo": ALBEDO}},
        "shapes": [{"type": "box", "min": [-0.1, -0.1, 0], "max": [0.1, 0.1, 0.01], "inside": "sheet",
                    "material": {"type": "boundary"}}],
        "lights": [{"type": "beam", "position": [0, 0, 2], "direction": [0, 0, -1], "radius": 0.05, "power": 1}],
        "integrator": {"type": "photon-map", "photons": {"emitted": 5000}, "radii": "constant",
                       "volume": {"type": "radius", "radius": 1.0, "kernel": "constant", "boundary": "none"}}})
    rows = vpm.photons(scene).array
    source = ALBEDO / (4 * np.pi) * CONSTANT_BALL * rows["power"].astype(float).sum(axis=0)
    assert len(rows) > 2000
    assert pixel(scene) == pytest.approx(source * (1 - np.exp(-0.5)) / 50, rel=1e-5)


def test_what_is_stored_has_the_energy_of_the_ledger():
    found = vpm.photons(room({"volume": {"type": "beam", "radius": 0.2}}))
    events = found.array["event"]
    collided = found.array[events == vpm.EVENTS.index("collision")]["power"].sum(axis=0, dtype=float)
    hit = found.array[events == vpm.EVENTS.index("hit")]["power"].sum(axis=0, dtype=float)
    assert len(found) == len(found.of("volume")) + len(found.of("surface")) and found.emitted == 20_000
    assert collided * (1 - ALBEDO) == pytest.approx(np.array(found.energy["absorbed_in_media"]), rel=1e-6)
    assert hit * (1 - REFLECTANCE) == pytest.approx(np.array(found.energy["absorbed_on_surfaces"]), rel=1e-6)
    assert found.energy["emitted"] == pytest.approx((4 * np.pi, 8 * np.pi, 12 * np.pi), rel=1e-6)


def test_histories_say_how_often_a_photon_was_scattered():
    found = vpm.photons(room({"volume": {"type": "beam", "radius": 0.2}})).array
    order = np.lexsort((found["scatterings"], found["number"]))
    rows = found[order]
    # Every event of this room is stored: those of one photon count up from 0.
    first = np.concatenate([[True], rows["number"][1:] != rows["number"][:-1]])
    assert (rows["scatterings"][first] == 0).all()
    assert (rows["scatterings"][1:][~first[1:]] == rows["scatterings"][:-1][~first[1:]] + 1).all()
    assert (rows["reflections"] == 0).all() and rows["number"].max() == 19_999


def test_paths_go_from_the_lamp_to_their_ends():
    found = vpm.flights(room({"volume": {"type": "beam", "radius": 0.2}}))
    paths = found.paths()
    assert len(paths) == 20_000 and sum(len(path) - 1 for path in paths) == len(found)
    assert np.allclose([path[0] for path in paths], [0.1, 0.6, -0.1], atol=1e-6)
    assert (np.abs(found.array["end"]) <= 1 + 1e-6).all()
    stored = vpm.photons(room({"volume": {"type": "beam", "radius": 0.2}})).array
    assert len(stored) == len(found)


def test_a_mirror_is_a_reflection_and_glass_names_its_shape():
    scene = room({"surface": {"type": "radius", "radius": 0.3}}, fog=False)
    assert set(vpm.flights(scene).array["event"]) == {vpm.EVENTS.index("hit")}
    ball = {"name": "ball", "type": "sphere", "center": [0.1, -0.4, -0.1], "radius": 0.3,
            "material": {"type": "dielectric", "ior": 1.5}}
    glass = vpm.Scene({"camera": {"position": [0, 0, 3], "target": [0, 0, 0]},
                       "shapes": [{"name": "floor", "type": "quad", "corner": [-1, -1, 1], "edge_u": [2, 0, 0],
                                   "edge_v": [0, 0, -2], "material": {"type": "lambertian", "reflectance": 0.5}}, ball],
                       "lights": [{"type": "point", "position": [0.1, 0.6, -0.1], "intensity": 1}],
                       "integrator": {"type": "photon-map", "photons": {"emitted": 20_000}}})
    flights, stored = vpm.flights(glass), vpm.photons(glass)
    at_ball = flights.array[flights.array["place"] == flights.places.index("ball")]
    assert set(at_ball["event"]) == {vpm.EVENTS.index("specular")} and at_ball["reflections"].max() > 1
    # Straight light is left to shadow rays: what the map has went through the ball.
    assert len(stored) > 100 and (stored.array["reflections"] > 0).all()


def test_files_hold_what_arrays_hold(tmp_path):
    found = vpm.photons(room({"volume": {"type": "beam", "radius": 0.2}, "photons": {"emitted": 300}}))
    for name in ("a.ply", "a.csv", "a.npz"):
        found.write(tmp_path / name)
    kept = np.load(tmp_path / "a.npz")
    assert all(np.array_equal(kept[field], found.array[field]) for field in found.array.dtype.names)
    assert list(kept["places"]) == found.places and kept["emitted"] == 300
    lines = (tmp_path / "a.csv").read_text().splitlines()
    first = dict(zip(lines[0].split(","), lines[1].split(",")))
    assert len(lines) == len(found) + 1 and first["place"] == "fog" and first["event"] == "collision"
    assert np.float32(first["x"]) == found.array["position"][0, 0]
    header, body = (tmp_path / "a.ply").read_bytes().split(b"end_header\n", 1)
    types = {"float": "f4", "uint": "u4", "ushort": "u2", "uchar": "u1"}
    columns = [(line.split()[2], "<" + types[line.split()[1]]) for line in header.decode().splitlines()
               if line.startswith("property")]
    rows = np.frombuffer(body, columns)
    assert np.array_equal(rows["nz"], found.array["direction"][:, 2])
    assert np.array_equal(rows["number"], found.array["number"]) and np.array_equal(rows["map"], found.array["map"])
    assert np.array_equal(rows["power_b"], found.array["power"][:, 2]) and (rows["blue"] == 255).all()
    with pytest.raises(vpm.InputError, match="written as .ply, .csv or .npz"):
        found.write(tmp_path / "a.obj")


def test_lines_of_a_ply_are_the_flights(tmp_path):
    found = vpm.flights(room({"photons": {"emitted": 50}}))
    found.write(tmp_path / "a.ply")
    header, body = (tmp_path / "a.ply").read_bytes().split(b"end_header\n", 1)
    vertices, edges = (int(line.split()[2]) for line in header.decode().splitlines() if line.startswith("element"))
    row = [("place", "<f4", 3), ("power", "<f4", 3), ("numbers", "<u4", 2), ("counts", "<u2", 2), ("bytes", "u1", 4)]
    points = np.frombuffer(body, row, vertices)
    lines = np.frombuffer(body, "<i4", offset=vertices * np.dtype(row).itemsize).reshape(edges, 2)
    assert edges == len(found) and vertices == sum(map(len, found.paths()))
    assert np.array_equal(points["place"][lines[:, 0]], found.array["start"])
    assert np.array_equal(points["place"][lines[:, 1]], found.array["end"])


def brute_force(points, positions):
    return np.sqrt(((points[:, None].astype(float) - positions[None].astype(float))**2).sum(axis=2))


def test_queries_find_what_brute_force_finds():
    random = np.random.default_rng(5)
    positions, points = random.random((3000, 3), np.float32), random.random((200, 3), np.float32)
    photons, apart = vpm.PhotonMap(positions), brute_force(points, positions)
    for radius in (0.05, 0.2, 0.9):
        counts = photons.within(points, radius)
        first, numbers = photons.within(points, radius, lists=True)
        assert np.array_equal(counts, (apart < radius).sum(axis=1)) and np.array_equal(np.diff(first), counts)
        for i in (0, 7, 199):
            assert np.array_equal(numbers[first[i]:first[i + 1]], np.flatnonzero(apart[i] < radius))
    numbers, distances = photons.nearest(points, 12)
    assert np.array_equal(numbers, np.argsort(apart, axis=1)[:, :12])
    assert np.allclose(distances, np.sort(apart, axis=1)[:, :12], rtol=1e-5)


def test_estimates_are_sums_of_powers_and_kernels():
    random = np.random.default_rng(6)
    positions, points = random.random((2000, 3), np.float32), random.random((50, 3), np.float32)
    powers, directions = random.random((2000, 3)), random.normal(size=(2000, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    photons, apart = vpm.PhotonMap(positions, powers, directions), brute_force(points, positions)
    q = (apart / 0.3)**2
    ball = np.where(q < 1, 1.875 / np.pi / 0.3**3 * (1 - q), 0)
    disc = np.where(q < 1, 2 / np.pi / 0.3**2 * (1 - q), 0)
    assert np.allclose(photons.estimate(points, 0.3), ball @ powers, rtol=1e-5)
    normals = np.broadcast_to([0.0, 0.6, 0.8], points.shape)
    height = np.abs((positions[None].astype(float) - points[:, None]) @ [0.0, 0.6, 0.8])
    arrives = (directions @ [0.0, 0.6, 0.8] < 0) & (height <= 0.05 * 0.3 + 0.3 * apart)
    assert np.allclose(photons.estimate(points, 0.3, normals=normals), (disc * arrives) @ powers, rtol=1e-5)
    away = np.broadcast_to([1.0, 0, 0], points.shape)
    scattered = ball * henyey_greenstein(directions[:, 0])
    assert np.allclose(photons.estimate(points, 0.3, directions=away, g=G), scattered @ powers, rtol=1e-4)


def test_a_map_of_photons_of_a_grid_gathers_power_over_density():
    """Where the density is a third at one end, and 1 at the other."""
    values = np.ones((9, 9, 9), np.float32)
    values[:5] = 1 / 3
    transform = np.diag([0.25, 0.25, 0.25, 1.0])
    transform[:3, 3] = -1
    made = vpm.Scene({
        "camera": {"position": [0, 0, 5], "target": [0, 0, 0]},
        "media": {"cloud": {"type": "grid", "sigma_t": 2.0, "albedo": 0.8, "grid": vpm.Grid(values, transform)}},
        "lights": [{"type": "directional", "direction": [0.3, -1, 0.2], "irradiance": 1}],
        "integrator": {"type": "photon-map", "photons": {"emitted": 5000}, "volume": {"radius": 0.1}}})
    rows = vpm.photons(made).array
    assert rows["density"].min() < 0.4
    points = np.float32([[-0.6, 0, 0], [0.6, 0.1, 0]])
    distance = np.linalg.norm(rows["position"][None] - points[:, None], axis=2)
    sums = ((distance < 0.4)[..., None] * (rows["power"] / rows["density"][:, None])).sum(axis=1)
    found = vpm.PhotonMap(rows).estimate(points, 0.4, kernel="constant")
    assert found == pytest.approx(sums / (4 / 3 * np.pi * 0.4**3), rel=1e-4)


def test_a_map_gathers_what_a_render_gathers():
    scene = room({"surface": {"type": "radius", "radius": 0.3}}, fog=False)
    direction, far = view_ray()
    photons = vpm.PhotonMap(vpm.photons(scene).array)
    found = photons.estimate([EYE + far * direction], 0.3, normals=[[0, 1, 0]])
    assert found[0] * REFLECTANCE / np.pi == pytest.approx(pixel(scene), rel=1e-4)  # the floor's position is rounded


@pytest.mark.parametrize("call, wrong", [
    (lambda m: m.within([[0, 0, 0]], 0), "radius: 0 is not a number of metres from"),
    (lambda m: m.within([[0, 0]], 1), r"points are an array \(n, 3\)"),
    (lambda m: m.nearest([[0, 0, 0]], 4), "k: there are only 3 photons, not 4"),
    (lambda m: m.estimate([[0, 0, np.nan]], 1), "points must be finite; row 0 is not"),
    (lambda m: m.estimate([[0, 0, 0]], 1, kernel="box"), "there is no kernel 'box'"),
    (lambda m: m.estimate([[0, 0, 0]], 1, normals=[[0, 0, 0]]), "normals must not be 0; row 0 is"),
    (lambda m: m.estimate([[0, 0, 0]], 1, g=1), "g: 1 is not a mean cosine"),
    (lambda m: vpm.PhotonMap([[0, 0, 0]], powers=[[1, -1, 1]]), "powers must not be negative"),
    (lambda m: vpm.PhotonMap(np.zeros((2, 3)), directions=[[0, 1, 0]]), "there are 1 directions, not 2")])
def test_wrong_questions_are_refused(call, wrong):
    with pytest.raises(vpm.InputError, match=wrong):
        call(vpm.PhotonMap(np.eye(3)))


def test_only_photon_maps_store_photons():
    scene = vpm.Scene({"camera": {"position": [0, 0, 3], "target": [0, 0, 0]},
                       "shapes": [{"type": "sphere", "center": [0, 0, 0], "radius": 1,
                                   "material": {"type": "lambertian", "reflectance": 0.5}}],
                       "lights": [{"type": "environment", "radiance": 1}], "integrator": {"type": "path"}})
    with pytest.raises(vpm.InputError, match='write type = "photon-map"'):
        vpm.photons(scene)


def test_the_program_writes_the_same_photons(tmp_path, vpm_program):
    scene = tmp_path / "room.toml"
    scene.write_text(vpm.Scene.text_of({
        "camera": {"position": [0, 0, 3], "target": [0, 0, 0]},
        "shapes": [{"name": "ball, grey", "type": "sphere", "center": [0, 0, 0], "radius": 1,
                    "material": {"type": "lambertian", "reflectance": 0.5}}],
        "lights": [{"type": "environment", "radiance": 1}],
        "integrator": {"type": "photon-map", "photons": {"emitted": 500}, "direct": {"type": "photons"},
                       "surface": {"radius": 0.1}}}))
    vpm_program("photons", scene, "-o", tmp_path / "a.csv", "--seed", "4", "--pass", "2", "--threads", "1")
    vpm.photons(scene, seed=4, number=2).write(tmp_path / "b.csv")
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()
    assert '"ball, grey"' in (tmp_path / "a.csv").read_text()


def test_the_lines_of_the_page_print_what_it_says(monkeypatch):
    project = Path(__file__).resolve().parents[2]
    monkeypatch.chdir(project)
    done = doctest.testfile(str(project / "tools/python/first_photon_map.md"), module_relative=False)
    assert done.attempted > 30 and done.failed == 0


@pytest.mark.parametrize("phase, keys", [
    ({"type": "draine", "g": 0.5, "alpha": 20.0}, {"phase": "draine", "g": 0.5, "alpha": 20}),
    ({"type": "two-lobes", "g1": 0.9, "g2": -0.4, "share": 0.8}, {"phase": "two-lobes", "g": 0.9, "g2": -0.4, "share": 0.8}),
    ({"type": "droplets", "diameter": 10.0}, {"phase": "droplets", "diameter": 10}),
    ({"type": "table", "path": "hg.csv"}, {"phase": "hg", "g": 0.75})])
def test_slabs_absorb_what_transport_theory_says(phase, keys, tmp_path):
    """By the ledger of 100,000 photons: false-alarm rate 6e-7."""
    if "path" in phase:
        angles = np.linspace(0, 180, 1801)
        np.savetxt(tmp_path / "hg.csv", np.c_[angles, (1 + 0.75**2 - 1.5 * np.cos(np.radians(angles)))**-1.5],
                   delimiter=",", header="angle,value", comments="")
        phase = {**phase, "path": tmp_path / "hg.csv"}
    slab = {"camera": {"position": [0, 5, 0], "target": [0, 0, 0.1]}, "film": {"width": 1, "height": 1},
            "media": {"mist": {"type": "homogeneous", "sigma_t": 2, "albedo": 0.9, "phase": phase}},
            "shapes": [{"type": "box", "min": [-500, 0, -500], "max": [500, 1, 500], "inside": "mist",
                        "material": {"type": "boundary"}}],
            "lights": [{"type": "beam", "position": [0, 2, 0], "direction": [0, -1, 0], "radius": 0.01, "power": 1}],
            "integrator": {"type": "photon-map", "photons": {"emitted": 100_000},
                           "volume": {"type": "beam", "radius": 0.1}}}
    absorbed = vpm.photons(slab).energy["absorbed_in_media"][0]
    truth = vpm.exact("slab", tau=2, albedo=0.9, **keys)["absorbed"].value
    # A photon brings its power to the account, or a share of it at each collision: less than 0.3 of it on average.
    assert abs(absorbed - truth) < 5 * 0.4 / 100_000**0.5
    assert abs(truth - vpm.exact("slab", tau=2, albedo=0.9, phase="isotropic")["absorbed"].value) > 0.02
