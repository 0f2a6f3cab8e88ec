# SPDX-License-Identifier: MIT
"""The trackers for what a source has: which there are, and a new one as it suits the source."""

from collections.abc import Collection, Mapping
from typing import Any

from tricue.data.source import Source
from tricue.track.base.registry import create, names, traits
from tricue.track.base.track import Tracker


def fitting_trackers(source: Source) -> dict[str, str]:
    """The trackers that run on the source's channels, and what each follows."""
    return {name: traits(name).follows for name in names() if traits(name).best(source.channels) is not None}


def default_tracker(fitting: Collection[str]) -> str:
    """Which of the fitting trackers a page offers first; "" where there is none."""
    return "fused" if "fused" in fitting else next(iter(fitting), "")


def make_tracker(name: str, source: Source, cameras: Mapping[str, Any], seed: int) -> Tracker:
    """A tracker by its name, for all channels that it can use; ValueError where these don't do.

    cameras: the trackers' keywords intrinsics or rig, where they are known.
    """
    kind = traits(name)
    best = kind.best(source.channels)
    if best is None:
        raise ValueError(f"{name}: expected other channels than {', '.join(source.channels)}")
    known = {keyword: camera for keyword, camera in cameras.items() if keyword in kind.camera}
    return create(name, **best.params, **known, seed=seed)
