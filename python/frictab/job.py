"""Job files: keys as nested dictionaries become TOML, with the place of every key."""
from __future__ import annotations

import json
import math
import os
import re
from typing import Any, Mapping, Optional

import numpy as np

from .faults import FrictabError

_BARE = re.compile(r"[A-Za-z0-9_-]+")
_INLINE = {"columns", "drop", "inputs"} # one line for each entry, so that a fault names it


class JobFile:
    """The text of a job, and the key that each of its lines holds."""

    def __init__(self, keys: Mapping[str, Any], heading: str) -> None:
        self._lines = [f"# {line}" for line in heading.splitlines()]
        self._keys: dict[int, str] = {}
        self._section(without_none(keys), "")
        self.text = "\n".join(self._lines) + "\n"

    def key_at(self, line: int) -> Optional[str]:
        """The key of a line of the text, from 1, as data.columns.psi; None where there is none."""
        return self._keys.get(line)

    def _section(self, keys: Mapping[str, Any], path: str) -> None:
        tables = {k: v for k, v in keys.items() if isinstance(v, Mapping)
                  and path.rpartition(".")[2] not in _INLINE}
        if path and (len(tables) < len(keys) or not keys):
            self._add(f"[{path}]", path)
        for key, value in keys.items():
            if key not in tables:
                self._add(f"{_key(key)} = {_value(value)}", _join(path, key))
        for key, value in tables.items():
            self._section(value, _join(path, key))

    def _add(self, line: str, key: str) -> None:
        self._lines.append(line)
        self._keys[len(self._lines)] = key


def merged(first: Mapping[str, Any], second: Mapping[str, Any]) -> dict[str, Any]:
    """Both, section by section; of a key that both have, the second's. A dotted name,
    "table.tolerance_MPa", stands for sections."""
    result = dict(first)
    for name, value in second.items():
        name, _, rest = str(name).partition(".")
        if rest:
            value = {rest: value}
        here = result.get(name)
        if isinstance(value, Mapping):
            value = merged(here if isinstance(here, Mapping) else {}, value)
        result[name] = value
    return result


def without_none(keys: Mapping[str, Any]) -> dict[str, Any]:
    """Without the keys that are None: these are left to the program."""
    return {k: without_none(v) if isinstance(v, Mapping) else v
            for k, v in keys.items() if v is not None}


def _join(path: str, key: str) -> str:
    return f"{path}.{_key(key)}" if path else _key(key)


def _key(name: str) -> str:
    return name if _BARE.fullmatch(name) else _text(name)


def _text(text: str) -> str: # TOML's escapes are JSON's, and it allows no DEL
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _value(value: Any) -> str:
    if isinstance(value, (np.generic, np.ndarray)):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, os.PathLike)):
        return _text(os.fspath(value))
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else str(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(str(k))} = {_value(v)}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple, set, frozenset)):
        items = sorted(value) if isinstance(value, (set, frozenset)) else value
        return "[" + ", ".join(map(_value, items)) + "]"
    raise FrictabError(f"a value of a job is a text, a number, true or false, a list or a "
                       f"dictionary of these; {value!r} is a {type(value).__name__}")
