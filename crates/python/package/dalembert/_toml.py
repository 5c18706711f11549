"""A dictionary as the text of a robot file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any


def text(robot: Mapping[str, Any]) -> str:
    """Write a robot file: tables as tables, everything else on a line of its own."""
    return "\n".join(_table(robot, "")) + "\n"


def _table(table: Mapping[str, Any], path: str) -> list[str]:
    lines, below = [], []
    for key, value in table.items():
        if not isinstance(key, str):
            raise TypeError(f"{path or 'the dictionary'}: expected names as keys, found {key!r}")
        place = f"{path}.{_key(key)}" if path else _key(key)
        if isinstance(value, Mapping):
            below += [f"[{place}]", *_table(value, place)]
        elif _is_tables(value):
            for each in value:
                below += [f"[[{place}]]", *_table(each, place)]
        else:
            lines.append(f"{_key(key)} = {_value(value, place)}")
    return lines + below


def _is_tables(value: Any) -> bool:
    is_list = isinstance(value, Sequence) and not isinstance(value, str)
    return is_list and len(value) > 0 and all(isinstance(each, Mapping) for each in value)


def _key(key: str) -> str:
    import json

    plain = key and all(c.isascii() and (c.isalnum() or c in "_-") for c in key)
    return key if plain else json.dumps(key, ensure_ascii=False)


def _value(value: Any, place: str) -> str:
    import json

    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if hasattr(value, "tolist"):
        # NumPy's own numbers are Python's as well, but are not written like them.
        return _value(value.tolist(), place)
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, Sequence):
        return "[" + ", ".join(_value(each, place) for each in value) + "]"
    raise TypeError(f"{place}: expected a number, a text, a list or a table, found {value!r}")
