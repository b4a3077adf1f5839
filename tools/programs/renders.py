"""Speed against error on whole scenes.

Renders each scene with new seeds for about a quarter, a half and all of --seconds, and prints the CPU seconds, the
error against the scene's reference, and the efficiency, 1 / (error x seconds): medians over renders. Passes are powers
of two: the one that comes closest to --seconds by a trial before, at least 4, its half and its quarter.

With --before, an older program renders the same at the same time, with the same seeds; each render has one thread and a
core of its own, and cores change from pair to pair. Each pair gives a ratio, the time of BEFORE over that of this
program at the lowest error that both reach: above 1 this program is quicker. Printed are the median over pairs with its
interval by order statistics, which supposes nothing of how errors are distributed, and the geometric mean over scenes.

With --renderer, pictures by other renderers stand in the same table: renders.csv in a folder, or a file, with the
columns scene, seconds, file (of the EXR picture) and, if need be, renderer; or the same as objects of a JSON list.
Seconds are CPU seconds of the process, user and system, on one thread, loading included, as they are here.

Errors are relative MSEs against the truth, as `vpm error` has them, less the reference's own noise: so the bias of
photons' radii counts. papers/performance.md says how references are made, and what the JSON file holds.

Exit status: 0; 1 where the interval of the geometric mean lies below 1: this program is slower (fewer than 5 pairs
decide nothing); 2 for wrong input, or where a render fails; 130 where it was interrupted.
"""
import argparse
import datetime
import hashlib
import json
import math
import os
import pathlib
import platform
import subprocess
import sys
import time

from programs import equal_error, pairs, suite
from programs.measure import bounds, difference_of, measure
from programs.other_renderers import read_renderer
from programs.suite import InputError, ROOT

MOST_PAIRS = (suite.REFERENCE_SEED - 1) // 1000 * 1000
MUCH = 0.2  # of an error: what a reference may be wrong by before it is noted


class Progress:
    """How many of all pairs are done, and when the rest will be, on a terminal."""

    def __init__(self, pairs_in_all):
        self.all, self.done, self.start = pairs_in_all, 0, time.monotonic()
        self.shown = sys.stderr.isatty()

    def show(self, scene):
        if self.shown:
            left = "" if self.done == 0 else f", {self.left()} left"
            sys.stderr.write(f"\r\x1b[K{scene}: {self.done} of {self.all} pairs{left}")
            sys.stderr.flush()

    def left(self):
        seconds = (time.monotonic() - self.start) / self.done * (self.all - self.done)
        return f"{seconds / 60:.0f} min" if seconds > 90 else f"{seconds:.0f} s"

    def clear(self):
        if self.shown:
            sys.stderr.write("\r\x1b[K")
            sys.stderr.flush()


def verdict(ratio, number_of_pairs):
    """Whether a ratio shows that this program is slower or quicker; "" where it does not, as of fewer than 5 pairs."""
    if number_of_pairs < 5:
        return ""
    return "SLOWER" if ratio["high"] < 1 else "quicker" if ratio["low"] > 1 else ""


def print_scene(found):
    reference = found["reference"]
    noise = "has no known noise" if reference["noise"] is None else f"has a noise of {reference['noise']:.2g}"
    stated = reference["stated"]
    stated_text = f", states an error of {stated['value']:.2g} +- {stated['standard_error']:.1g}" if stated else ""
    print(f"{found['scene']}: the reference {noise}{stated_text}")
    names = {"after": "vpm", "before": "before"}
    for row in found["table"]:
        print(f"  {names[row['program']]:<24}{row['passes']:>8}{row['seconds']:>9.2f}{row['error']['median']:>12.3g}{row['efficiency'] or math.nan:>15.4g}")
    for row in found["others"]:
        print(f"  {row['renderer'][:31]:<32}{row['seconds']:>9.2f}{row['error']:>12.3g}{row['efficiency'] or math.nan:>15.4g}", end="")
        seconds = row["vpm_seconds_for_that_error"]
        print(f"  vpm: {seconds:.3g} s{', extrapolated' if row['outside'] else ''}" if seconds else "")
    if found["ratio"]:
        print(f"  {'time at equal error, before / now':<54}{show_ratio(found['ratio'], len(found['ratios']))}"
              + (f"; {found['ratios_outside']} extrapolated" if found["ratios_outside"] else ""))
    warn_of_reference(found)
    sys.stdout.flush()


def show_ratio(ratio, number_of_pairs):
    return f"{ratio['median']:.3f} [{ratio['low']:.3f}, {ratio['high']:.3f}]  {verdict(ratio, number_of_pairs)}".rstrip()


def warn_of_reference(found):
    """Says where a reference is not good enough for what was measured by it."""
    reference = found["reference"]
    if any(render["error"] <= 0 for render in found["renders"]):
        print("  NO RATIO: renders come closer to the reference than its own noise; it needs more time (--reference-error)")
        return
    wrong = reference["stated"]["value"] if reference["stated"] else reference["noise"]
    least = min(row["error"]["median"] for row in found["table"])
    if wrong is None or wrong > MUCH * least:
        how = "of unknown size" if wrong is None else f"{wrong / least:.0%} of the least error here"
        print(f"  the reference's own error is {how}: the errors above are the less certain")


def sha256(file):
    return hashlib.sha256(pathlib.Path(file).read_bytes()).hexdigest()


def describe_program(program):
    done = subprocess.run([program, "--version"], capture_output=True, text=True, errors="replace")
    if done.returncode != 0 or not done.stdout.strip():
        raise InputError(f"{program}: it does not print its --version, as vpm does")
    return {"version": done.stdout.strip(), "sha256": sha256(program)}


def processor():
    cpuinfo = pathlib.Path("/proc/cpuinfo")
    lines = cpuinfo.read_text().splitlines() if cpuinfo.exists() else []
    return next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), platform.processor())


def write_json(options, found, skipped, mean, programs):
    """Writes what there is so far, all or nothing."""
    if options.json is None:
        return
    summary = {"layout": "vpm bench renders 1", "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
            "machine": {"processor": processor(), "cores": len(os.sched_getaffinity(0)), "system": platform.platform()},
            "programs": programs, "size": options.size, "pairs": options.pairs,
            "seconds": options.seconds, "confidence": pairs.interval([0] * options.pairs)[3],
            "scenes": found, "skipped": skipped, "geometric_mean": mean}
    part = options.json.with_name(options.json.name + ".part")
    part.write_text(json.dumps(summary, indent=1) + "\n")
    part.replace(options.json)


def above_zero(text):
    value = float(text)
    if not 0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"{text} is not a number above 0")
    return value


def whole(lowest, highest):
    def read(text):
        value = int(text)
        if not lowest <= value <= highest:
            raise argparse.ArgumentTypeError(f"{text} is not from {lowest} to {highest}")
        return value
    read.__name__ = "whole number"
    return read


def read_arguments():
    parser = argparse.ArgumentParser(prog="tools/bench renders", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", metavar="SCENE", nargs="*", help=f"{', '.join(suite.STANDARD)}, or a scene file; all of these unless given")
    parser.add_argument("--before", metavar="PROGRAM", help="an older vpm to be compared with")
    parser.add_argument("--program", metavar="PROGRAM", help="the vpm that is measured; build/release/vpm, built anew, unless given")
    parser.add_argument("--pairs", type=whole(1, MOST_PAIRS), metavar="N",
                        help="pairs of renders of each scene and number of passes, 6 or more for intervals of 95 %%; 25 unless given, without --before 5")
    parser.add_argument("--seconds", type=above_zero, default=10.0, metavar="S", help="CPU seconds of the longest renders, about; 10 unless given")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE", help="write all that was measured")
    parser.add_argument("--renderer", type=pathlib.Path, action="append", default=[], metavar="PATH",
                        help="pictures by another renderer: a folder or a list, see above; may be repeated")
    parser.add_argument("--size", type=whole(8, 4096), default=suite.USUAL_SIZE, metavar="N",
                        help=f"pictures of N x N pixels; {suite.USUAL_SIZE} unless given")
    parser.add_argument("--grids", type=pathlib.Path, default=ROOT.parent / "shared" / "vdb", metavar="FOLDER",
                        help="of grids that others publish; ../shared/vdb unless given")
    parser.add_argument("--references", type=pathlib.Path, default=ROOT / "build" / "renders" / "references", metavar="FOLDER",
                        help="where references are kept, or SCENE.exr of your own are; build/renders/references unless given")
    parser.add_argument("--reference-error", type=above_zero, metavar="E",
                        help="the error that references are to state; each scene has its own unless given")
    options = parser.parse_intermixed_args()
    options.pairs = options.pairs or (25 if options.before else 5)
    # Their order is that of the table.
    options.programs = {"before": pairs.program(parser, options.before)} if options.before else {}
    options.programs["after"] = pairs.program(parser, options.program) if options.program else str(ROOT / "build/release/vpm")
    return options


def choose(options):
    """The scenes that can be rendered, those that are skipped, and the rows of other renderers."""
    scenes = [suite.find_scene(text, options.grids.resolve()) for text in dict.fromkeys(options.scene or suite.STANDARD)]
    skipped = [{"scene": scene.name, "why": suite.missing_grid(scene)} for scene in scenes if suite.missing_grid(scene)]
    for scene in skipped:
        if options.scene:
            raise InputError(f"{scene['scene']}: {scene['why']}")
        print(f"bench: {scene['scene']} is skipped: {scene['why']}", file=sys.stderr)
    scenes = [scene for scene in scenes if not suite.missing_grid(scene)]
    known = {*suite.STANDARD, *(scene.name for scene in scenes)}
    rows = [row for path in options.renderer for row in read_renderer(path, known)]
    for row in rows:
        if row.scene not in [scene.name for scene in scenes]:
            print(f"bench: {row.where} is left out: {row.scene} is not rendered", file=sys.stderr)
    return scenes, skipped, rows


def check_sizes(options, rows):
    """Refuses pictures of another size, before hours are spent on what they stand beside."""
    for row in rows:
        try:
            compared = difference_of(options.programs["after"], row.file, row.file)
        except RuntimeError as error:
            raise InputError(f"{row.where}: {error}") from error
        if (compared["width"], compared["height"]) != (options.size, options.size):
            raise InputError(f"{row.where}: {row.file} has {compared['width']} x {compared['height']} pixels, and pictures here have "
                             f"{options.size} x {options.size}: render it at that size, or give --size")


def check_json(file):
    """Refuses a file that cannot be written, before there is something to write."""
    if file is not None and file.is_dir():
        raise InputError(f"{file}: it is a folder; --json takes a file")
    if file is not None and not file.resolve().parent.is_dir():
        raise InputError(f"{file}: there is no folder {file.resolve().parent}")


def run(options):
    """Measures and prints all scenes; the exit status."""
    scenes, skipped, rows = choose(options)
    check_json(options.json)
    if not options.program:
        subprocess.run([ROOT / "tools" / "build", "release", "vpm"], stdout=sys.stderr.fileno(), check=True)
    check_sizes(options, rows)
    programs = {name: describe_program(program) for name, program in options.programs.items()}
    confidence = pairs.interval([0] * options.pairs)[3]
    print(f"{options.size} x {options.size} pixels, renders for each row: {options.pairs}; medians"
          + (f"; intervals of {confidence:.1%}" if options.before else ""))
    print(f"  {'':<24}{'passes':>8}{'CPU s':>9}{'error':>12}{'1/(error s)':>15}")
    found, mean, progress = [], None, Progress(options.pairs * len(scenes))
    for scene in scenes:
        try:
            found.append(measure(options, scene, [row for row in rows if row.scene == scene.name], progress))
        except RuntimeError as error:
            raise RuntimeError(f"{scene.name}: {error}") from error
        finally:
            progress.clear()
        print_scene(found[-1])
        lists = [of_scene["ratios"] for of_scene in found if of_scene["ratios"]]
        mean = bounds(equal_error.geometric_means(lists)) if lists else None
        write_json(options, found, skipped, mean, programs)
    if mean:
        print(f"{'geometric mean over scenes':<56}{show_ratio(mean, options.pairs)}")
    return 1 if mean and verdict(mean, options.pairs) == "SLOWER" else 0


def main():
    options = read_arguments()
    try:
        return run(options)
    except (OSError, RuntimeError, subprocess.CalledProcessError, InputError) as error:
        print(f"bench: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main())
