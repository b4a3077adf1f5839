"""The scenes of `tools/bench renders`, and the pictures that their errors are measured by."""
import collections
import hashlib
import json
import pathlib
import subprocess
import sys
import tomllib

from programs.cases import SCENES

ROOT = SCENES.parent
REFERENCE_SEED = 7001  # as of tools/references; renders that are measured have seeds from 1 on, below this
USUAL_SIZE = 160  # pixels a side
AIM_OF_OTHERS = 1e-4  # of the reference of a scene that is not in this list

# How a scene is measured: its file, settings of every program, and how its reference is made: settings, and the error
# that it is to state, relative MSE.
Scene = collections.namedtuple("Scene", "name file sets reference_sets aim")

# Unbiased: for grids, where photons need long as well. What these settings are worth: papers/reference-pictures.md.
PATHS = ["integrator.type=path", "render.samples_per_pixel=16"]
PATHS_IN_GRIDS = [*PATHS, "integrator.distance.type=delta-local", "integrator.transmittance.type=ratio-local"]

# Photons are as many as suit pictures of 160 x 160 pixels: scene files have those of larger ones. References by photons
# have radii of 0.7 of the scene's, which shrink with their many passes, so that little is left of the bias of renders
# that are measured.
STANDARD = {name: (sets, reference_sets, aim) for name, sets, reference_sets, aim in [
    ("fog_room", [], ["integrator.volume.radius=0.07", "integrator.surface.radius=0.07"], 2e-5),
    ("glass_caustic", ["integrator.photons.emitted=200_000"], ["integrator.photons.emitted=400_000", "integrator.volume.radius=0.035", "integrator.surface.radius=0.02"], 1e-4),
    ("smoke", ["integrator.photons.emitted=200_000"], PATHS_IN_GRIDS, 2e-4),
    ("cloud", ["integrator.photons.emitted=100_000"], PATHS_IN_GRIDS, 2e-4),
    ("wdas_cloud", ["integrator.photons.emitted=100_000"], PATHS_IN_GRIDS, 1e-4),
    ("cornell", [], ["integrator.surface.radius=0.04"], 3e-4),
    ("plume_room", ["integrator.photons.emitted=200_000"], ["integrator.volume.radius=0.02", "integrator.surface.radius=0.035"], 1e-4),
]}

# What a reference is: its picture, and the error that it states or None where it says nothing of that.
Reference = collections.namedtuple("Reference", "file stated")


class InputError(Exception):
    """What is wrong with what was asked for, and what would be right."""


def grid_files(scene):
    """The files of density that a scene names, by their keys for --set."""
    media = tomllib.loads(scene.file.read_text()).get("media", {})
    given = dict(change.split("=", 1) for change in scene.sets)
    paths = {f"media.{name}.path": medium["path"] for name, medium in media.items() if "path" in medium}
    return {key: pathlib.Path(given[key]) if key in given else scene.file.parent / path for key, path in paths.items()}


def find_scene(text, grids):
    """A scene of the list, or of a file of one's own. Grids that do not lie where a scene says are looked for in a
    folder. Throws InputError where it is neither."""
    if text in STANDARD:
        scene = Scene(text, SCENES / f"{text}.toml", *STANDARD[text])
    elif text.endswith(".toml") and pathlib.Path(text).is_file():
        scene = Scene(pathlib.Path(text).stem, pathlib.Path(text).resolve(), [], PATHS, AIM_OF_OTHERS)
    else:
        raise InputError(f"there is no scene '{text}': name one of {', '.join(STANDARD)}, or a scene file, NAME.toml")
    found = [f"{key}={grids / path.name}" for key, path in grid_files(scene).items()
             if not path.is_file() and (grids / path.name).is_file()]
    return scene._replace(sets=[*scene.sets, *found])


def missing_grid(scene):
    """Why a scene cannot be rendered; "" where it can."""
    for path in grid_files(scene).values():
        if not path.is_file():
            made = "tools/quickstart makes it" if path.parent.name == "media" else "it is published by others: --grids FOLDER says where it is"
            return f"{path.name} is missing; {made}"
    return ""


def render_command(program, scene, size, picture, seed, options, sets):
    command = [program, "render", scene.file, "-o", picture, "--seed", seed, *options]
    for change in [f"film.width={size}", f"film.height={size}", *sets]:
        command += ["--set", change]
    return command


def identity(scene, size):
    """What a reference depends on, the program aside."""
    files = [scene.file, *grid_files(scene).values()]
    return {"sha256": [hashlib.sha256(file.read_bytes()).hexdigest() for file in files], "size": size,
            "sets": scene.reference_sets, "seed": REFERENCE_SEED}


def make_reference(program, scene, size, aim, picture):
    """Renders until the picture states to be good enough, on all cores, on from what this same program left."""
    own = [change for change in scene.sets if change.startswith("media.")]  # where grids are
    checkpoint, maker = picture.with_suffix(".checkpoint"), picture.with_suffix(".maker")
    sha256 = hashlib.sha256(pathlib.Path(program).read_bytes()).hexdigest()
    kept = checkpoint.exists() and maker.exists() and maker.read_text() == sha256
    if not kept:
        checkpoint.unlink(missing_ok=True)
        maker.write_text(sha256)
    command = render_command(program, scene, size, picture, REFERENCE_SEED,
                             ["--error", aim, "--resume" if kept else "--checkpoint"], [*own, *scene.reference_sets])
    done = subprocess.run(list(map(str, command)), stdout=subprocess.DEVNULL)  # its progress is vpm's
    if done.returncode != 0:
        raise RuntimeError(f"{scene.name}: its reference was not finished; the next run goes on with it")


def reference_of(program, scene, size, aim, folder):
    """The reference of a scene: made once, kept, and made better where that is asked for. A picture in the folder that
    was not made here is taken as it is."""
    folder.mkdir(parents=True, exist_ok=True)
    name = scene.name if size == USUAL_SIZE else f"{scene.name}-{size}"
    picture, record = folder / f"{name}.exr", folder / f"{name}.made.json"
    checkpoint = picture.with_suffix(".checkpoint")
    wanted = {**identity(scene, size), "aim": aim or scene.aim}
    made = json.loads(record.read_text()) if record.exists() else None
    if made is not None and {**made, "aim": wanted["aim"]} != wanted:
        print(f"bench: the reference of {scene.name} is of another scene or grid, and is made anew", file=sys.stderr)
        made = None
        for file in (record, picture, checkpoint):
            file.unlink(missing_ok=True)
    begun = made is None and (checkpoint.exists() or not picture.exists())
    if begun or (made is not None and made["aim"] > wanted["aim"]):
        make_reference(program, scene, size, wanted["aim"], picture)
        record.write_text(json.dumps(wanted, indent=1) + "\n")
    report = picture.with_suffix(".json")
    stated = json.loads(report.read_text()).get("error") if report.exists() else None
    return Reference(picture, stated)
