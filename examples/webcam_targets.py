# SPDX-License-Identifier: MIT
"""Several targets before a webcam, or in a video file, each in a color of its own.

    python examples/webcam_targets.py            # the first camera: draw boxes, each with Enter; Esc starts
    python examples/webcam_targets.py video.mp4 --box 128,79,64,78 --box 10,20,40,40 --output overlay.mp4

Drawing boxes and the window need a cv2 with windows (opencv-python, not -headless); without them give --box.
Ctrl-C, or q in the window, ends it.
"""

import argparse
from contextlib import nullcontext

import cv2
import tricue
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
    parser.add_argument("--box", action="append", default=[], help="x,y,width,height, for each target")
    parser.add_argument("--output", help="a video of it, .mp4 or .webm")
    parser.add_argument("--no-window", action="store_true")
    options = parser.parse_args(arguments)
    try:
        track(tricue.open_source(options.source), options)
    except (OSError, ValueError) as error:
        parser.error(str(error))
    except KeyboardInterrupt:
        print("ended")


def choose_boxes(frame: tricue.Frame, texts: list[str], window: bool) -> list[list[float]]:
    """The boxes of the command line, or those that are drawn."""
    boxes = [[float(number) for number in text.split(",")] for text in texts]
    if not boxes and window:
        boxes = [[float(number) for number in box] for box in cv2.selectROIs(TITLE, frame.color)]
    if not boxes:
        raise ValueError("no boxes; draw some, or give --box x,y,width,height")
    return boxes


def track(source: Source, options: argparse.Namespace) -> None:
    """Start on the boxes, follow them, show and write the overlay."""
    window = not options.no_window and has_window()
    writer = None if options.output is None else OverlayWriter(options.output, source.fps)
    with writer or nullcontext(), tricue.MultiTracker(on_lost=report) as several:
        for frame in source:
            frame.require("color")
            if several.ids:
                several.update(frame)
            else:
                for box in choose_boxes(frame, options.box, window):
                    several.add(frame, box)
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
    """Called when a target becomes LOST; it is searched for on."""
    print(f"{target} is lost, last seen near {', '.join(f'{number:.0f}' for number in last.box.center)}")


if __name__ == "__main__":
    main()
