# SPDX-License-Identifier: MIT
"""Trackers from user settings: parameters in a TOML file, overridden by text such as particles=300."""

import ast
import dataclasses
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from tricue.camera import toml
from tricue.track.base.params import current_names
from tricue.track.base.registry import create, tracker_class
from tricue.track.base.track import Tracker


def make_tracker(
    name: str, params_file: Path | None, settings: Sequence[str], seed: int, kernels: str, **camera: Any
) -> Tracker:
    """A tracker with the parameters of a TOML file, overridden by settings "name=value"."""
    return create(name, **read_settings(name, params_file, settings), seed=seed, kernels=kernels, **camera)


def read_settings(name: str, params_file: Path | None, settings: Sequence[str]) -> dict[str, Any]:
    """The same parameters as keywords. Those of the file are checked; the settings are not yet."""
    kind = tracker_class(name).Params
    if kind is None:  # a third-party class, which checks its own parameters
        return ({} if params_file is None else toml.read(params_file)) | parse_settings(settings)
    values: dict[str, Any] = {}
    if params_file is not None:
        values = dataclasses.asdict(kind.from_toml(params_file))
    return values | _split_words(current_names(kind, parse_settings(settings)), kind)


def parse_settings(settings: Sequence[str]) -> dict[str, Any]:
    """Keywords from strings name=value; values are numbers, true, false, tuples such as 16,20, or text."""
    pairs = [setting.partition("=") for setting in settings]
    for name, equals, _ in pairs:
        if not (equals and name.isidentifier()):
            raise ValueError(f"--set: expected name=value, got {name + equals!r}")
    return {name: _literal(text.strip()) for name, _, text in pairs}


def _split_words(values: Mapping[str, Any], kind: Any) -> dict[str, Any]:
    """The values, with text such as "flow,disparity" split into words for parameters that take a tuple."""
    tuples = {field.name for field in dataclasses.fields(kind) if isinstance(field.default, tuple)}
    return {
        name: tuple(word.strip() for word in value.split(",") if word.strip())
        if name in tuples and isinstance(value, str)
        else value
        for name, value in values.items()
    }


def _literal(text: str) -> Any:
    try:
        return ast.literal_eval(text.title() if text in ("true", "false") else text)
    except (ValueError, SyntaxError):
        return text
