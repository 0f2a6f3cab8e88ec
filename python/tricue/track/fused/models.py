# SPDX-License-Identifier: MIT
"""The models of the target's appearance, one set per kind of picture."""

from typing import NamedTuple

from tricue.track.fused.experts.color import ColorExpert
from tricue.track.fused.experts.correlation_filter import CorrelationFilterExpert
from tricue.track.fused.experts.size import SizeExpert
from tricue.track.fused.experts.turn import TurnExpert
from tricue.track.fused.identity import FirstColors
from tricue.track.fused.picture_observation import PictureKind


class AppearanceModels(NamedTuple):
    """The target's appearance in one kind of picture."""

    filter: CorrelationFilterExpert
    color: ColorExpert
    size: SizeExpert
    turn: TurnExpert
    first_colors: FirstColors


ModelsByKind = dict[PictureKind, AppearanceModels]
