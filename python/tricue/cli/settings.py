# SPDX-License-Identifier: MIT
"""Trackers from user settings: parameters in a TOML file, overridden by text such as particles=300."""

import ast
import dataclasses
from collections.abc import Container, Iterable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from pathlib import Path
from typing import Any, Literal

from tricue.camera import toml
from tricue.track.base.params import Params, current_names
from tricue.track.base.registry import create, is_built_in, names, tracker_class
from tricue.track.base.track import Tracker

PAPER = "paper"
"""Instead of a TOML file: the parameters as the tracker's paper prints them."""
OPTIONS = {
    "seed": "--seed N",
    "kernels": "--kernels NAME",
    "intrinsics": "--calibration FILE",
    "rig": "--calibration FILE",
}
"""The options by which users set a tracker's arguments that aren't parameters."""
THIRD_PARTYS = ("seed", "kernels")
"""The options that third-party classes also have."""


def make_tracker(
    name: str,
    base: Path | Literal["paper"] | None,
    settings: Sequence[str],
    seed: int,
    kernels: str,
    **camera: Any,
) -> Tracker:
    """A tracker with the parameters of ``base``, overridden by settings "name=value".

    base: a TOML file, :data:`PAPER`, or None for the defaults.
    """
    return create(name, **read_settings(name, base, settings), seed=seed, kernels=kernels, **camera)


def read_settings(
    name: str,
    base: Path | Literal["paper"] | None,
    settings: Sequence[str],
    options: Mapping[str, str] = OPTIONS,
) -> dict[str, Any]:
    """The same parameters as keywords; ``base`` is checked, and the names in the settings.

    A third-party class checks its own parameters, except the seed and the kernels, which have options.
    options: the options of the command that set these, as in :data:`OPTIONS`.
    """
    kind = tracker_class(name).Params
    if base == PAPER:
        return _printed(name, kind) | _parse_for(name, kind, settings, options)
    if kind is None:
        values = {} if base is None else toml.read(base)
        _check_options(values, options, THIRD_PARTYS, str(base))
        return values | third_party_settings(settings, options)
    values = {} if base is None else _read_file(name, kind, base)
    return values | _parse_for(name, kind, settings, options)


def third_party_settings(settings: Sequence[str], options: Mapping[str, str] = OPTIONS) -> dict[str, Any]:
    """The settings as keywords, for a class whose parameters aren't known."""
    values = parse_settings(settings)
    _check_options(values, options, THIRD_PARTYS)
    return values


def papers() -> tuple[str, ...]:
    """The names of the trackers that have parameters as printed."""
    return tuple(name for name in names() if hasattr(tracker_class(name).Params, PAPER))


def parse_settings(settings: Sequence[str]) -> dict[str, Any]:
    """Keywords from strings name=value; values are numbers, true, false, tuples such as 16,20, or text."""
    pairs = [setting.partition("=") for setting in settings]
    for setting, (name, equals, _) in zip(settings, pairs, strict=True):
        if not (equals and name.isidentifier()):
            raise ValueError(f"--set: expected name=value, got {setting!r}")
    return {name: _literal(text.strip()) for name, _, text in pairs}


def _printed(name: str, kind: Any) -> dict[str, Any]:
    """The parameters as the tracker's paper prints them; ValueError for a tracker that follows no paper."""
    if not hasattr(kind, PAPER):
        raise ValueError(f"--paper: {name} follows no paper; those that do: {', '.join(papers())}")
    return dataclasses.asdict(kind.paper())


def _read_file(name: str, kind: Any, path: str | Path) -> dict[str, Any]:
    """The parameters in a TOML file; TypeError names the trackers for which it is, if they are others."""
    try:
        return dataclasses.asdict(kind.from_toml(path))
    except TypeError:
        given = toml.read(path).keys()
        others = _trackers_with(given)
        if given <= _accepted_names(kind) or not others:
            raise
        text = f"{path}: expected parameters of {name}, got those for --tracker {others}"
        raise TypeError(text) from None


def _parse_for(name: str, kind: Any, settings: Sequence[str], options: Mapping[str, str]) -> dict[str, Any]:
    """The parameters of a class from keywords; TypeError for a name that isn't among them."""
    values = current_names(kind, parse_settings(settings))
    unknown = values.keys() - _names(kind)
    _check_options(unknown, options, options)
    if unknown and (others := _trackers_with(unknown)):
        given = ", ".join(sorted(unknown))
        text = f"--set {given}: expected parameters of {name}, got those for --tracker {others}"
        raise TypeError(text)
    if issubclass(kind, Params):
        kind.__new__(kind, **values)  # this checks only the names
    return _split_words(values, kind)


def _trackers_with(parameters: AbstractSet[str]) -> str:
    """The names of tricue's trackers that have all of these parameters, as "a, b or c"; "" if none has."""
    own = filter(is_built_in, names())
    found = [each for each in own if parameters <= _accepted_names(tracker_class(each).Params)]
    return " or ".join(filter(None, (", ".join(found[:-1]), *found[-1:])))


def _check_options(
    given: Container[str], options: Mapping[str, str], names: Iterable[str], place: str = "--set"
) -> None:
    """Raise TypeError for a name in ``options``, which has its own option. place: where it was given."""
    for name in names:
        if name in given:
            mark = " " if place == "--set" else ": "
            raise TypeError(f"{place}{mark}{name}: expected a parameter, got what {options[name]} sets")


def _names(kind: Any) -> set[str]:
    """The names of a kind's parameters."""
    return {field.name for field in dataclasses.fields(kind)}


def _accepted_names(kind: Any) -> set[str]:
    """These names, and those that some had in the previous release."""
    return _names(kind) | {field.metadata.get("was", "") for field in dataclasses.fields(kind)}


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
    except (ValueError, SyntaxError, MemoryError, RecursionError):  # the last two: nested too deeply
        return text
