# SPDX-License-Identifier: MIT
"""Pictures of the worst moments of a run, with the true box and those of the trackers drawn over them."""

import base64
from collections.abc import Mapping
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.frame import Frame
from tricue.draw.depth_pictures import depth_picture, depth_range
from tricue.errors import one_line
from tricue.evaluation.dataset import Opened
from tricue.evaluation.evaluate import Result
from tricue.evaluation.report.looks import Look, swatch
from tricue.evaluation.report.markup import Html, joined, scrolled, tag
from tricue.evaluation.report.moments import moments

Picture = NDArray[np.uint8]

_SIDE, _QUALITY = 240, 70  # pixels at most; of the JPEGs
_TRUTH = Look("#ffffff", "4 4", 1.4)
_EDGES = {_TRUTH: Look("#000000", "", 2.2)}  # under the line, so that it shows on any ground
_EDGE = Look("#ffffff", "", 3.8)


def filmstrip(opened: Opened, tracker: str, results: Mapping[str, Result], looks: Mapping[str, Look]) -> Html:
    """The start and the worst moments of ``tracker``, one of the ``results``, whose boxes are all drawn."""
    main = results[tracker]
    chosen, since = moments(main.judged), main.judged.start
    try:
        frames = list(opened.source.frames([since + index for index in chosen]))
    except (ValueError, OSError) as error:  # the numbers are whole without pictures
        return tag("p", f"Its pictures can't be read: {one_line(error)}", class_="note")
    pictures = _pictures(frames, opened.channel)
    figures = [
        tag(
            "figure",
            _drawn(picture, index, results, looks, f"{opened.entry.name}, frame {since + index}"),
            _caption(index, since, results, looks),
            class_="still",
        )
        for index, picture in zip(chosen, pictures, strict=False)
    ]
    return scrolled(joined(figures), f"worst moments of {tracker} on {opened.entry.name}", "film")


def _pictures(frames: list[Frame], channel: str) -> list[Any]:
    """The images whose pixels the boxes count; depth in the shades of the first."""
    if channel != "depth":
        return [frame.color for frame in frames]
    near, far = next((depth_range(frame.depth) for frame in frames if frame.depth is not None), None) or (
        0,
        1,
    )
    return [depth_picture(frame.depth, near, far) for frame in frames if frame.depth is not None]


def _drawn(
    picture: Picture, index: int, results: Mapping[str, Result], looks: Mapping[str, Look], label: str
) -> Html:
    """The picture as JPEG, the boxes over it as lines, sharp at any size."""
    height, width = picture.shape[:2]
    first = next(iter(results.values())).judged
    boxes = [(each.judged.boxes[index], looks[name], name) for name, each in reversed(list(results.items()))]
    lines = [_box(box, look, name) for box, look, name in [*boxes, (first.truth[index], _TRUTH, "truth")]]
    over = tag("svg", lines, viewBox=f"0 0 {width} {height}", preserveAspectRatio="none", aria_hidden="true")
    return tag("div", tag("img", src=_jpeg(picture), alt=label), over, class_="picture")


def _box(box: NDArray[np.float64], look: Look, name: str) -> Html:
    if np.isnan(box).any():
        return Html()
    x, y, width, height = (f"{value:.1f}" for value in box)
    return joined(
        [
            tag(
                "rect",
                tag("title", name) if stroke is look else None,
                x=x,
                y=y,
                width=width,
                height=height,
                stroke=stroke.color,
                stroke_width=stroke.width,
                stroke_dasharray=stroke.dashes or None,
            )
            for stroke in (_EDGES.get(look, _EDGE), look)
        ]
    )


def _caption(index: int, since: int, results: Mapping[str, Result], looks: Mapping[str, Look]) -> Html:
    head = tag("strong", f"frame {since + index}"), " (start)" if index == 0 else None
    said = [
        tag(
            "li",
            swatch(looks[name]),
            tag("span", name, class_="who"),
            tag("span", _said(each, index), class_="number"),
        )
        for name, each in results.items()
    ]
    return tag("figcaption", head, tag("ul", said, class_="legend"))


def _said(result: Result, index: int) -> str:
    """The overlap, and the status where it isn't TRACKED."""
    run = result.judged
    overlap = run.overlaps[index]
    told = "absent" if run.absent[index] else "no truth" if np.isnan(overlap) else f"{overlap:.2f}"
    status = result.judged.statuses[index]
    return told if run.tracked[index] else f"{told} {str(status).upper()}"


def _jpeg(picture: Picture) -> str:
    scale = min(1.0, _SIDE / max(picture.shape[:2]))
    small = (
        cv2.resize(picture, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA) if scale < 1 else picture
    )
    done, data = cv2.imencode(".jpg", small, [cv2.IMWRITE_JPEG_QUALITY, _QUALITY])
    assert done
    return "data:image/jpeg;base64," + base64.b64encode(data.tobytes()).decode()
