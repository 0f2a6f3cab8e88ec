# SPDX-License-Identifier: MIT
"""A run as a thin picture, with time to the right: the overlap as a shade, the status below."""

import base64

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.evaluation.report.markup import Html, tag
from tricue.evaluation.rows import ScoredRun

MAX_COLUMNS = 160
"""Columns of the picture; in longer runs each column shows the worst of several frames."""
SHADES = ("#7a1020", "#c9452f", "#f0a04b", "#f7e0a3", "#b7dfc4", "#8fcbaa")
"""Colors of overlaps from 0 to 1; darker is worse, so that lightness distinguishes them, too."""
ABSENT_COLOR, UNKNOWN, NOT_TRACKED, TRACKED = "#b9c4d6", "#ffffff", "#3b4a63", "#ffffff"
_ROWS, _STATUS_ROWS = 6, 2  # of the picture, which the page stretches


def timeline(run: ScoredRun, label: str) -> Html:
    """The picture of a run; label: its text alternative."""
    columns = np.array_split(np.arange(len(run.overlaps)), min(MAX_COLUMNS, len(run.overlaps)))
    overlap = np.array([_shade(run, frames) for frames in columns], np.uint8)
    status = np.array(
        [_rgb(NOT_TRACKED if (~run.tracked[frames]).any() else TRACKED) for frames in columns], np.uint8
    )
    rows = [overlap] * (_ROWS - _STATUS_ROWS) + [status] * _STATUS_ROWS
    return tag(
        "img", class_="timeline", src=_png(np.stack(rows)), alt=label, width=len(columns), height=_ROWS
    )


def _shade(run: ScoredRun, frames: NDArray[np.int64]) -> tuple[int, ...]:
    known = run.overlaps[frames][~np.isnan(run.overlaps[frames])]
    if not known.size:
        return _rgb(ABSENT_COLOR if run.absent[frames].any() else UNKNOWN)
    return _rgb(SHADES[min(int(known.min() * len(SHADES)), len(SHADES) - 1)])


def _rgb(color: str) -> tuple[int, ...]:
    return tuple(bytes.fromhex(color[1:]))


def _png(picture: NDArray[np.uint8]) -> str:
    done, data = cv2.imencode(".png", picture[:, :, ::-1], [cv2.IMWRITE_PNG_COMPRESSION, 9])
    assert done
    return "data:image/png;base64," + base64.b64encode(data.tobytes()).decode()
