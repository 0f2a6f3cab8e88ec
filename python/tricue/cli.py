# SPDX-License-Identifier: MIT
"""The command line: parses, calls, prints."""

import argparse
import os
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import NoReturn

import tricue
from tricue.camera.box import Box, as_box
from tricue.errors import one_line
from tricue.track.create import names

USAGE, INTERRUPTED = 2, 130

_TRACK_EXAMPLES = """\
examples:
  tricue track video.mp4 --box 120,80,64,78 --output overlay.mp4 --csv track.csv
  tricue track 0 --detect face --output overlay.mp4           the first camera, until Ctrl-C
  tricue track sequences/David --json track.json              starts on the sequence's first true box
  tricue track images/ --box 10,20,30,40 --set particles=300 --seed 7
  tricue track images/ --box=-5,20,30,40                      a box that begins left of the image
  tricue track depth/ --depth-scale 0.001 --fps 15 --tracker depth-particle --fov 57,43 --plot path.png
  tricue track video.mp4 --depth depth/ --depth-scale 0.001 --tracker depth-particle --calibration camera.yml
  tricue track left.mp4 --right right.mp4 --calibration stereo.yml --tracker stereo-head --detect face
  tricue track kitti/ --tracker stereo-head --box 560,170,30,60 --set near=5 --set far=40
  tricue track pair/ --tracker flow-depth --box 60,30,25,74 --calibration stereo.yml --output overlay.mp4
  tricue track rgbd/ --tracker flow-depth --box 60,30,25,74   color and depth; a target among others
  tricue track video.mp4 --tracker flow-depth --set cues=flow --box 60,30,25,74   without any depth
"""
_DEMO_EXAMPLES = """\
examples:
  tricue demo
  tricue demo depth-particle                                  people before a depth camera, in metres
  tricue demo stereo-head                                     a head before a stereo pair, in metres
  tricue demo flow-depth                                      a walker who is overtaken, before a panning pair
  tricue demo color-particle --kernels reference --output here
"""
_REPRODUCE_EXAMPLES = """\
examples:
  tricue reproduce sabeti-fig1
  tricue reproduce sabeti-depth --jobs 2
  tricue reproduce moreno-fig3 --jobs 2
  tricue reproduce okada-fig8 --jobs 2
  tricue reproduce sabeti-fig2 --seeds 50 --jobs 2 --output results
"""
_VOT_EXAMPLES = """\
examples:
  tricue vot-workspace vot --trackers color-particle --sequences data/
  tricue vot-workspace vot --trackers color-particle,flow-depth --sequences rgbd/
  tricue vot-workspace vot --trackers depth-particle          another tracker, into the same workspace
"""


_EVALUATE_EXAMPLES = """\
examples:
  tricue evaluate sequences/                                  everything; see evaluation/report.html
  tricue evaluate sequences/ --jobs 2                         the same command goes on after Ctrl-C
  tricue evaluate sequences/ --trackers color-particle,CSRT,KCF --seeds 5 --output color
  tricue evaluate sequences/ --trackers color-particle --set color-particle.particles=300
  tricue evaluate recordings/ --depth-scale 0.001 --fps 15    16-bit depth in millimetres, no times
  tricue evaluate /data/all --scheduler tcp://host:8786       a Dask cluster, which sees that folder
"""


_INFO_EXAMPLES = """\
examples:
  tricue info sequences/David
  tricue info sequences/                                      a line for each sequence below
  tricue info depth/ --depth-scale 0.001 --fps 15
  tricue info left.mp4 --right right.mp4 --calibration stereo.yml
  tricue info kitti/ --target "Car 31" --json
"""


class Parser(argparse.ArgumentParser):
    """Errors in one line, without the usage in front."""

    def error(self, message: str) -> NoReturn:
        self.exit(USAGE, f"{self.prog}: {message}; see {self.prog} --help\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; the exit code: 0, 2 for an error (one line on stderr), 130 after Ctrl-C."""
    silence_opencv()
    options = parser().parse_args(arguments)
    try:
        with _warnings_in_a_line(options.verb):
            code: int = options.run(options)
        return code
    except (ImportError, OSError, RuntimeError, TypeError, ValueError) as error:
        print(f"tricue {options.verb}: {one_line(error)}", file=sys.stderr)
        return USAGE
    except KeyboardInterrupt:
        print(f"tricue {options.verb}: interrupted", file=sys.stderr)
        return INTERRUPTED


def parser() -> argparse.ArgumentParser:
    """The verbs and their options."""
    top = Parser(prog="tricue", description=tricue.__doc__)
    top.add_argument("--version", action="version", version=f"tricue {tricue.__version__}")
    verbs = top.add_subparsers(dest="verb", metavar="VERB", required=True)
    _add_demo(_verb(verbs, "demo", "track a scene with known truth", _DEMO_EXAMPLES, _demo))
    _add_track(_verb(verbs, "track", "track in a video, a folder, a camera", _TRACK_EXAMPLES, _track))
    _add_info(_verb(verbs, "info", "say what is in a video, a folder, a sequence", _INFO_EXAMPLES, _info))
    _add_reproduce(
        _verb(verbs, "reproduce", "redo an experiment of the papers", _REPRODUCE_EXAMPLES, _reproduce)
    )
    _add_evaluate(
        _verb(verbs, "evaluate", "trackers beside OpenCV's over a data set", _EVALUATE_EXAMPLES, _evaluate)
    )
    _add_vot(_verb(verbs, "vot-workspace", "let the VOT toolkit run trackers", _VOT_EXAMPLES, _vot_workspace))
    return top


def _verb(
    verbs: "argparse._SubParsersAction[Parser]",
    name: str,
    about: str,
    examples: str,
    run: Callable[[argparse.Namespace], int],
) -> argparse.ArgumentParser:
    formatter = argparse.RawDescriptionHelpFormatter
    verb = verbs.add_parser(name, help=about, description=about, epilog=examples, formatter_class=formatter)
    verb.set_defaults(run=run)
    return verb


def _add_track(verb: argparse.ArgumentParser) -> None:
    verb.add_argument(
        "input", metavar="INPUT", help="video file, folder of images, sequence folder, camera number"
    )
    verb.add_argument("--tracker", default=names()[0], choices=names(), help="default %(default)s")
    start = verb.add_mutually_exclusive_group()
    start.add_argument("--box", type=_box, metavar="X,Y,W,H", help="the box to start on, in pixels")
    start.add_argument(
        "--detect",
        choices=("face", "person"),
        help="start on the largest face, or on whom a depth tracker finds, as soon as there is one",
    )
    verb.add_argument(
        "--fps",
        type=float,
        metavar="N",
        help="frames a second of images that tell no times (default 30); videos, cameras, VOT, TUM and "
        "Princeton have their own",
    )
    _add_stereo(verb)
    _add_depth(verb)
    verb.add_argument("--output", type=Path, metavar="FILE", help="overlay video, .mp4 or .avi")
    verb.add_argument("--csv", type=Path, metavar="FILE", help="a line a frame")
    verb.add_argument(
        "--json", type=Path, metavar="FILE", help="the same, with the tracker and its parameters"
    )
    verb.add_argument("--plot", type=Path, metavar="FILE", help="the path in metres from above, .png")
    verb.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the tracker"
    )
    verb.add_argument("--params", type=Path, metavar="FILE", help="parameters of the tracker, TOML")
    _add_common(verb)


def _add_stereo(verb: argparse.ArgumentParser) -> None:
    verb.add_argument(
        "--right", metavar="PLACE", help="the right camera's video, folder or number; INPUT is the left one's"
    )
    verb.add_argument(
        "--rectify", action="store_true", help="the pairs are raw: rectify them by OpenCV's --calibration"
    )
    verb.add_argument(
        "--unit", type=float, metavar="M", help="metres per unit of the board in OpenCV's --calibration"
    )


def _add_depth(verb: argparse.ArgumentParser) -> None:
    verb.add_argument(
        "--depth", type=Path, metavar="PLACE", help="folder of 16-bit depth images beside a color INPUT"
    )
    verb.add_argument(
        "--depth-scale", type=float, metavar="M", help="metres per unit of depth, 0.001 for millimetres"
    )
    camera = verb.add_mutually_exclusive_group()
    camera.add_argument(
        "--calibration",
        type=Path,
        metavar="FILE",
        help="the camera's or the pair's, by OpenCV, KITTI, Princeton or in TOML",
    )
    camera.add_argument(
        "--fov", type=_angles, metavar="H[,V]", help="the camera's angles of view instead, in degrees"
    )


def _add_info(verb: argparse.ArgumentParser) -> None:
    verb.add_argument("place", metavar="PLACE", help="video file, sequence folder, or folder of sequences")
    verb.add_argument("--depth-scale", type=float, metavar="M", help="metres per unit of depth")
    verb.add_argument("--fps", type=float, metavar="N", help="frames a second of images that tell no times")
    verb.add_argument("--right", metavar="PLACE", help="the right camera's; PLACE is the left one's")
    verb.add_argument("--target", metavar="NAME", help="one of a folder's several targets")
    verb.add_argument("--calibration", type=Path, metavar="FILE", help="instead of the one beside the images")
    verb.add_argument("--json", action="store_true", help="the same as one JSON object")


def _add_demo(verb: argparse.ArgumentParser) -> None:
    verb.add_argument("tracker", nargs="?", default=names()[0], choices=names(), help="default %(default)s")
    verb.add_argument(
        "--output", type=Path, default=Path("demo"), metavar="FOLDER", help="default %(default)s/"
    )
    _add_common(verb)


def _add_reproduce(verb: argparse.ArgumentParser) -> None:
    verb.add_argument(
        "experiment",
        metavar="EXPERIMENT",
        help="sabeti-fig1, sabeti-fig2, sabeti-depth, moreno-fig3, okada-fig8",
    )
    verb.add_argument(
        "--seeds", type=int, default=20, help="runs of each model on each scene, default %(default)s"
    )
    verb.add_argument("--jobs", type=int, default=1, help="processes, default %(default)s")
    verb.add_argument(
        "--output", type=Path, default=Path("results"), metavar="FOLDER", help="default %(default)s/"
    )


def _add_vot(verb: argparse.ArgumentParser) -> None:
    verb.add_argument("folder", type=Path, metavar="FOLDER", help="new, or a workspace to add to")
    verb.add_argument("--trackers", type=_words, required=True, metavar="NAMES", help="with commas between")
    verb.add_argument(
        "--sequences",
        type=Path,
        metavar="DATA",
        help="folder of sequences with true boxes, of any known layout",
    )
    verb.add_argument(
        "--python",
        default=sys.executable,
        metavar="PATH",
        help="the interpreter with tricue[vot], default this one; the toolkit may be in another environment",
    )


def _add_evaluate(verb: argparse.ArgumentParser) -> None:
    verb.add_argument(
        "dataset", type=Path, metavar="DATASET", help="a sequence with true boxes, or a folder of them"
    )
    verb.add_argument(
        "--trackers", type=_words, metavar="NAMES", help="ours and cv2's, with commas between; all without it"
    )
    verb.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="TRACKER.NAME=VALUE",
        help="a parameter of one of our trackers",
    )
    verb.add_argument(
        "--seeds",
        type=_count,
        default=3,
        metavar="N",
        help="runs of those that draw random numbers, default %(default)s",
    )
    verb.add_argument(
        "--no-restarts", action="store_true", help="leave out the runs that start again after a failure"
    )
    where = verb.add_mutually_exclusive_group()
    where.add_argument("--jobs", type=_count, default=1, metavar="N", help="processes, default %(default)s")
    where.add_argument("--scheduler", metavar="ADDRESS", help="of a Dask cluster, tcp://HOST:PORT")
    verb.add_argument("--fresh", action="store_true", help="run again what was run before")
    verb.add_argument(
        "--output", type=Path, default=Path("evaluation"), metavar="FOLDER", help="default %(default)s/"
    )
    verb.add_argument(
        "--depth-scale",
        type=float,
        metavar="M",
        help="metres per unit of depth, where the format doesn't say",
    )
    verb.add_argument("--fps", type=float, metavar="N", help="frames a second of images that tell no times")
    verb.add_argument(
        "--unit", type=float, metavar="M", help="metres per unit of the board in OpenCV's calibrations"
    )
    verb.add_argument(
        "--truth",
        choices=("color", "depth"),
        help="the channel whose pixels the true boxes count, if both are there",
    )


def _add_common(verb: argparse.ArgumentParser) -> None:
    verb.add_argument(
        "--kernels", default="native", choices=("native", "reference"), help="default %(default)s"
    )
    verb.add_argument("--seed", type=int, default=0, help="of the random numbers, default %(default)s")


def _track(options: argparse.Namespace) -> int:
    from tricue.commands.track import track

    return track(options)


def _info(options: argparse.Namespace) -> int:
    from tricue.commands.info import info

    return info(options)


def _demo(options: argparse.Namespace) -> int:
    from tricue.commands.demo import demo

    return demo(options)


def _reproduce(options: argparse.Namespace) -> int:
    from tricue.commands.reproduce import reproduce

    return reproduce(options)


def _evaluate(options: argparse.Namespace) -> int:
    from tricue.commands.evaluate import run

    return run(options)


def _vot_workspace(options: argparse.Namespace) -> int:
    from tricue.commands.vot_workspace import vot_workspace

    return vot_workspace(options)


def _count(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"expected a whole number above 0, got {text!r}")
    return int(text)


def _words(text: str) -> list[str]:
    words = [word.strip() for word in text.split(",") if word.strip()]
    if not words:
        raise argparse.ArgumentTypeError(f"expected names with commas between, got {text!r}")
    return words


def _box(text: str) -> Box:
    try:
        return as_box([float(number) for number in text.split(",")])
    except ValueError as error:
        reason = (
            str(error)
            if str(error).startswith("box:")
            else f"expected four numbers x,y,width,height, got {text!r}"
        )
        raise argparse.ArgumentTypeError(reason.removeprefix("box: ")) from None


def _angles(text: str) -> tuple[float, ...]:
    try:
        angles = tuple(float(number) for number in text.split(","))
    except ValueError:
        angles = ()
    if len(angles) not in (1, 2):
        raise argparse.ArgumentTypeError(f"expected one angle or two, H,V in degrees, got {text!r}")
    return angles


@contextmanager
def _warnings_in_a_line(verb: str) -> Iterator[None]:
    """Warnings as short as errors; a place in the code warns once, for the next frames would say the same."""
    told: set[tuple[str, int]] = set()

    def show(message: Warning | str, _category: object, filename: str, lineno: int, *_: object) -> None:
        if (filename, lineno) not in told:
            told.add((filename, lineno))
            print(f"tricue {verb}: warning: {message}", file=sys.stderr)

    with warnings.catch_warnings():
        warnings.showwarning = show  # type: ignore[assignment]  # it takes all that it is given
        yield


def silence_opencv() -> None:
    """OpenCV and FFmpeg write to stderr by themselves; what matters of it comes as an exception."""
    os.environ.setdefault("OPENCV_LOG_LEVEL", "SILENT")
    os.environ.setdefault("OPENCV_FFMPEG_LOGLEVEL", "-8")
