# SPDX-License-Identifier: MIT
"""Scenes with exact truth.

Those in color are made from photographs of scikit-image (``pip install tricue[demo]``); those in depth, of
people before a depth camera, need nothing but NumPy and OpenCV.
"""

from tricue.scenes.clutter import face_over_clutter
from tricue.scenes.light import light_change
from tricue.scenes.people import crossing, walker
from tricue.scenes.photographs import BACKGROUNDS
from tricue.scenes.scene import Bystander, DepthScene, Scene

__all__ = [
    "BACKGROUNDS",
    "Bystander",
    "DepthScene",
    "Scene",
    "crossing",
    "face_over_clutter",
    "light_change",
    "walker",
]
