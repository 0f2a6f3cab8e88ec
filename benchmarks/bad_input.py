# SPDX-License-Identifier: MIT
"""What our trackers and cv2's make of bad input: ``python benchmarks/bad_input.py`` writes docs/bad-input.md.

Every case runs in a process of its own, so that a crash or a hang is seen for what it is.
"""

import argparse
import multiprocessing
import re
import signal
import warnings
from collections.abc import Callable
from multiprocessing.connection import Connection
from pathlib import Path
from types import ModuleType
from typing import Any

import bad_color
import bad_depth
import bad_stereo
import cv2
import tricue
from bad_case import Case, Made

SECONDS = 20.0
LONGEST = 90  # characters of an error by C++, of which the rest doesn't help
PAGE = Path(__file__).parents[1] / "docs" / "bad-input.md"
Follow = Callable[[Case], Any]


def peers() -> dict[str, Follow]:
    """Those trackers that the installed cv2 has."""
    found: dict[str, Follow] = {}
    for name in ("CSRT", "KCF", "MIL", "MOSSE", "MedianFlow"):
        module = next((m for m in (cv2, getattr(cv2, "legacy", None)) if hasattr(m, f"Tracker{name}")), None)
        if module is not None:
            found[name] = follow_with(getattr(module, f"Tracker{name}").create)
    return found


def follow_with(create: Callable[[], Any]) -> Follow:
    """A tracker of cv2's on a case; None where it has no use for it."""

    def follow(case: Case) -> Any:
        first, second = (each.bare if isinstance(each, Made) else each for each in (case.first, case.second))
        if any(isinstance(each, Made) and each.bare is None for each in (case.first, case.second)):
            return None
        tracker = create()
        if case.starts:
            tracker.init(first, case.box)
        return tracker.update(second)

    return follow


def outcome(follow: Follow, case: Case) -> str:
    """What happened, in a few words, with the warnings."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            text = shown(follow(case))
        except Exception as error:
            text = f"{type(error).__name__}: {shortened(str(error), isinstance(error, cv2.error))}"
    told = {str(warning.message): None for warning in caught if warning.category is UserWarning}
    return "; ".join([text, *(f"warns: {message}" for message in told)])


def shown(answer: Any) -> str:
    """The status and the box of ours, and the position where there is one, or cv2's (found, box)."""
    if answer is None:
        return ""
    if isinstance(answer, tricue.Track):
        place = "" if answer.position is None else f", {' '.join(f'{m:.2f}' for m in answer.position)} m"
        return f"{answer.status}, score {answer.score:.2f}, {numbers(answer.box)}{place}"
    found, box = answer
    return f"{'found' if found else 'not found'}, {numbers(box)}"


def numbers(box: Any) -> str:
    """A box in four digits a number."""
    return f"box {' '.join(f'{number:.4g}' for number in box)}"


def shortened(message: str, foreign: bool) -> str:
    """One line without C++ file names; another's of at most 90 characters."""
    lines = [line.strip() for line in message.splitlines() if line.strip()]
    text = " ".join(lines[:1] if "Overload" not in message else lines[1:3])
    text = re.sub(r"OpenCV\([^)]*\) (\S+:\d+: )?(error: )?", "", text).replace("|", r"\|")
    return f"{text[: LONGEST - 2]} ..." if foreign and len(text) > LONGEST else text


def told(send: Connection, follow: Follow, case: Case) -> None:
    """Send the outcome from the case's own process."""
    cv2.setNumThreads(1)
    send.send(outcome(follow, case))


def isolated(follow: Follow, case: Case) -> str:
    """The outcome in a process of its own: also "crash" with its signal, or "hang"."""
    context = multiprocessing.get_context("fork")
    receive, send = context.Pipe(duplex=False)
    process = context.Process(target=told, args=(send, follow, case))
    process.start()
    send.close()
    process.join(SECONDS)
    if process.is_alive():
        process.kill()
        process.join()
        return f"**hang**: no answer in {SECONDS:.0f} s"
    if process.exitcode:
        name = signal.Signals(-process.exitcode).name if process.exitcode < 0 else process.exitcode
        return f"**crash**: {name}"
    return str(receive.recv())


HEAD = f"""# Bad input

Written by `python benchmarks/bad_input.py`, not by hand. Each case is one `init` and one `update` in a process of its own. Our trackers name
the argument, what it expected and what came, and their state stays as it was; what is in order they follow. Beside them cv2's trackers,
OpenCV {cv2.__version__}: an error of theirs often names only a line of C++, and some cases pass silently. The first three columns
are ours; `tests/track/*/test_bad_input.py` hold many more cases. Where `flow-depth` doesn't see its target its score is 0; its status follows in a
moment, as a single frame may be bad. With `cues=flow` it has nothing to tell by in a first update.

"""


def table(ours: ModuleType) -> str:
    """A table's lines: what a module's cases come to with our trackers and with cv2's."""
    trackers: dict[str, Follow] = {**ours.OURS, **peers()}
    rows = [["case", *trackers], ["---"] * (len(trackers) + 1)]
    for case in ours.CASES:
        rows.append([case.name, *(isolated(follow, case) for follow in trackers.values())])
        print(case.name, flush=True)
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


def main() -> None:
    """Run all cases and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", type=Path, default=PAGE)
    output = parser.parse_args().output
    parts = [part for ours in (bad_color, bad_depth, bad_stereo) for part in (ours.HEAD, table(ours))]
    output.parent.mkdir(exist_ok=True)
    output.write_text("".join([HEAD, *parts]), encoding="utf-8")


if __name__ == "__main__":
    main()
