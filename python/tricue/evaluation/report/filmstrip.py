# SPDX-License-Identifier: MIT
"""Pictures of the worst frames of a run, with the true box and those of the trackers."""

import base64
from collections.abc import Mapping
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.frame import Frame
from tricue.draw.depth_pictures import depth_picture, depth_range
from tricue.errors import one_line
from tricue.evaluation.dataset import OpenedSequence
from tricue.evaluation.evaluate import RunResult
from tricue.evaluation.report.markup import Html, joined, scrolled, tag
from tricue.evaluation.report.plot_styles import LineStyle, swatch
from tricue.evaluation.report.worst_frames import worst_frames

Picture = NDArray[np.uint8]

_MAX_SIDE, _JPEG_QUALITY = 240, 70  # pixels; percent
_TRUTH = LineStyle("#ffffff", "4 4", 1.4)
_EDGES = {_TRUTH: LineStyle("#000000", "", 2.2)}  # under the line, to be visible on any background
_EDGE = LineStyle("#ffffff", "", 3.8)


def filmstrip(
    opened: OpenedSequence, tracker: str, results: Mapping[str, RunResult], styles: Mapping[str, LineStyle]
) -> Html:
    """The first and the worst frames of ``tracker``, with the boxes of all ``results``."""
    main = results[tracker]
    chosen, start = worst_frames(main.scored), main.scored.start
    try:
        frames = list(opened.source.frames([start + index for index in chosen]))
    except (ValueError, OSError) as error:  # the report is complete without pictures
        return tag("p", f"The images of this sequence can't be read: {one_line(error)}", class_="note")
    pictures = _pictures(frames, opened.channel)
    figures = [
        tag(
            "figure",
            _picture(picture, index, results, styles, f"{opened.entry.name}, frame {start + index}"),
            _caption(index, start, results, styles),
            class_="still",
        )
        for index, picture in zip(chosen, pictures, strict=False)
    ]
    return scrolled(joined(figures), f"worst frames of {tracker} on {opened.entry.name}", "film")


def _pictures(frames: list[Frame], channel: str) -> list[Any]:
    """The images in whose pixels the boxes are; depth is shown in the first one's range."""
    if channel != "depth":
        return [frame.color for frame in frames]
    depths = [frame.depth for frame in frames if frame.depth is not None]
    near, far = (depth_range(depths[0]) if depths else None) or (0, 1)
    return [depth_picture(depth, near, far) for depth in depths]


def _picture(
    picture: Picture,
    index: int,
    results: Mapping[str, RunResult],
    styles: Mapping[str, LineStyle],
    label: str,
) -> Html:
    """The image as JPEG, with the boxes over it as SVG, sharp at any size."""
    height, width = picture.shape[:2]
    first = next(iter(results.values())).scored
    boxes = [(each.scored.boxes[index], styles[name], name) for name, each in reversed(list(results.items()))]
    lines = [_box(box, style, name) for box, style, name in [*boxes, (first.truth[index], _TRUTH, "truth")]]
    overlay = tag(
        "svg", lines, viewBox=f"0 0 {width} {height}", preserveAspectRatio="none", aria_hidden="true"
    )
    return tag("div", tag("img", src=_jpeg(picture), alt=label), overlay, class_="picture")


def _box(box: NDArray[np.float64], style: LineStyle, name: str) -> Html:
    if np.isnan(box).any():
        return Html()
    x, y, width, height = (f"{value:.1f}" for value in box)
    return joined(
        [
            tag(
                "rect",
                tag("title", name) if stroke is style else None,
                x=x,
                y=y,
                width=width,
                height=height,
                stroke=stroke.color,
                stroke_width=stroke.width,
                stroke_dasharray=stroke.dashes or None,
            )
            for stroke in (_EDGES.get(style, _EDGE), style)
        ]
    )


def _caption(
    index: int, start: int, results: Mapping[str, RunResult], styles: Mapping[str, LineStyle]
) -> Html:
    heading = tag("strong", f"frame {start + index}"), " (start)" if index == 0 else None
    items = [
        tag(
            "li",
            swatch(styles[name]),
            tag("span", name, class_="who"),
            tag("span", _overlap_and_status(each, index), class_="number"),
        )
        for name, each in results.items()
    ]
    return tag("figcaption", heading, tag("ul", items, class_="legend"))


def _overlap_and_status(result: RunResult, index: int) -> str:
    """The overlap, and the status unless it is TRACKED."""
    run = result.scored
    overlap = run.overlaps[index]
    text = "absent" if run.absent[index] else "no truth" if np.isnan(overlap) else f"{overlap:.2f}"
    status = result.scored.statuses[index]
    return text if run.tracked[index] else f"{text} {str(status).upper()}"


def _jpeg(picture: Picture) -> str:
    scale = min(1.0, _MAX_SIDE / max(picture.shape[:2]))
    small = (
        cv2.resize(picture, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA) if scale < 1 else picture
    )
    done, data = cv2.imencode(".jpg", small, [cv2.IMWRITE_JPEG_QUALITY, _JPEG_QUALITY])
    assert done
    return "data:image/jpeg;base64," + base64.b64encode(data.tobytes()).decode()
