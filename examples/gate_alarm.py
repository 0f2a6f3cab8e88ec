# SPDX-License-Identifier: MIT
"""An alarm when a target leaves a region of the image, is lost, or the camera gives no images.

    python examples/gate_alarm.py rtsp://camera.local/stream --box 128,79,64,78 --region 60,20,200,200
    python examples/gate_alarm.py video.mp4 --box 128,79,64,78 --box 40,90,60,80 --region 60,20,200,200

The region and the boxes are x,y,width,height, pixels. A target is in the region while its box's center is.
Put your siren, message or relay into ``alarm``. Ctrl-C ends it.
"""

import argparse
import sys
from contextlib import suppress
from threading import Timer

import tricue
from tricue.cli.arguments import box
from tricue.data.source import Source

MAX_SILENCE = 2.0  # seconds without images


def alarm(seconds: float, text: str) -> None:
    """Your siren."""
    print(f"{seconds:8.2f} s  ALARM: {text}")


def watch(source: Source, boxes: list[tricue.Box], region: tricue.Box) -> int:
    """Follow all targets through the source; the number of alarms."""
    alarms, now = 0, 0.0

    def raise_alarm(text: str) -> None:
        nonlocal alarms
        alarms += 1
        alarm(now, text)

    def lost(target: int, _: tricue.Track) -> None:
        raise_alarm(f"target {target} is lost")

    def restart(watchdog: Timer) -> Timer:
        """A new watchdog: the loop below waits while no images come, so another thread has to notice."""
        watchdog.cancel()
        new = Timer(MAX_SILENCE, raise_alarm, ["no images come"])
        new.daemon = True
        new.start()
        return new

    watchdog = Timer(MAX_SILENCE, raise_alarm)
    with suppress(KeyboardInterrupt), tricue.MultiTracker(on_lost=lost) as several:
        inside: dict[int, bool] = {}
        for number, frame in enumerate(source):
            watchdog = restart(watchdog)
            now = number / source.fps if frame.timestamp is None else frame.timestamp
            if number == 0:
                for start in boxes:
                    inside[several.add(frame, start)] = region.contains(*start.center)
                continue
            for target, track in several.update(frame).items():
                if track.status is not tricue.Status.TRACKED:
                    continue  # its box is a guess
                here = region.contains(*track.box.center)
                if inside[target] and not here:
                    raise_alarm(f"target {target} has left the region")
                inside[target] = here
    watchdog.cancel()
    return alarms


def main(arguments: list[str] | None = None) -> int:
    """Watch; the exit code is 1 if there was an alarm."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("source", help="a camera's number, a URL, or a file")
    parser.add_argument(
        "--box", type=box, action="append", required=True, help="x,y,width,height, for each target"
    )
    parser.add_argument("--region", type=box, required=True)
    options = parser.parse_args(arguments)
    try:
        alarms = watch(tricue.open_source(options.source), options.box, options.region)
    except (ImportError, OSError, ValueError) as error:
        parser.error(str(error))
    print(f"{alarms} alarms")
    return 1 if alarms else 0


if __name__ == "__main__":
    sys.exit(main())
