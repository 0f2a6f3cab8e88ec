# SPDX-License-Identifier: MIT
"""Cameras in a notebook."""

import math

from tricue.camera.pose import Pose
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.evaluation.report.markup import Html
from tricue.notebook.markup import properties

DISTANCES = 1, 2, 4, 8
"""Distances in meters for which a rig's disparities are shown."""


def intrinsics_html(camera: Intrinsics) -> Html:
    """Image size, focal lengths, principal point, angles of view."""
    return properties("Intrinsics", _rows(camera))


def rig_html(rig: StereoRig) -> Html:
    """The same, the baseline, and the disparities at some distances."""
    found = ", ".join(f"{rig.intrinsics.fx * rig.baseline / z:.1f} px at {z} m" for z in DISTANCES)
    return properties(
        "StereoRig", [("baseline", f"{rig.baseline:g} m"), ("disparity", found), *_rows(rig.intrinsics)]
    )


def _rows(camera: Intrinsics) -> list[tuple[str, str | None]]:
    horizontal = _angle(camera.fx, camera.cx, camera.width)
    vertical = _angle(camera.fy, camera.cy, camera.height)
    return [
        ("image", f"{camera.width}x{camera.height} px"),
        ("focal lengths", f"fx {camera.fx:.1f}, fy {camera.fy:.1f} px"),
        ("principal point", f"cx {camera.cx:.1f}, cy {camera.cy:.1f} px"),
        ("angles of view", f"{horizontal:.1f}° by {vertical:.1f}°"),
        ("in the world", None if camera.pose is None else _place(camera.pose)),
    ]


def _angle(focal_length: float, center: float, size: int) -> float:
    """Degrees between the outer edges of the first and last pixels, whose centers are 0 and size - 1."""
    edges = (-0.5 - center) / focal_length, (size - 0.5 - center) / focal_length
    return math.degrees(math.atan(edges[1]) - math.atan(edges[0]))


def _place(pose: Pose) -> str:
    return "at " + ", ".join(f"{value:+.3f}" for value in pose.translation) + " m"
