"""Renders of a scene by one program or two, their errors, and what comes of these: tables and ratios."""
import contextlib
import json
import math
import pathlib
import statistics
import subprocess
import tempfile

from programs import equal_error, pairs, suite
from programs.old_keys import for_programs

LEAST_PASSES = 4  # of the longest render: the shortest makes one


def difference_of(program, picture, reference):
    """What `vpm error` prints of two pictures. Throws RuntimeError with what it says where they cannot be compared."""
    done = subprocess.run([program, "error", "--json", str(picture), str(reference)], capture_output=True, text=True, errors="replace")
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    return json.loads(done.stdout)


def error_of(program, picture, reference):
    """The error of a picture less the reference's noise, and that noise, or None where the reference has no variance.
    Throws RuntimeError where they cannot be compared."""
    compared = difference_of(program, picture, reference)
    noise = compared["relative_mse"]["noise_of_reference"]
    if compared["crop"] is not None:
        raise RuntimeError(f"{picture} is only a part of the picture of {reference}, and all of it is measured")
    if sum(compared["non_finite_pixels"].values()) > 0:
        raise RuntimeError(f"{picture} has pixels that are no finite numbers")
    return compared["relative_mse"]["value"] - (noise or 0), noise


def commands_of(options, scene, passes, seed, folders):
    """The renders of all programs at once, of a dictionary of passes."""
    commands = [suite.render_command(program, scene, options.size, folder / "picture.exr", seed,
                                     ["--threads", 1, "--passes", passes[name], "--progress", "never"], scene.sets)
                for (name, program), folder in zip(options.programs.items(), folders)]
    return for_programs(commands, folders)


@contextlib.contextmanager
def folders_of(options):
    """An empty folder for each program."""
    with tempfile.TemporaryDirectory() as scratch:
        folders = [pathlib.Path(scratch, name) for name in options.programs]
        for folder in folders:
            folder.mkdir()
        yield folders


def passes_within(seconds, passes, of_quarter, of_all):
    """The power of two of passes that takes closest to some seconds, by those of so many passes and of their quarter
    (of 1 pass: of none)."""
    of_pass = max(of_all - of_quarter, of_all / 4) / (passes - passes // 4)
    wanted = passes + (seconds - of_all) / of_pass
    return max(LEAST_PASSES, 2 ** round(math.log2(max(wanted, 1))))


def choose_passes(options, scene):
    """How many passes the longest render of each program makes: the power of two that takes closest to --seconds.

    So programs that make the same pictures have errors at the same passes, though one be slower; and what is rendered
    does not depend on the load of the machine, as it does with --time, but for this trial.
    """
    def seconds_of(passes):
        with folders_of(options) as folders:
            commands = commands_of(options, scene, dict.fromkeys(options.programs, passes), suite.REFERENCE_SEED, folders)
            return pairs.run_together(commands, folders, 0)
    passes, last, now = 1, [0.0] * len(options.programs), seconds_of(1)
    while max(now) < options.seconds / 8:
        passes, last, now = 4 * passes, now, seconds_of(4 * passes)
    return {name: passes_within(options.seconds, passes, *spent) for name, *spent in zip(options.programs, last, now)}


def render_pair(options, scene, number, longest, reference):
    """The renders of a pair, by all programs: dictionaries as the JSON file has them."""
    renders, seed = [], number + 1
    for part in (4, 2, 1):
        passes = {name: most // part for name, most in longest.items()}
        with folders_of(options) as folders:
            seconds = pairs.run_together(commands_of(options, scene, passes, seed, folders), folders, number)
            for name, folder, spent in zip(options.programs, folders, seconds):
                error, _ = error_of(options.programs["after"], folder / "picture.exr", reference.file)
                renders.append({"program": name, "pair": number, "seed": seed, "passes": passes[name], "seconds": spent, "error": error})
    return renders


def bounds(values):
    median, low, high, _ = pairs.interval(values)
    return {"median": median, "low": low, "high": high}


def table_of(renders, programs):
    """A row for each program and number of passes."""
    rows = []
    for name in programs:
        for passes in sorted({render["passes"] for render in renders if render["program"] == name}):
            own = [render for render in renders if (render["program"], render["passes"]) == (name, passes)]
            seconds, errors = [render["seconds"] for render in own], [render["error"] for render in own]
            efficiency = statistics.median(1 / (t * e) if e > 0 else math.inf for t, e in zip(seconds, errors))
            rows.append({"program": name, "passes": passes, "seconds": statistics.median(seconds), "error": bounds(errors),
                         "efficiency": efficiency if math.isfinite(efficiency) else None})
    return rows


def curve_of(renders, name, number):
    return [(render["seconds"], render["error"]) for render in renders if (render["program"], render["pair"]) == (name, number)]


def ratios_of(renders, number_of_pairs):
    """The ratio of each pair, and how many of them lie outside of the times that were measured."""
    found = [equal_error.ratio_of(curve_of(renders, "before", pair), curve_of(renders, "after", pair)) for pair in range(number_of_pairs)]
    return [ratio for ratio, _ in found], sum(outside for _, outside in found)


def other_row(row, options, reference, table):
    """A picture by another renderer, and how long this program takes for the same error, by its medians."""
    error, _ = error_of(options.programs["after"], row.file, reference.file)
    curve = sorted((own["seconds"], own["error"]["median"]) for own in table if own["program"] == "after")
    compared = {"renderer": row.renderer, "file": str(row.file), "seconds": row.seconds, "error": error,
            "efficiency": None, "vpm_seconds_for_that_error": None, "outside": None}
    if error > 0 and all(e > 0 for _, e in curve):
        seconds, outside = equal_error.time_of(curve, error)
        compared |= {"efficiency": 1 / (row.seconds * error), "vpm_seconds_for_that_error": seconds, "outside": outside}
    return compared


def measure(options, scene, others, progress):
    """All that is found out of a scene, as the JSON file has it."""
    reference = suite.reference_of(options.programs["after"], scene, options.size, options.reference_error, options.references)
    progress.show(scene.name)
    renders, longest = [], choose_passes(options, scene)
    for number in range(options.pairs):
        progress.show(scene.name)
        renders += render_pair(options, scene, number, longest, reference)
        progress.done += 1
    table = table_of(renders, options.programs)
    _, noise = error_of(options.programs["after"], reference.file, reference.file)
    found = {"scene": scene.name, "file": str(scene.file), "sets": scene.sets,
             "reference": {"file": str(reference.file), "noise": noise, "stated": reference.stated},
             "table": table, "ratio": None, "ratios": None, "ratios_outside": None,
             "others": [other_row(row, options, reference, table) for row in others], "renders": renders}
    usable = all(render["error"] > 0 for render in renders)
    if "before" in options.programs and usable:
        ratios, outside = ratios_of(renders, options.pairs)
        found |= {"ratio": bounds(ratios), "ratios": ratios, "ratios_outside": outside}
    return found
