# SPDX-License-Identifier: MIT
"""``python -m tricue.cli.trax``: a tracker behind the TraX protocol on standard input and output.

The VOT toolkit runs it this way.
"""

import argparse
import os
import shlex
import sys
import threading
from collections.abc import Mapping, Sequence
from pathlib import Path

from tricue.cli.arguments import seed, tracker_name
from tricue.cli.program import USAGE, Parser, silence_opencv
from tricue.cli.settings import read_settings
from tricue.errors import one_line
from tricue.evaluation.toolkits.trax_server import TraxTracker, serve
from tricue.track.base.registry import names

PROGRAM = "python -m tricue.cli.trax"
_NOTES = """\
Options that the command line lacks are taken from the environment: TRICUE_TRACKER, TRICUE_SET
("particles=300 min_score=0.2"), TRICUE_PARAMS, TRICUE_SEED, TRICUE_CALIBRATION. That is for VOT's
trackers.ini:

  [color-particle]
  protocol = traxpython
  command = tricue.cli.trax
  env_TRICUE_TRACKER = color-particle
  env_TRICUE_SET = particles=300

Files need absolute paths: the toolkit starts trackers in a folder of its own. tricue vot-workspace writes
such a trackers.ini.
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Serve until the client quits or disconnects. The exit code is 0, or 2 after an error."""
    silence_opencv()
    options = _parser(os.environ).parse_args(arguments)
    try:
        tracker = _read_tracker(options, os.environ)
        if "TRAX_SOCKET" not in os.environ:
            _quit_at_end_of_input()
        serve(tracker)
    except (ImportError, OSError, RuntimeError, TypeError, ValueError) as error:
        print(f"{PROGRAM}: {one_line(error)}", file=sys.stderr)
        return USAGE
    return 0


def _parser(environment: Mapping[str, str]) -> Parser:
    def of(name: str, default: str | None = None) -> str | None:
        return environment.get(f"TRICUE_{name}") or default

    formatter = argparse.RawDescriptionHelpFormatter
    parser = Parser(prog=PROGRAM, description=__doc__, epilog=_NOTES, formatter_class=formatter)
    default = of("TRACKER", names()[0])
    parser.add_argument("--tracker", type=tracker_name, default=default, help="default %(default)s")
    parser.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the tracker"
    )
    parser.add_argument(
        "--params", type=Path, default=of("PARAMS"), metavar="FILE", help="parameters of the tracker, TOML"
    )
    parser.add_argument("--seed", type=seed, default=of("SEED", "0"), help="default %(default)s")
    parser.add_argument(
        "--calibration",
        type=Path,
        default=of("CALIBRATION"),
        metavar="FILE",
        help="the depth camera's; without it a camera with 60 degrees of view is assumed",
    )
    parser.add_argument(
        "--kernels", default="native", choices=("native", "reference"), help="default %(default)s"
    )
    return parser


def _read_tracker(options: argparse.Namespace, environment: Mapping[str, str]) -> TraxTracker:
    settings = [*shlex.split(environment.get("TRICUE_SET", "")), *options.set]  # the later one wins
    values = read_settings(options.tracker, options.params, settings)
    return TraxTracker(options.tracker, values, options.seed, options.kernels, options.calibration)


def _quit_at_end_of_input() -> None:
    """Treat the end of standard input as a quit.

    vot-trax 4.0.2 takes it for a broken message or, between initialize and its frame, reads forever and fills
    the memory. So a thread forwards the input, and appends the quit that a killed client can't send.
    """
    source = os.dup(0)
    readable, writable = os.pipe()
    os.dup2(readable, 0)
    os.close(readable)

    def pass_on() -> None:
        while data := os.read(source, 1 << 16):
            os.write(writable, data)
        os.write(writable, b"\n@@TRAX:quit\n")

    threading.Thread(target=pass_on, daemon=True).start()


if __name__ == "__main__":
    sys.exit(main())
