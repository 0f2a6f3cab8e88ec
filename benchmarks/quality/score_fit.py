# SPDX-License-Identifier: MIT
"""The line from the fused tracker's log-odds to its score: a fit on its own tracks, and how well it works.

    python -m benchmarks.quality.score_fit --jobs 2

The printed line is fitted on all sequences, in the form of tricue/track/fused/identity.py: a logistic
regression of "the overlap is above 0.3" on the log-odds, in which each frame of all runs counts the same
(Platt 1999). The table is for the scores in use, and for scores by lines that were fitted without the
recording that they are tested on; for all runs, and for those of each protocol.

The tracks depend on the log-odds alone, so they stay the same if the thresholds move with the line.
"""

import sys
from collections.abc import Mapping, Sequence
from dataclasses import fields, replace

import numpy as np
from tricue.track.fused.identity import log_odds_of

from benchmarks.quality.common import logistic_regression
from benchmarks.quality.common.arguments import add_dataset, add_output, bare_parser
from benchmarks.quality.common.confidence_summary import ON_TARGET_OVERLAP, summarize
from benchmarks.quality.common.folds import leave_one_out
from benchmarks.quality.common.frame_results import Array, Flags, FrameResults
from benchmarks.quality.common.protocols import PROTOCOLS, belongs
from benchmarks.quality.common.sequence_runs import SequenceResult, find_tasks, run_sequences
from benchmarks.quality.common.tables import Cell, markdown, write_csv
from benchmarks.quality.common.variants import parse_variants

HEAD = ("scores", "runs", "deviation", "calibration error", "AUROC")


def log_odds(scores: Array) -> Array:
    """(N, 1) the log-odds that give these scores, (N,) in [0, 1]."""
    return np.array([log_odds_of(float(score)) for score in scores])[:, None]


def fit(features: Array, on_target: Array) -> Array:
    """(2,) the line's slope and offset; features: (N, 1) log-odds, on_target: (N,) 1 or 0."""
    return logistic_regression.fit(features, on_target > 0, np.ones(len(features)))


def judge(features: Array, on_target: Array, sequences: Sequence[str]) -> Array:
    """(N,) scores by a line that was fitted without their recording. ValueError for a single recording."""
    scores: Array = np.zeros(len(features))
    for fold in leave_one_out(sequences):
        found = fit(features[fold.fit], on_target[fold.fit])
        scores[fold.judge] = logistic_regression.predict(features[fold.judge], found)
    return scores


def rows(name: str, frames: FrameResults, protocols: Mapping[str, Flags]) -> list[list[Cell]]:
    """Rows of the table: for all frames, and for those of each protocol that has any."""
    parts = {
        "all": frames,
        **{each: select(frames, flags) for each, flags in protocols.items() if flags.any()},
    }
    found = {runs: summarize(part) for runs, part in parts.items()}
    return [[name, runs, each.deviation, each.calibration_error, each.auroc] for runs, each in found.items()]


def known(frames: FrameResults) -> FrameResults:
    """The frames with known truth, or known to be without the target, but the first of each run."""
    return select(frames, ~np.isnan(frames.seconds) & (frames.absent | ~np.isnan(frames.overlaps)))


def select(frames: FrameResults, chosen: Flags) -> FrameResults:
    """Some of the frames; chosen: (N,)."""
    return FrameResults(*(getattr(frames, field.name)[chosen] for field in fields(frames)))


def by_protocol(results: Sequence[SequenceResult], runs: Sequence[FrameResults]) -> dict[str, Flags]:
    """Which frames of all runs belong to each protocol; runs: those of the results, in their order."""
    orders = [order for each in results for order in each.runs]
    counts = [len(run.scores) for run in runs]
    return {name: np.repeat([belongs(order, name) for order in orders], counts) for name in PROTOCOLS}


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the line and the table; the exit code."""
    made = bare_parser("score_fit", __doc__)
    add_dataset(made)
    made.add_argument("--only", nargs="+", default=[], metavar="NAME", help="of these sequences")
    add_output(made)
    options = made.parse_args(arguments)
    try:
        todo = find_tasks(parse_variants(["fused"], []), options.dataset, options.only)
        results = run_sequences(todo, options.jobs)
        runs = [known(run) for each in results for run in each.runs.values()]
        sequences = [each.sequence for each in results for _ in each.runs]
        names = np.repeat(sequences, [len(run.scores) for run in runs]).tolist()
        frames = FrameResults.pooled(runs)
        features = log_odds(frames.scores)
        on_target = ((frames.overlaps > ON_TARGET_OVERLAP) & ~frames.absent).astype(float)
        left_out = replace(frames, scores=judge(features, on_target, names))
    except (OSError, ValueError) as error:
        made.error(str(error))
    slope, offset = fit(features, on_target).round(2).tolist()
    protocols = by_protocol(results, runs)
    table = [*rows("in use", frames, protocols), *rows("left out", left_out, protocols)]
    print(f"SCORE_SLOPE, SCORE_OFFSET = {slope}, {offset}, of these log-odds\n\n{markdown(HEAD, table)}")
    write_csv(options.csv, HEAD, table)
    return 0


if __name__ == "__main__":
    sys.exit(main())
