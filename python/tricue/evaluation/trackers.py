# SPDX-License-Identifier: MIT
"""The evaluated trackers, by the names that users give: tricue's, baselines and others'."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from tricue.evaluation import baselines
from tricue.evaluation.foreign.spec import (
    DEFAULT_TIME_LIMIT,
    foreign_spec,
    is_foreign,
    split_name,
    split_prefix,
)
from tricue.evaluation.tracker_spec import TrackerSpec
from tricue.track.base import registry


def tracker_specs(
    chosen: Sequence[str] | None,
    settings: Mapping[str, Mapping[str, Any]],
    time_limit: float = DEFAULT_TIME_LIMIT,
) -> list[TrackerSpec]:
    """The specs of the given names, by default of all installed trackers. settings: parameters by tracker
    name. time_limit: seconds for an update of a tracker that isn't ours.

    A baseline that the installed cv2 lacks can be chosen, but runs nowhere. ValueError lists the known names
    for an unknown one, and the chosen ones for parameters of a tracker that isn't chosen. ValueError,
    TypeError or OSError say what is wrong with a tracker or its parameters.
    """
    known = [*registry.names(), *baselines.available()]
    words = known if chosen is None else chosen
    names = [split_name(word)[0] if is_foreign(word) else split_ours(word)[0] for word in words]
    plain = [word for word in words if not is_foreign(word) and word not in baselines.NAMES]
    for word in plain:
        if word not in known and not split_ours(word)[1]:
            places = "module:Class, file.py:Class, cv2:Name, trax:command"
            raise ValueError(f"trackers: expected some of {', '.join(known)}, {places}, got {word!r}")
    for name in settings:
        if name not in names:
            running = ", ".join(names) or "none"
            raise ValueError(
                f"settings: expected a parameter of a tracker that runs ({running}), got one of {name!r}"
            )
    for word, name in zip(words, names, strict=True):
        if name in (*baselines.NAMES, *registry.names()) and word != name:
            raise ValueError(f"trackers: expected another name than {name!r}, which is taken, in {word!r}")
    found = [
        foreign_spec(word, settings.get(name, {}), time_limit)
        if is_foreign(word)
        else TrackerSpec(name, tuple(settings.get(name, {}).items()), kind=split_ours(word)[1])
        for word, name in zip(words, names, strict=True)
    ]
    for each in found:
        _check(each)
    if found and all(each.name in _missing() for each in found):
        raise ValueError(f"trackers: {baselines.missing_reason(found[0].name)}")
    return found


def split_ours(word: str) -> tuple[str, str]:
    """NAME and the tracker of NAME=tracker, if that is one of tricue's; else the word and ""."""
    name, kind = split_prefix(word)
    return (name, kind) if name and registry.is_built_in(kind) else (word, "")


def require_unique(names: Iterable[str]) -> None:
    """ValueError if two trackers have the same name, or one has a name that can't be a folder's."""
    for name, count in Counter(names).items():
        if count > 1:
            raise ValueError(f"trackers: expected different names, got {name!r} twice; NAME=... gives one")
        if name in (".", "..") or "/" in name or "\\" in name:
            raise ValueError(f"trackers: expected a name without slashes, got {name!r}")


def missing_note(chosen: Sequence[str] | None) -> str:
    """A note on the baselines that the installed cv2 lacks, if all were requested; "" if it has all."""
    missing = _missing() if chosen is None else []
    if not missing:
        return ""
    return f"not run: {', '.join(missing)}: {baselines.missing_reason(*missing)}"


def _missing() -> list[str]:
    there = baselines.available()
    return [name for name in baselines.NAMES if name not in there]


def _check(spec: TrackerSpec) -> None:
    """TypeError or ValueError for wrong parameters, before the first run."""
    if spec.ours:
        registry.tracker_class(spec.kind or spec.name).Params(**dict(spec.settings))
    elif spec.settings and spec.name in baselines.NAMES:
        raise ValueError(f"settings: expected a parameter of one of our trackers, got one of {spec.name}")
