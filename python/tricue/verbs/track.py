# SPDX-License-Identifier: MIT
"""The options of ``tricue track``."""

import argparse
from pathlib import Path

from tricue.track.create import names
from tricue.verbs.verb import Verb, add_common, angles, box

USUAL, IN_DEPTH = "fused", "depth-particle"  # trackers where none is chosen
EXAMPLES = """\
examples:
  tricue track video.mp4 --box 120,80,64,78 --output overlay.mp4 --csv track.csv
  tricue track 0 --detect face --output overlay.mp4           the first camera, until Ctrl-C
  tricue track sequences/David --json track.json              starts on the sequence's first true box
  tricue track images/ --box 10,20,30,40 --tracker color-particle --set particles=300 --seed 7
  tricue track images/ --box=-5,20,30,40                      a box that begins left of the image
  tricue track depth/ --depth-scale 0.001 --fps 15 --tracker depth-particle --fov 57,43 --plot path.png
  tricue track video.mp4 --depth depth/ --depth-scale 0.001 --tracker depth-particle --calibration camera.yml
  tricue track left.mp4 --right right.mp4 --calibration stereo.yml --tracker stereo-head --detect face
  tricue track kitti/ --tracker stereo-head --box 560,170,30,60 --set near=5 --set far=40
  tricue track pair/ --tracker flow-depth --box 60,30,25,74 --calibration stereo.yml --output overlay.mp4
  tricue track rgbd/ --tracker flow-depth --box 60,30,25,74   color and depth; a target among others
  tricue track video.mp4 --tracker flow-depth --set cues=flow --box 60,30,25,74   without any depth
"""


def add_options(verb: argparse.ArgumentParser) -> None:
    """Add the verb's options to its parser."""
    verb.add_argument(
        "input", metavar="INPUT", help="video file, folder of images, sequence folder, camera number"
    )
    verb.add_argument(
        "--tracker",
        choices=names(),
        help=f"default {USUAL}; {IN_DEPTH} where there is depth and nothing tells where to start",
    )
    start = verb.add_mutually_exclusive_group()
    start.add_argument("--box", type=box, metavar="X,Y,W,H", help="the box to start on, in pixels")
    start.add_argument(
        "--detect",
        choices=("face", "person"),
        help="start on the largest face, or on whom a depth tracker finds, as soon as there is one",
    )
    verb.add_argument(
        "--fps",
        type=float,
        metavar="N",
        help="frames a second of images that tell no times (default 30); videos, cameras, VOT, TUM and "
        "Princeton have their own",
    )
    _add_stereo(verb)
    _add_depth(verb)
    verb.add_argument("--output", type=Path, metavar="FILE", help="overlay video, .mp4 or .avi")
    verb.add_argument("--csv", type=Path, metavar="FILE", help="a line a frame")
    verb.add_argument(
        "--json", type=Path, metavar="FILE", help="the same, with the tracker and its parameters"
    )
    verb.add_argument("--plot", type=Path, metavar="FILE", help="the path in metres from above, .png")
    verb.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the tracker"
    )
    verb.add_argument("--params", type=Path, metavar="FILE", help="parameters of the tracker, TOML")
    add_common(verb)


def _add_stereo(verb: argparse.ArgumentParser) -> None:
    verb.add_argument(
        "--right", metavar="PLACE", help="the right camera's video, folder or number; INPUT is the left one's"
    )
    verb.add_argument(
        "--rectify", action="store_true", help="the pairs are raw: rectify them by OpenCV's --calibration"
    )
    verb.add_argument(
        "--unit", type=float, metavar="M", help="metres per unit of the board in OpenCV's --calibration"
    )


def _add_depth(verb: argparse.ArgumentParser) -> None:
    verb.add_argument(
        "--depth", type=Path, metavar="PLACE", help="folder of 16-bit depth images beside a color INPUT"
    )
    verb.add_argument(
        "--depth-scale", type=float, metavar="M", help="metres per unit of depth, 0.001 for millimetres"
    )
    camera = verb.add_mutually_exclusive_group()
    camera.add_argument(
        "--calibration",
        type=Path,
        metavar="FILE",
        help="the camera's or the pair's, by OpenCV, KITTI, Princeton or in TOML",
    )
    camera.add_argument(
        "--fov", type=angles, metavar="H[,V]", help="the camera's angles of view instead, in degrees"
    )


VERB = Verb(
    "track", "track in a video, a folder, a camera", EXAMPLES, add_options, "tricue.commands.track:track"
)
