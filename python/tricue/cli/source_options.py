# SPDX-License-Identifier: MIT
"""The options of commands that open a recording: its channels, and the camera that took it."""

import argparse
from pathlib import Path
from typing import Any

from tricue.cli.arguments import angles
from tricue.data.open_source import Source, open_source

UNIT_HELP = "meters per unit of the board in OpenCV's --calibration"
OPENING = ("depth", "depth_scale", "fps", "right", "topics")


def add_source_options(command: argparse.ArgumentParser) -> Any:
    """Add them to a command's parser; return the group of mutually exclusive camera options."""
    command.add_argument(
        "--fps",
        type=float,
        metavar="N",
        help="frames/s of images without times (default 30, or 10 for KITTI tracking); videos, cameras, VOT, "
        "TUM and Princeton have their own",
    )
    command.add_argument(
        "--right", metavar="PLACE", help="the right camera's video, folder or number; INPUT is the left one's"
    )
    command.add_argument(
        "--rectify", action="store_true", help="rectify the stereo pairs first, by OpenCV's --calibration"
    )
    command.add_argument("--unit", type=float, metavar="M", help=UNIT_HELP)
    command.add_argument(
        "--depth", type=Path, metavar="PLACE", help="folder of 16-bit depth images beside a color INPUT"
    )
    command.add_argument(
        "--depth-scale", type=float, metavar="M", help="meters per unit of depth, 0.001 for millimeters"
    )
    camera = command.add_mutually_exclusive_group()
    camera.add_argument(
        "--calibration",
        type=Path,
        metavar="FILE",
        help="calibration of the camera or stereo pair: OpenCV's, ROS's, KITTI's, Princeton's or TOML",
    )
    camera.add_argument(
        "--fov", type=angles, metavar="H[,V]", help="angles of view instead of a calibration, in degrees"
    )
    return camera


def opening(options: argparse.Namespace) -> dict[str, Any]:
    """The keywords for ``open_source``."""
    return {name: getattr(options, name) for name in OPENING}


def open_input(options: argparse.Namespace) -> Source:
    """Open the source named by INPUT."""
    return open_source(options.input, **opening(options))
