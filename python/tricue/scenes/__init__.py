# SPDX-License-Identifier: MIT
"""Scenes with exact truth, made from photographs of scikit-image (``pip install tricue[demo]``)."""

from tricue.scenes.clutter import face_over_clutter
from tricue.scenes.light import light_change
from tricue.scenes.photographs import BACKGROUNDS
from tricue.scenes.scene import Scene

__all__ = ["BACKGROUNDS", "Scene", "face_over_clutter", "light_change"]
