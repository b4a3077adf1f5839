"""Fields inside media, against transport theory and against the ledger."""
import numpy as np
import pytest
import vpm


def slab(medium, emitted=40_000, power=1.0):
    """A layer of 1 m, wide enough that nothing leaves it at its sides, and a narrow beam through it."""
    return vpm.Scene({
        "camera": {"position": [0, 5, 0], "target": [0, 0, 0.1]},
        "media": {"mist": {"type": "homogeneous", **medium}},
        "shapes": [{"type": "box", "min": [-500, 0, -500], "max": [500, 1, 500], "inside": "mist",
                    "material": {"type": "boundary"}}],
        "lights": [{"type": "beam", "position": [0, 2, 0], "direction": [0, -1, 0], "radius": 0.01, "power": power}],
        "integrator": {"type": "photon-map", "photons": {"emitted": emitted},
                       "volume": {"type": "beam", "radius": 0.1}}})


def profile(medium, passes=16, **keys):
    """Fluence over a beam's irradiance, by depth: that of cells as wide as the slab, times their area."""
    layers = 20
    field = vpm.fluence(slab(medium, **keys), box=((-500, 0, -500), (500, 1, 500)), cells=(1, layers, 1), passes=passes)
    area = 1000.0**2
    return field, area * field.fluence[0, ::-1, 0], area * field.fluence_error[0, ::-1, 0]


def truth_of(tau, albedo, **phase):
    """The mean fluence of 20 layers, by Simpson's rule."""
    depths = np.linspace(0, tau, 41)
    depths[0] = 1e-9
    found = vpm.exact("slab", tau=tau, albedo=albedo, depths=",".join(f"{d:.12g}" for d in depths), **phase)
    fluence = np.array(found["fluence"].value)
    return (fluence[:-1:2] + 4 * fluence[1::2] + fluence[2::2]) / 6


def test_fluence_in_a_slab_is_that_of_transport_theory():
    """Chi-square over 20 layers, whose errors are those of 16 passes: false-alarm rate about 1e-4."""
    medium = {"sigma_t": 2.0, "albedo": 0.9, "phase": {"type": "henyey-greenstein", "g": 0.75}}
    _, fluence, error = profile(medium)
    off = (fluence[:, 0] - truth_of(2, 0.9, g=0.75)) / error[:, 0]
    assert (error[:, 0] < 0.006 * fluence[:, 0]).all() and (off**2).sum() < 85
    assert abs(off.mean()) < 4


def test_channels_are_those_of_grey_media():
    """Each channel of a chromatic slab against the exact one: false-alarm rate about 1e-4."""
    medium = {"sigma_t": [1.0, 2.0, 4.0], "albedo": [0.5, 0.9, 0.2]}
    _, fluence, error = profile(medium)
    for channel, (tau, albedo) in enumerate([(1, 0.5), (2, 0.9), (4, 0.2)]):
        off = (fluence[:, channel] - truth_of(tau, albedo)) / error[:, channel]
        assert (off**2).sum() < 85, channel


def test_what_cells_absorb_is_in_the_ledger():
    field, _, _ = profile({"sigma_t": [1.0, 2.0, 4.0], "albedo": [0.5, 0.9, 0.2]}, passes=2, power=[3.0, 1.0, 2.0])
    absorbed = field.absorbed.sum(axis=(0, 1, 2), dtype=float) * field.cell_volume
    assert absorbed == pytest.approx(np.array(field.energy["absorbed_in_media"]), rel=1e-6)


def test_absorbed_power_is_fluence_times_absorption():
    field, fluence, error = profile({"sigma_t": 2.0, "albedo": 0.7})
    absorbed, of_absorbed = field.absorbed[0, ::-1, 0, 0] * 1e6, field.absorbed_error[0, ::-1, 0, 0] * 1e6
    off = (absorbed - 0.6 * fluence[:, 0]) / np.hypot(of_absorbed, 0.6 * error[:, 0])
    assert (off**2).sum() < 85


def box_of_grid(values, transform, **integrator):
    return vpm.Scene({
        "camera": {"position": [0, 0, 5], "target": [0, 0, 0]},
        "media": {"cloud": {"type": "grid", "sigma_t": 3.0, "albedo": [0.8, 0.6, 0.4],
                            "grid": vpm.Grid(values, transform)}},
        "lights": [{"type": "directional", "direction": [0.3, -1, 0.2], "irradiance": 1}],
        "integrator": {"type": "photon-map", "photons": {"emitted": 20_000}, "volume": {"radius": 0.1}, **integrator}})


def test_in_grids_collisions_and_flights_agree():
    """Where cells are those of even parts of the density: false-alarm rate about 1e-4."""
    values = np.ones((9, 9, 9), np.float32)
    transform = np.diag([0.25, 0.25, 0.25, 1.0])
    transform[:3, 3] = -1
    field = vpm.fluence(box_of_grid(values, transform), box=((-1, -1, -1), (1, 1, 1)), cells=4)
    off = ((field.absorbed - field.fluence * np.float32([0.6, 1.2, 1.8]))
           / np.hypot(field.absorbed_error, field.fluence_error * np.float32([0.6, 1.2, 1.8])))
    assert off.shape == (4, 4, 4, 3) and (off[..., 0]**2).mean() < 1.9


def test_the_same_bits_on_any_number_of_threads():
    scene = slab({"sigma_t": [1.0, 2.0, 4.0], "albedo": 0.9}, emitted=9000)
    vpm.set_threads(1)
    one = vpm.fluence(scene, box=((-1, 0, -1), (1, 1, 1)), cells=16, passes=2)
    vpm.set_threads(0)
    two = vpm.fluence(scene, box=((-1, 0, -1), (1, 1, 1)), cells=16, passes=2)
    assert np.array_equal(one.fluence, two.fluence) and np.array_equal(one.absorbed_error, two.absorbed_error)
    assert one.fluence.shape == (16, 8, 16, 3) and one.fluence.max() > 0


def test_a_lone_flight_is_as_long_as_its_cells():
    """Without scattering, in thin air: a beam of 1 W along a diagonal."""
    scene = vpm.Scene({
        "camera": {"position": [0, 0, 5], "target": [0, 0, 0]},
        "media": {"air": {"type": "homogeneous", "sigma_t": 1e-9, "albedo": 0}},
        "shapes": [{"type": "box", "min": [-2, -2, -2], "max": [2, 2, 2], "inside": "air",
                    "material": {"type": "boundary"}}],
        "lights": [{"type": "beam", "position": [-3, -3, -3.1], "direction": [1, 1, 1], "radius": 1e-6, "power": 1}],
        "integrator": {"type": "photon-map", "photons": {"emitted": 100}, "volume": {"type": "beam", "radius": 0.1}}})
    field = vpm.fluence(scene, box=((-1, -1, -1), (1, 1, 1)), cells=(2, 4, 8), passes=1)
    assert field.fluence.sum(axis=(0, 1, 2), dtype=float) * field.cell_volume == pytest.approx(
        1.9 * np.sqrt(3), rel=1e-5)
    assert np.isnan(field.fluence_error).all()
    # It enters at x = y = -0.9, and passes y = -0.5, 0 (and x = 0 there), 0.5 and z = -0.75, -0.5, ... 0.75. The beam
    # is not quite narrow: where two planes meet it passes slivers of two more cells.
    assert (field.fluence[..., 0] > 1e-3).sum() == 1 + 3 + 7


def test_files_and_wrong_wishes(tmp_path):
    scene = slab({"sigma_t": 2.0, "albedo": 0.7}, emitted=1000)
    field = vpm.fluence(scene, cells=8, passes=2)
    field.write(tmp_path / "a.npy")
    kept = np.load(tmp_path / "a.npy")
    assert np.array_equal(kept[..., 0, :], field.fluence) and np.array_equal(kept[..., 3, :], field.absorbed_error)
    assert repr(field) == "Field(8 x 1 x 8 cells, 2 passes)" and len(field.centers()[2]) == 8
    with pytest.raises(vpm.InputError, match="box: "):
        vpm.fluence(scene, box=((0, 0, 0), (1, 0, 1)))
    with pytest.raises(vpm.InputError, match="cells: "):
        vpm.fluence(scene, cells=0)
    with pytest.raises(vpm.InputError, match="fields are written as .npy"):
        field.write(tmp_path / "a.txt")
    with pytest.raises(vpm.InputError, match="do not end as the transmittance says"):
        vpm.fluence(box_of_grid(np.ones((4, 4, 4), np.float32), np.eye(4), distance={"type": "local-extinction"}), cells=8)


def test_net_flux_is_what_absorption_takes():
    """In a slab the flux downwards falls by what is absorbed above; across it there is none. False-alarm rate about
    1e-3."""
    scene = slab({"sigma_t": [1.0, 2.0, 4.0], "albedo": [0.5, 0.9, 0.2]})
    field = vpm.fluence(scene, box=((-500, 0, -500), (500, 1, 500)), cells=(1, 20, 1), passes=16, flux=True)
    assert field.flux.shape == field.flux_error.shape == (3, 1, 20, 1, 3)
    area = 1000.0**2
    down, error = -area * field.flux[1, 0, ::-1, 0], area * field.flux_error[1, 0, ::-1, 0]
    for channel, (tau, albedo) in enumerate([(1, 0.5), (2, 0.9), (4, 0.2)]):
        exact = vpm.exact("slab", tau=tau, albedo=albedo, depths=",".join(f"{d:.12g}" for d in np.linspace(1e-9, tau, 41)))
        net = np.array(exact["net flux"].value)
        off = (down[:, channel] - (net[:-1:2] + 4 * net[1::2] + net[2::2]) / 6) / error[:, channel]
        assert (off**2).sum() < 85, channel
    assert (np.abs(field.flux[[0, 2]]) < 5 * field.flux_error[[0, 2]]).all()
    assert vpm.fluence(scene, cells=2, passes=1).flux is None
