"""Commands for programs of older versions: the scenes of today, with the keys that these programs know."""
import functools
import pathlib
import re
import subprocess
import tomllib


@functools.cache
def keys_of(program):
    """The old key of each key of today, as a program says; none where it is one of the older versions itself."""
    done = subprocess.run([program, "upgrade", "--keys"], capture_output=True, text=True)
    if done.returncode != 0:
        return {}
    pairs = [line.split(" ", 1) for line in done.stdout.splitlines()]
    return {new: old for old, new in pairs if old != "surface.method"}


def flat(table, path):
    """The values of a table by their whole keys, as --set takes them."""
    for key, value in table.items():
        if isinstance(value, dict):
            yield from flat(value, f"{path}.{key}")
        else:
            text = "+".join(value) if isinstance(value, list) else str(value).lower() if isinstance(value, bool) else value
            yield f"{path}.{key}", f"{text}"


def whole_path(folder, name):
    """The whole path of a file that a scene names; any other text as it is."""
    return (folder / name).resolve() if (folder / name).is_file() else name


def old_scene(file, folder):
    """A scene without the tables of its integrator, in a folder: where its files are is written out."""
    text = re.sub(r"(?ms)^\[integrator[^\n]*\n.*?(?=^\[|\Z)", "", file.read_text())
    text = re.sub(r'"([^"\n]+)"', lambda match: f'"{whole_path(file.parent, match[1])}"', text)
    written = pathlib.Path(folder, file.name)
    written.write_text(text)
    return written


def as_known(command, keys, folder):
    """A command that names a scene and options, as an older version takes it. What it needs is written to a folder."""
    words = [str(word) for word in command]
    file = next(pathlib.Path(word) for word in words if word.endswith(".toml"))
    sets = [change for flag, change in zip(words, words[1:]) if flag == "--set"]
    scene = flat(tomllib.loads(file.read_text()).get("integrator", {}), "integrator")
    settings = [f"{key}={value}" for key, value in scene]
    known = []
    for change in [*settings, *sets]:
        key, value = change.split("=", 1)
        value = "photon" if value == "photon-map" else value
        known += ["--set", f"{keys.get(key, key)}={value}"]
    rest = [word for before, word in zip(["", *words], words) if word != "--set" and before != "--set"]
    return [str(old_scene(file, folder)) if word == str(file) else word for word in rest] + known


def for_programs(commands, folders):
    """Commands of several programs: those of older versions get their keys, as one of the others says, and their scene
    in a folder of theirs."""
    found = [keys_of(str(command[0])) for command in commands]
    keys = next(filter(None, found), {})
    return [command if own or not keys else as_known(command, keys, folder)
            for command, own, folder in zip(commands, found, folders)]
