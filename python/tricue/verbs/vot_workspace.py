# SPDX-License-Identifier: MIT
"""The options of ``tricue vot-workspace``."""

import argparse
import sys
from pathlib import Path

from tricue.verbs.verb import Verb, words

EXAMPLES = """\
examples:
  tricue vot-workspace vot --trackers color-particle --sequences data/
  tricue vot-workspace vot --trackers color-particle,flow-depth --sequences rgbd/
  tricue vot-workspace vot --trackers depth-particle          another tracker, into the same workspace
"""


def add_options(verb: argparse.ArgumentParser) -> None:
    """Add the verb's options to its parser."""
    verb.add_argument("folder", type=Path, metavar="FOLDER", help="new, or a workspace to add to")
    verb.add_argument("--trackers", type=words, required=True, metavar="NAMES", help="with commas between")
    verb.add_argument(
        "--sequences",
        type=Path,
        metavar="DATA",
        help="folder of sequences with true boxes, of any known layout",
    )
    verb.add_argument(
        "--python",
        default=sys.executable,
        metavar="PATH",
        help="the interpreter with tricue[vot], default this one; the toolkit may be in another environment",
    )


VERB = Verb(
    "vot-workspace",
    "let the VOT toolkit run trackers",
    EXAMPLES,
    add_options,
    "tricue.commands.vot_workspace:vot_workspace",
)
