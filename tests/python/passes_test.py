"""Passes from Python: stop rules, choices, threads and interruptions."""
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
import vpm
from ball import BALL
from like_ball import PROGRAM, command


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
    overrides = {"integrator.surface.type": "radius", "integrator.radii": "per-pixel"}
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
    assert 0.9 <= vpm.render(BALL, seconds=1).seconds < 5
    assert len(list(vpm.passes(BALL, overrides={"render.passes": 3}))) == 3


def test_values_are_chosen_as_by_the_command_line(ball_file, tmp_path):
    command("render", ball_file, "-o", tmp_path / "line.exr", "--passes", 2, "--set", "integrator.volume.radius=auto")
    result = vpm.render(ball_file, overrides={"integrator.volume.radius": "auto"}, passes=2)
    assert np.array_equal(result.radiance, vpm.read_exr(tmp_path / "line.exr").radiance)
    assert any("chosen integrator.volume.radius" in note for note in result.notes)
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


def test_a_time_in_which_no_pass_fits_is_refused():
    # The words are of the time asked for, of which choosing the radii takes a part.
    with pytest.raises(vpm.NoPassFits, match="no pass is finished within the 0.02 s asked for") as error:
        vpm.render(BALL, overrides={"integrator.photons.emitted": 1_000_000_000, "integrator.photons.block": 1_000_000}, seconds=0.02)
    assert isinstance(error.value, TimeoutError)


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


def test_threads_can_be_set():
    before = vpm.thread_count()
    vpm.set_threads(1)
    one = vpm.render(BALL, passes=1).radiance
    vpm.set_threads(0)
    assert np.array_equal(one, vpm.render(BALL, passes=1).radiance)
    assert vpm.thread_count() == before
    with pytest.raises(vpm.InputError):
        vpm.set_threads(-1)
