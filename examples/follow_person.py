# SPDX-License-Identifier: MIT
"""A robot that follows a person at a distance, with a depth camera or a recording of one.

    python examples/follow_person.py realsense:                      # a live camera; also oak:
    python examples/follow_person.py walk.bag --distance 2           # a recording: prints what it would do
    python examples/follow_person.py sequence/ --box 60,30,25,74     # a box in the first frame
    python examples/follow_person.py walk.bag --pan-tilt             # turns a camera's head instead

Without a box it waits for a person who stands free. The robot, or the head, moves while the person is seen.
It stops while somebody hides them or the score is low, when they are lost, when the images end or can't be
read, and on Ctrl-C. Put your motors into ``drive`` and ``turn_head``. Give them a watchdog that stops them
when no command comes for half a second: this program can't stop them while a camera hangs, or once it is
killed.
"""

import argparse
import math
from dataclasses import replace

import tricue
from tricue.camera.numbers import positive
from tricue.camera.read_calibration import read_intrinsics
from tricue.cli.arguments import box
from tricue.data.source import Source
from tricue.errors import TargetNotFoundError
from tricue.track.pan_tilt import PanTiltCommand

MAX_SPEED, MAX_TURN = 0.8, 1.0  # m/s, rad/s
GAIN, TURN_GAIN = 0.8, 1.5  # 1/s
MIN_SCORE = 0.15  # on rendered people it was 0.2 and more, on recorded ones 0.39 and more


def drive(forward: float, turn: float) -> None:
    """Your motors. forward: m/s. turn: rad/s, to the right."""
    print(f"  forward {forward:+.2f} m/s, turn {turn:+.2f} rad/s")


def turn_head(command: PanTiltCommand) -> None:
    """Your camera's head."""
    print(f"  pan {command.pan_speed:+.2f} rad/s, tilt {command.tilt_speed:+.2f} rad/s")


def standing(command: PanTiltCommand) -> PanTiltCommand:
    """The command that keeps the head where the last one brought it."""
    return command._replace(pan_speed=0.0, tilt_speed=0.0)


def trusted(track: tricue.Track) -> tricue.Track:
    """The track, as LOST unless the person is seen.

    The position of a hidden person is a prediction, which doesn't know that the camera turns: whoever turns
    towards it never gets there.
    """
    seen = track.status is tricue.Status.TRACKED and track.score >= MIN_SCORE and track.position is not None
    return track if seen else replace(track, status=tricue.Status.LOST)


def follow(track: tricue.Track, distance: float) -> tuple[float, float]:
    """Forward speed, and turn to the right, that bring the target straight ahead, at the distance."""
    if track.status is not tricue.Status.TRACKED or track.position is None:
        return 0.0, 0.0
    x, _, z = track.position
    turn = min(max(TURN_GAIN * math.atan2(x, z), -MAX_TURN), MAX_TURN)
    return min(max(GAIN * (z - distance), -MAX_SPEED), MAX_SPEED), turn


def camera_of(source: Source, fov: float | None) -> tricue.Intrinsics:
    """The depth camera: from the device or recording, a file beside the images, or its field of view."""
    if isinstance(source.camera, tricue.Intrinsics):
        return source.camera
    if source.calibration is not None:
        return read_intrinsics(source.calibration, source.size, "depth")
    if fov is None:
        raise ValueError("the camera isn't known; give its horizontal field of view: --fov 57")
    return tricue.Intrinsics.from_fov(*source.size, fov)


def run(source: Source, options: argparse.Namespace) -> None:
    """Follow the person through the source, and stop, however it ends."""
    if "depth" not in source.channels:
        raise ValueError(f"{source.name}: expected depth images, found only {' and '.join(source.channels)}")
    distance = positive(options.distance, "--distance", "meters")
    tracker = tricue.DepthParticleTracker(intrinsics=camera_of(source, options.fov))
    head, command, started = tricue.PanTilt(), PanTiltCommand(0.0, 0.0, 0.0, 0.0), False
    try:
        for number, frame in enumerate(source):
            try:
                track = tracker.update(frame) if started else tracker.init(frame, options.box)
            except TargetNotFoundError:
                print(f"{number}: nobody there")
                continue
            started = True
            print(f"{number}: {track.status}, score {track.score:.2f}")
            if options.pan_tilt:
                command = head.command(trusted(track), timestamp=frame.timestamp)
                turn_head(command)
            else:
                drive(*follow(trusted(track), distance))
    finally:
        if options.pan_tilt:
            turn_head(standing(command))
        else:
            drive(0.0, 0.0)


def main(arguments: list[str] | None = None) -> None:
    """Follow, and print a line per frame."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("source")
    parser.add_argument("--box", type=box, help="x,y,width,height in the first frame")
    parser.add_argument("--distance", type=float, default=1.5, help="meters")
    parser.add_argument("--depth-scale", type=float, help="meters per unit")
    parser.add_argument("--fov", type=float, help="degrees, horizontal")
    parser.add_argument("--pan-tilt", action="store_true")
    options = parser.parse_args(arguments)
    try:
        run(tricue.open_source(options.source, depth_scale=options.depth_scale), options)
    except (ImportError, OSError, ValueError) as error:
        parser.error(str(error))
    except KeyboardInterrupt:
        print("ended")


if __name__ == "__main__":
    main()
