# SPDX-License-Identifier: MIT
"""How tricue's and cv2's trackers handle bad input: ``python benchmarks/bad_input.py`` writes docs/bad-input.md.

Every case runs in its own process, so that crashes and hangs are noticed.
"""

import argparse
import multiprocessing
import signal
import warnings
from collections.abc import Callable, Iterable
from multiprocessing.connection import Connection
from pathlib import Path
from types import ModuleType
from typing import Any

import bad_color
import bad_depth
import bad_stereo
import cv2
import numpy as np
import tricue
from bad_case import Case, Made
from tricue.evaluation import metrics

SECONDS = 20.0
BASELINES = ("CSRT", "KCF", "MIL", "MOSSE", "MedianFlow")
MIN_OVERLAP = 0.5  # with the true box, for a tracker that follows the target
PAGE = Path(__file__).parents[1] / "docs" / "bad-input.md"
Follow = Callable[[Case], str]

NAMING = ("boundingBox", "image is not", "image data type")
"""Texts in OpenCV's errors that name the argument."""


def baselines() -> dict[str, Follow]:
    """OpenCV's trackers; ImportError if the installed cv2 lacks one, as wheels without contrib do."""
    found: dict[str, Follow] = {}
    for name in BASELINES:
        module = next((m for m in (cv2, getattr(cv2, "legacy", None)) if hasattr(m, f"Tracker{name}")), None)
        if module is None:
            raise ImportError(
                f"cv2 {cv2.__version__} has no {name}: install opencv-contrib-python-headless<5"
            )
        found[name] = follow_with(getattr(module, f"Tracker{name}").create)
    return found


def follow_with(create: Callable[[], Any]) -> Follow:
    """How a tracker of cv2's handles a case, in a word or two; "-" if it can't take such frames."""

    def follow(case: Case) -> str:
        first, second = (each.bare if isinstance(each, Made) else each for each in (case.first, case.second))
        if any(isinstance(each, Made) and each.bare is None for each in (case.first, case.second)):
            return "-"
        try:
            tracker = create()
            if case.starts:
                tracker.init(first, case.box)
            found, box = tracker.update(second)
        except Exception as error:
            return "named error" if any(words in str(error) for words in NAMING) else "unnamed error"
        if not found:
            return "not found"
        return "follows" if overlaps(box, case.truth) else "**wrong silently**"

    return follow


def overlaps(box: Any, truth: Any) -> bool:
    """Whether a box overlaps the true one enough."""
    if truth is None:
        return False
    return bool(metrics.overlaps(np.array([box], float), np.array([truth], float))[0] > MIN_OVERLAP)


def answer_of(follow: Callable[[Case], tricue.Track]) -> Follow:
    """How a tricue tracker handles a case: its status or error, and the warnings."""

    def answered(case: Case) -> str:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            try:
                text = str(follow(case).status)
            except Exception as error:
                message = " ".join(str(error).split()).replace("|", r"\|")
                text = f"{type(error).__name__}: {message}"
        told = {str(each.message): None for each in caught if each.category is UserWarning}
        return "; ".join([text, *(f"warns: {message}" for message in told)])

    return answered


def send_answer(send: Connection, follow: Follow, case: Case) -> None:
    """Send the answer from the case's own process."""
    cv2.setNumThreads(1)
    send.send(follow(case))


def isolated(follow: Follow, case: Case) -> str:
    """The answer of a separate process, or "crash" or "hang"."""
    context = multiprocessing.get_context("fork")
    receive, send = context.Pipe(duplex=False)
    process = context.Process(target=send_answer, args=(send, follow, case))
    process.start()
    send.close()
    process.join(SECONDS)
    if process.is_alive():
        process.kill()
        process.join()
        return f"**hang**, {SECONDS:.0f} s"
    if process.exitcode:
        name = signal.Signals(-process.exitcode).name if process.exitcode < 0 else process.exitcode
        return f"**crash**, {name}"
    return str(receive.recv())


HEAD = """# Bad input

Written by `python benchmarks/bad_input.py`; don't edit. Each case is one `init` and one `update` in a process of its own.

tricue's trackers either return a track or raise an error that names the argument, what was expected and what they got: a `ValueError` or
a `TypeError`, or a `RuntimeError` for `update` before `init`. An error leaves the tracker as it was, and it goes on with the next good
frame. `tests/track/*/test_*_input.py` have many more cases.

The tables show the status after the update, or the error, and any warnings. An answer that all three trackers give is shown once; cases
with the same answer share a row. The first table has checks that all trackers share, such as most errors in boxes. When `flow-depth`
misses its target, the score is 0; the status stays `tracked` for 0.4 s unless something nearer hides the target. `tracked` doesn't prove
that there is a target: some trackers report it for black images, and `flow-depth` with flow alone may give noise a score of 1.

"""

OTHERS = f"""
## OpenCV's trackers

The cases of [color](#color) again, with the trackers of OpenCV {cv2.__version__} with contrib, which use neither depth nor a right image.

- follows: the box has an overlap above {MIN_OVERLAP} with the true one.
- not found: it reports that it hasn't found the target, without an error.
- **wrong silently**: it reports "found", but the box is not on the target, or there is no target.
- named error: the message says which argument is wrong. unnamed error: it names a line of C++, or nothing.
- A dash: the tracker can't take such a frame.

"""


def our_table(cases: ModuleType) -> str:
    """A row for each answer of tricue's trackers to a module's cases, with the cases that have it."""
    trackers = {name: answer_of(follow) for name, follow in cases.OURS.items()}
    rows: dict[str, list[str]] = {}
    for case in cases.CASES:
        answer = joined({name: isolated(follow, case) for name, follow in trackers.items()})
        rows.setdefault(answer, []).append(case.name)
        print(case.name, flush=True)
    lines = [[f"case, with {', '.join(f'`{name}`' for name in trackers)}", "answer"], ["---", "---"]]
    return table([*lines, *(["; ".join(names), answer] for answer, names in rows.items())])


def joined(answers: dict[str, str]) -> str:
    """The answer if all have the same; else each one's, with the trackers that give it."""
    trackers: dict[str, list[str]] = {}
    for name, answer in answers.items():
        trackers.setdefault(answer, []).append(f"`{name}`")
    if len(trackers) == 1:
        return next(iter(trackers))
    return "<br>".join(f"{', '.join(names)}: {answer}" for answer, names in trackers.items())


def others_table() -> str:
    """A row for each case of color, a column for each of cv2's trackers."""
    trackers = baselines()
    rows = [["case", *trackers], ["---"] * (len(trackers) + 1)]
    rows += [
        [case.name, *(isolated(follow, case) for follow in trackers.values())] for case in bad_color.CASES
    ]
    return table(rows)


def table(rows: Iterable[list[str]]) -> str:
    """Rows in Markdown."""
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


def main() -> None:
    """Run all cases and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", type=Path, default=PAGE)
    output = parser.parse_args().output
    try:
        baselines()  # checks that they are there, before the work
    except ImportError as error:
        parser.error(str(error))
    parts = [part for cases in (bad_color, bad_depth, bad_stereo) for part in (cases.HEAD, our_table(cases))]
    output.parent.mkdir(exist_ok=True)
    output.write_text("".join([HEAD, *parts, OTHERS, others_table()]), encoding="utf-8")


if __name__ == "__main__":
    main()
