# SPDX-License-Identifier: MIT
"""Tables of trackers on recorded color and depth: by target and group, and differences by channels."""

from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np

from benchmarks.quality.common.color_tables import SUMMARY, TIMES, times
from benchmarks.quality.common.comparison import interval_table
from benchmarks.quality.common.confidence_summary import summarize
from benchmarks.quality.common.depth_summary import summarize_depth
from benchmarks.quality.common.frame_results import FrameResults
from benchmarks.quality.common.groups import members
from benchmarks.quality.common.protocols import PROTOCOLS
from benchmarks.quality.common.saved_runs import aucs
from benchmarks.quality.common.sequence_runs import SequenceResult, by_tracker, pool
from benchmarks.quality.common.tables import Cell, markdown, mean
from benchmarks.quality.common.variants import Variant

DEPTH = ("z error m", "TRACKED on target", "bias", "sigma", "within 1 sigma", "within 2 sigma")
CSV_COLUMNS = (
    *("tracker", "target", "protocol", "runs", "frames", "AUC", "mean overlap", *SUMMARY, *DEPTH),
    "ms/frame",
)
Found = Mapping[str, Sequence[SequenceResult]]


def tables(variants: Sequence[Variant], results: Sequence[SequenceResult]) -> str:
    """Markdown: all tables of this module, one after the other."""
    found = by_tracker(results)
    return "\n\n".join([target_table(found), *difference_tables(variants, found), *frame_tables(found)])


def target_table(found: Found) -> str:
    """The AUC and the mean overlap by tracker, target and protocol, and their means over groups."""
    rows: list[list[Cell]] = []
    for tracker, own in found.items():
        rows += [[tracker, each.sequence, *_both([each])] for each in own]
        rows += [[tracker, f"{name} ({len(some)})", *_both(some)] for name, some in _grouped(own)]
    head = [*PROTOCOLS, *(f"{protocol}: overlap" for protocol in PROTOCOLS)]
    return markdown(["tracker", "target, AUC", *head], rows)


def _both(some: Sequence[SequenceResult]) -> list[float]:
    """For each protocol, the mean AUC and the mean overlap over some targets."""
    means = [[mean([of(each, name) for each in some]) for name in PROTOCOLS] for of in _MEASURES]
    return [number for numbers in means for number in numbers]


_MEASURES = (SequenceResult.auc, SequenceResult.overlap)


def _grouped(own: Sequence[SequenceResult]) -> Iterator[tuple[str, list[SequenceResult]]]:
    for name, targets in members(each.sequence for each in own).items():
        yield name, [each for each in own if each.sequence in targets]


def difference_tables(variants: Sequence[Variant], found: Found) -> list[str]:
    """For each pair of variants: the differences of the AUC by group and protocol, with intervals."""
    return [
        interval_table(f"{now} minus {before}: AUC", aucs(found[now]), aucs(found[before]))
        for now, before in pairs(variants)
        if now in found and before in found
    ]


def pairs(variants: Sequence[Variant]) -> list[tuple[str, str]]:
    """The labels of variants that are compared.

    Each is compared with the same tracker on color alone; one without times, with the same one with times.
    """
    made = []
    for each in variants:
        for other in variants:
            same = (each.spec, each.timed) == (other.spec, other.timed)
            by_channels = same and each.only != ("color",) == other.only
            by_times = (each.spec, each.only, each.timed) == (other.spec, other.only, not other.timed)
            if by_channels or (by_times and other.timed):
                made.append((each.label, other.label))
    return made


def frame_tables(found: Found) -> list[str]:
    """For all frames of a tracker in a group: the summary of score and status, times, and that of depths."""
    pooled = [(tracker, name, pool(some)) for tracker, own in found.items() for name, some in _grouped(own)]
    first: list[list[Cell]] = [
        [tracker, name, len(frames.overlaps), *summarize(frames), *times(frames)]
        for tracker, name, frames in pooled
    ]
    second: list[list[Cell]] = [
        [tracker, name, *summarize_depth(frames)]
        for tracker, name, frames in pooled
        if not np.isnan(frames.depth_errors).all()
    ]
    return [
        markdown(["tracker", "group", "frames", *SUMMARY, *TIMES], first),
        markdown(["tracker", "group", *DEPTH], second),
    ]


def csv_rows(results: Iterable[SequenceResult]) -> list[list[Cell]]:
    """CSV_COLUMNS for each tracker, target and protocol."""
    rows: list[list[Cell]] = []
    for each in results:
        for protocol in PROTOCOLS:
            if runs := each.runs_of(protocol):
                frames = FrameResults.pooled(runs)
                head = each.tracker, each.sequence, protocol, len(runs), len(frames.overlaps)
                numbers = each.auc(protocol), each.overlap(protocol), *summarize(frames)
                rows.append([*head, *numbers, *summarize_depth(frames), frames.milliseconds])
    return rows
