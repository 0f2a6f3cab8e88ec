# SPDX-License-Identifier: MIT
"""Parameters: one frozen dataclass per tracker, every default with its unit and its source.

@dataclass(frozen=True, slots=True, kw_only=True)
class MyParams(Params):
particles: int = parameter(100, unit="particles", source="section V", low=1)
"""

import dataclasses
import difflib
import functools
import math
import sys
import types
import typing
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from numbers import Integral, Real
from pathlib import Path
from typing import Any

from tricue.camera import toml
from tricue.camera.numbers import positive, to_float

if typing.TYPE_CHECKING:
    from typing_extensions import Self

OURS = "our experiment: benchmarks/README.md"
"""The source of a default that we found by experiment."""

_PACKAGE = __name__.partition(".")[0]
_BOUNDS = {"low": "at least", "above": "above", "high": "at most", "below": "below"}
_TYPE_NAMES = {int: "an integer", float: "a number", bool: "True or False", str: "a string"}


def parameter(
    default: Any,
    *,
    unit: str,
    source: str,
    doc: str = "",
    low: float | None = None,
    high: float | None = None,
    above: float | None = None,
    below: float | None = None,
    choices: tuple[Any, ...] | None = None,
    was: str = "",
) -> Any:
    """A field of :class:`Params`. Bounds: ``low``, ``high`` inclusive; ``above``, ``below`` exclusive.

    was: its name in the previous release, which still works, with a DeprecationWarning.
    For a tuple, bounds and choices hold for each element. None is allowed only if it is the default.
    """
    bounds = {"low": low, "above": above, "high": high, "below": below}
    words = {"unit": unit, "source": source, "doc": doc, "was": was}
    return field(default=default, metadata={**words, "choices": choices, **bounds})


class _AcceptsFormerNames(type):
    """Accepts parameters by the names that they had in the previous release."""

    def __call__(cls, *args: Any, **values: Any) -> Any:
        return super().__call__(*args, **current_names(cls, values))


@dataclass(frozen=True, slots=True)
class Params(metaclass=_AcceptsFormerNames):
    """Base class of every tracker's parameters: checks types and ranges, reads and writes TOML.

    TypeError for an unknown name or a wrong type, ValueError for a value out of range, NaN or infinity.
    An int is kept as a float where a float is expected.
    """

    def __new__(cls, *_: Any, **values: Any) -> "Self":
        known = [f.name for f in dataclasses.fields(cls)]
        for name in values.keys() - set(known):
            near = difflib.get_close_matches(name, known, n=3)
            hint = f"did you mean {' or '.join(near)}?" if near else f"expected one of {', '.join(known)}"
            raise TypeError(f"{name}: unknown parameter of {cls.__qualname__}; {hint}")
        return object.__new__(cls)  # not super(): slots=True makes another class of the same name

    def __getattr__(self, name: str) -> Any:
        for f in dataclasses.fields(self):
            if name and f.metadata.get("was") == name:
                _warn_renamed(name, f.name)
                return getattr(self, f.name)
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    def __post_init__(self) -> None:
        cls: Any = type(self)
        kinds = _field_types(cls)
        for f in dataclasses.fields(self):
            value = getattr(self, f.name)
            if value is not None or f.default is not None:
                object.__setattr__(self, f.name, _check_value(value, kinds[f.name], f))

    def _repr_html_(self) -> str:
        from tricue.notebook.parameters import params_html

        return params_html(self)

    def to_toml(self, path: str | Path) -> None:
        """Write each parameter on a line, with its unit and source as a comment; None is left out."""
        values = {name: value for name, value in dataclasses.asdict(self).items() if value is not None}
        comments = {
            f.name: f"{_metadata(f, 'unit')}; {_metadata(f, 'source')}" for f in dataclasses.fields(self)
        }
        Path(path).write_text(toml.dumps(values, comments), encoding="utf-8")

    @classmethod
    def from_toml(cls, path: str | Path) -> "Self":
        """Read parameters. Those missing from the file keep their defaults; unknown names are errors."""
        try:
            return cls(**toml.read(path))
        except (TypeError, ValueError) as error:
            raise type(error)(str(error) if str(path) in str(error) else f"{path}: {error}") from None

    @classmethod
    def describe(cls) -> str:
        """A table in plain text: name, default, unit, source, and what the parameter does."""
        titles = ("name", "default", "unit", "source", "meaning")
        rows = [titles, *(_describe_field(f) for f in dataclasses.fields(cls))]
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        lines = ("  ".join(map(str.ljust, row, widths)) for row in rows)
        return "\n".join(line.rstrip() for line in lines)


def current_names(cls: Any, values: Mapping[str, Any]) -> dict[str, Any]:
    """The values by the present names of their parameters; TypeError for a parameter given by both names."""
    renamed = {f.metadata["was"]: f.name for f in dataclasses.fields(cls) if f.metadata.get("was")}
    for old in values.keys() & renamed.keys():
        if renamed[old] in values:
            raise TypeError(f"{old}: expected once, got also {renamed[old]}, its new name")
        _warn_renamed(old, renamed[old])
    return {renamed.get(name, name): value for name, value in values.items()}


def _warn_renamed(old: str, new: str) -> None:
    message = f"{old}: deprecated, the parameter is {new} now"
    warnings.warn(message, DeprecationWarning, stacklevel=_caller_stacklevel())


def _caller_stacklevel() -> int:
    """The ``stacklevel`` with which a warning of the calling function points to the user's line.

    That is the first stack frame outside of this package.
    """
    level = 1
    frame = sys._getframe(1)
    while frame.f_back is not None and f"{frame.f_globals.get('__name__')}.".startswith(f"{_PACKAGE}."):
        frame = frame.f_back
        level += 1
    return level


def seconds_of_frames(value: Any, name: str, rate: float) -> Any:
    """Convert a duration in frames, as version 0.1.0 took it (a whole number), to seconds.

    Other values are returned unchanged. rate: frames/s; ValueError or TypeError names it if it's no positive
    number. Warns (DeprecationWarning): the next release takes whole numbers for seconds.
    """
    if not isinstance(value, int) or isinstance(value, bool) or value < 1:
        return value
    seconds = to_float(value) / positive(rate, "rate", "frames/s")
    message = (
        f"{name}: a number of frames is deprecated, give seconds: {seconds:.3g} instead of {value!r:.20}"
    )
    warnings.warn(message, DeprecationWarning, stacklevel=_caller_stacklevel())
    return seconds


def _describe_field(f: "dataclasses.Field[Any]") -> tuple[str, ...]:
    return (f.name, str(f.default), *(_metadata(f, key) for key in ("unit", "source", "doc")))


def _metadata(f: "dataclasses.Field[Any]", key: str) -> str:
    return str(f.metadata.get(key, ""))


@functools.cache
def _field_types(cls: Any) -> dict[str, Any]:
    """The type of each field, without its "or None"."""
    return {name: _without_none(hint) for name, hint in typing.get_type_hints(cls).items()}


def _without_none(hint: Any) -> Any:
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        return next(kind for kind in typing.get_args(hint) if kind is not type(None))
    return hint


def _check_value(value: Any, kind: Any, f: "dataclasses.Field[Any]") -> Any:
    if typing.get_origin(kind) is tuple:
        return _check_tuple(value, typing.get_args(kind), f)
    if typing.get_origin(kind) is typing.Literal:
        _check_choice(value, typing.get_args(kind), f.name)
        return value
    value = _convert(value, kind, f)
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueError(f"{f.name}: expected a finite number, got {value}")
    _check_choice(value, f.metadata.get("choices"), f.name)
    _check_bounds(value, f)
    return value


def _check_tuple(value: Any, kinds: tuple[Any, ...], f: "dataclasses.Field[Any]") -> tuple[Any, ...]:
    if not isinstance(value, (tuple, list)):
        raise TypeError(f"{f.name}: expected a tuple, got {value!r:.80}")
    if kinds[-1] is Ellipsis:
        kinds = kinds[:1] * len(value)
    if len(value) != len(kinds):
        raise ValueError(f"{f.name}: expected {len(kinds)} values, got {len(value)}: {value!r:.80}")
    return tuple(_check_value(element, kind, f) for element, kind in zip(value, kinds, strict=True))


def _convert(value: Any, kind: Any, f: "dataclasses.Field[Any]") -> Any:
    abstract = {int: Integral, float: Real}.get(kind, kind)
    if not isinstance(value, abstract) or (isinstance(value, bool) and kind is not bool):
        raise TypeError(f"{f.name}: expected {_TYPE_NAMES.get(kind, kind)}, got {value!r:.80}")
    return to_float(value) if kind is float else kind(value)


def _check_choice(value: Any, choices: tuple[Any, ...] | None, name: str) -> None:
    if choices is not None and value not in choices:
        raise ValueError(f"{name}: expected one of {', '.join(map(repr, choices))}, got {value!r:.80}")


def _check_bounds(value: Any, f: "dataclasses.Field[Any]") -> None:
    bounds = {key: f.metadata[key] for key in _BOUNDS if f.metadata.get(key) is not None}
    within = {
        "low": lambda bound: value >= bound,
        "above": lambda bound: value > bound,
        "high": lambda bound: value <= bound,
        "below": lambda bound: value < bound,
    }
    if not all(within[key](bound) for key, bound in bounds.items()):
        expected = " and ".join(f"{_BOUNDS[key]} {bound}" for key, bound in bounds.items())
        raise ValueError(f"{f.name}: expected {expected}, got {value!r:.80}")
