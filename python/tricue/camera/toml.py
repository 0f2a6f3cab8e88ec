# SPDX-License-Identifier: MIT
"""TOML files: read by the standard library (tomli on Python 3.10); flat tables are written here."""

import importlib
import json
import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from tricue.camera.text import open_text

Value = bool | int | float | str | tuple[Any, ...]


def read(path: str | os.PathLike[str]) -> dict[str, Any]:
    """The file's keys and tables. ValueError if the file isn't TOML, OSError if it can't be read."""
    try:
        parser = importlib.import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")
    except ImportError:
        from tricue.doctor.install import install_extra

        raise ImportError(f"TOML on Python 3.10 needs an extra: {install_extra('toml')}") from None
    try:
        with open_text(Path(path), errors="strict") as file:
            return dict(parser.loads(file.read()))
    except RecursionError:
        raise ValueError(f"{path}: expected a TOML file, its values are nested too deeply") from None
    except ValueError as error:  # both bad TOML and a bad encoding
        raise ValueError(f"{path}: expected a TOML file, {error}") from None


def dumps(table: Mapping[str, Value], comments: Mapping[str, str] | None = None) -> str:
    """TOML text with one line per key, followed by the key's comment, if any."""
    comments = comments or {}
    notes = {key: f"  # {' '.join(text.split())}" for key, text in comments.items() if text.strip()}
    return "".join(f"{key} = {_literal(value)}{notes.get(key, '')}\n" for key, value in table.items())


def _literal(value: Value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):  # JSON escapes all that TOML requires to be escaped, except DEL
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    return f"[{', '.join(map(_literal, value))}]"
