"""Renders by several processes from Python, as mpiexec starts them with mpi4py's launcher."""
import os
import subprocess
import sys

import numpy as np
import vpm
from ball import BALL

# Each rank writes what it has, as rank 0 alone writes pictures.
SCRIPT = """
import numpy as np
import vpm
from mpi4py import MPI
from ball import BALL

vpm.set_threads(1)
rank = MPI.COMM_WORLD.rank
first = vpm.render(BALL, passes=5, seed=3, together=True)
assert first.passes == 5
if rank == 1:
    try:
        first.write("/nowhere/at/all.exr")
    except vpm.InputError:
        raise SystemExit("a rank other than 0 has written")
result = first.resume(passes=9)
result.write("all.exr")
np.save(f"radiance{rank}", result.radiance)
np.save(f"variance{rank}", result.variance)
chosen = vpm.render(BALL, overrides={"integrator.photons.emitted": "auto"}, passes=2, together=True)
np.save(f"chosen{rank}", chosen.radiance)
"""

MPIEXEC = ["mpiexec", "--oversubscribe", "--bind-to", "none", "-n"]


def run(ranks, script, folder):
    """A script in a folder, by so many processes."""
    (folder / "script.py").write_text(script)
    environment = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                                "PYTHONPATH": os.pathsep.join([os.environ["PYTHONPATH"], os.path.dirname(__file__)])}
    return subprocess.run([*MPIEXEC, str(ranks), sys.executable, "-m", "mpi4py", "script.py"], cwd=folder,
                          env=environment, capture_output=True, text=True, timeout=300)


def test_all_ranks_have_the_result_of_one_process(tmp_path):
    done = run(3, SCRIPT, tmp_path)
    assert done.returncode == 0, done.stderr
    alone = vpm.render(BALL, passes=9, seed=3)
    chosen = vpm.render(BALL, overrides={"integrator.photons.emitted": "auto"}, passes=2)
    for rank in range(3):
        assert np.array_equal(np.load(tmp_path / f"radiance{rank}.npy"), alone.radiance)
        assert np.array_equal(np.load(tmp_path / f"variance{rank}.npy"), alone.variance)
        assert np.array_equal(np.load(tmp_path / f"chosen{rank}.npy"), chosen.radiance)
    assert np.array_equal(vpm.read_exr(tmp_path / "all.exr").radiance, alone.radiance)


def test_another_scene_on_another_rank_ends_all(tmp_path):
    done = run(2, SCRIPT.replace("seed=3", "seed=3 + rank"), tmp_path)
    assert done.returncode != 0
    assert "this rank would render something else" in done.stderr
    assert "render.seed: 3 of rank 0, 4 here" in done.stderr


def test_a_rank_that_catches_what_a_render_raises_ends_all(tmp_path):
    # Rank 0 is interrupted before it tells the others that the render is over, which they wait for.
    done = run(2, """
import _thread, threading
import vpm
from mpi4py import MPI
from ball import BALL

scene = vpm.Scene(BALL)
assert vpm.render(scene, passes=1, together=True).passes == 1
if MPI.COMM_WORLD.rank == 0:
    threading.Timer(1.0, _thread.interrupt_main).start()
try:
    vpm.render(scene, passes=1_000_000, together=True)
except vpm.Interrupted as stopped:
    assert stopped.result.passes > 0
    stopped.result.write("some.exr")
    try:
        vpm.render(scene, passes=1, together=True)
    except vpm.InputError as error:
        print("refused:", error)
    print(vpm.render(scene, passes=1).passes, "by itself")
""", tmp_path)
    assert done.returncode == 1, done.stderr
    assert "refused: an earlier render together ended with an exception" in done.stdout
    assert "1 by itself" in done.stdout
    assert vpm.read_exr(tmp_path / "some.exr").radiance.any()


def test_two_threads_do_not_render_together_at_once(tmp_path):
    done = run(1, """
import threading
import vpm
from ball import BALL

threading.Thread(target=lambda: vpm.render(BALL, seconds=3, together=True)).start()
import time; time.sleep(1.0)
try:
    vpm.render(BALL, passes=1, together=True)
except vpm.InputError as error:
    print(error)
""", tmp_path)
    assert done.returncode == 0, done.stderr
    assert "another thread renders together" in done.stdout


def test_processes_that_are_not_together_render_for_themselves(tmp_path):
    done = run(2, "import vpm\nfrom mpi4py import MPI\nfrom ball import BALL\n"
                  "print(vpm.render(BALL, passes=1, seed=MPI.COMM_WORLD.rank).seed)\n", tmp_path)
    assert done.returncode == 0, done.stderr
    assert sorted(done.stdout.split()) == ["0", "1"]
