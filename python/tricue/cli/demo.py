# SPDX-License-Identifier: MIT
"""``tricue demo``: scenes with known truth, tracked; an error table, an overlay video and a plot."""

import argparse
import importlib
from pathlib import Path

from tricue.cli.arguments import add_common

DEMOS = {
    "color-particle": "tricue.cli.demos.color",
    "depth-particle": "tricue.cli.demos.depth",
    "flow-depth": "tricue.cli.demos.flow_depth",
    "fused": "tricue.cli.demos.fused",
    "stereo-head": "tricue.cli.demos.stereo",
}
EXAMPLES = """\
examples:
  tricue demo
  tricue demo depth-particle                                  people before a depth camera, in metres
  tricue demo stereo-head                                     a head before a stereo pair, in metres
  tricue demo flow-depth                                      a walker who is overtaken, before a panning pair
  tricue demo fused                                           a target in all troubles, before three cameras
  tricue demo color-particle --kernels reference --output here
"""


def add_options(command: argparse.ArgumentParser) -> None:
    """Add the command's options to its parser."""
    command.add_argument(
        "tracker", nargs="?", default="color-particle", choices=tuple(DEMOS), help="default %(default)s"
    )
    command.add_argument(
        "--output", type=Path, default=Path("demo"), metavar="FOLDER", help="default %(default)s/"
    )
    add_common(command)


def run(options: argparse.Namespace) -> int:
    """Run the demo of the chosen tracker; the exit code."""
    code: int = importlib.import_module(DEMOS[options.tracker]).run(options)
    return code
