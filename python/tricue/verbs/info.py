# SPDX-License-Identifier: MIT
"""The options of ``tricue info``."""

import argparse
from pathlib import Path

from tricue.verbs.verb import Verb

EXAMPLES = """\
examples:
  tricue info sequences/David
  tricue info sequences/                                      a line for each sequence below
  tricue info depth/ --depth-scale 0.001 --fps 15
  tricue info left.mp4 --right right.mp4 --calibration stereo.yml
  tricue info kitti/ --target "Car 31" --json
"""


def add_options(verb: argparse.ArgumentParser) -> None:
    """Add the verb's options to its parser."""
    verb.add_argument("place", metavar="PLACE", help="video file, sequence folder, or folder of sequences")
    verb.add_argument("--depth-scale", type=float, metavar="M", help="metres per unit of depth")
    verb.add_argument("--fps", type=float, metavar="N", help="frames a second of images that tell no times")
    verb.add_argument("--right", metavar="PLACE", help="the right camera's; PLACE is the left one's")
    verb.add_argument("--target", metavar="NAME", help="one of a folder's several targets")
    verb.add_argument("--calibration", type=Path, metavar="FILE", help="instead of the one beside the images")
    verb.add_argument("--json", action="store_true", help="the same as one JSON object")


VERB = Verb(
    "info", "say what is in a video, a folder, a sequence", EXAMPLES, add_options, "tricue.commands.info:info"
)
