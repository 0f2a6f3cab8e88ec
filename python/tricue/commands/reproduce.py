# SPDX-License-Identifier: MIT
"""``tricue reproduce EXPERIMENT``: an experiment of the papers, again."""

from argparse import Namespace

from tricue.commands.progress import Progress


def reproduce(options: Namespace) -> int:
    """Run the verb and print the summary; the exit code."""
    from tricue.evaluation.papers.reproduce import run

    with Progress() as progress:

        def show(done: int, total: int) -> None:
            progress.total = total
            progress(done, "scenes")

        report = run(
            options.experiment, seeds=options.seeds, output=options.output, jobs=options.jobs, progress=show
        )
    print(report.summary)
    print(f"wrote {report.figure}\nwrote {report.table}")
    return 0
