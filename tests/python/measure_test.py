"""Detectors, against exact solutions, against solid angles, and against the consensus of other programs."""
import numpy as np
import pytest
import vpm

CAMERA = {"position": [0, 5, 0], "target": [0, 0, 0.1]}


def scene(media=(), shapes=(), lights=(), detectors=(), emitted=20_000, world=None):
    parts = {
        "camera": CAMERA, "media": dict(media), "shapes": list(shapes), "lights": list(lights),
        "detectors": list(detectors),
        "integrator": {"type": "photon-map", "photons": {"emitted": emitted}, "volume": {"type": "beam", "radius": 0.1}}}
    return vpm.Scene(parts | ({"world": world} if world else {}))


def box(low, high, inside, **more):
    return {"type": "box", "min": low, "max": high, "inside": inside, "material": {"type": "boundary"}, **more}


def slab(medium, detectors=(), **more):
    """A layer of 1 m under a narrow beam, wide enough that nothing leaves it at its sides."""
    return scene({"mist": {"type": "homogeneous", **medium}}, [box([-200, 0, -200], [200, 1, 200], "mist")],
                 [{"type": "beam", "position": [0, 2, 0], "direction": [0, -1, 0], "radius": 0.01, "power": 1}],
                 detectors, **more)


MIST = {"sigma_t": 2.0, "albedo": 0.9, "phase": {"type": "henyey-greenstein", "g": 0.75}}
TOP = {"name": "top", "type": "plane", "point": [0, 1, 0], "normal": [0, 1, 0]}


def squares(found, error, truth):
    """Of the deviations, in standard errors."""
    return ((np.asarray(found) - np.asarray(truth)) / np.asarray(error))**2


def test_a_slab_reflects_transmits_and_absorbs_what_is_exact():
    """64 passes, whose errors are nearly Gaussian: false-alarm rate about 1e-4."""
    found = vpm.measure(slab(MIST), passes=64).slab
    for share, truth in zip(("reflected", "transmitted", "absorbed"), (0.097395, 0.660958, 0.241648)):
        value, error, exact = found[share]
        assert exact[0] == pytest.approx(truth, abs=2e-6)
        assert error[0] < 0.005 * value[0] and squares(value[0], error[0], exact[0]) < 20


def test_channels_and_angles_are_those_of_grey_slabs():
    """Chi-square over the ten angles of each channel: false-alarm rate about 1e-5."""
    medium = {"sigma_t": [1.0, 2.0, 4.0], "albedo": [0.5, 0.9, 0.2]}
    found = vpm.measure(slab(medium, [TOP | {"angles": 10}]), passes=64)
    for channel, (tau, albedo) in enumerate([(1, 0.5), (2, 0.9), (4, 0.2)]):
        exact = vpm.exact("slab", tau=tau, albedo=albedo,
                          mu_edges=",".join(f"{mu:g}" for mu in np.linspace(0, 1, 11)))
        truth = np.array(exact["reflected flux"].value)[::-1]  # from the normal on
        off = squares(found["top"].forward_parts[0, 0, :, channel], found["top"].forward_parts_error[0, 0, :, channel],
                      truth)
        assert off.sum() < 45 and found["top"].forward_parts.shape == (1, 1, 10, 3)
        for share in ("reflected", "transmitted", "absorbed"):
            value, error, truth = (part[channel] for part in found.slab[share])
            assert squares(value, error, truth) < 20


def droplet_table(path, diameter=10.0):
    """Droplets of a diameter in micrometres [Jendersie2023], as a table of cosines that is fine forward."""
    g1 = np.exp(-0.0990567 / (diameter - 1.67154))
    g2 = np.exp(-2.20679 / (diameter + 3.91029) - 0.428934)
    alpha, share = np.exp(3.62489 - 8.29288 / (diameter + 5.52825)), np.exp(-0.599085 / (diameter - 0.641583) - 0.665888)
    mu = np.concatenate([-np.cos(np.linspace(0, np.pi / 2, 800)), 1 - np.geomspace(1, 1e-9, 4000)[1:], [1.0]])
    hg = lambda g: (1 - g * g) / (4 * np.pi * (1 + g * g - 2 * g * mu)**1.5)
    value = (1 - share) * hg(g1) + share * hg(g2) * (1 + alpha * mu**2) / (1 + alpha * (1 + 2 * g2 * g2) / 3)
    np.savetxt(path, np.column_stack([mu, value]), fmt="%.15g")
    return str(path)


def test_a_slab_of_tabulated_droplets(tmp_path):
    """Against discrete ordinates by the table's own moments, and those against the function's: false-alarm rate about
    1e-4."""
    path = droplet_table(tmp_path / "droplets.txt")
    found = vpm.measure(slab({"sigma_t": 8.0, "albedo": 0.99, "phase": {"type": "table", "path": path}}, emitted=5000),
                        passes=64).slab
    of_function = vpm.exact("slab", tau=8, albedo=0.99, phase="droplets", diameter=10)
    of_table = vpm.exact("slab", tau=8, albedo=0.99, phase="table", table=path)
    for share in ("reflected", "transmitted", "absorbed"):
        value, error, exact = found[share]
        assert squares(value[0], error[0], exact[0]) < 20
        assert exact[0] == pytest.approx(of_function[share].value, rel=2e-3)
        assert exact[0] == pytest.approx(of_table[share].value, rel=1e-6)


def test_a_plane_within_a_chromatic_medium_sees_each_channel():
    """What goes straight on to the middle of an absorber: false-alarm rate about 1e-4."""
    middle = {"name": "middle", "type": "plane", "point": [0, 0.5, 0], "normal": [0, -1, 0]}
    found = vpm.measure(slab({"sigma_t": [1.0, 2.0, 4.0], "albedo": 0.0}, [middle]), passes=64)["middle"]
    assert (squares(found.forward, found.forward_error, np.exp([-0.5, -1.0, -2.0])) < 20).all()
    assert found.backward_count == 0


def test_stated_errors_are_those_of_many_runs():
    """Of 200 runs of 16 passes the squares in standard errors have the mean 15 / 13 (Student), with a standard error of
    0.15: false-alarm rate about 1e-4."""
    made = slab(MIST, emitted=500)
    off = [squares(value[0], error[0], exact[0]) for seed in range(200)
           for value, error, exact in [vpm.measure(made, passes=16, seed=seed).slab["transmitted"]]]
    assert abs(np.mean(off) - 15 / 13) < 0.6


LAMP = {"type": "point", "position": [0, 1, 0], "intensity": 1 / (4 * np.pi)}
FLOOR = {"type": "quad", "corner": [-9, -5, -9], "edge_u": [0, 0, 18], "edge_v": [18, 0, 0],
         "material": {"type": "lambertian", "reflectance": 0}}


def test_surfaces_in_the_open_are_passed_by_their_solid_angles():
    """Of a lamp of 1 W: false-alarm rate about 1e-4."""
    half = np.cos(np.arctan2(2.0, 1.0))
    detectors = [
        {"name": "around", "type": "sphere", "center": [0, 1, 0.5], "radius": 1},
        {"name": "beside", "type": "sphere", "center": [0, 1, 2], "radius": 1},
        {"name": "disc", "type": "disc", "center": [0, 0, 0], "normal": [0, 1, 0], "radius": 2},
        {"name": "plane", "type": "plane", "point": [3, 0, 1], "normal": [0, -2, 0]},
        {"name": "quad", "type": "quad", "corner": [-1, 0, -1], "edge_u": [2, 0, 0], "edge_v": [0, 0, 2],
         "cells": [2, 3], "angles": 2}]
    found = vpm.measure(scene(shapes=[FLOOR], lights=[LAMP], detectors=detectors), passes=64)
    assert found["around"].forward == pytest.approx(1, rel=1e-6) and found["around"].backward_count == 0
    beside = found["beside"]
    assert beside.forward_count == beside.backward_count > 0
    for side, error, truth in ((beside.forward, beside.forward_error, (1 - np.sqrt(0.75)) / 2),
                               (found["disc"].backward, found["disc"].backward_error, (1 - half) / 2)):
        assert squares(side[0], error[0], truth) < 20
    assert found["plane"].forward == pytest.approx(0.5, abs=1e-3)  # photons are spread evenly: all passes say so
    quad = found["quad"]
    assert quad.forward_parts is not None and quad.forward_parts.shape == (2, 3, 2, 3)
    assert quad.backward_count == 0  # its normal is down: edge_u x edge_v

    def corner(x, z):  # the solid angle of a rectangle with a corner straight below, at 1 m
        return np.arctan(x * z / np.sqrt(1 + x * x + z * z))
    truth = [[(corner(1, z1) - corner(1, z0)) / (4 * np.pi) for z0, z1 in ((-1, -1 / 3), (-1 / 3, 1 / 3), (1 / 3, 1))]] * 2
    parts, error = quad.forward_parts[..., 0].sum(2), np.sqrt((quad.forward_parts_error[..., 0]**2).sum(2))
    assert squares(parts, error, truth).sum() < 36
    assert quad.forward_parts[..., 1, 0].max() == 0  # no place of it is seen at more than 60 degrees


def test_diffuse_light_has_the_angles_of_the_cosine():
    """A panel that sends 1 W down: shares between cosines a and b are b^2 - a^2. False-alarm rate about 1e-4."""
    panel = {"type": "quad", "corner": [-1, 2, -1], "edge_u": [2, 0, 0], "edge_v": [0, 0, 2],
             "material": {"type": "lambertian", "reflectance": 0}, "emission": 1 / (4 * np.pi)}
    plane = {"name": "p", "type": "plane", "point": [0, 1, 0], "normal": [0, -1, 0], "angles": 5}
    found = vpm.measure(scene(shapes=[FLOOR, panel], detectors=[plane]), passes=64)["p"]
    edges = np.linspace(1, 0, 6)
    off = squares(found.forward_parts[0, 0, :, 0], found.forward_parts_error[0, 0, :, 0], edges[:-1]**2 - edges[1:]**2)
    assert off.sum() < 25


def test_media_absorb_what_the_ledger_says():
    media = {"a": {"type": "homogeneous", "sigma_t": 1.0, "albedo": 0.5},
             "b": {"type": "homogeneous", "sigma_t": [1.0, 2.0, 3.0], "albedo": [0.2, 0.5, 0.9]}}
    shapes = [box([-1, -1, -1], [1, 0.5, 1], "a"), box([-1, 1.5, -1], [1, 3, 1], "b")]
    detectors = [{"name": name, "type": "medium", "medium": name} for name in "ab"]
    found = vpm.measure(scene(media, shapes, [LAMP], detectors), passes=4)
    assert found["a"].absorbed + found["b"].absorbed == pytest.approx(found.absorbed_in_media[0], rel=1e-9)
    assert found["a"].absorbed_count > 0 and (found["b"].absorbed_error > 0).all()


def layer_of_boxes(albedo, zenith, detectors, columns=(2.0, 18.0)):
    """The step cloud of I3RC: two columns, 250 m wide and high, of these optical depths, side by side without end."""
    media = {f"m{i}": {"type": "homogeneous", "sigma_t": depth / 250, "albedo": albedo,
                       "phase": {"type": "henyey-greenstein", "g": 0.85}} for i, depth in enumerate(columns)}
    width = 500 / len(columns)
    shapes = [box([i * width, 0, 0], [(i + 1) * width, 250, 500], f"m{i}") for i in range(len(columns))]
    return scene(media, shapes, [sun(zenith)], detectors, emitted=12_500, world={"cyclic": ["x", "z"]})


def sun(zenith):
    s, c = np.sin(np.radians(zenith)), np.cos(np.radians(zenith))
    return {"type": "directional", "direction": [s, -c, 0], "irradiance": 1 / (c * 250_000)}


FACES = [{"name": "R", "type": "quad", "corner": [0, 250.01, 500], "edge_u": [500, 0, 0], "edge_v": [0, 0, -500],
          "cells": [32, 1]},
         {"name": "T", "type": "quad", "corner": [0, -0.01, 0], "edge_u": [500, 0, 0], "edge_v": [0, 0, 500],
          "cells": [32, 1]}]

# The consensus of the Intercomparison of 3D Radiation Codes, case 1 (step cloud): reflectance and transmittance of 32
# columns; experiment 1 has the sun in the zenith and no absorption, experiment 4 the sun at 60 degrees and an albedo of
# 0.99 (i3rc.gsfc.nasa.gov, consensus_result_case1; [Cahalan2005]).
CONSENSUS = {
    (0, 1.0): {
        "R": """.27859 .26712 .25531 .24542 .23761 .23207 .22805 .22592 .22597 .22796 .23176 .23787 .24578 .25563 .26676
                .27939 .32332 .36758 .39589 .41544 .43034 .44028 .44675 .45022 .44978 .44676 .44118 .43032 .41623 .39624
                .36826 .32325""",
        "T": """.84654 .94825 1.0049 1.0359 1.0539 1.0638 1.0697 1.0706 1.0703 1.0697 1.0640 1.0543 1.0363 1.0045 .94871
                .84774 .44446 .35244 .32505 .31401 .30884 .30715 .30596 .30572 .30614 .30642 .30683 .30907 .31385 .32537
                .35255 .44375"""},
    (60, 0.99): {
        "R": """.38919 .33814 .30943 .29164 .28112 .27579 .27479 .27608 .28105 .28895 .29862 .31206 .32827 .34823 .37136
                .39690 .50371 .61392 .67620 .70765 .71969 .71838 .70939 .69644 .67965 .66247 .64396 .62474 .60415 .58147
                .55020 .49561""",
        "T": """.22620 .24431 .25894 .27104 .28272 .29476 .30722 .32081 .33567 .35257 .37056 .38990 .40756 .42551 .43743
                .43396 .41504 .40732 .39876 .38867 .37543 .35982 .34274 .32379 .30480 .28645 .26937 .25403 .24120 .23123
                .22294 .21616"""}}


def compare_with_consensus(found, truth):
    """Chi-square over 32 columns, to which the consensus adds its own errors of about 0.3 %: false-alarm rate about
    1e-3 for the columns, and 1e-4 for their means, known to 0.1 %."""
    for side, text in truth.items():
        columns = np.array([float(number) for number in text.split()])
        power, error = 32 * found[side].forward_parts[:, 0, 0, 0], 32 * found[side].forward_parts_error[:, 0, 0, 0]
        assert squares(power, np.hypot(error, 0.003 * columns), columns).sum() < 62, side
        mean, error = found[side].forward[0], found[side].forward_error[0]
        assert squares(mean, np.hypot(error, 0.001 * columns.mean()), columns.mean()) < 16, side


@pytest.mark.parametrize("zenith, albedo", CONSENSUS)
def test_the_step_cloud_is_that_of_other_programs(zenith, albedo):
    found = vpm.measure(layer_of_boxes(albedo, zenith, FACES), passes=64)
    compare_with_consensus(found, CONSENSUS[zenith, albedo])


def test_the_step_cloud_as_a_grid_is_the_same():
    """Densities that are constant in each of 32 columns, by interpolation "nearest"."""
    values = np.ones((32, 16, 4), np.float32)
    values[:16] = 2 / 18
    transform = np.diag([500 / 32, 250 / 16, 500 / 4, 1.0])
    transform[:3, 3] = [500 / 64, 250 / 32, 500 / 8]
    cloud = {"type": "grid", "sigma_t": 18 / 250, "albedo": 1.0, "interpolation": "nearest",
             "phase": {"type": "henyey-greenstein", "g": 0.85}, "grid": vpm.Grid(values, transform)}
    found = vpm.measure(scene({"cloud": cloud}, [], [sun(0)], FACES, emitted=12_500, world={"cyclic": ["x", "z"]}),
                        passes=64)
    compare_with_consensus(found, CONSENSUS[0, 1.0])


@pytest.mark.parametrize("axes", (["x", "z"], ["x"]))
def test_a_box_that_repeats_itself_is_a_slab(axes):
    """A narrow box, whose sides most photons pass: false-alarm rate about 1e-4."""
    light = {"type": "beam", "position": [0.3, 2, 0.2], "direction": [0, -1, 0], "radius": 0.01, "power": 1}
    wide = 0.25 if axes == ["x", "z"] else 50
    made = scene({"mist": {"type": "homogeneous", **MIST}}, [box([0, 0, -wide], [0.5, 1, wide], "mist")], [light],
                 world={"cyclic": axes})
    for value, error, exact in vpm.measure(made, passes=64).slab.values():
        assert squares(value[0], error[0], exact[0]) < 20


def test_detectors_off_a_layer_that_repeats_itself_count_what_crosses_their_period():
    """Far above the layer, where light has passed sides since it left, and below: as many as a plane counts."""
    above = [{"name": f"above {h}", "type": "quad", "corner": [0, 250 + h, 500], "edge_u": [500, 0, 0],
              "edge_v": [0, 0, -500]} for h in (0.01, 1000)]
    plane = {"name": "plane", "type": "plane", "point": [0, 260, 0], "normal": [0, 1, 0]}
    found = vpm.measure(layer_of_boxes(1.0, 60, above + [plane]), passes=2)
    assert found["above 1000"].forward_count == found["above 0.01"].forward_count == found["plane"].forward_count > 0
    assert found["above 1000"].backward_count == found["plane"].backward_count == found.photons


def test_nothing_is_lost():
    """Photons that are cut are counted, too."""
    found = vpm.measure(slab({"sigma_t": 20.0, "albedo": 1.0}, [TOP]), passes=2)
    for cut in (found, vpm.measure(vpm.Scene({**CUT}), passes=2)):
        gone = cut.absorbed_in_media[0] + cut.absorbed_on_surfaces[0] + cut.escaped[0] + cut.cut_at_max_events[0]
        assert gone == pytest.approx(cut.emitted[0], rel=1e-6)
    assert (cut.cut_at_max_events[0] > 0).all()


CUT = {
    "camera": CAMERA, "media": {"mist": {"type": "homogeneous", "sigma_t": 20.0, "albedo": 1.0}},
    "shapes": [box([-200, 0, -200], [200, 1, 200], "mist")], "detectors": [TOP], "render": {"max_events": 5},
    "lights": [{"type": "beam", "position": [0, 2, 0], "direction": [0, -1, 0], "radius": 0.01, "power": 1}],
    "integrator": {"type": "photon-map", "photons": {"emitted": 1000}, "volume": {"type": "beam", "radius": 0.1}}}


def test_fluence_in_a_scene_that_repeats_itself_is_that_of_a_slab():
    sun_above = {"type": "directional", "direction": [0, -1, 0], "irradiance": 1}
    made = scene({"mist": {"type": "homogeneous", "sigma_t": 2.0, "albedo": 0.5}}, [box([0, 0, 0], [0.5, 1, 3], "mist")],
                 [sun_above], emitted=40_000, world={"cyclic": ["x", "z"]})
    field = vpm.fluence(made, box=((0, 0, 0), (0.5, 1, 3)), cells=(1, 10, 1), passes=32)
    depths = np.linspace(0, 2, 21)
    depths[0] = 1e-9
    exact = np.array(vpm.exact("slab", tau=2, albedo=0.5, depths=",".join(f"{d:.12g}" for d in depths))["fluence"].value)
    truth = (exact[:-1:2] + 4 * exact[1::2] + exact[2::2]) / 6
    assert squares(field.fluence[0, ::-1, 0, 0], field.fluence_error[0, ::-1, 0, 0], truth).sum() < 40


def test_the_same_bits_on_any_number_of_threads():
    made = slab(MIST | {"sigma_t": [1.0, 2.0, 4.0]}, [TOP | {"angles": 5}], emitted=9000)
    vpm.set_threads(1)
    one = vpm.measure(made, passes=3)
    vpm.set_threads(0)
    two = vpm.measure(made, passes=3)
    assert np.array_equal(one["top"].forward_parts_error, two["top"].forward_parts_error)
    assert np.isnan(vpm.measure(made, passes=1)["top"].forward_error).all()


def test_a_time_is_kept():
    """No second pass is begun where there is no time, and it counts in the place of passes."""
    found = vpm.measure(slab(MIST, [TOP], emitted=1000), passes=7, time=1e-9)
    assert found.photons == 1000 and repr(found) == "Measurement(top; 1 passes)"


WRONG = [
    ({"type": "plane", "point": [0, 0, 0]}, "normal"),
    ({"type": "disc", "center": [0, 0, 0], "normal": [0, 1, 0], "radius": 0}, "radius"),
    ({"type": "sphere", "center": [0, 0, 0], "radius": 1, "angles": 0}, "angles"),
    ({"type": "quad", "corner": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [2, 0, 0]}, "parallel"),
    ({"type": "quad", "corner": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, 1], "cells": [2, 1.5]}, "whole"),
    ({"type": "quad", "corner": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, 1], "cells": [1000, 100]}, "50000"),
    ({"type": "medium", "medium": "mits"}, "mist"),
    ({"type": "medium", "medium": "vacuum"}, "vacuum absorbs nothing"),
    ({"type": "medium", "medium": "mist", "angles": 3}, "angles"),
    ({"type": "cube"}, "plane")]


@pytest.mark.parametrize("detector, said", WRONG)
def test_wrong_detectors_are_refused(detector, said):
    with pytest.raises(vpm.InputError, match=said):
        slab(MIST, [detector])


def test_wrong_wishes_are_refused():
    with pytest.raises(vpm.InputError, match="two detectors are named 'top'"):
        slab(MIST, [TOP, TOP])
    with pytest.raises(vpm.InputError, match="no detector: add"):
        vpm.measure(scene(shapes=[FLOOR], lights=[LAMP]))
    with pytest.raises(vpm.InputError, match="there is no detector 'x'"):
        vpm.measure(slab(MIST, emitted=100), passes=1)["x"]
    with pytest.raises(vpm.InputError, match="time: "):
        vpm.measure(slab(MIST), time=-1)
    with pytest.raises(vpm.InputError, match="emitted"):
        vpm.measure(slab(MIST, emitted="auto"))


CYCLIC = {"cyclic": ["x", "z"]}


@pytest.mark.parametrize("world, light, said", [
    (CYCLIC, {"type": "environment", "radiance": 1}, "quad as wide"),
    ({"cyclic": ["x"]}, {"type": "directional", "direction": [0, -1, 0], "irradiance": 1}, "along two axes"),
    (CYCLIC, {"type": "directional", "direction": [1, 0, 0], "irradiance": 1}, "never enters"),
    (CYCLIC, {"type": "point", "position": [5, 0.5, 0.5], "intensity": 1}, "beyond the box"),
    ({"cyclic": ["w"]}, LAMP, "cyclic"),
    (CYCLIC | {"medium": "mist"}, {"type": "point", "position": [0.5, 0.5, 0.5], "intensity": 1}, "no box to repeat")])
def test_wrong_periods_are_refused(world, light, said):
    with pytest.raises(vpm.InputError, match=said):
        scene({"mist": {"type": "homogeneous", **MIST}}, [box([0, 0, 0], [1, 1, 1], "mist")], [light], world=world)


@pytest.mark.parametrize("detector", [
    {"type": "sphere", "center": [1, 0.5, 0.5], "radius": 0.1},
    {"type": "disc", "center": [0.5, 0.5, 3], "normal": [0, 1, 0], "radius": 0.1},
    {"type": "plane", "point": [0.5, 0, 0], "normal": [1, 0, 0]}])
def test_detectors_across_the_sides_of_a_period_are_refused(detector):
    with pytest.raises(vpm.InputError, match="reaches across the sides"):
        scene({"mist": {"type": "homogeneous", **MIST}}, [box([0, 0, 0], [1, 1, 1], "mist")],
              [{"type": "point", "position": [0.5, 0.5, 0.5], "intensity": 1}], [detector], world=CYCLIC)


def test_a_period_has_a_width():
    with pytest.raises(vpm.InputError, match="no width"):
        scene(lights=[LAMP], detectors=[TOP], world=CYCLIC)


def test_scenes_that_repeat_themselves_make_no_pictures():
    made = scene({"mist": {"type": "homogeneous", **MIST}}, [box([0, 0, 0], [1, 1, 1], "mist")],
                 [{"type": "point", "position": [0.5, 0.5, 0.5], "intensity": 1}], world=CYCLIC)
    for way in (vpm.render, vpm.photons):
        with pytest.raises(vpm.InputError, match="makes no picture"):
            way(made)
