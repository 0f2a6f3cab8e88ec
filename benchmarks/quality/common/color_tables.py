# SPDX-License-Identifier: MIT
"""Tables of trackers on recorded color sequences: by group, by sequence, and over all frames together."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from tricue.evaluation.bootstrap import LEVEL

from benchmarks.quality.common.confidence_intervals import summary_intervals
from benchmarks.quality.common.confidence_summary import reliability, summarize
from benchmarks.quality.common.frame_results import Flags, FrameResults
from benchmarks.quality.common.groups import members, recording
from benchmarks.quality.common.protocols import PROTOCOLS
from benchmarks.quality.common.sequence_runs import SequenceResult, by_tracker, mean_auc, pool
from benchmarks.quality.common.tables import Cell, markdown

SUMMARY = ("lost", "AUROC", "TRACKED of lost", "not TRACKED of on target", "deviation", "calibration error")
TIMES = ("TRACKED ms p50", "p99", "not TRACKED ms p50", "p99")
CSV_COLUMNS = ("tracker", "sequence", "protocol", "runs", "frames", "AUC", *SUMMARY, "ms/frame")


def tables(results: Sequence[SequenceResult]) -> str:
    """Markdown: all tables of this module, one after the other."""
    made = group_table, sequence_table, frame_table, reliability_table, interval_table
    found = by_tracker(results)
    return "\n\n".join(each(found) for each in made)


def group_table(found: Mapping[str, Sequence[SequenceResult]]) -> str:
    """The mean AUC by tracker, protocol and group; the head has each group's number of sequences."""
    groups = members(dict.fromkeys(each.sequence for own in found.values() for each in own))
    rows: list[list[Cell]] = [
        [
            tracker,
            protocol,
            *(mean_auc([each for each in own if each.sequence in of], protocol) for of in groups.values()),
        ]
        for tracker, own in found.items()
        for protocol in PROTOCOLS
    ]
    return markdown(["tracker", "AUC", *(f"{group} ({len(of)})" for group, of in groups.items())], rows)


def sequence_table(found: Mapping[str, Sequence[SequenceResult]]) -> str:
    """The AUC by tracker, sequence and protocol."""
    rows: list[list[Cell]] = [
        [tracker, each.sequence, *map(each.auc, PROTOCOLS)] for tracker, own in found.items() for each in own
    ]
    return markdown(["tracker", "sequence", *PROTOCOLS], rows)


def frame_table(found: Mapping[str, Sequence[SequenceResult]]) -> str:
    """By tracker, over all frames and those of each protocol: the quality of score and status, times."""
    rows: list[list[Cell]] = []
    for tracker, own in found.items():
        parts = {"all": pool(own)}
        parts |= {name: pool(own, name) for name in PROTOCOLS if any(each.runs_of(name) for each in own)}
        rows += [
            [tracker, name, len(frames.overlaps), *summarize(frames), *times(frames)]
            for name, frames in parts.items()
        ]
    return markdown(["tracker", "runs", "frames", *SUMMARY, *TIMES], rows)


def reliability_table(found: Mapping[str, Sequence[SequenceResult]]) -> str:
    """By tracker, the share of frames on target in each bin of the score."""
    rows: list[list[Cell]] = []
    for tracker, own in found.items():
        line = reliability(pool(own))
        for index, (low, high) in enumerate(zip(line.edges[:-1], line.edges[1:], strict=True)):
            means = float(line.scores[index]), float(line.overlaps[index])
            rows.append([tracker, f"{low:.1f} to {high:.1f}", *means, int(line.counts[index])])
    return markdown(["tracker", "score", "mean score", "on target", "frames"], rows)


def interval_table(found: Mapping[str, Sequence[SequenceResult]]) -> str:
    """The bootstrap intervals, over recordings, of the summary of all frames."""
    rows: list[list[Cell]] = []
    for tracker, own in found.items():
        names = dict.fromkeys(recording(each.sequence) for each in own)
        by_recording = {name: [each for each in own if recording(each.sequence) == name] for name in names}
        intervals = summary_intervals({name: pool(results) for name, results in by_recording.items()})
        rows.append(
            [tracker, *(f"[{each.low:.3f}, {each.high:.3f}]" if each.known else "-" for each in intervals)]
        )
    return markdown([f"tracker, {100 * LEVEL:g} % interval", *SUMMARY], rows)


def times(frames: FrameResults) -> list[float]:
    """TIMES: milliseconds of the updates that return TRACKED, and of all others."""
    return [
        float(1e3 * percentile)
        for status in (frames.tracked, ~frames.tracked)
        for percentile in _percentiles(frames, status)
    ]


def _percentiles(frames: FrameResults, chosen: Flags) -> Sequence[float]:
    seconds = frames.seconds[chosen & ~np.isnan(frames.seconds)]
    return np.percentile(seconds, [50, 99]).tolist() if seconds.size else [float("nan")] * 2


def csv_rows(results: Iterable[SequenceResult]) -> list[list[Cell]]:
    """CSV_COLUMNS for each tracker, sequence and protocol."""
    rows: list[list[Cell]] = []
    for each in results:
        for protocol in PROTOCOLS:
            if runs := each.runs_of(protocol):
                frames = FrameResults.pooled(runs)
                numbers = each.auc(protocol), *summarize(frames), frames.milliseconds
                rows.append(
                    [each.tracker, each.sequence, protocol, len(runs), len(frames.overlaps), *numbers]
                )
    return rows
