# SPDX-License-Identifier: MIT
"""Rendered scenes with exact truth.

The face scenes, the stress scenes and the rooms use photographs of scikit-image (``pip install
tricue[demo]``). The others need only NumPy and OpenCV: people in front of a depth camera, a head in front of
a stereo pair, walkers in front of a panning stereo pair, and hands and a jumping person in front of one
camera.
"""

from tricue.former_names import attributes
from tricue.scenes.faces.clutter import face_over_clutter
from tricue.scenes.faces.light_change import light_change
from tricue.scenes.files import write_sequence
from tricue.scenes.heads.head import HEAD_KINDS, head, static_head
from tricue.scenes.indoors.gestures import hand, hidden_face, skin_picture
from tricue.scenes.indoors.jump import jump
from tricue.scenes.overtakings.overtaking import OVERTAKING_KINDS, overtaking
from tricue.scenes.pan_tilt.head import HeadLimits, SimulatedHead
from tricue.scenes.pan_tilt.scene import PanTiltScene, pan_tilt_scene
from tricue.scenes.people.lit_walker import LIGHT_COURSES, LitScene, lit_walker
from tricue.scenes.people.walkers import crossing, walker
from tricue.scenes.rendering.photographs import BACKGROUNDS
from tricue.scenes.rooms.scene import ROOM_CHANNELS, ROOM_KINDS, RoomScene, room_scene
from tricue.scenes.scene import Bystander, DepthScene, Events, Scene, StereoScene, WalkScene
from tricue.scenes.stress.scene import STRESS_CHANNELS, STRESS_KINDS, StressScene, stress_scene

__all__ = [
    "BACKGROUNDS",
    "HEAD_KINDS",
    "LIGHT_COURSES",
    "OVERTAKING_KINDS",
    "ROOM_CHANNELS",
    "ROOM_KINDS",
    "STRESS_CHANNELS",
    "STRESS_KINDS",
    "Bystander",
    "DepthScene",
    "Events",
    "HeadLimits",
    "LitScene",
    "PanTiltScene",
    "RoomScene",
    "Scene",
    "SimulatedHead",
    "StereoScene",
    "StressScene",
    "WalkScene",
    "crossing",
    "face_over_clutter",
    "hand",
    "head",
    "hidden_face",
    "jump",
    "light_change",
    "lit_walker",
    "overtaking",
    "pan_tilt_scene",
    "room_scene",
    "skin_picture",
    "static_head",
    "stress_scene",
    "walker",
    "write_sequence",
]

__getattr__ = attributes(__name__, {"KINDS": "HEAD_KINDS", "OVERTAKINGS": "OVERTAKING_KINDS"})
