# SPDX-License-Identifier: MIT
"""The curves of all experiments: one model in one scene, with a value per frame."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from tricue.arrays import Flags, Floats
from tricue.track.base.track import Status

MIN_OVERLAP = 0.5
"""Above this intersection over union the box is on the target."""
MIN_VISIBLE = 0.5
"""Visible share of the target from which on a frame counts."""
HIDDEN_BELOW = 0.15
"""Visible share of the target below which it counts as hidden."""


@dataclass(frozen=True, slots=True, eq=False)
class Curve:
    """One model in one scene, M frames."""

    model: str
    scene: str
    seed: int
    overlaps: Floats
    """(M,) intersection over union with the true box of the whole target."""


@dataclass(frozen=True, slots=True, eq=False)
class VisibilityCurve(Curve):
    """The curve of a target that others may hide."""

    visible: Floats
    """(M,) visible share of the target."""

    @property
    def counted(self) -> Flags:
        """The frames (M,) in which at least half of the target is visible."""
        return np.asarray(self.visible >= MIN_VISIBLE)


@dataclass(frozen=True, slots=True, eq=False)
class OcclusionCurve(VisibilityCurve):
    """The curve of such a target, with the tracker's statuses."""

    statuses: tuple[Status, ...]

    @property
    def tracked(self) -> Flags:
        """The frames (M,) with status TRACKED."""
        return np.array([status is Status.TRACKED for status in self.statuses], np.bool_)

    @property
    def correct(self) -> Flags:
        """The frames (M,) with status TRACKED and the box on the target."""
        return self.tracked & (self.overlaps > MIN_OVERLAP)


AnyCurve = TypeVar("AnyCurve", bound=Curve)


def models_of(curves: Sequence[Curve]) -> list[str]:
    """The models' names, in the order in which they first occur."""
    return list(dict.fromkeys(curve.model for curve in curves))


def scenes_of(curves: Sequence[Curve]) -> list[str]:
    """The scenes' names, in the order in which they first occur."""
    return list(dict.fromkeys(curve.scene for curve in curves))


def runs_of(curves: Sequence[AnyCurve], scene: str, model: str) -> list[AnyCurve]:
    """The curves of one model in one scene, one per seed."""
    return [curve for curve in curves if (curve.scene, curve.model) == (scene, model)]


def first_runs(curves: Sequence[AnyCurve], scene: str) -> dict[str, AnyCurve]:
    """The curves of seed 0 in a scene, by model."""
    return {curve.model: curve for curve in curves if (curve.scene, curve.seed) == (scene, 0)}


def stacked(curves: Sequence[Curve], model: str, values: str) -> Floats:
    """The values (R, M) of an attribute, by its name, in one model's R runs."""
    return np.stack([getattr(curve, values) for curve in curves if curve.model == model])
