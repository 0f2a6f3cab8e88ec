# SPDX-License-Identifier: MIT
"""``tricue reproduce EXPERIMENT``: repeats an experiment of the papers."""

import argparse
from pathlib import Path

from tricue.cli.arguments import count
from tricue.cli.option_names import naming_options
from tricue.cli.progress import Progress

EXAMPLES = """\
examples:
  tricue reproduce sabeti-fig1
  tricue reproduce sabeti-depth --jobs 2
  tricue reproduce moreno-fig2 --jobs 2
  tricue reproduce moreno-fig3 --jobs 2
  tricue reproduce okada-fig8 --jobs 2
  tricue reproduce sabeti-roc --data my-images --rate 0.05
  tricue reproduce sabeti-fig2 --seeds 50 --jobs 2 --output results
"""
NAMES = [
    "sabeti-fig1",
    "sabeti-fig2",
    "sabeti-fig3",
    "sabeti-fig4",
    "sabeti-roc",
    "sabeti-depth",
    "sabeti-dark",
    "moreno-fig2",
    "moreno-fig3",
    "okada-fig8",
    "okada-vergence",
    "okada-follow",
]


def add_options(command: argparse.ArgumentParser) -> None:
    """Add the command's options to its parser."""
    command.add_argument("experiment", metavar="EXPERIMENT", help=", ".join(NAMES))
    command.add_argument(
        "--seeds",
        type=count,
        default=20,
        help="runs of each model on each scene; sabeti-roc: images, if no --data; default %(default)s",
    )
    command.add_argument(
        "--jobs", type=count, default=1, help="processes, default %(default)s; sabeti-roc has one"
    )
    command.add_argument(
        "--output", type=Path, default=Path("results"), metavar="FOLDER", help="default %(default)s/"
    )
    command.add_argument(
        "--data",
        type=Path,
        metavar="FOLDER",
        help="sabeti-roc: FOLDER/image/NAME.* and FOLDER/mask/NAME.*, white where skin is",
    )
    command.add_argument(
        "--rate", type=float, help="sabeti-roc: false-positive rate of the threshold, default 0.1"
    )


def run(options: argparse.Namespace) -> int:
    """Run the command and print the summary; return the exit code."""
    from tricue.papers.reproduce import run

    with Progress() as progress, naming_options(experiment="EXPERIMENT", data="--data", rate="--rate"):

        def show(done: int, total: int) -> None:
            progress.total = total
            progress(done, "images" if options.experiment == "sabeti-roc" else "scenes")

        report = run(
            options.experiment,
            seeds=options.seeds,
            output=options.output,
            jobs=options.jobs,
            progress=show,
            data=options.data,
            rate=options.rate,
        )
    print(report.summary)
    print(f"wrote {report.figure}\nwrote {report.table}")
    return 0
