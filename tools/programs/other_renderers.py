"""Pictures that other renderers made of the scenes, with the seconds that they took: the rows beside vpm's."""
import collections
import csv
import io
import json
import math
import pathlib

from programs.suite import InputError

FIELDS = ("scene", "seconds", "file")

# A picture by another renderer. `where` is the line and file that lists it.
Row = collections.namedtuple("Row", "renderer scene seconds file where")


def read_list(file):
    """The dictionaries of a CSV or JSON file, each with where it stands."""
    try:
        text = file.read_text(encoding="utf-8-sig")  # as spreadsheets write it, too
    except UnicodeDecodeError as error:
        raise InputError(f"{file}: it is no text in UTF-8: {error}") from error
    if file.suffix == ".json":
        try:
            rows = json.loads(text)
        except ValueError as error:
            raise InputError(f"{file}: it is no JSON: {error}") from error
        if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
            raise InputError(f"{file}: it is to be a list of objects with {', '.join(FIELDS)}")
        return [(f"{file}, object {number}", row) for number, row in enumerate(rows, 1)]
    reader = csv.DictReader(io.StringIO(text, newline=""), skipinitialspace=True)
    return [(f"{file}, line {reader.line_num}", row) for row in reader]


def read_row(where, values, file):
    missing = [field for field in FIELDS if values.get(field) in (None, "")]
    if missing:
        raise InputError(f"{where}: there is no {' and no '.join(missing)}; the columns are {', '.join(FIELDS)}, and "
                         "renderer, where there are several")
    try:
        seconds = float(values["seconds"])
    except (TypeError, ValueError):
        seconds = math.nan
    if not 0 < seconds < math.inf:
        raise InputError(f"{where}: seconds are '{values['seconds']}', and must be a number above 0: CPU seconds of the "
                         "process, user and system, on one thread, loading included")
    picture = file.parent / str(values["file"])
    if not picture.is_file():
        raise InputError(f"{where}: there is no picture '{picture}'; names are relative to the folder of {file.name}")
    name = values.get("renderer") or (file.parent.name if file.stem == "renders" else file.stem)
    return Row(str(name), str(values["scene"]), seconds, picture, where)


def read_renderer(path, scenes):
    """The rows of a file, or of renders.csv or renders.json in a folder. Throws InputError where something is wrong."""
    file = path
    if path.is_dir():
        file = next((path / name for name in ("renders.csv", "renders.json") if (path / name).is_file()), None)
        if file is None:
            raise InputError(f"{path}: there is neither renders.csv nor renders.json in this folder")
    elif not path.is_file():
        raise InputError(f"{path}: there is no such file or folder")
    rows = [read_row(where, values, file) for where, values in read_list(file)]
    if not rows:
        raise InputError(f"{file}: it has no rows; each is to have {', '.join(FIELDS)}")
    for row in rows:
        if row.scene not in scenes:
            raise InputError(f"{row.where}: the scene '{row.scene}' is not rendered here; these are: {', '.join(scenes)}")
    return rows
