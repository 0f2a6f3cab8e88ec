# SPDX-License-Identifier: MIT
"""Trackers by name: ours, those that installed packages offer, and any class as ``module:Class``."""

import importlib
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from tricue.track.base.adapter import adapted
from tricue.track.base.track import Tracker
from tricue.track.base.traits import Traits

GROUP = "tricue.trackers"
"""The group of entry points by which packages offer trackers; ours come that way, too, installed or not."""

_OURS = {
    "color-particle": "tricue.track.color_particle.tracker:ColorParticleTracker",
    "depth-particle": "tricue.track.depth_particle.tracker:DepthParticleTracker",
    "flow-depth": "tricue.track.flow_depth.tracker:FlowDepthTracker",
    "fused": "tricue.track.fused.tracker:FusedTracker",
    "stereo-head": "tricue.track.stereo_head.tracker:StereoHeadTracker",
}


def names() -> tuple[str, ...]:
    """The names that :func:`create` knows; ``module:Class`` works beside them."""
    return *_OURS, *sorted(_offered().keys() - _OURS.keys())


def known(name: str) -> bool:
    """Whether it is one of :func:`names`, or has the form ``module:Class``."""
    return name in names() or ":" in name


def tracker_class(name: str) -> Any:
    """The class behind a name; imported only now, so that the package opens quickly.

    A class of somebody else's that has only ``init(frame, box)`` and ``update(frame)`` comes back wrapped,
    see :func:`tricue.track.base.adapter.adapted`. ValueError where there is none of that name.
    """
    where = _OURS.get(name) or (_offered()[name].value if name in _offered() else name)
    if not isinstance(where, str) or ":" not in where:
        raise ValueError(
            f"name: expected one of {', '.join(map(repr, names()))} or module:Class, got {name!r}"
        )
    return adapted(_imported(where))


def traits(name: str) -> Traits:
    """What the tracker of that name needs, takes and can do."""
    found: Traits = tracker_class(name).traits
    return found


def create(name: str, **params: Any) -> Tracker:
    """A tracker by its name, such as ``create("color-particle", seed=0, particles=300)``.

    name: one of :func:`names`, or ``module:Class``. The keywords are those of the tracker's class.
    ValueError for an unknown name lists the known ones.
    """
    tracker: Tracker = tracker_class(name)(**params)
    return tracker


@cache
def _offered() -> dict[str, EntryPoint]:
    return {each.name: each for each in entry_points(group=GROUP)}


def _imported(where: str) -> Any:
    """What "module:attribute" names; ValueError where it isn't there, or isn't a class."""
    module, _, attribute = where.partition(":")
    try:
        found = importlib.import_module(module)
        for part in attribute.split("."):
            found = getattr(found, part)
    except ModuleNotFoundError as error:
        if error.name is None or not f"{module}.".startswith(f"{error.name}."):
            raise  # an import inside of it
        raise ValueError(f"{where}: there is no module {error.name}") from None
    except AttributeError:
        raise ValueError(f"{where}: the module {module} has no {attribute}") from None
    if not isinstance(found, type):
        raise ValueError(f"{where}: expected a class with init and update, got {type(found).__name__}")
    return found
