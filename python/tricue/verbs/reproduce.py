# SPDX-License-Identifier: MIT
"""The options of ``tricue reproduce``."""

import argparse
from pathlib import Path

from tricue.verbs.verb import Verb

EXAMPLES = """\
examples:
  tricue reproduce sabeti-fig1
  tricue reproduce sabeti-depth --jobs 2
  tricue reproduce moreno-fig3 --jobs 2
  tricue reproduce okada-fig8 --jobs 2
  tricue reproduce sabeti-fig2 --seeds 50 --jobs 2 --output results
"""


def add_options(verb: argparse.ArgumentParser) -> None:
    """Add the verb's options to its parser."""
    verb.add_argument(
        "experiment",
        metavar="EXPERIMENT",
        help="sabeti-fig1, sabeti-fig2, sabeti-depth, moreno-fig3, okada-fig8",
    )
    verb.add_argument(
        "--seeds", type=int, default=20, help="runs of each model on each scene, default %(default)s"
    )
    verb.add_argument("--jobs", type=int, default=1, help="processes, default %(default)s")
    verb.add_argument(
        "--output", type=Path, default=Path("results"), metavar="FOLDER", help="default %(default)s/"
    )


VERB = Verb(
    "reproduce",
    "redo an experiment of the papers",
    EXAMPLES,
    add_options,
    "tricue.commands.reproduce:reproduce",
)
