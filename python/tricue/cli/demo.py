# SPDX-License-Identifier: MIT
"""``tricue demo``: tracks scenes with known truth; writes an error table, an overlay video and a plot."""

import argparse
import importlib
from pathlib import Path

from tricue.cli.arguments import add_common, tracker_name
from tricue.track.base.registry import traits

DEMOS = (
    (lambda traits: "mask" in traits.shows, "flow_depth"),
    (lambda traits: traits.best(("color", "right")) and traits.best(("depth",)), "fused"),
    (lambda traits: traits.best(("depth",)), "depth"),
    (lambda traits: traits.best(("color",)), "color"),
    (lambda traits: traits.best(("color", "right")), "stereo"),
)
"""The modules of tricue.cli.demos, each with a test of the tracker's traits; the first match runs."""
EXAMPLES = """\
examples:
  tricue demo
  tricue demo depth-particle                                  people in front of a depth camera, in meters
  tricue demo stereo-head                                     a head in front of two cameras, in meters
  tricue demo flow-depth                                      a walker among others in front of two cameras
  tricue demo fused                                           a hard scene, by color, depth and a stereo pair
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
    """Run the demo for the chosen tracker; return the exit code."""
    its = traits(options.tracker)
    name = next((name for suits, name in DEMOS if suits(its)), None)
    if name is None:
        raise ValueError(f"tracker: there is no scene for one that needs {its.needs}")
    code: int = importlib.import_module(f"tricue.cli.demos.{name}").run(options)
    return code
