# SPDX-License-Identifier: MIT
"""The options of ``tricue demo``."""

import argparse
from pathlib import Path

from tricue.track.create import names
from tricue.verbs.verb import Verb, add_common

EXAMPLES = """\
examples:
  tricue demo
  tricue demo depth-particle                                  people before a depth camera, in metres
  tricue demo stereo-head                                     a head before a stereo pair, in metres
  tricue demo flow-depth                                      a walker who is overtaken, before a panning pair
  tricue demo fused                                           a target in all troubles, before three cameras
  tricue demo color-particle --kernels reference --output here
"""


def add_options(verb: argparse.ArgumentParser) -> None:
    """Add the verb's options to its parser."""
    verb.add_argument("tracker", nargs="?", default=names()[0], choices=names(), help="default %(default)s")
    verb.add_argument(
        "--output", type=Path, default=Path("demo"), metavar="FOLDER", help="default %(default)s/"
    )
    add_common(verb)


VERB = Verb("demo", "track a scene with known truth", EXAMPLES, add_options, "tricue.commands.demo:demo")
