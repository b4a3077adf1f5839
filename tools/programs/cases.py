"""The pictures that tools/compare_programs compares: what is rendered, and how. The scenes' contents have a file of
their own."""
import collections
import itertools
import pathlib
import re
import subprocess
import tomllib

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"

# A picture to be made: `arguments` follow the name of the program. `may_refuse` is true of combinations, of which some
# are not allowed. Of any other case a refusal by both programs would mean that it compares nothing.
Case = collections.namedtuple("Case", "group name arguments may_refuse")

# What vpm makes for the scenes: the keys that name it, and the files.
MADE = {"smoke": {"media.smoke.path": "smoke.vdb"}, "cloud": {"media.cloud.path": "cloud.vdb"},
        "plume_room": {"media.smoke.path": "smoke.vdb"},
        "plume_lake": {"media.smoke.path": "smoke.vdb", "shapes.water.path": "waves.ply"},
        "ring_caustic": {"shapes.ring.path": "ring.ply"}, "pool": {"shapes.water.path": "waves.ply"},
        "street_lamp": {"shapes.pole.path": "pole.ply"}, "fire": {"media.fire.path": "fire.vdb"},
        "fire_glass": {"media.fire.path": "fire.vdb"}}

# Radii so wide that maps of a thousand photons have some within them.
WIDE = {"fog_room": ".volume.radius=0.3 .surface.radius=0.3",
        "glass_caustic": ".volume.radius=0.3 .surface.radius=0.2",
        "smoke": ".volume.radius=0.08 .surface.radius=0.2"}
GATHER = ".indirect.type=final-gather .caustics.radius=0.2"


def make_files(program, folder):
    """Lets a program make small grids, meshes and a picture for the scenes to name, in a folder. Throws RuntimeError
    where it fails."""
    def make(*arguments):
        done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{program} {' '.join(arguments)}: {done.stderr.strip()}")
    for name in ("smoke", "cloud", "fire"):
        make("media", name, "--resolution", "32", "-o", f"{name}.vdb")
    make("mesh", "ring", "--resolution", "64", "-o", "ring.ply")
    make("mesh", "pole", "--resolution", "16", "-o", "pole.ply")
    make("mesh", "waves", "--resolution", "32", "-o", "waves.ply")
    # A sky, and as its radiance is below 1 in spite of noise, a texture too.
    make("render", str(SCENES / "fog_ball.toml"), "-o", "sky.exr", "--passes", "1", "--progress", "never",
         "--set", "film.width=16", "--set", "film.height=8", "--set", "integrator.type=path",
         "--set", "lights.sky.radiance=[0.1,0.15,0.2]")
    (folder / "square.obj").write_text("v -0.4 0.8 0\nv 0.4 0.8 0\nv 0.4 1.4 0.1\nv -0.4 1.4 0.1\n"
                                       "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n")


def scene_names():
    return [file.stem for file in sorted(SCENES.glob("*.toml"))]


def is_complete(scene):
    """Whether there are all files that a scene names, or vpm makes them."""
    tables = tomllib.loads((SCENES / f"{scene}.toml").read_text())
    parts = [*tables.get("media", {}).values(), *tables.get("shapes", [])]
    return scene in MADE or all((SCENES / part["path"]).exists() for part in parts if "path" in part)


def choices(key, *values):
    """The texts key=value."""
    return [f"{key}={value}" for value in values]


class Cases:
    """Collects cases, most of which are a scene and values for --set."""

    def __init__(self, folder):
        self.folder = folder  # of the files that were made
        self.all = []

    def add(self, group, scene, sets=(), *, options=(), passes=2, size=16, emitted=1500, bake="", may_refuse=False):
        """Adds a picture, or with `bake` the light map of that shape: values for --set, in one text where none has
        blanks, and other options. ".volume.radius=1" is short for "integrator.volume.radius=1"."""
        sets = sets.split() if isinstance(sets, str) else list(sets)
        sets = [f"integrator{change}" if change.startswith(".") else change for change in sets]
        has_own = any(change.startswith("integrator.photons.") or change == "integrator.type=path" for change in sets)
        changes = [] if has_own else [f"integrator.photons.emitted={emitted}"]
        changes += [f"{key}={self.folder / made}" for key, made in MADE.get(scene, {}).items()]
        file = str(SCENES / f"{scene}.toml")
        if bake:
            arguments = ["bake", file, "--mesh", bake, "--resolution", str(size)]
        else:
            arguments = ["render", file]
            changes += [f"film.width={size}", f"film.height={size}"]
        for change in [*changes, *sets]:
            arguments += ["--set", change]
        if passes > 0:
            arguments += ["--passes", str(passes)]
        name = " ".join([scene, *([f"--mesh {bake}"] if bake else []), *sets, *options])
        for folder in (self.folder, SCENES):
            name = name.replace(f"{folder}/", "")
        self.all.append(Case(group, name, [*arguments, *options], may_refuse))

    def combine(self, group, scene, base, *lists, **more):
        """Adds all combinations of one text of each list, beside a base."""
        for combination in itertools.product(*lists):
            self.add(group, scene, " ".join([base, *combination]), may_refuse=True, **more)


def add_scenes(cases):
    """Every scene whose files there are, by photons and by paths."""
    for scene in filter(is_complete, scene_names()):
        few = " .importance.importons=2000" if scene in ("keyhole_fog", "milk_glass") else ""
        cases.add("scenes", scene, f".type=photon-map{few}", size=32, emitted=5000)
        cases.add("scenes", scene, ".type=path", size=32)


def add_gathers(cases):
    """All ways to gather from maps of media, and all from those of surfaces."""
    radii = choices(".radii", "per-pass", "per-pixel", "constant")
    volume = [[".volume.type=radius", ".volume.type=nearest .volume.count=20", ".volume.type=beam",
               ".volume.type=beam .volume.count=10", ".volume.type=photon-beams",
               ".volume.type=photon-beams .volume.length=long .volume.flights=500",
               ".volume.type=photon-planes .volume.planes=50", ".volume.type=beams-points"],
              choices(".volume.form", "density-at-query", "density-at-photon"), choices(".volume.boundary", "none", "ends", "corrected"),
              choices(".single_scattering.type", "photons", "shadow-rays", "equiangular"), radii]
    direct = choices(".direct.type", "photons", "shadow-rays")
    gathered = [f"{light} {GATHER} .indirect.rays=2 {by} {irradiance}" for light, by, irradiance in itertools.product(
        direct, choices(".indirect.rays_by", "material", "photons"), choices(".indirect.irradiance", "estimate", "precomputed"))]
    surface = [[".surface.type=radius", ".surface.type=nearest .surface.count=20"],
               choices(".surface.boundary", "none", "corrected"), [*direct, *gathered], radii]
    for scene, wide in WIDE.items():
        cases.combine("volume", scene, wide, *volume, emitted=1000, size=12)
        cases.combine("surface", scene, wide, *surface, emitted=1000, size=12)


def add_importance(cases):
    """All ways to use importance."""
    ways = [choices(f".importance.{way}", "true", "false") for way in ("aim", "split", "scatter")]
    for scene, wide in {**WIDE, "keyhole_fog": ".volume.radius=1 .surface.radius=1", "cornell": ""}.items():
        cases.combine("importance", scene, f"{wide} .importance.importons=500", *ways, emitted=500)


def add_flights(cases):
    """All distance strategies and transmittance estimators."""
    strategies = ["regular", "homogeneous", "local-extinction", "local-extinction .distance.extinction_floor=0.5",
                  "mean-extinction", "ray-march", "ray-march .distance.step=0.3", "ray-march-adaptive",
                  "ray-march-adaptive .distance.step=0.5 .distance.optical_step=0.03", "delta", "delta-local",
                  "progressive-null", "progressive-null .distance.majorant=0.6", "weighted",
                  "weighted .distance.majorant=0.6", "decomposition", "auto"]
    estimators = ["regular", "ratio", "ratio-local", "residual-ratio", "unbiased-ray-march",
                  "unbiased-ray-march .transmittance.samples=3", "ray-march", "ray-march .transmittance.step=0.3",
                  "jackknife", "jackknife .transmittance.step=0.3"]
    for scene, wide in {**WIDE, "fog_ball": "", "cloud": ".volume.radius=60"}.items():
        shadow_rays = [f"{wide} {rays}" for rays in (
            ".single_scattering.type=shadow-rays", ".single_scattering.type=equiangular .single_scattering.samples=3",
            ".indirect.type=final-gather", ".volume.type=beam .single_scattering.type=shadow-rays")]
        cases.combine("distance", scene, "", [wide, ".type=path"], choices(".distance.type", *strategies))
        cases.combine("transmittance", scene, "", choices(".transmittance.type", *estimators), [*shadow_rays, ".type=path"])


def add_settings(cases):
    """Every key and word about how to render that no combination uses."""
    kernels = ("constant", "cone", "epanechnikov", "biweight", "triweight", "order-4")
    fog = [*choices(".volume.type=radius .volume.kernel", *kernels), *choices(".volume.type=beam .volume.kernel", *kernels),
           *choices(".surface.kernel", *kernels), "render.samples_per_pixel=3", "render.seed=77", "render.max_events=3",
           ".max_optical_step=0.05", ".photons.stored=800", ".photons.emitted=900 .photons.in_cube=2",
           ".photons.emitted=900 .photons.in_cube=1 .volume.type=radius", "film.filter=tent",
           "film.filter=gaussian film.filter_radius=2.5", "film.filter=box film.filter_radius=1",
           ".surface.type=nearest .surface.count=7", "render.passes=3", "camera.medium=fog", "camera.up=[1,1,0]"]
    for sets in fog:
        cases.add("settings", "fog_room", f"{WIDE['fog_room']} {sets}", passes=0 if "render.passes" in sets else 2)
    gathers = [*choices(".caustics.kernel", *kernels), ".indirect.rays=5", ".caustics.type=radius",
               ".caustics.type=nearest .caustics.count=9", ".caustics.emitted=700", ".caustics.radius=auto",
               ".surface.boundary=corrected .caustics.emitted=300"]
    for scene, sets in itertools.product(("cornell", "glass_caustic"), gathers):
        cases.add("settings", scene, f".indirect.type=final-gather .surface.radius=0.2 {sets}")
    for scene in ("fog_room", "smoke", "cornell"):
        for sets in (".volume.radius=auto", ".surface.radius=auto"):
            cases.add("settings", scene, sets)
        for options in (["--seed", "5"], ["--auto"]):
            cases.add("settings", scene, options=options)
        cases.add("settings", scene, "render.error=0.3", passes=0)
    for scene in ("smoke", "cloud"):
        for sets in (".volume.density_floor=0.3", ".volume.density_floor=0", ".max_optical_step=0.1"):
            cases.add("settings", scene, sets)


def add_light_maps(cases):
    """Light maps of quads, and of a mesh."""
    gather = ".indirect.type=final-gather"
    ways = [".direct.type=photons", ".surface.type=nearest", ".surface.boundary=corrected", gather,
            f"{gather} .indirect.rays_by=photons", f"{gather} .indirect.irradiance=precomputed",
            f"{gather} .caustics.emitted=500", ".importance.importons=0", ".importance.scatter=true",
            ".radii=constant", ".radii=per-pixel", "render.samples_per_pixel=3", ".type=path",
            ".single_scattering.type=equiangular", ".transmittance.type=ratio", ".distance.type=delta"]
    for scene in ("cornell", "keyhole_fog", "smoke"):
        cases.combine("light maps", scene, ".importance.importons=200 .surface.radius=0.3", ways, bake="floor")
    square = f'shapes.new={{name="square",type="mesh",path="{cases.folder / "square.obj"}",material="white"}}'
    cases.add("light maps", "cornell", [square, ".surface.radius=0.3"], bake="square")


def add_own(cases):
    """What one program must make alike on one thread and on two, and interrupted or not."""
    gather = ".indirect.type=final-gather .surface.radius=0.2"
    ways = [("fog_room", ".type=path"), ("smoke", ".type=path .distance.type=weighted"),
            ("fog_room", ".radii=per-pixel"), ("cornell", ".radii=per-pixel"),
            ("fog_room", ".radii=constant film.filter=gaussian"),
            ("smoke", ".distance.type=progressive-null .volume.type=beam .volume.count=20"),
            ("smoke", ".distance.type=decomposition"), ("smoke", ".photons.stored=9000"),
            ("smoke", ".single_scattering.type=shadow-rays .transmittance.type=ratio"),
            ("glass_caustic", f"{gather} .caustics.emitted=5000"), ("cornell", f"{gather} .indirect.rays_by=photons"),
            ("cornell", f"{gather} .indirect.irradiance=precomputed"),
            ("fog_room", ".importance.importons=5000 .importance.scatter=true"),
            ("fog_room", ".photons.emitted=10000 .photons.in_cube=3"), ("fog_room", ".single_scattering.type=equiangular"),
            ("fog_room", ".photons.emitted=10000 .photons.block=3000"), ("smoke", ".photons.block=4000"),
            ("fog_box", ".volume.boundary=corrected .surface.boundary=corrected")]
    guided = ("keyhole_fog", "milk_glass")
    scenes = [(scene, ".importance.importons=5000" if scene in guided else "") for scene in scene_names()]
    for scene, sets in [*scenes, *ways]:
        # Work is cut into tiles of 16 pixels and chunks of 4096 photons: there must be several of each.
        if is_complete(scene):
            cases.add("AFTER alone", scene, sets, passes=0, size=40, emitted=10000)


# What makes another picture each time, as it depends on how long renders take. `emitted` is "auto" in no other case.
TIMED = ("render.seconds", '"auto" of `emitted`')


def unused_words(cases):
    """Keys of the table of settings in scenes/README.md that no case sets, and words that no key of their table is
    given.

    A list of cases says nothing of what it leaves out, such as a setting that came later; so this is read from the
    page.
    """
    given = {change for case in cases for flag, change in zip(case.arguments, case.arguments[1:]) if flag == "--set"}
    given = {word for change in given for word in [change, change.partition("=")[0]]}
    page = (SCENES / "README.md").read_text()
    table = re.search(r"a test compares\. -->(.*)<!-- The end of the table\. -->", page, re.DOTALL)[1]
    sections, unused = [], []
    for cells in (re.split(r"(?<!\\)\|", line)[1:-1] for line in table.splitlines() if line.startswith("|")):
        if len(cells) != 6:
            continue
        sections = re.findall(r"`\[([\w.]+)\]`", cells[0]) or sections
        for section, key in itertools.product(sections, re.findall(r"`(\w+)`", cells[1])):
            if f"{section}.{key}" not in given:
                unused.append(f"{section}.{key}")
        for word in re.findall(r'`"([\w-]+)"`', cells[4]):
            if not any(change.startswith(tuple(f"{section}." for section in sections)) and change.endswith(f"={word}") for change in given):
                unused.append(f'"{word}" of {cells[1].strip()}')
    if not sections:
        raise ValueError("no row of the table of scenes/README.md was read")
    return [name for name in unused if name not in TIMED]
