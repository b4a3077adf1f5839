"""A scene as a dict becomes the text of a scene file, which the library reads: so its errors are the same."""
from __future__ import annotations

import json
import numbers
import os
import re
from typing import Any, Mapping, Sequence

import numpy as np

from ._vpm import InputError


def text_of_value(value: Any, where: str) -> str:
    """The value as TOML, on one line; `where` is what errors call it. Refuses what TOML has no type for."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Mapping):
        entries = (f"{text_of_key(key, where)} = {text_of_value(entry, f'{where}.{key}')}"
                   for key, entry in value.items())
        return "{ " + ", ".join(entries) + " }"
    if isinstance(value, (Sequence, np.ndarray)) and not isinstance(value, (bytes, bytearray)):
        return "[" + ", ".join(text_of_value(entry, f"{where}.{i}") for i, entry in enumerate(value)) + "]"
    raise InputError(f"{where} is {value!r}, of type {type(value).__name__}, which no scene holds\n"
                     "a scene holds dicts, lists, arrays, texts, paths, numbers, True and False")


def text_of_key(key: Any, where: str) -> str:
    """The key of a table."""
    if not isinstance(key, str):
        raise InputError(f"{where} has the key {key!r}, which is no text")
    return key if re.fullmatch("[A-Za-z0-9_-]+", key) else json.dumps(key, ensure_ascii=False)


def text_of_scene(scene: Mapping[str, Any]) -> str:
    """The whole scene: a line for each key, in the order of the dict."""
    lines: list[str] = []
    _add_table(scene, "", lines)
    return "\n".join(lines) + "\n"


def _is_list_of_tables(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(entry, Mapping) for entry in value)


def _add_table(table: Mapping[str, Any], path: str, lines: list[str]) -> None:
    """Plain values first, as TOML wants. Tables within the sections of a scene have headings of their own where they
    are parts with names, media and materials; what is deeper stands on a line."""
    inner = []
    for key, value in table.items():
        name = text_of_key(key, path or "the scene")
        full = f"{path}.{name}" if path else name
        of_parts = path == "" or path in ("media", "materials")
        if of_parts and isinstance(value, Mapping):
            inner.append((f"[{full}]", full, value))
        elif path == "" and _is_list_of_tables(value):
            inner.extend((f"[[{full}]]", f"{full}.{i}", entry) for i, entry in enumerate(value))
        else:
            lines.append(f"{name} = {text_of_value(value, full)}")
    for heading, full, value in inner:
        lines.extend(([""] if lines else []) + [heading])
        _add_table(value, full, lines)
