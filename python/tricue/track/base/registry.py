# SPDX-License-Identifier: MIT
"""Trackers by their names."""

import importlib
from typing import Any

from tricue.track.base.track import Tracker

_TRACKERS = {
    "color-particle": "tricue.track.color_particle.tracker:ColorParticleTracker",
    "depth-particle": "tricue.track.depth_particle.tracker:DepthParticleTracker",
    "flow-depth": "tricue.track.flow_depth.tracker:FlowDepthTracker",
    "fused": "tricue.track.fused.tracker:FusedTracker",
    "stereo-head": "tricue.track.stereo_head.tracker:StereoHeadTracker",
}


def names() -> tuple[str, ...]:
    """The names that :func:`create` knows."""
    return tuple(_TRACKERS)


def tracker_class(name: str) -> Any:
    """The class behind a name; imported only now, so that the package opens quickly."""
    if name not in _TRACKERS:
        raise ValueError(f"name: expected one of {', '.join(map(repr, _TRACKERS))}, got {name!r}")
    module, attribute = _TRACKERS[name].split(":")
    return getattr(importlib.import_module(module), attribute)


def create(name: str, **params: Any) -> Tracker:
    """A tracker by its name, such as ``create("color-particle", seed=0, particles=300)``.

    The keywords are those of the tracker's class. ValueError for an unknown name lists the known ones.
    """
    tracker: Tracker = tracker_class(name)(**params)
    return tracker
