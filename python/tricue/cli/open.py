# SPDX-License-Identifier: MIT
"""``tricue open INPUT``: a page on this machine to draw boxes in a video or a camera, track and export."""

import argparse
from pathlib import Path
from typing import Any

from tricue import app
from tricue.cli.arguments import add_topics, seed, tracker_name
from tricue.cli.calibrations import find_calibration
from tricue.cli.option_names import by_options, naming_options
from tricue.cli.source_options import add_source_options, open_input
from tricue.cli.starts import DEFAULT_TRACKER, by_calibration, depth_tracker
from tricue.data.open_source import Source, live_device
from tricue.track.base.registry import traits

EXAMPLES = """\
examples:
  tricue open video.mp4                                       opens the browser; Ctrl-C ends it
  tricue open video.mp4 --no-browser --port 9000              prints the address
  tricue open images/ --fps 25
  tricue open pair/ --calibration stereo.yml                  positions in meters, the path from above
  tricue open walk.bag --topics color=/rgb/image_raw,depth=/depth/image_raw
  tricue open 0                                               the first camera; also rtsp://..., realsense:
  tricue open video.mp4 --depth depth/ --depth-scale 0.001 --calibration camera.yml
"""


def add_options(command: argparse.ArgumentParser) -> None:
    """Add the command's options to its parser."""
    command.add_argument(
        "input", metavar="INPUT", help="video, folder of images, sequence, recording, URL, camera number"
    )
    command.add_argument(
        "--port", type=int, metavar="N", help="the server's port on 127.0.0.1; 0: any free one"
    )
    command.add_argument("--no-browser", action="store_true", help="only print the address")
    command.add_argument(
        "--tracker",
        type=tracker_name,
        metavar="NAME",
        help="the tracker for new targets, which the page can change",
    )
    command.add_argument(
        "--seed", type=seed, default=0, help="seed of the random numbers, default %(default)s"
    )
    add_topics(command)
    add_source_options(command)


def run(options: argparse.Namespace) -> int:
    """Serve the page until Ctrl-C; return the exit code."""
    app.require()
    if device := live_device(options.input):
        return _serve_camera(options, device.name)
    from tricue.app.serve import serve_project

    source = open_input(options)
    source, cameras, notes = _calibrated(options, source)
    for note in notes:
        print(note)
    serve_project(
        source,
        Path(options.input),
        port=options.port,
        browser=not options.no_browser,
        cameras=cameras,
        tracker=options.tracker or "",
        seed=options.seed,
        notes=notes,
        say=lambda text: print(text, flush=True),
        word=_for_page,
    )
    return 0


def _serve_camera(options: argparse.Namespace, name: str) -> int:
    from tricue.app.live.serve import serve_camera
    from tricue.app.live.session import Opened

    def open_() -> Opened:
        with naming_options():  # for the page, which shows them
            source, cameras, notes = _calibrated(options, open_input(options))
        for note in notes:
            print(note, flush=True)
        return Opened(source, cameras)

    serve_camera(
        open_,
        name,
        port=options.port,
        browser=not options.no_browser,
        tracker=options.tracker or "",
        seed=options.seed,
        say=lambda text: print(text, flush=True),
        word=_for_page,
    )
    return 0


def _for_page(error: str) -> str:
    """An error with options in place of Python's arguments; as the page can't set them, how to."""
    told = by_options(by_calibration(error))
    return told if told == error else f"{told}; end tricue open and start it again with that"


def _calibrated(
    options: argparse.Namespace, source: Source
) -> tuple[Source, dict[str, Any], tuple[str, ...]]:
    """The source as trackers need it, what is known of its cameras, and notes for the user.

    The tracker that takes the most kinds of camera stands in for all, because the user chooses in the page.
    """
    given = {name: value for name, value in vars(options).items() if name != "tracker"}
    general = DEFAULT_TRACKER
    if traits(general).best(source.channels) is None:
        general = depth_tracker()
    found = find_calibration(argparse.Namespace(**given, tracker=general), source)
    notes = (*source.notes, *([found.note] if found.note else []))
    return found.prepare(source), found.keywords, tuple(map(by_options, notes))
