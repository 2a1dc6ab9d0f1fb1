"""A dictionary as the text of a machine file."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

from ._errors import Fault, OptionError


def _refused(path: str, why: str) -> OptionError:
    return OptionError(f"{path}: {why}", (Fault(why, path, None, "give texts, numbers, truths, lists and dictionaries"),))


def _value(path: str, value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        # A TOML text may hold the same characters as one of JSON, which escapes them in the same way.
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, int):
        return str(value)
    if hasattr(value, "__float__") and not isinstance(value, (Mapping, Sequence)):
        number = float(value)
        if not math.isfinite(number):
            raise _refused(path, f"a number must be finite: {number}")
        return repr(number)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(path, key)} = {_value(f'{path}.{key}', item)}" for key, item in value.items()) + " }"
    if isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray)):
        return "[" + ", ".join(_value(path, item) for item in value) + "]"
    raise _refused(path, f"a {type(value).__name__} is no value of a machine file")


def _key(path: str, key: Any) -> str:
    if not isinstance(key, str):
        raise _refused(path or "data", f"a key must be a text: {key!r}")
    return key if key and all(c.isalnum() and c.isascii() or c in "-_" for c in key) else json.dumps(key, ensure_ascii=False)


def _is_tables(value: Any) -> bool:
    if not isinstance(value, Sequence) or isinstance(value, (str, bytes)):
        return False
    return len(value) > 0 and all(isinstance(item, Mapping) for item in value)


def _table(path: str, table: Mapping[str, Any], lines: list[str]) -> None:
    def below(key: str) -> str:
        name = _key(path, key)
        return f"{path}.{name}" if path else name

    plain = {key: value for key, value in table.items() if not isinstance(value, Mapping) and not _is_tables(value)}
    lines.extend(f"{_key(path, key)} = {_value(below(key), value)}" for key, value in plain.items())
    for key, value in table.items():
        if key in plain:
            continue
        for item in [value] if isinstance(value, Mapping) else value:
            lines.append(f"\n[{below(key)}]" if isinstance(value, Mapping) else f"\n[[{below(key)}]]")
            _table(below(key), item, lines)


def written(data: Mapping[str, Any]) -> str:
    """The text of a machine file with these tables and keys."""
    lines: list[str] = []
    _table("", data, lines)
    return "\n".join(lines) + "\n"
