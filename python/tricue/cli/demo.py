# SPDX-License-Identifier: MIT
"""``tricue demo``: scenes with known truth, tracked; an error table, an overlay video and a plot."""

import argparse
import importlib
from pathlib import Path

from tricue.cli.arguments import add_common, tracker_name
from tricue.track.base.registry import traits

DEMOS = {
    "fused": "tricue.cli.demos.fused",
    "flow-depth": "tricue.cli.demos.flow_depth",
}
"""Demos made for one tracker; any other has that of the channels that it needs."""
BY_CHANNELS = {
    frozenset({"color"}): "tricue.cli.demos.color",
    frozenset({"depth"}): "tricue.cli.demos.depth",
    frozenset({"color", "right"}): "tricue.cli.demos.stereo",
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
        "tracker", nargs="?", default="color-particle", type=tracker_name, help="default %(default)s"
    )
    command.add_argument(
        "--output", type=Path, default=Path("demo"), metavar="FOLDER", help="default %(default)s/"
    )
    add_common(command)


def run(options: argparse.Namespace) -> int:
    """Run the demo of the chosen tracker; the exit code."""
    sets = traits(options.tracker).channels
    module = DEMOS.get(options.tracker) or next(
        (BY_CHANNELS[each.names] for each in sets if each.names in BY_CHANNELS), None
    )
    if module is None:
        raise ValueError(f"tracker: there is no scene for one that needs {traits(options.tracker).needs}")
    code: int = importlib.import_module(module).run(options)
    return code
