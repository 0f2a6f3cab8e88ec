# SPDX-License-Identifier: MIT
"""The trackers that fit a source: lists them, and creates them."""

from collections.abc import Collection, Mapping
from typing import Any

from tricue.data.source import Source
from tricue.track.base.registry import create, names, traits
from tricue.track.base.track import Tracker


def fitting_trackers(source: Source) -> dict[str, str]:
    """The trackers that run on the source's channels, with what each follows."""
    return {name: traits(name).follows for name in names() if traits(name).best(source.channels) is not None}


def default_tracker(fitting: Collection[str]) -> str:
    """The fitting tracker that a page offers first; "" if there is none."""
    return "fused" if "fused" in fitting else next(iter(fitting), "")


def make_tracker(name: str, source: Source, cameras: Mapping[str, Any], seed: int) -> Tracker:
    """A tracker by its name, for all channels that it can use; ValueError if these aren't enough.

    cameras: the trackers' keywords intrinsics or rig, if known.
    """
    kind = traits(name)
    best = kind.best(source.channels)
    if best is None:
        raise ValueError(f"{name}: expected other channels than {', '.join(source.channels)}")
    known = {keyword: camera for keyword, camera in cameras.items() if keyword in kind.camera}
    return create(name, **best.params, **known, seed=seed)
