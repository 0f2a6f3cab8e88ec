# SPDX-License-Identifier: MIT
"""The options of ``tricue track``, and examples of them."""

import argparse
from pathlib import Path

from tricue.cli.arguments import (
    add_common,
    add_topics,
    angles,
    count,
    frame_number,
    output_file,
    seconds,
    start_box,
    tracker_name,
)
from tricue.cli.settings import PAPER
from tricue.cli.source_options import add_source_options
from tricue.cli.starts import DEFAULT_TRACKER, depth_tracker
from tricue.draw.trail import DEFAULT_SECONDS
from tricue.track.base.registry import names

EXAMPLES = """\
examples:
  tricue track video.mp4 --box 120,80,64,78 --output overlay.mp4 --csv track.csv
  tricue track video.mp4 --box 120,80,64,78 --output overlay.mp4 --trail   with the path of the last seconds
  tricue track 0 --detect face --output overlay.mp4           the first camera, until Ctrl-C
  tricue track sequences/David --json track.json              starts on the sequence's first true box
  tricue track images/ --box 10,20,30,40 --tracker color-particle --set particles=300 --seed 7
  tricue track images/ --box=-5,20,30,40                      a box that extends left of the image
  tricue track depth/ --depth-scale 0.001 --fps 15 --tracker depth-particle --fov 57,43 --plot path.png
  tricue track video.mp4 --depth depth/ --depth-scale 0.001 --tracker depth-particle --calibration camera.yml
  tricue track left.mp4 --right right.mp4 --calibration stereo.yml --tracker stereo-head --detect face
  tricue track walk.bag --topics color=/rgb/image_raw,depth=/depth/image_raw --box 60,30,25,74
  tricue track rtsp://camera/stream --box 60,30,25,74         live: always the newest frame
  tricue track kitti/ --tracker stereo-head --box 560,170,30,60 --set near=5 --set far=40
  tricue track pair/ --tracker flow-depth --box 60,30,25,74 --calibration stereo.yml --output overlay.mp4
  tricue track rgbd/ --tracker flow-depth --box 60,30,25,74   color and depth; a target among others
  tricue track video.mp4 --tracker flow-depth --set cues=flow --box 60,30,25,74   without any depth
  tricue track video.mp4 --box 60,30,25,74 --box 120,32,24,70 --workers 2 --mot tracks.txt   two targets
"""


def add_options(command: argparse.ArgumentParser) -> None:
    """Add the command's options to its parser."""
    command.add_argument(
        "input", metavar="INPUT", help="video, folder of images, sequence, recording, URL, camera number"
    )
    command.add_argument(
        "--target", metavar="NAME", help="the labeled target to start on, if a folder has several"
    )
    command.add_argument(
        "--tracker",
        type=tracker_name,
        metavar="NAME",
        help=f"{', '.join(names())}, module:Class or file.py:Class; default {DEFAULT_TRACKER}, "
        f"or {depth_tracker()} for depth without a box to start on",
    )
    start = command.add_mutually_exclusive_group()
    start.add_argument(
        "--box",
        type=start_box,
        action="append",
        metavar="[FRAME:]X,Y,W,H",
        help="the box to start on, in pixels, and its frame if that isn't the first; once for each target",
    )
    start.add_argument(
        "--select", action="store_true", help="draw the boxes to start on in the browser (extra app)"
    )
    start.add_argument(
        "--detect",
        choices=("face", "person"),
        help="start on the first face (in stereo and depth: head), or on the first person that a depth "
        "tracker detects",
    )
    command.add_argument(
        "--start", type=frame_number, default=0, metavar="N", help="the first frame, from 0; default 0"
    )
    command.add_argument(
        "--end", type=frame_number, metavar="N", help="the last frame; default the last of all"
    )
    add_topics(command)
    add_source_options(command).add_argument(
        "--assume-fov",
        type=angles,
        metavar="H[,V]",
        help="angles of view to assume; positions are then marked as assumed",
    )
    command.add_argument(
        "--output", type=output_file, metavar="FILE", help="overlay video, .mp4, .mkv, .webm or .avi"
    )
    command.add_argument(
        "--trail",
        type=seconds,
        nargs="?",
        const=DEFAULT_SECONDS,
        metavar="SECONDS",
        help="draw the path of the last seconds, by default %(const)g, into --output",
    )
    command.add_argument("--csv", type=output_file, metavar="FILE", help="a line per frame")
    command.add_argument(
        "--json",
        type=output_file,
        metavar="FILE",
        help="the same, with the tracker and its parameters; -: one object per line, on standard output",
    )
    command.add_argument(
        "--mot", type=output_file, metavar="FILE", help="the tracks in MOTChallenge's text format"
    )
    command.add_argument(
        "--coco", type=output_file, metavar="FILE", help="the tracks in COCO's JSON format for video"
    )
    command.add_argument(
        "--plot", type=output_file, metavar="FILE", help="the path seen from above, in meters, .png"
    )
    command.add_argument(
        "--workers",
        type=count,
        default=1,
        metavar="N",
        help="processes that share the targets of several boxes, default %(default)s",
    )
    command.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the tracker"
    )
    base = command.add_mutually_exclusive_group()
    base.add_argument("--params", type=Path, metavar="FILE", help="parameters of the tracker, TOML")
    base.add_argument(
        "--paper",
        action="store_const",
        const=PAPER,
        help="the tracker as its paper prints it, without our additions",
    )
    add_common(command)
