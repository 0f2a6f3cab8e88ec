# SPDX-License-Identifier: MIT
"""What our tracker and cv2's make of bad input: ``python benchmarks/bad_input.py`` writes docs/bad-input.md.

Every case runs in a process of its own, so that a crash or a hang is seen for what it is.
"""

import argparse
import multiprocessing
import re
import signal
from collections.abc import Callable
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, NamedTuple

import cv2
import numpy as np
import tricue

cv2.setNumThreads(0)  # before any work: a process forked from one with a thread pool waits for it for ever
SECONDS = 20.0
PAGE = Path(__file__).parents[1] / "docs" / "bad-input.md"
NOISE = np.random.default_rng(0).integers(0, 256, (60, 80, 3), np.uint8)
IMAGE = cv2.GaussianBlur(cv2.resize(NOISE, (320, 240), interpolation=cv2.INTER_CUBIC), (0, 0), 2)
NEXT = np.roll(IMAGE, 3, axis=1)
BOX = (120, 80, 50, 60)
BLACK, WHITE = np.zeros_like(IMAGE), np.full_like(IMAGE, 255)
TINY, HUGE = IMAGE[:1, :1].copy(), np.tile(IMAGE, (13, 13, 1))[:3000, :4000].copy()


class Case(NamedTuple):
    """Init on ``first`` and ``box``, then update on ``second``, whatever they are."""

    name: str
    first: Any = IMAGE
    box: Any = BOX
    second: Any = NEXT
    starts: bool = True


def gray(image: Any) -> Any:
    """One channel."""
    return cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)


CASES = (
    Case("all is well"),
    Case("update before init", starts=False),
    Case("frame None", second=None),
    Case("frame a list", second=NEXT.tolist()),
    Case("frame empty", second=NEXT[:0]),
    Case("uint16 frame", second=NEXT.astype(np.uint16)),
    Case("uint16 frames", IMAGE.astype(np.uint16), second=NEXT.astype(np.uint16)),
    Case("float32 frame, 0 to 1", second=NEXT.astype(np.float32) / 255),
    Case("float32 frames, 0 to 1", IMAGE.astype(np.float32) / 255, second=NEXT.astype(np.float32) / 255),
    Case("bool frame", second=NEXT > 127),
    Case("grey frame", second=gray(NEXT)),
    Case("grey frames", gray(IMAGE), second=gray(NEXT)),
    Case("BGRA frame", second=cv2.cvtColor(NEXT, cv2.COLOR_BGR2BGRA)),
    Case("crop of a larger array", second=np.pad(NEXT, ((4, 4), (4, 4), (0, 0)))[4:-4, 4:-4]),
    Case("mirrored view", second=NEXT[:, ::-1]),
    Case("channels-reversed view", second=NEXT[..., ::-1]),
    Case("Fortran order", second=np.asfortranarray(NEXT)),
    Case("smaller frame", second=NEXT[:120, :160].copy()),
    Case("larger frame", second=np.tile(NEXT, (2, 2, 1))),
    Case("4000x3000 after 320x240", second=HUGE),
    Case("1x1 image", TINY, (0, 0, 1, 1), TINY),
    Case("4000x3000 images", HUGE, BOX, HUGE),
    Case("box of NaN", box=(np.nan, 80, 50, 60)),
    Case("infinite box", box=(120, 80, np.inf, 60)),
    Case("box of strings", box=("120", "80", "50", "60")),
    Case("box of three numbers", box=(120, 80, 50)),
    Case("box of fractions", box=(120.5, 80.25, 50.0, 60.5)),
    Case("box of zeros", box=(0, 0, 0, 0)),
    Case("box of zero width", box=(120, 80, 0, 60)),
    Case("negative size", box=(170, 140, -50, -60)),
    Case("box of 1x1", box=(120, 80, 1, 1)),
    Case("box of 1x300", box=(120, -30, 1, 300)),
    Case("box half outside", box=(-25, 80, 50, 60)),
    Case("box outside", box=(400, 80, 50, 60)),
    Case("box far outside", box=(10**9, 80, 50, 60)),
    Case("box larger than the image", box=(-100, -100, 600, 600)),
    Case("black at init", BLACK),
    Case("saturated at init", WHITE),
    Case("black at update", second=BLACK),
    Case("saturated at update", second=WHITE),
    Case("noise at update", second=cv2.resize(NOISE, (320, 240), interpolation=cv2.INTER_NEAREST)),
)


def makers() -> dict[str, Callable[[], Any]]:
    """Ours, and those that the installed cv2 has."""
    found: dict[str, Callable[[], Any]] = {"tricue": lambda: tricue.create("color-particle", seed=0)}
    for name in ("CSRT", "KCF", "MIL", "MOSSE", "MedianFlow"):
        module = next((m for m in (cv2, getattr(cv2, "legacy", None)) if hasattr(m, f"Tracker{name}")), None)
        if module is not None:
            found[name] = getattr(module, f"Tracker{name}").create
    return found


def outcome(make: Callable[[], Any], case: Case) -> str:
    """What happened, in a few words."""
    tracker = make()
    try:
        if case.starts:
            tracker.init(case.first, case.box)
        answer = tracker.update(case.second)
    except Exception as error:
        return f"{type(error).__name__}: {shortened(str(error))}"
    return shown(answer)


def shown(answer: Any) -> str:
    """The status and the box of ours, or cv2's (found, box)."""
    if isinstance(answer, tricue.Track):
        return f"{answer.status}, score {answer.score:.2f}, {numbers(answer.box)}"
    found, box = answer
    return f"{'found' if found else 'not found'}, {numbers(box)}"


def numbers(box: Any) -> str:
    """A box in four digits a number."""
    return f"box {' '.join(f'{number:.4g}' for number in box)}"


def shortened(message: str) -> str:
    """One line without C++ file names, at most 90 characters."""
    lines = [line.strip() for line in message.splitlines() if line.strip()]
    text = " ".join(lines[:1] if "Overload" not in message else lines[1:3])
    text = re.sub(r"OpenCV\([^)]*\) (\S+:\d+: )?(error: )?", "", text).replace("|", r"\|")
    return text if len(text) <= 90 else f"{text[:88]} ..."


def told(send: Connection, make: Callable[[], Any], case: Case) -> None:
    """Send the outcome from the case's own process."""
    cv2.setNumThreads(1)
    send.send(outcome(make, case))


def isolated(make: Callable[[], Any], case: Case) -> str:
    """The outcome in a process of its own: also "crash" with its signal, or "hang"."""
    context = multiprocessing.get_context("fork")
    receive, send = context.Pipe(duplex=False)
    process = context.Process(target=told, args=(send, make, case))
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

Written by `python benchmarks/bad_input.py`, not by hand. Each case is one `init` and one `update` in a process of its own, with all
else as it should be: a textured picture of 320x240 that moves 3 pixels to the right, the box {BOX}. tricue
names the argument, what it expected and what came, and its state stays as it was; what is in order it follows. Beside it cv2's trackers,
OpenCV {cv2.__version__}: an error of theirs often names only a line of C++, and some cases pass silently.

"""


def main() -> None:
    """Run all cases and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", type=Path, default=PAGE)
    output = parser.parse_args().output
    trackers = makers()
    rows = [["case", *trackers], ["---"] * (len(trackers) + 1)]
    for case in CASES:
        rows.append([case.name, *(isolated(make, case) for make in trackers.values())])
        print(case.name, flush=True)
    output.parent.mkdir(exist_ok=True)
    output.write_text(HEAD + "".join(f"| {' | '.join(row)} |\n" for row in rows), encoding="utf-8")


if __name__ == "__main__":
    main()
