"""Does a program end when it is to? Under --busy other processes, for each scene:

- renders it for 2, 8 and 30 seconds, and again with --auto, and prints the time on the wall, passes, and the error that
  is stated or the sentence that is said. A render of T seconds is to end within 1.1 T + 0.5 s with at least a pass, by
  2 T + 1 s where its first pass was late, or with status 3 and a sentence;
- interrupts it by SIGINT at ten random moments (--moments), and prints the longest time that it took to end. That is to
  be a second at the most, with a picture after a finished pass, else with nothing left and status 130.

Then interrupts loading a grid, validate, compare and bake likewise. What took too long is marked by "LATE", and makes
the exit status 1.
"""
import argparse
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = "fog_room glass_caustic cloud smoke pool lantern".split()
SECONDS = (2, 8, 30)

SLAB = """
[camera]
position = {camera}
target = [0, 0, 0]
fov = 40
[film]
width = 32
height = 32
[media.slab]
type = "homogeneous"
sigma_s = {sigma_s}
sigma_a = {sigma_a}
phase = {{ type = "henyey-greenstein", g = 0.75 }}
[materials.open]
type = "boundary"
[[shapes]]
type = "box"
material = "open"
min = [-200, {low}, -200]
max = [200, {high}, 200]
inside = "slab"
[[lights]]
type = "beam"
position = [0, 5, 0]
direction = [0, -1, 0]
radius = 0.01
power = 1
{more}
"""


def slab(albedo=0.9, thickness=1.0, camera="[0, 3, 0.5]", more=""):
    """A wide slab of optical depth 2 under a thin beam, whose default radius is 1 % of its diagonal."""
    sigma_t = 2.0 / thickness
    return SLAB.format(sigma_s=albedo * sigma_t, sigma_a=(1 - albedo) * sigma_t, low=-thickness / 2, high=thickness / 2,
                       camera=camera, more=more)


SLABS = {"slab": slab(), "slab-albedo-0.5": slab(albedo=0.5), "slab-thin": slab(thickness=0.1),
         "slab-inside": slab(camera="[0, 0, 20]")}
OLD_RADIUS = slab(more="[integrator.volume]\nradius = 5.657\n")  # the default when slabs could hang


def run(command, folder, wait=None):
    """Runs a command in a folder, interrupted after `wait` s where that is given: seconds on the wall from the signal
    or the start, the exit status, and what it said."""
    process = subprocess.Popen([str(word) for word in command], cwd=folder, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True)
    begin = time.monotonic()
    if wait is not None:
        try:
            process.wait(wait)
            return None  # it had ended before
        except subprocess.TimeoutExpired:
            begin = time.monotonic()
            process.send_signal(signal.SIGINT)
    said, _ = process.communicate()
    return time.monotonic() - begin, process.returncode, said


def timed(program, name, scene, seconds, options):
    """A line on a render of so many seconds; whether it ended in time."""
    with tempfile.TemporaryDirectory() as folder:
        wall, status, said = run([program, "render", scene, "-o", "p.exr", "--time", seconds, "--progress", "never",
                                  *options], folder)
        found = re.search(r": (\d+) pass(es)? in ", said)
        passes, stated = int(found[1]) if found else 0, said.strip().splitlines()[-1] if said.strip() else ""
        if status == 0:
            found = re.search(r"relative MSE at most [^;]*", said)
            stated = found[0] if found else f"{passes} passes: no error is stated"
        late = "no pass is finished after" in said
        limit = 2 * seconds + 1 if late else 1.1 * seconds + 0.5
        good = wall <= limit and (status == 3 or (status == 0 and passes > 0))
        print(f"{name:18} {' '.join(options):7} {seconds:3} s: {wall:6.2f} s, status {status}, {passes:4} passes; "
              f"{stated}{'' if good else '  LATE'}", flush=True)
        return good


def interrupted(name, command, span, moments, kept=()):
    """A line on interrupting a command at random moments of its first `span` s; whether it always ended in time.
    `kept`: files that may be left."""
    longest, unfinished, good = 0.0, 0, True
    for _ in range(moments):
        with tempfile.TemporaryDirectory() as folder:
            found = run(command, folder, random.uniform(0.0, span))
            if found is None:
                continue
            took, status, said = found
            left = sorted(path.name for path in pathlib.Path(folder).iterdir() if path.name not in kept)
            picture = "interrupted after" in said
            right = status in (130, -signal.SIGINT) and (bool(left) == picture)
            longest, unfinished = max(longest, took), unfinished + (not picture)
            if took > 1.0 or not right:
                good = False
                print(f"  {name}: {took:.2f} s, status {status}, left {left}: {said.strip()[-200:]}  LATE")
    print(f"{name:18} SIGINT at {moments} moments: {longest:.2f} s at most, {unfinished} of them without a picture",
          flush=True)
    return good


def main():
    parser = argparse.ArgumentParser(prog="tools/bench time", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=ROOT / "build/release/vpm", help="default: this checkout's")
    parser.add_argument("--scenes", nargs="*", default=SCENES, help="of the folder scenes; default: six")
    parser.add_argument("--seconds", nargs="*", type=float, default=SECONDS)
    parser.add_argument("--busy", type=int, default=2, help="other processes; default 2")
    parser.add_argument("--moments", type=int, default=10)
    arguments = parser.parse_args()
    program = pathlib.Path(arguments.program).resolve()
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(arguments.busy)]
    random.seed(1)
    good = True
    try:
        with tempfile.TemporaryDirectory() as folder:
            scenes = {name: ROOT / f"scenes/{name}.toml" for name in arguments.scenes}
            for name, text in SLABS.items():
                scenes[name] = pathlib.Path(folder, f"{name}.toml")
                scenes[name].write_text(text)
            old = pathlib.Path(folder, "old.toml")
            old.write_text(OLD_RADIUS)
            for name, scene in scenes.items():
                for options in ([], ["--auto"]):
                    for seconds in arguments.seconds:
                        good &= timed(program, name, scene, seconds, options)
            for name, scene in [*scenes.items(), ("slab, old radius", old)]:
                good &= interrupted(name, [program, "render", scene, "-o", "p.exr"], 4.0, arguments.moments)
            good &= others_interrupted(program, folder, arguments.moments)
    finally:
        for process in busy:
            process.kill()
    return 0 if good else 1


def others_interrupted(program, folder, moments):
    """The same of what is no render."""
    grid = pathlib.Path(folder, "cloud512.vdb")
    subprocess.run([program, "media", "cloud", "--resolution", "512", "-o", grid], check=True, stdout=subprocess.DEVNULL)
    experiment = ROOT / "scenes/experiments/lantern.toml"
    commands = {
        "512^3 grid": ([program, "view", grid, "-o", "p.exr"], 2.0, ()),
        "validate": ([program, "validate"], 20.0, ()),
        "compare": ([program, "compare", experiment, "-o", "out"], 10.0, ("out",)),
        "bake": ([program, "bake", ROOT / "scenes/cornell.toml", "--mesh", "floor"], 4.0, ()),
    }
    return all([interrupted(name, command, span, moments, kept) for name, (command, span, kept) in commands.items()])


if __name__ == "__main__":
    sys.exit(main())
