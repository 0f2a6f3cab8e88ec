# SPDX-License-Identifier: MIT
"""Track one person or object by color, depth and motion, on a CPU, with its position in meters."""

import importlib
from typing import TYPE_CHECKING, Any

from tricue import start
from tricue.doctor.called import is_called as doctor_is_called

if start.is_command():
    start.exit_at_interrupts()

if not doctor_is_called():  # it has to run, and say what is wrong, even if none of this can be imported
    try:
        importlib.import_module("tricue._core")
    except ImportError as error:
        raise ImportError(
            f"tricue: the native kernels can't be loaded ({error}); build them: pip install .; "
            "python -m tricue doctor tells more"
        ) from error

    from tricue import former_names
    from tricue.camera.box import Box
    from tricue.camera.frame import Frame
    from tricue.camera.pose import Pose
    from tricue.camera.rig import Intrinsics, StereoRig
    from tricue.track.base.opencv import as_opencv
    from tricue.track.base.registry import create, tracker_class
    from tricue.track.base.track import Status, Track
    from tricue.track.multi.tracker import MultiTracker
    from tricue.track.pan_tilt import PanTilt

    former_names.install()

if TYPE_CHECKING:
    from tricue.data.open_source import open_source
    from tricue.track.color_particle.tracker import ColorParticleTracker
    from tricue.track.depth_particle.tracker import DepthParticleTracker
    from tricue.track.flow_depth.tracker import FlowDepthTracker
    from tricue.track.fused.tracker import FusedTracker
    from tricue.track.stereo_head.tracker import StereoHeadTracker

    __version__: str

__all__ = [
    "Box",
    "ColorParticleTracker",
    "DepthParticleTracker",
    "FlowDepthTracker",
    "Frame",
    "FusedTracker",
    "Intrinsics",
    "MultiTracker",
    "PanTilt",
    "Pose",
    "Status",
    "StereoHeadTracker",
    "StereoRig",
    "Track",
    "__version__",
    "as_opencv",
    "create",
    "open_source",
]


_TRACKERS = {
    "ColorParticleTracker": "color-particle",
    "DepthParticleTracker": "depth-particle",
    "FlowDepthTracker": "flow-depth",
    "FusedTracker": "fused",
    "StereoHeadTracker": "stereo-head",
}


def __getattr__(name: str) -> Any:
    """Names that are looked up at their first use, so that the import stays quick."""
    if name in _TRACKERS:
        return tracker_class(_TRACKERS[name])
    if name == "open_source":
        from tricue.data.open_source import open_source

        return open_source
    if name == "__version__":
        from importlib.metadata import version

        globals()[name] = version("tricue")  # kept, as looking it up reads files
        return globals()[name]
    raise AttributeError(f"module 'tricue' has no attribute {name!r}")


def __dir__() -> list[str]:
    return list(__all__)
