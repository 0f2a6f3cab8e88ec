# SPDX-License-Identifier: MIT
"""A frame in a notebook: its channels as small pictures."""

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.frame import Frame
from tricue.draw.depth_pictures import depth_picture, depth_range
from tricue.evaluation.report.markup import Html
from tricue.notebook.markup import faint, picture, strong, text

MAX_SHOWN_WIDTH = 320  # pixels
SCALE_SIZE = 12, 120  # pixels, of the depth scale

_WHAT = {"color": "color", "right": "right image", "depth": "depth"}


def frame_html(frame: Frame) -> Html:
    """The pictures side by side, each with its size; depth in colors, with a scale in meters."""
    moment = "" if frame.timestamp is None else f" at {frame.timestamp:.3f} s"
    place = "" if frame.pose is None else ", with a pose"
    figures = "".join(_figure(name, getattr(frame, name)) for name in frame.channels)
    row = "display:flex;flex-wrap:wrap;gap:0.5em 1.5em"
    return Html(f'{strong("Frame")}{text(moment + place)}<div style="{row}">{figures}</div>')


def _figure(name: str, image: NDArray[Any]) -> str:
    height, width = image.shape[:2]
    words = [_WHAT[name], f"{width}x{height} px"]
    if name == "depth":
        shown, scale = _depth(image)
        words.append(f"{np.isfinite(image).mean():.0%} measured")
    else:
        shown, scale = image, Html("")
        words += ["gray"] * (image.ndim == 2)
    caption = f"<figcaption>{faint(', '.join(words))}</figcaption>"
    return f'<figure style="margin:0">{picture(_small(shown), words[0])}{scale}{caption}</figure>'


def _depth(depth: NDArray[np.float32]) -> tuple[NDArray[np.uint8], Html]:
    """The depth in colors, and its color scale; there is no scale if nothing is measured."""
    found = depth_range(depth)
    if found is None:
        return depth_picture(depth), Html("")
    near, far = found
    width, height = SCALE_SIZE
    ramp = np.repeat(np.linspace(near, far, height, dtype=np.float32)[:, None], width, axis=1)
    column = "display:inline-flex;flex-direction:column;align-items:flex-start"
    column += ";vertical-align:middle;margin-left:0.5em"
    labels = f"<span>{near:.2f} m</span>{picture(depth_picture(ramp, near, far), 'scale of depth')}"
    return depth_picture(depth, near, far), Html(
        f'<span style="{column}">{labels}<span>{far:.2f} m</span></span>'
    )


def _small(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """A copy of at most MAX_SHOWN_WIDTH."""
    height, width = image.shape[:2]
    if width <= MAX_SHOWN_WIDTH:
        return image
    size = MAX_SHOWN_WIDTH, max(1, round(height * MAX_SHOWN_WIDTH / width))
    return np.asarray(cv2.resize(image, size, interpolation=cv2.INTER_AREA), np.uint8)
