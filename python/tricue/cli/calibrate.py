# SPDX-License-Identifier: MIT
"""``tricue calibrate WHAT``: parameters of the trackers, measured on the user's own images."""

import argparse
import os
import shutil
import tempfile
import warnings
from collections.abc import Iterable, Iterator, Mapping
from itertools import chain, tee
from pathlib import Path
from typing import Any

from tricue.camera import toml
from tricue.cli.arguments import box, meters, output_file, share
from tricue.cli.calibrations import find_calibration
from tricue.cli.output_files import check_not_read
from tricue.data.color_samples import read_color_samples
from tricue.data.input_files import input_files
from tricue.data.open_source import open_source
from tricue.data.skin_masks import find_masked_images, is_mask_folder
from tricue.draw.writable import check_writable, naming
from tricue.errors import MissingChannelError
from tricue.track.base.params import Params
from tricue.track.base.registry import tracker_class

EXAMPLES = """\
examples:
  tricue calibrate skin-threshold skin/ --output skin.toml          skin/image/ and skin/mask/
  tricue calibrate head-colors --skin skin/ --hair hair/ --output head.toml
  tricue calibrate stereo-noise pair/ --box 60,30,25,33 --calibration stereo.yml --output noise.toml
  tricue calibrate stereo-noise pair/ --params head.toml --output head.toml       adds to a file
  tricue track video.mp4 --tracker color-particle --params skin.toml --box 120,80,64,78
"""
RATES = (0.02, 0.05, 0.1, 0.2, 0.3)
"""False-positive rates at which the threshold is printed."""

MAX_DISTANCE_RATIO = 1.5
"""Between a head's given and measured distance; matches on a blurred head may be this far off."""


def add_options(command: argparse.ArgumentParser) -> None:
    """Add the command's options to its parser."""
    kinds = command.add_subparsers(dest="what", metavar="WHAT", required=True)
    skin = kinds.add_parser("skin-threshold", help="of color-particle, from images with masks of the skin")
    skin.add_argument("place", type=Path, metavar="FOLDER", help="with image/ and mask/, white where skin is")
    skin.add_argument(
        "--false-positives",
        type=share,
        default=0.1,
        metavar="SHARE",
        help="share of the other pixels that may be taken for skin, default %(default)s",
    )
    skin.set_defaults(measure=_skin_threshold, tracker="color-particle")
    head = kinds.add_parser("head-colors", help="of stereo-head, from samples of skin and of hair")
    for part in ("skin", "hair"):
        head.add_argument(
            f"--{part}",
            type=Path,
            required=True,
            metavar="PLACE",
            help=f"images with masks of the {part}, image/ and mask/, or a recording with boxes",
        )
    head.add_argument(
        "--hair-weight",
        type=share,
        metavar="SHARE",
        help="share of hair in the model, default: parameter hair",
    )
    head.set_defaults(measure=_head_colors, tracker="stereo-head")
    noise = kinds.add_parser("stereo-noise", help="of stereo-head, from stereo pairs of a head at rest")
    noise.add_argument("input", metavar="INPUT", help="as for tricue track")
    noise.add_argument("--box", type=box, metavar="X,Y,W,H", help="the head; default the first true box")
    noise.add_argument("--distance", type=meters, metavar="M", help="to the face along the camera's axis")
    noise.add_argument("--right", metavar="PLACE", help="the right camera's images; INPUT is the left one's")
    noise.add_argument("--calibration", type=Path, metavar="FILE", help="of the stereo pair")
    noise.add_argument(
        "--rectify", action="store_true", help="rectify the stereo pairs first, by OpenCV's --calibration"
    )
    noise.add_argument("--unit", type=float, metavar="M", help="meters per unit of its board")
    noise.set_defaults(measure=_stereo_noise, tracker="stereo-head", fov=None)
    for kind in (skin, head, noise):
        kind.add_argument(
            "--params", type=Path, metavar="FILE", help="parameters to measure with and to keep, TOML"
        )
        kind.add_argument(
            "--output", type=output_file, required=True, metavar="FILE", help="parameters, TOML"
        )


def run(options: argparse.Namespace) -> int:
    """Measure, print, and write the parameters; return the exit code."""
    kind = tracker_class(options.tracker).Params
    params = kind.from_toml(options.params) if options.params else kind()
    given = toml.read(options.params) if options.params else {}
    measured = options.measure(options, params)
    _write(options.output, kind, given | measured, measured)
    print(f"wrote {options.output}; tricue track --tracker {options.tracker} --params {options.output}")
    return 0


def _skin_threshold(options: argparse.Namespace, _params: Any) -> dict[str, Any]:
    from tricue.papers.roc import LOWEST_SKIN_THRESHOLD, round_up, skin_roc

    pairs = find_masked_images(options.place)
    _check_output(options.output, chain.from_iterable(pairs))
    with_skin = 0

    def read() -> Iterator[tuple[Any, Any]]:
        nonlocal with_skin
        for pair in pairs:
            image, mask = pair.read()
            with_skin += bool(mask.any())
            yield image, mask

    images, masks = tee(read())
    try:
        curve = skin_roc((image for image, _ in images), (mask for _, mask in masks))
    except ValueError as error:
        if str(error).startswith("masks:"):
            raise ValueError(f"{options.place}: {error}") from None
        raise
    threshold, _ = curve.at_false_positive_rate(options.false_positives, LOWEST_SKIN_THRESHOLD)
    count = f"{len(pairs)} images, {with_skin} with skin"
    print(f"{options.place}: {count}, area under the ROC curve {curve.area:.3f}")
    for rate in sorted({*RATES, options.false_positives}):
        at, found = curve.at_false_positive_rate(rate, LOWEST_SKIN_THRESHOLD)
        print(f"  false positives {rate:5.1%}: threshold {round_up(at, 3):6.3f}, {found:.1%} of the skin")
    return {"skin_threshold": round_up(threshold, 4)}


def _head_colors(options: argparse.Namespace, params: Any) -> dict[str, Any]:
    from tricue.track.stereo_head.color_samples import head_colors

    _check_output(options.output, chain(_sample_files(options.skin), _sample_files(options.hair)))
    weight = params.hair if options.hair_weight is None else options.hair_weight
    skin, hair = read_color_samples(options.skin), read_color_samples(options.hair)
    colors = head_colors(skin, hair, weight, params)
    print(f"{len(colors)} of {params.bins[0] * params.bins[1] * params.bins[2]} bins have a color")
    return {"bins": params.bins, "max_chroma": params.max_chroma, "head_colors": colors}


def _sample_files(place: Path) -> Iterator[Path]:
    """The files that the samples of a color are read from."""
    if is_mask_folder(place):
        return chain.from_iterable(find_masked_images(place))
    return input_files(open_source(place), place)


def _stereo_noise(options: argparse.Namespace, params: Any) -> dict[str, Any]:
    from tricue.track.stereo_head.static_head import measure_static_head

    source = open_source(options.input, right=options.right)
    places = [Path(place) for place in (options.input, options.right) if place]
    given = [*places, options.calibration] if options.calibration else places
    _check_output(options.output, chain(given, input_files(source, *places)))
    found = find_calibration(options, source, without="the head's place won't be measured in meters")
    head = options.box or source.first_box
    if head is None:
        raise ValueError(f"{source.name}: expected a box; give --box x,y,width,height")
    if options.distance is not None and found.rig is None:
        raise ValueError("--distance: expected with the stereo pair's calibration, --calibration FILE")
    try:
        static = measure_static_head(found.prepare(source), head, found.rig, params)
    except ValueError as error:
        raise ValueError(f"{source.name}: {error}{_hint(error)}") from None
    if options.distance is not None:
        _check_distance(options.distance, float(static.positions[:, 2].mean()))
    if static.moves:
        warnings.warn(
            f"{source.name}: the head seems to move, which counts as noise; record a head at rest",
            stacklevel=2,
        )
    measured = static.noise
    pairs = f"{static.frames} stereo pairs after the first, which gives the model"
    print(f"{source.name}: a head measured in {len(static.colors)} of {pairs}")
    if options.distance is not None:
        assert found.rig
        measured["disparity_noise"] = static.disparity_noise(found.rig, options.distance)
    measured = {name: _rounded(value) for name, value in measured.items()}
    for name, value in measured.items():
        print(f"  {name:18} {value}")
    if found.rig:
        for axis, values in zip("XYZ", static.positions.T, strict=True):
            print(f"  {axis} {values.mean():8.3f} m ± {1000 * values.std(ddof=1):.1f} mm")
    return measured


def _hint(error: ValueError) -> str:
    """How to give the right images where there are none."""
    missing = isinstance(error, MissingChannelError) and error.channel == "right"
    return "; give the right camera's images with --right PLACE" if missing else ""


def _check_distance(given: float, measured: float) -> None:
    """ValueError if the given distance, meters, doesn't fit the measured one: it is in another unit, or of
    another head or camera. The difference would count as noise.
    """
    if not 1 / MAX_DISTANCE_RATIO < given / measured < MAX_DISTANCE_RATIO:
        raise ValueError(
            f"--distance: expected about {measured:.2f} m, as the pairs measure, got {given:g}; "
            "is the calibration in meters (--unit), and of these cameras?"
        )


def _rounded(value: Any) -> Any:
    if isinstance(value, tuple):
        return tuple(_rounded(each) for each in value)
    return float(f"{value:.4g}")


def _check_output(path: Path, read: Iterable[Path]) -> None:
    """ValueError for an output that is among the files that are read, OSError for one that can't be written.

    Both before anything is measured.
    """
    check_not_read([path], read)
    check_writable(path)


def _write(path: Path, kind: type[Params], values: Mapping[str, Any], measured: Mapping[str, Any]) -> None:
    """Write the parameters, after checking them, as a whole file or not at all.

    A link stays a link. A pipe, a device, or a file in a folder where no file can be created is written into.
    """
    kind(**values)
    text = toml.dumps(values, dict.fromkeys(measured, "from tricue calibrate"))
    with naming(path):  # not the temporary file
        if path.exists() and not (path.is_file() and os.access(path.resolve().parent, os.W_OK)):
            path.write_text(text, encoding="utf-8")
        else:
            _replace(path.resolve(), text)


def _replace(path: Path, text: str) -> None:
    """Write a regular file beside the existing one, then replace that."""
    path.parent.mkdir(parents=True, exist_ok=True)
    number, name = tempfile.mkstemp(prefix=".tricue-", dir=path.parent)
    part = Path(name)
    try:
        with os.fdopen(number, "w", encoding="utf-8") as file:
            file.write(text)
        if not path.exists():
            path.touch()  # gives it the mode of a new file
        shutil.copymode(path, part)
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
