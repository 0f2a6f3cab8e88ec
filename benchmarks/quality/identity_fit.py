# SPDX-License-Identifier: MIT
"""The fused tracker's identity weights: a fit on recorded color video, and how well the weights work.

    python -m benchmarks.quality.identity_fit --jobs 2

The first lines are the weights fitted on all sequences, in the form of tricue/track/fused/identity.py.
Features whose weight is 0 there are left out. A logistic regression separates good frames, with an overlap
above 0.3, from covered, lost and other places; each sequence counts the same.

The table is for weights that were fitted without the recording that they are tested on. "AUROC": the chance
that a good frame has a higher score than the target's place while it is covered, than a tracked place with an
overlap under 0.1, or than a place that a search of the whole frame finds elsewhere. "above": the share of
these places above the threshold that 3 % of the good frames miss.
"""

import sys
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from tricue.evaluation import confidence
from tricue.track.fused.identity import APPEARANCE, STRUCTURE, Weights

from benchmarks.quality.common import logistic_regression
from benchmarks.quality.common.arguments import add_dataset, add_output, bare_parser
from benchmarks.quality.common.folds import leave_one_out
from benchmarks.quality.common.frame_results import Array
from benchmarks.quality.common.identity_samples import Kind, Samples, collect
from benchmarks.quality.common.sequence_runs import find_tasks, run_longest_first
from benchmarks.quality.common.tables import Cell, markdown, write_csv

FITTED: Mapping[str, Weights] = {"APPEARANCE": APPEARANCE, "STRUCTURE": STRUCTURE}
COUNTS: Mapping[Kind, float] = {Kind.GOOD: 2.0, Kind.COVERED: 1.0, Kind.LOST: 1.0, Kind.ELSEWHERE: 0.3}
"""The total weight of a sequence's samples by their kind."""
MIN_LOST = 50
"""If a sequence has fewer lost samples, these have less weight, as they are from few moments."""
MISSED_SHARE = 0.03
"""Share of the good frames that miss the threshold."""
OTHERS = (Kind.COVERED, Kind.LOST, Kind.ELSEWHERE)
HEAD = (
    "weights",
    *(f"AUROC {kind.name.lower()}" for kind in OTHERS),
    *(f"above: {kind.name.lower()}" for kind in OTHERS),
)


def sample_weights(kinds: NDArray[np.intp], sequences: NDArray[np.str_]) -> Array:
    """(N,) the weights of samples; kinds, sequences: (N,) the samples' kinds and sequences."""
    weights: Array = np.zeros(len(kinds))
    for sequence in np.unique(sequences):
        for kind, count in COUNTS.items():
            own = (sequences == sequence) & (kinds == kind)
            samples = int(own.sum())
            least = MIN_LOST if kind is Kind.LOST else 1
            weights[own] = count / max(samples, least)
    return weights


def fit(samples: Samples, weights: Array, used: Weights) -> Array:
    """(9,) log-odds per unit of the features and of their changes, and the offset.

    weights: (N,) of the samples. used: where these weights are 0, the fitted ones stay 0.
    """
    columns = np.flatnonzero([*used.features, *used.change])
    found = logistic_regression.fit(samples.features[:, columns], samples.kinds == Kind.GOOD, weights)
    whole: Array = np.zeros(samples.features.shape[1] + 1)
    whole[[*columns, -1]] = found
    return whole


def judge(samples: Samples, weights: Array, sequences: Sequence[str], used: Weights) -> Array:
    """(N,) the samples' probabilities by fits without their recording. ValueError for a single recording."""
    scores: Array = np.zeros(len(samples.kinds))
    for fold in leave_one_out(sequences):
        part = Samples(samples.kinds[fold.fit], samples.features[fold.fit])
        found = fit(part, weights[fold.fit], used)
        scores[fold.judge] = logistic_regression.predict(samples.features[fold.judge], found)
    return scores


def numbers_of(kinds: NDArray[np.intp], scores: Array) -> list[float]:
    """The columns of HEAD after the first, for scores in [0, 1]; NaN for a kind without samples."""
    good = scores[kinds == Kind.GOOD]
    threshold = np.quantile(good, MISSED_SHARE) if good.size else float("nan")
    others = [scores[kinds == kind] for kind in OTHERS]
    aurocs = [
        confidence.auroc(np.repeat([1.0, 0.0], [good.size, each.size]), np.concatenate([good, each]))
        for each in others
    ]
    return [*aurocs, *(float((each > threshold).mean()) if each.size else float("nan") for each in others)]


def source_line(name: str, found: Array) -> str:
    """The line of identity.py with these weights, (9,)."""
    values = (found.round(1) + 0.0).tolist()  # not -0.0
    return f"{name} = Weights({tuple(values[:4])}, {tuple(values[4:8])}, {values[8]})"


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the weights and the table; the exit code."""
    made = bare_parser("identity_fit", __doc__)
    add_dataset(made)
    made.add_argument("--only", nargs="+", default=[], metavar="NAME", help="of these sequences")
    add_output(made)
    options = made.parse_args(arguments)
    try:
        todo = find_tasks([], options.dataset, options.only)
        found = run_longest_first(collect, todo, options.jobs)
        names = [task.entry.name for task, own in zip(todo, found, strict=True) for _ in own.kinds]
        samples = Samples(*(np.concatenate(each) for each in zip(*found, strict=True)))
        weights = sample_weights(samples.kinds, np.array(names))
        table: list[list[Cell]] = [
            [name, *numbers_of(samples.kinds, judge(samples, weights, names, used))]
            for name, used in FITTED.items()
        ]
    except (OSError, ValueError) as error:
        made.error(str(error))
    for name, used in FITTED.items():
        print(source_line(name, fit(samples, weights, used)))
    counts = [f"{(samples.kinds == kind).sum()} {kind.name.lower()}" for kind in Kind]
    print(f"\n{markdown(HEAD, table)}\n\nsamples: {', '.join(counts)}")
    write_csv(options.csv, HEAD, table)
    return 0


if __name__ == "__main__":
    sys.exit(main())
