# SPDX-License-Identifier: MIT
"""How commands handle faults: ``python -m tools.faults`` writes a table of them into docs/reliability.md.

Each fault happens to a separate process in a temporary folder. Its exit code, its last message, and what can
still be read of its files are a line of the page's table. What the page promises is tested in tests/cli.
"""

import argparse
import csv
import functools
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np
from tricue.draw.video import OverlayWriter

from tools.page_sections import with_section

PAGE = Path(__file__).parents[1] / "docs" / "reliability.md"
FRAMES, SIZE = 150, (320, 240)
LONG = 1000  # frames, so that a signal comes in the middle
SECONDS = 120.0
TRACK = [sys.executable, "-m", "tricue", "track"]
START = ["--box", "60,60,60,60"]


class Result(NamedTuple):
    """Exit code, or minus the signal that ended the process; the last message; what is left of the outputs."""

    code: int
    message: str
    kept: str


class Fault(NamedTuple):
    """A line of the table."""

    name: str
    happen: Callable[[Path], Result]


def square(index: int) -> np.ndarray:
    """A frame, BGR, of a textured square that moves over noise."""
    random = np.random.default_rng(0)
    picture = random.integers(0, 90, (SIZE[1], SIZE[0], 3), np.uint8)
    texture = random.integers(90, 255, (60, 60, 3), np.uint8)
    left = 60 + int(30 * np.sin(index / 10))
    picture[60:120, left : left + 60] = texture
    return picture


@functools.cache
def encoded(suffix: str, frames: int) -> bytes:
    """The bytes of a video of the square."""
    with tempfile.TemporaryDirectory() as folder, OverlayWriter(f"{folder}/v{suffix}", 30.0) as writer:
        for index in range(frames):
            writer.write(square(index))
        writer.close()
        return writer.path.read_bytes()


def write_video(path: Path, frames: int = FRAMES) -> Path:
    """A video of the square."""
    path.write_bytes(encoded(path.suffix, frames))
    return path


def write_images(folder: Path, frames: int = 20) -> Path:
    """A folder of images of the square."""
    folder.mkdir()
    for index in range(frames):
        cv2.imwrite(str(folder / f"{index:04d}.png"), square(index))
    return folder


def outputs(folder: Path) -> list[str]:
    """Options that write all outputs into a folder."""
    files = {"--csv": "o.csv", "--json": "o.json", "--output": "o.mp4"}
    return [word for option, name in files.items() for word in (option, str(folder / name))]


def run(words: list[str], folder: Path, limit: str = "") -> Result:
    """Run a command to its end; limit: arguments of ulimit."""
    command = ["sh", "-c", f'ulimit {limit}; exec "$@"', "sh", *words] if limit else words
    done = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS, check=False, cwd=folder)
    return Result(done.returncode, last_line(done.stderr or done.stdout, folder), left_in(folder))


def interrupt(words: list[str], folder: Path, number: signal.Signals) -> Result:
    """Run a command, and send it a signal once its video has some bytes."""
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=folder)
    deadline = time.monotonic() + SECONDS
    while process.poll() is None and time.monotonic() < deadline and written(folder) < 20:
        time.sleep(0.02)
    process.send_signal(number)
    out, error = process.communicate(timeout=SECONDS)
    return Result(process.returncode, last_line(error or out, folder), left_in(folder))


def written(folder: Path) -> int:
    """The size of the video so far, in units of 4 KB."""
    videos = [*folder.glob("o.mp4"), *folder.glob("o.webm")]
    return sum(video.stat().st_size for video in videos) // 4096


def last_line(text: str, folder: Path) -> str:
    """The last line, or the one about an interruption, without the folder's name."""
    lines = text.strip().splitlines() or [""]
    told = next((each for each in lines if "interrupted" in each or "ended" in each), lines[-1])
    return told.replace(f"{folder}/", "").replace("|", "/")


def left_in(folder: Path) -> str:
    """What can still be read of the outputs."""
    found = [f"{path.suffix[1:]}: {READERS[path.suffix](path)}" for path in sorted(folder.glob("o.*"))]
    return ", ".join(found) or "nothing written"


def _csv_rows(path: Path) -> str:
    with path.open(newline="") as file:
        rows = list(csv.reader(file))
    return f"{max(len(rows) - 1, 0)} rows"


def _json_tracks(path: Path) -> str:
    try:
        return f"{len(json.loads(path.read_text())['tracks'])} tracks"
    except ValueError:
        return "cut off"


def _video_frames(path: Path) -> str:
    if not path.stat().st_size:
        return "empty"
    capture = cv2.VideoCapture(str(path))
    count = 0
    while capture.grab():
        count += 1
    return f"{count} frames" if count else "no frame"


READERS: dict[str, Callable[[Path], str]] = {
    ".csv": _csv_rows,
    ".json": _json_tracks,
    ".mp4": _video_frames,
    ".webm": _video_frames,
}


def interrupted(number: signal.Signals) -> Callable[[Path], Result]:
    """A signal in the middle of a run."""

    def happen(folder: Path) -> Result:
        video = write_video(folder / "in.mp4", LONG)
        return interrupt([*TRACK, str(video), *START, *outputs(folder)], folder, number)

    return happen


def full_disk(folder: Path) -> Result:
    """No file may be larger than 20 blocks of 512 bytes."""
    video = write_video(folder / "in.mp4")
    return run([*TRACK, str(video), *START, *outputs(folder)], folder, "-f 20")


def unwritable(folder: Path) -> Result:
    """An output in a folder that is a file."""
    video = write_video(folder / "in.mp4")
    (folder / "file").touch()
    return run([*TRACK, str(video), *START, "--csv", str(folder / "file" / "o.csv")], folder)


def vanishing(folder: Path) -> Result:
    """The folder of the outputs is removed in the middle of the run."""
    video, out = write_video(folder / "in.mp4", LONG), folder / "out"
    out.mkdir()
    words = [*TRACK, str(video), *START, "--csv", str(out / "o.csv"), "--output", str(out / "o.mp4")]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + SECONDS
    while process.poll() is None and time.monotonic() < deadline and written(out) < 2:
        time.sleep(0.02)
    for path in out.iterdir():
        path.unlink()
    out.rmdir()
    printed, error = process.communicate(timeout=SECONDS)
    return Result(process.returncode, last_line(error or printed, folder), left_in(folder))


def closed_pipe(folder: Path) -> Result:
    """The process that reads the CSV from stdout stops reading."""
    video = write_video(folder / "in.mp4")
    words = [*TRACK, str(video), *START, "--csv", "/dev/stdout"]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=folder)
    assert process.stdout
    process.stdout.readline()
    process.stdout.close()
    assert process.stderr
    error = process.stderr.read()
    return Result(process.wait(timeout=SECONDS), last_line(error, folder), left_in(folder))


def truncated(folder: Path) -> Result:
    """The second half of the input is missing."""
    video = write_video(folder / "in.mkv")
    video.write_bytes(video.read_bytes()[: video.stat().st_size // 2])
    return run([*TRACK, str(video), *START, *outputs(folder)], folder)


def corrupt_frame(folder: Path) -> Result:
    """One of the files isn't an image."""
    images = write_images(folder / "in")
    (images / "0010.png").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(100))
    return run([*TRACK, str(images), *START, *outputs(folder)], folder)


def other_size(folder: Path) -> Result:
    """From the middle on, images have another size."""
    images = write_images(folder / "in")
    for index in range(10, 20):
        cv2.imwrite(str(images / f"{index:04d}.png"), cv2.resize(square(index), (200, 160)))
    return run([*TRACK, str(images), *START, *outputs(folder)], folder)


def jumping_clock(folder: Path) -> Result:
    """Timestamps go back by an hour, stay the same, and jump ahead by a day: expects a finite track per frame."""
    code = (
        "import numpy as np, tricue\n"
        "from tools.faults import square\n"
        "tracker = tricue.FusedTracker()\n"
        "times = [0, .03, .06, -3600, -3600, -3599.97, 86400, 86400.03]\n"
        "tracks = [tracker.init(tricue.Frame(square(0), timestamp=0), (60, 60, 60, 60))]\n"
        "for i, t in enumerate(times[1:], 1):\n"
        "    tracks.append(tracker.update(tricue.Frame(square(i), timestamp=t)))\n"
        "assert np.isfinite([track.box for track in tracks]).all()\n"
        "print(f'{sum(str(t.status) == \"tracked\" for t in tracks)} of {len(tracks)} frames tracked')\n"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(PAGE.parents[1]), *sys.path[1:]])}
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False, env=environment
    )
    return Result(done.returncode, last_line(done.stderr or done.stdout, folder), "-")


def killed(process: str) -> Callable[[Path], Result]:
    """A process gets kill -9 whenever a tracker in ``tricue evaluate --jobs 2`` sees a bright frame.

    process: a Python expression for its number, evaluated in the separate process of a third party's tracker.
    """

    def happen(folder: Path) -> Result:
        (folder / "fragile.py").write_text(
            "import os, signal, tricue\n"
            "class Fragile(tricue.FusedTracker):\n"
            "    def update(self, frame):\n"
            "        if frame.color.mean() > 150:\n"
            f"            os.kill({process}, signal.SIGKILL)\n"
            "        return super().update(frame)\n"
        )
        for name in ("dark", "bright", "other"):
            (folder / "set" / name).mkdir(parents=True)
            images = write_images(folder / "set" / name / "img")
            (folder / "set" / name / "groundtruth_rect.txt").write_text("61,61,60,60\n" * 20)
            for path in images.iterdir() if name == "bright" else ():
                cv2.imwrite(str(path), 255 - square(0))
        options = ["--trackers", "fragile:Fragile", "--jobs", "2", "--output", "results", "--no-restarts"]
        words = [sys.executable, "-m", "tricue", "evaluate", "set", *options]
        done = subprocess.run(words, capture_output=True, text=True, timeout=SECONDS, check=False, cwd=folder)
        runs = list((folder / "results" / "runs").rglob("*.json"))
        lines = [*done.stderr.splitlines(), *done.stdout.splitlines()]
        message = next((each for each in lines if "its process was" in each), done.stderr)
        return Result(done.returncode, last_line(message, folder), f"{len(runs)} of 3 runs")

    return happen


FAULTS = [
    Fault("full disk", full_disk),
    Fault("output that can't be written", unwritable),
    Fault("output folder removed while it runs", vanishing),
    Fault("Ctrl-C (SIGINT)", interrupted(signal.SIGINT)),
    Fault("SIGTERM", interrupted(signal.SIGTERM)),
    Fault("closed terminal (SIGHUP)", interrupted(signal.SIGHUP)),
    Fault("kill -9", interrupted(signal.SIGKILL)),
    Fault("closed pipe", closed_pipe),
    Fault("killed worker of an evaluation", killed("os.getppid()")),
    Fault("killed process of a third party's tracker", killed("os.getpid()")),
    Fault("truncated video", truncated),
    Fault("corrupt image in a folder", corrupt_frame),
    Fault("frames that change their size", other_size),
    Fault("clock that jumps", jumping_clock),
]


ABOUT = """\
## Faults

`python -m tools.faults` causes each fault in a separate process and writes this section. `tricue track` follows a square
through 20 to 1,000 frames and writes a CSV file, a JSON file and a video; "kept" is what can be read of them afterward. A negative exit
code is the signal that ended the process.

| fault | exit code | last message | kept |
| --- | --- | --- | --- |
"""


def line(fault: Fault) -> str:
    """The fault's line of the table."""
    with tempfile.TemporaryDirectory() as folder:
        result = fault.happen(Path(folder))
    message = f"`{result.message}`" if result.message else "none"
    return f"| {fault.name} | {result.code} | {message} | {result.kept} |"


def main() -> int:
    """Try all faults, or those whose names contain a given word, and write the page."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--only", default="", metavar="WORD", help="try these, and print their lines")
    only = parser.parse_args().only
    lines = []
    for fault in FAULTS:
        if only in fault.name:
            lines.append(line(fault))
            print(lines[-1], flush=True)
    if not only:
        PAGE.write_text(with_section(PAGE.read_text(), ABOUT + "\n".join(lines) + "\n"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
