# SPDX-License-Identifier: MIT
"""The options of ``tricue evaluate``."""

import argparse
from pathlib import Path

from tricue.verbs.verb import Verb, count, words

EXAMPLES = """\
examples:
  tricue evaluate sequences/                                  everything; see evaluation/report.html
  tricue evaluate sequences/ --jobs 2                         the same command goes on after Ctrl-C
  tricue evaluate sequences/ --trackers color-particle,CSRT,KCF --seeds 5 --output color
  tricue evaluate sequences/ --trackers color-particle --set color-particle.particles=300
  tricue evaluate recordings/ --depth-scale 0.001 --fps 15    16-bit depth in millimetres, no times
  tricue evaluate /data/all --scheduler tcp://host:8786       a Dask cluster, which sees that folder
"""


def add_options(verb: argparse.ArgumentParser) -> None:
    """Add the verb's options to its parser."""
    verb.add_argument(
        "dataset", type=Path, metavar="DATASET", help="a sequence with true boxes, or a folder of them"
    )
    verb.add_argument(
        "--trackers", type=words, metavar="NAMES", help="ours and cv2's, with commas between; all without it"
    )
    verb.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="TRACKER.NAME=VALUE",
        help="a parameter of one of our trackers",
    )
    verb.add_argument(
        "--seeds",
        type=count,
        default=3,
        metavar="N",
        help="runs of those that draw random numbers, default %(default)s",
    )
    verb.add_argument(
        "--no-restarts", action="store_true", help="leave out the runs that start again after a failure"
    )
    where = verb.add_mutually_exclusive_group()
    where.add_argument("--jobs", type=count, default=1, metavar="N", help="processes, default %(default)s")
    where.add_argument("--scheduler", metavar="ADDRESS", help="of a Dask cluster, tcp://HOST:PORT")
    verb.add_argument(
        "--ahead",
        type=count,
        default=0,
        metavar="N",
        help="frames to read ahead, for slow disks; takes part of another core",
    )
    verb.add_argument("--fresh", action="store_true", help="run again what was run before")
    verb.add_argument(
        "--output", type=Path, default=Path("evaluation"), metavar="FOLDER", help="default %(default)s/"
    )
    verb.add_argument(
        "--depth-scale",
        type=float,
        metavar="M",
        help="metres per unit of depth, where the format doesn't say",
    )
    verb.add_argument("--fps", type=float, metavar="N", help="frames a second of images that tell no times")
    verb.add_argument(
        "--unit", type=float, metavar="M", help="metres per unit of the board in OpenCV's calibrations"
    )
    verb.add_argument(
        "--truth",
        choices=("color", "depth"),
        help="the channel whose pixels the true boxes count, if both are there",
    )


VERB = Verb(
    "evaluate",
    "trackers beside OpenCV's over a data set",
    EXAMPLES,
    add_options,
    "tricue.commands.evaluate:run",
)
