# SPDX-License-Identifier: MIT
"""All videos of a folder, in processes: a CSV for each, and a summary. An error of one leaves the others.

    python examples/batch_folder.py videos/ --boxes boxes.csv --output tracks/ --jobs 4

boxes.csv has a line for each video, ``name.mp4,x,y,width,height``, pixels of its first frame. Without it each
video starts on the first box of the table beside it: of ``name.mp4`` that is ``name.csv``.
"""

import argparse
import csv
import sys
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

import tricue
from tricue.errors import one_line
from tricue.export.table import columns, row

SUFFIXES = {".avi", ".mkv", ".mov", ".mp4", ".webm"}


def track_video(video: Path, box: list[float] | None, target: Path) -> dict[str, int]:
    """Track one video into a CSV file; its frames, and how many of them have which status."""
    source, tracker = tricue.open_source(video), tricue.FusedTracker()
    counts = {"frames": 0, "tracked": 0, "occluded": 0, "lost": 0}
    with target.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns())
        for number, frame in enumerate(source):
            track = tracker.update(frame) if number else tracker.init(frame, box or source.first_box)
            writer.writerow(row(number, frame.timestamp, track))
            counts["frames"] += 1
            counts[str(track.status)] += 1
    return counts


def read_boxes(path: Path | None) -> dict[str, list[float]]:
    """The boxes by the videos' names. ValueError names a line that has no box."""
    if path is None:
        return {}
    with path.open(newline="", encoding="utf-8") as file:
        lines = csv.reader(file)
        return dict(_named_box(fields, f"{path}:{lines.line_num}") for fields in lines)


def _named_box(fields: list[str], place: str) -> tuple[str, list[float]]:
    try:
        name, x, y, width, height = fields
        return name, [float(x), float(y), float(width), float(height)]
    except ValueError:
        line = ",".join(fields)
        raise ValueError(f"{place}: expected name.mp4,x,y,width,height, got {line!r}") from None


def main(arguments: list[str] | None = None) -> int:
    """Track all, and print the summary; the exit code is 1 where a video failed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--boxes", type=Path)
    parser.add_argument("--output", type=Path, default=Path("tracks"))
    parser.add_argument("--jobs", type=int, default=None, help="processes; by default one for each core")
    options = parser.parse_args(arguments)
    try:
        videos = sorted(path for path in options.folder.iterdir() if path.suffix.lower() in SUFFIXES)
        boxes = read_boxes(options.boxes)
        options.output.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        parser.error(one_line(error))
    failed = 0
    with ProcessPoolExecutor(options.jobs) as pool:
        jobs = {
            pool.submit(
                track_video, video, boxes.get(video.name), options.output / f"{video.stem}.csv"
            ): video
            for video in videos
        }
        for job in as_completed(jobs):
            name = jobs[job].name
            try:
                print(f"{name}: " + ", ".join(f"{count} {what}" for what, count in job.result().items()))
            except Exception as error:  # whatever one video does, the others go on
                failed += 1
                print(f"{name}: {one_line(error)}", file=sys.stderr)
    print(f"{len(videos) - failed} of {len(videos)} videos tracked into {options.output}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
