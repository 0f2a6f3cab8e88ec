# SPDX-License-Identifier: MIT
"""Several targets in front of a webcam or in a video file, each in a color of its own.

    python examples/webcam_targets.py            # the first camera: draw boxes, Enter after each; Esc starts
    python examples/webcam_targets.py video.mp4 --box 128,79,64,78 --box 10,20,40,40 --output overlay.mp4

Drawing boxes and the window need a cv2 with windows (opencv-python, not -headless); without one give --box.
Ctrl-C, or q in the window, ends it.
"""

import argparse
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path

import cv2
import numpy as np
import tricue
from numpy.typing import NDArray
from tricue.camera.box import BoxLike
from tricue.cli.arguments import box
from tricue.cli.output_files import check_not_read
from tricue.data.input_files import input_files
from tricue.data.source import Source
from tricue.draw import OverlayWriter, targets_overlay

TITLE = "targets: q ends"


def has_window() -> bool:
    """Whether the installed cv2 can open windows."""
    try:
        cv2.namedWindow(TITLE)
        return True
    except cv2.error:
        return False


def main(arguments: list[str] | None = None) -> None:
    """Track until the video or the user ends it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("source", nargs="?", default="0", help="a camera's number, a URL, or a file")
    parser.add_argument(
        "--box", type=box, action="append", default=[], help="x,y,width,height, for each target"
    )
    parser.add_argument("--output", help="overlay video, .mp4 or .webm")
    parser.add_argument("--no-window", action="store_true")
    options = parser.parse_args(arguments)
    try:
        track(tricue.open_source(options.source), options)
    except (ImportError, OSError, ValueError) as error:
        parser.error(str(error))
    except KeyboardInterrupt:
        print("ended")


def choose_boxes(image: NDArray[np.uint8], given: list[tricue.Box], window: bool) -> Sequence[BoxLike]:
    """The boxes of the command line, or those that are drawn."""
    boxes: Sequence[BoxLike] = given or (cv2.selectROIs(TITLE, image) if window else [])
    if not len(boxes):
        raise ValueError("no boxes; draw some, or give --box x,y,width,height")
    return boxes


def track(source: Source, options: argparse.Namespace) -> None:
    """Start on the boxes, follow them, show and write the overlay."""
    window = not options.no_window and has_window()
    writer = None if options.output is None else OverlayWriter(options.output, source.fps)
    if writer is not None:
        check_not_read([writer.path], input_files(source, Path(options.source)))
    with writer or nullcontext(), tricue.MultiTracker(on_lost=report) as several:
        for frame in source:
            frame.require("color")
            assert frame.color is not None
            if several.ids:
                several.update(frame)
            else:
                for each in choose_boxes(frame.color, options.box, window):
                    several.add(frame, each)
            picture = targets_overlay(frame.color, several.tracks)
            if writer is not None:
                writer.write(picture, frame.timestamp)
            if window:
                cv2.imshow(TITLE, picture)
                if cv2.waitKey(1) == ord("q"):
                    break
        for target, last in several.tracks.items():
            print(f"{target}: {last.status} at the end, score {last.score:.2f}")


def report(target: int, last: tricue.Track) -> None:
    """Called when a target becomes LOST; the search for it goes on."""
    print(f"{target} is lost, last seen near {', '.join(f'{number:.0f}' for number in last.box.center)}")


if __name__ == "__main__":
    main()
