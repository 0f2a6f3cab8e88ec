# SPDX-License-Identifier: MIT
"""All videos of a folder, in processes: a CSV for each, and a summary. An error in one stops no other.

    python examples/batch_folder.py videos/ --boxes boxes.csv --output tracks/ --jobs 4

boxes.csv has a line for each video, ``name.mp4,x,y,width,height``, pixels of its first frame. A video without
a line starts on the first box of the table beside it, ``name.csv`` for ``name.mp4``. A CSV is written once
its whole video is tracked; Ctrl-C keeps those already written.
"""

import argparse
import csv
import signal
import sys
from collections.abc import Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from pathlib import Path

import tricue
from tricue.cli.arguments import count as whole_number
from tricue.errors import one_line
from tricue.export.table import columns, row

SUFFIXES = {".avi", ".mkv", ".mov", ".mp4", ".webm"}


def track_video(video: Path, box: list[float] | None, target: Path) -> dict[str, int]:
    """Track one video into a CSV file; the number of frames, in total and by status."""
    source, tracker = tricue.open_source(video), tricue.FusedTracker()
    start = box or source.first_box
    if start is None:
        raise ValueError(f"no box; give it a line in --boxes, or {video.with_suffix('.csv').name} beside it")
    counts = {"frames": 0, "tracked": 0, "occluded": 0, "lost": 0}
    rows: list[Sequence[object]] = [columns()]
    for number, frame in enumerate(source):
        track = tracker.update(frame) if number else tracker.init(frame, start)
        rows.append(row(number, frame.timestamp, track))
        counts["frames"] += 1
        counts[str(track.status)] += 1
    with target.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows(rows)
    return counts


def plan(folder: Path, boxes: dict[str, list[float]], output: Path) -> dict[Path, Path]:
    """The CSV of each video. ValueError if one would overwrite another, or lie beside its video."""
    videos = sorted(
        path
        for path in folder.iterdir()
        if path.suffix.lower() in SUFFIXES and not path.name.startswith(".")  # macOS leaves such beside files
    )
    if not videos:
        raise ValueError(f"{folder}: no videos ({', '.join(sorted(SUFFIXES))})")
    if strays := sorted(boxes.keys() - {video.name for video in videos}):
        raise ValueError(f"--boxes: {folder} has no {', '.join(strays)}")
    if output.resolve() == folder.resolve():
        raise ValueError("--output: expected another folder than the videos', whose tables may be there")
    targets = {output / f"{video.stem}.csv": video for video in videos}
    for video in videos:
        if (other := targets[output / f"{video.stem}.csv"]) is not video:
            raise ValueError(f"{video.name} and {other.name} would have the same CSV; rename one")
    return {video: target for target, video in targets.items()}


def read_boxes(path: Path | None) -> dict[str, list[float]]:
    """The boxes by the videos' names. A ValueError names the line without a box."""
    if path is None:
        return {}
    with path.open(newline="", encoding="utf-8-sig") as file:  # spreadsheets add a byte-order mark
        lines = csv.reader(file)
        return dict(_named_box(fields, f"{path}:{lines.line_num}") for fields in lines if fields)


def _named_box(fields: list[str], place: str) -> tuple[str, list[float]]:
    try:
        name, x, y, width, height = fields
        return name, [float(x), float(y), float(width), float(height)]
    except ValueError:
        line = ",".join(fields)
        raise ValueError(f"{place}: expected name.mp4,x,y,width,height, got {line!r}") from None


def report(name: str, job: Future[dict[str, int]]) -> bool:
    """Print a video's result or error; whether it was tracked. No error stops the others."""
    try:
        print(f"{name}: " + ", ".join(f"{count} {what}" for what, count in job.result().items()))
    except Exception as error:
        print(f"{name}: {one_line(error)}", file=sys.stderr)
        return False
    return True


def main(arguments: list[str] | None = None) -> int:
    """Track all, and print the summary; the exit code is 1 if a video failed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--boxes", type=Path)
    parser.add_argument("--output", type=Path, default=Path("tracks"))
    parser.add_argument("--jobs", type=whole_number, help="processes; by default one for each core")
    options = parser.parse_args(arguments)
    try:
        boxes = read_boxes(options.boxes)
        targets = plan(options.folder, boxes, options.output)
        options.output.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        parser.error(one_line(error))
    # By default Ctrl-C would end only a process's current video, and the process would start the next one.
    # Programs that a shell runs in the background ignore Ctrl-C.
    ignored = signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    hearing = signal.SIGINT, signal.SIG_IGN if ignored else signal.SIG_DFL
    with ProcessPoolExecutor(options.jobs, None, signal.signal, hearing) as pool:
        jobs = {
            pool.submit(track_video, video, boxes.get(video.name), target): video.name
            for video, target in targets.items()
        }
        try:
            failed = sum(not report(jobs[job], job) for job in as_completed(jobs))
        except KeyboardInterrupt:
            pool.shutdown(cancel_futures=True)
            print("ended")
            return 130
    print(f"{len(targets) - failed} of {len(targets)} videos tracked into {options.output}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
