"""The package as README.md says that it is installed, from the source tree into an environment of its own."""
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def run(*command):
    environment = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_pip_installs_the_package_and_leaves_the_tree_as_it_is(tmp_path):
    before = run("git", "-C", str(ROOT), "status", "--porcelain", "--ignored")
    run(sys.executable, "-m", "venv", "--system-site-packages", str(tmp_path / "env"))
    run(str(tmp_path / "env/bin/pip"), "install", "--no-build-isolation", "--no-index", str(ROOT / "tools/python"))
    told = run(str(tmp_path / "env/bin/python"), "-c", """if True:
        import pathlib, vpm
        scene = vpm.Scene({"camera": {"position": [0, 0, 3], "target": [0, 0, 0]},
                           "film": {"width": 8, "height": 4},
                           "shapes": [{"type": "sphere", "center": [0, 0, 0], "radius": 1,
                                       "material": {"type": "lambertian", "reflectance": 0.5}}],
                           "lights": [{"type": "directional", "direction": [0, -1, -1], "irradiance": 3}]})
        files = sorted(path.name for path in pathlib.Path(vpm.__file__).parent.glob("*py*"))
        print(vpm.__file__, files, vpm.render(scene, passes=1).radiance.shape)""")
    assert told.startswith(str(tmp_path / "env")) and "(4, 8, 3)" in told
    assert "'py.typed'" in told and "'_vpm.pyi'" in told
    assert before == run("git", "-C", str(ROOT), "status", "--porcelain", "--ignored")
