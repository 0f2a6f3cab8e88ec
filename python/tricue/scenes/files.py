# SPDX-License-Identifier: MIT
"""Writes a stress scene or a room as a folder that ``tricue evaluate`` and ``tricue track`` read."""

from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera import toml
from tricue.camera.box import Box
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.data.box_table import BOX_TABLE
from tricue.data.open_source import CALIBRATION_FILE
from tricue.data.vot import SEQUENCE_FILE
from tricue.scenes.rooms.scene import RoomScene
from tricue.scenes.stress.events import STRESS_FRAME_RATE
from tricue.scenes.stress.scene import StressScene

TABLE_HEADER = "frame,x,y,width,height,X_m,Y_m,Z_m"
MIN_WRITTEN_SIDE = 1.0  # pixels; smaller boxes aren't written


def write_sequence(scene: StressScene | RoomScene, folder: str | Path) -> None:
    """Write a scene's images without loss, its true boxes and positions, and its camera's calibration.

    A stereo pair goes to left/ and right/. Other scenes become a sequence in VOT's layout with color/, depth/
    in millimeters, or both; their boxes are clipped to the image. The camera goes to intrinsics.toml, that of
    a stereo pair with its baseline. The truth goes to boxes.csv, with empty cells, which readers take as
    absent, if no part of the target is visible. Timestamps aren't written, only the frame rate, and for a
    stereo pair not even that.
    FileExistsError if the folder isn't empty, TypeError for another kind of scene.
    """
    if not isinstance(scene, (StressScene, RoomScene)):
        raise TypeError(f"scene: expected a StressScene or a RoomScene, got {type(scene).__name__}")
    folder = Path(folder)
    if folder.exists() and any(folder.iterdir()):
        raise FileExistsError(f"{folder}: expected a new or an empty folder")
    pair = scene.rig is not None
    folders = {"color": "left" if pair else "color", "right": "right", "depth": "depth"}
    channels = scene.frames[0].channels
    for channel in channels:
        (folder / folders[channel]).mkdir(parents=True)
    for number, frame in enumerate(scene.frames, 1):
        for channel in channels:
            _write(folder / folders[channel] / f"{number:08d}.png", getattr(frame, channel))
    (folder / BOX_TABLE).write_text(_table(scene, clipped=not pair))
    (folder / CALIBRATION_FILE).write_text(_toml(scene.intrinsics, scene.rig))
    if not pair:
        lines = [f"channels.{channel}={channel}/%08d.png" for channel in channels]
        (folder / SEQUENCE_FILE).write_text(
            "\n".join([*lines, f"fps={_rate(scene):g}", f"name={scene.name}"]) + "\n"
        )


def _write(path: Path, image: NDArray[np.uint8] | NDArray[np.float32]) -> None:
    """Write color as it is, and depth (float32 meters) as 16-bit millimeters, 0 where unmeasured."""
    if image.dtype == np.float32:
        image = np.rint(np.nan_to_num(image) * 1000).astype(np.uint16)
    if not cv2.imwrite(str(path), image):
        raise OSError(f"{path}: can't be written")


def _rate(scene: StressScene | RoomScene) -> float:
    """Frames per second."""
    return scene.rate if isinstance(scene, RoomScene) else STRESS_FRAME_RATE


def _table(scene: StressScene | RoomScene, clipped: bool) -> str:
    size = scene.intrinsics.width, scene.intrinsics.height
    lines = [TABLE_HEADER]
    for index, row in enumerate(scene.boxes):
        box = Box(*row.tolist())
        written = box.clip(*size) if clipped else box
        # A sliver at the image's edge, which no tracker could follow, gets no box either.
        seen = scene.visible[index] > 0 and min(written.width, written.height) >= MIN_WRITTEN_SIDE
        cells = [f"{value:.4f}" for value in written] if seen else [""] * 4
        place = scene.positions[index]
        cells += [""] * 3 if np.isnan(place).any() else [f"{value:.6f}" for value in place]
        lines.append(",".join([str(index), *cells]))
    return "\n".join(lines) + "\n"


def _toml(camera: Intrinsics, rig: StereoRig | None) -> str:
    names = ("fx", "fy", "cx", "cy", "width", "height")
    values = {name: getattr(camera, name) for name in names}
    return toml.dumps(values if rig is None else {**values, "baseline": rig.baseline})
