# SPDX-License-Identifier: MIT
"""``tricue evaluate DATASET``: trackers over many sequences, tables and a report."""

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from tricue.cli.arguments import any_tracker_names, count, output_file, seconds, words
from tricue.cli.option_names import by_options, naming_options
from tricue.cli.progress import SEARCH_NOTE, Progress
from tricue.cli.settings import read_settings, third_party_settings
from tricue.draw.writable import check_writable
from tricue.evaluation import baselines, tables
from tricue.evaluation.attributes.measure import measure_all
from tricue.evaluation.dataset import ReadOptions
from tricue.evaluation.evaluate import Evaluation, Options, ProgressUpdate, evaluate
from tricue.evaluation.figures import FOLDER as FIGURES
from tricue.evaluation.figures import check_formats, write_figures
from tricue.evaluation.foreign.spec import DEFAULT_TIME_LIMIT, is_foreign
from tricue.evaluation.latex import write_latex
from tricue.evaluation.markdown import markdown
from tricue.evaluation.protocols import ONE_PASS, RESTARTS
from tricue.evaluation.raw_results import check_folder, write_raw
from tricue.evaluation.report import svg
from tricue.evaluation.report.page import write_report
from tricue.evaluation.results_folder import FORMS
from tricue.evaluation.tasks import perform
from tricue.evaluation.trackers import split_ours
from tricue.track.base.registry import names

EXAMPLES = """\
examples:
  tricue evaluate sequences/                                  everything; see evaluation/report.html
  tricue evaluate sequences/ --jobs 2                         the same command goes on after Ctrl-C
  tricue evaluate sequences/ --trackers color-particle,CSRT,KCF --seeds 5 --output color
  tricue evaluate sequences/ --trackers color-particle --set color-particle.particles=300
  tricue evaluate sequences/ --trackers fused,slow=fused --set slow.rate=15   one tracker with two settings
  tricue evaluate sequences/ --trackers fused,mine.py:Mine,cv2:TrackerMIL     your class, any of cv2's
  tricue evaluate sequences/ --trackers 'fused,theirs=trax:./theirs --fast'   a TraX program
  tricue evaluate sequences/ --trackers fused --results SiamFC=results/SiamFC others' result files
  tricue evaluate sequences/ --protocols one-pass,restarts,starts,every-3,noisy-5 --attributes
  tricue evaluate sequences/ --latex table.tex --figures pdf      for a paper
  tricue evaluate recordings/ --depth-scale 0.001 --fps 15    16-bit depth in millimeters, no times
  tricue evaluate sequences/ --raw boxes                      as OTB's, GOT-10k's and VOT's files, too
  tricue evaluate /data/all --scheduler tcp://host:8786       a Dask cluster, which sees that folder
"""
FAILED = 1
_OPTIONS = {
    "protocols": "--protocols",
    "results": "--results",
    "scheduler": "--scheduler",
    "settings": "--set",
    "trackers": "--trackers",
}
MAX_NAMES = 6  # names of sequences per line
_SET_BY = {
    "seed": "--seeds N",
    "kernels": "this command itself, to native,",
    "intrinsics": "the sequence's calibration",
    "rig": "the sequence's calibration",
}
"""How to set the settings that aren't a tracker's parameters."""


def add_options(command: argparse.ArgumentParser) -> None:
    """Add the command's options to its parser."""
    command.add_argument(
        "dataset", type=Path, metavar="DATASET", help="a sequence with true boxes, or a folder of them"
    )
    command.add_argument(
        "--trackers",
        type=any_tracker_names,
        action="extend",
        metavar="NAMES",
        help="tricue's, the baselines', module:Class, file.py:Class, cv2:Name, trax:COMMAND, each but the "
        "baselines' with NAME= before it to name it; separated by commas, or several times; default all that "
        "are installed",
    )
    command.add_argument(
        "--results",
        action="append",
        default=[],
        metavar="NAME=FOLDER",
        help=f"others' results on the same sequences; :FORM behind it, one of {', '.join(FORMS)}, if "
        "it isn't what the folder looks like",
    )
    command.add_argument(
        "--time-limit",
        type=seconds,
        default=DEFAULT_TIME_LIMIT,
        metavar="SECONDS",
        help="time for a frame of a tracker that isn't ours, default %(default)g; loading may take a minute",
    )
    command.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="TRACKER.NAME=VALUE",
        help="a parameter of one of the trackers, also of yours",
    )
    command.add_argument(
        "--seeds",
        type=count,
        default=3,
        metavar="N",
        help="runs of each tracker that draws random numbers, default %(default)s",
    )
    command.add_argument(
        "--protocols",
        type=words,
        default=[ONE_PASS, RESTARTS],
        metavar="NAMES",
        help="one-pass (always), restarts, starts, backward, every-N, noisy-N; default one-pass,restarts",
    )
    command.add_argument(
        "--no-restarts", action="store_true", help="leave out the runs with restarts after failures"
    )
    command.add_argument(
        "--attributes",
        action="store_true",
        help="measure the sequences' attributes, and group results by them",
    )
    command.add_argument("--latex", type=output_file, metavar="FILE", help="also write the tables as LaTeX")
    command.add_argument(
        "--figures",
        type=words,
        default=[],
        metavar="FORMATS",
        help="also write figures for papers into OUTPUT/figures: pdf, svg, png",
    )
    where = command.add_mutually_exclusive_group()
    where.add_argument("--jobs", type=count, default=1, metavar="N", help="processes, default %(default)s")
    where.add_argument("--scheduler", metavar="ADDRESS", help="a Dask cluster, tcp://HOST:PORT")
    command.add_argument(
        "--ahead",
        type=count,
        default=0,
        metavar="N",
        help="frames to read ahead, for slow disks; uses part of another core",
    )
    command.add_argument("--fresh", action="store_true", help="repeat finished runs")
    command.add_argument(
        "--output", type=Path, default=Path("evaluation"), metavar="FOLDER", help="default %(default)s/"
    )
    command.add_argument(
        "--raw",
        type=Path,
        metavar="FOLDER",
        help="write all boxes in the formats of OTB, GOT-10k and VOT, with a manifest",
    )
    command.add_argument(
        "--depth-scale",
        type=float,
        metavar="M",
        help="meters per unit of depth, if the format doesn't say",
    )
    command.add_argument("--fps", type=float, metavar="N", help="frames/s of images without times")
    command.add_argument(
        "--unit", type=float, metavar="M", help="meters per unit of the board in OpenCV's calibrations"
    )
    command.add_argument(
        "--truth",
        choices=("color", "depth"),
        help="the channel in whose pixels the true boxes are given, for sequences with both",
    )


def run(options: argparse.Namespace) -> int:
    """Run the command: progress on stderr, the table on stdout. The exit code is 1 if a sequence couldn't be
    read, if a requested tracker was run but started nowhere, or if results fit no sequence.
    """
    svg.require()  # fail now, not after hours
    if options.raw is not None:
        check_folder(options.raw)
    if options.latex is not None:
        check_writable(options.latex)
    with naming_options(formats="--figures"):
        check_formats(options.figures)
    folder: Path = options.output
    if folder.exists() and options.dataset.exists() and folder.samefile(options.dataset):
        raise ValueError(f"--output: expected another folder than that of the sequences, got {folder}")
    restarts, protocols = chosen_protocols(options)
    chosen = Options(
        trackers=tuple(options.trackers) if options.trackers else None,
        settings=settings_by_tracker(options.set, options.trackers or ()),
        seeds=options.seeds,
        restarts=restarts,
        reading=ReadOptions(options.depth_scale, options.fps, options.unit, options.truth),
        results=tuple(options.results),
        time_limit=options.time_limit,
        protocols=protocols,
    )
    with Progress() as progress, naming_options(**_OPTIONS):

        def show(update: ProgressUpdate) -> None:
            progress.total = update.total
            progress(update.done, _remaining_note(update))

        try:
            evaluation = evaluate(
                options.dataset,
                folder,
                chosen,
                jobs=options.jobs,
                fresh=options.fresh,
                scheduler=options.scheduler,
                on_progress=show,
                on_search=partial(progress, note=SEARCH_NOTE),
                work=partial(perform, ahead=options.ahead),
            )
        except KeyboardInterrupt:
            print(f"what is finished is in {folder}; the same command goes on", file=sys.stderr)
            raise
    return _report(evaluation, folder, options)


def chosen_protocols(options: argparse.Namespace) -> tuple[bool, tuple[str, ...]]:
    """Whether to run with restarts, and the protocols other than restarts and one pass."""
    restarts = RESTARTS in options.protocols and not options.no_restarts
    return restarts, tuple(name for name in options.protocols if name not in (ONE_PASS, RESTARTS))


def settings_by_tracker(settings: Sequence[str], trackers: Sequence[str] = ()) -> dict[str, dict[str, Any]]:
    """Parameters by tracker from strings tracker.name=value; trackers: as ``--trackers`` names them."""
    kinds = dict(map(split_ours, trackers))
    found: dict[str, list[str]] = {}
    for setting in settings:
        place, equals, value = setting.partition("=")
        tracker, dot, name = place.rpartition(".")
        if not dot:
            raise ValueError(f"--set: expected tracker.name=value, got {setting!r}")
        found.setdefault(tracker, []).append(f"{name}{equals}{value}")
    return {
        tracker: read_settings(kinds.get(tracker) or tracker, None, each, _SET_BY)
        if kinds.get(tracker) or (tracker in names() and not is_foreign(tracker))
        else third_party_settings(each, _SET_BY)
        for tracker, each in found.items()
    }


def _report(evaluation: Evaluation, folder: Path, options: argparse.Namespace) -> int:
    if options.attributes:
        evaluation = _with_attributes(evaluation, folder)
    others = {
        each.name: each.description
        for each in evaluation.trackers
        if not each.ours and each.name not in baselines.NAMES
    }
    about = tables.settings(evaluation, dataset=str(options.dataset), jobs=options.jobs, others=others)
    written = [*tables.write(evaluation, folder, about), write_report(evaluation, folder, about)]
    if options.raw is not None:
        written.append(write_raw(evaluation, folder, options.raw, about))
    if options.latex:
        written.append(write_latex(evaluation, options.latex))
    if options.figures:
        written += write_figures(evaluation, folder / FIGURES, options.figures)
    print(markdown(evaluation))
    for line in [*_troubles(evaluation), *_left_out(evaluation), *evaluation.notes]:
        print(by_options(line))
    errors = _errors(evaluation)
    for error in errors:
        print(f"failed: {error}", file=sys.stderr)
    for path in written:
        print(f"wrote {path}")
    return FAILED if errors else 0


def _errors(evaluation: Evaluation) -> list[str]:
    """The errors that make the exit code 1: unreadable sequences, requested trackers that started nowhere,
    and results that fit no sequence.
    """
    asked, total = _asked(evaluation), len(evaluation.opened)
    return [
        *(f"{name}: {by_options(error)}" for name, error in evaluation.failed.items()),
        *(line for name in evaluation.unstarted if name in asked for line in _unstarted(evaluation, name)),
        *(f"{name}: no result that fits any of {total} sequences" for name in _without_results(evaluation)),
    ]


def _troubles(evaluation: Evaluation) -> list[str]:
    """The errors of trackers. One that started nowhere has a line per reason. That isn't a failure unless it
    was requested by name: stereo-head, for example, doesn't start on targets that are too near.
    """
    asked, unstarted = _asked(evaluation), evaluation.unstarted
    rows = [each.row for each in evaluation.results if each.row.trouble]
    return [
        *(
            f"{r.tracker} on {r.sequence}, {r.run}, seed {r.seed}: {r.trouble}"
            for r in rows
            if r.tracker not in unstarted
        ),
        *(line for name in unstarted if name not in asked for line in _unstarted(evaluation, name)),
    ]


def _unstarted(evaluation: Evaluation, tracker: str) -> list[str]:
    """The lines of a tracker that started on no sequence."""
    reasons = evaluation.unstarted[tracker]
    total = len({name for names in reasons.values() for name in names})
    noun = "sequence" if total == 1 else "sequences"
    return [f"{tracker} on {len(names)} of {total} {noun}: {why}" for why, names in reasons.items()]


def _without_results(evaluation: Evaluation) -> list[str]:
    """The folders of results, by name, from which nothing could be compared."""
    there = {each.row.tracker for each in evaluation.results}
    return [name for name in _result_names(evaluation.options) if name not in there]


def _result_names(options: Options) -> list[str]:
    return [text.partition("=")[0].strip() for text in options.results]


def _asked(evaluation: Evaluation) -> set[str]:
    """The names that were requested: trackers, unless all are run, and results."""
    options = evaluation.options
    asked = {each.name for each in evaluation.trackers} if options.trackers else set()
    return asked | {*_result_names(options)}


def _left_out(evaluation: Evaluation) -> list[str]:
    """Which of the requested names didn't run, and why."""
    asked = _asked(evaluation)
    sequences: dict[tuple[str, str], list[str]] = {}
    for (tracker, sequence), why in evaluation.left_out.items():
        if tracker in asked:
            sequences.setdefault((tracker, why), []).append(sequence)
    return [f"not run: {tracker} on {_some(found)}: {why}" for (tracker, why), found in sequences.items()]


def _some(names: list[str]) -> str:
    return ", ".join(names[:MAX_NAMES]) + (" and others" if len(names) > MAX_NAMES else "")


def _with_attributes(evaluation: Evaluation, folder: Path) -> Evaluation:
    """The evaluation with its sequences' attributes; a second run reads those that the first stored."""
    with Progress() as progress:
        progress.total = len(evaluation.opened)
        found = measure_all(evaluation.opened, folder, lambda done: progress(done, "attributes"))
    return replace(evaluation, attributes=found)


def _remaining_note(update: ProgressUpdate) -> str:
    if update.last is None or update.seconds_left is None:
        return ""
    minutes, seconds = divmod(round(update.seconds_left), 60)
    return f"{minutes}:{seconds:02d} left, {update.last.tracker.name} {update.last.entry.name}"
