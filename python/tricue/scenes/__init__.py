# SPDX-License-Identifier: MIT
"""Scenes with exact truth.

Those in color are made from photographs of scikit-image (``pip install tricue[demo]``); those in depth, of
people before a depth camera, and those in stereo, of a head or of walkers before a pair, need nothing but
NumPy and OpenCV.
"""

from tricue.scenes.faces.clutter import face_over_clutter
from tricue.scenes.faces.light_change import light_change
from tricue.scenes.heads.head import HEAD_KINDS, head
from tricue.scenes.overtakings.overtaking import OVERTAKING_KINDS, overtaking
from tricue.scenes.people.walkers import crossing, walker
from tricue.scenes.rendering.photographs import BACKGROUNDS
from tricue.scenes.scene import Bystander, DepthScene, Events, Scene, StereoScene, WalkScene

__all__ = [
    "BACKGROUNDS",
    "HEAD_KINDS",
    "OVERTAKING_KINDS",
    "Bystander",
    "DepthScene",
    "Events",
    "Scene",
    "StereoScene",
    "WalkScene",
    "crossing",
    "face_over_clutter",
    "head",
    "light_change",
    "overtaking",
    "walker",
]
