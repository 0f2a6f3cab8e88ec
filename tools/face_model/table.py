# SPDX-License-Identifier: MIT
"""Writes what was learned as a Python file: half of a symmetric template, and the votes."""

import textwrap

import numpy as np

from tools.face_model.learn import GRAIN, Model

FULL, LEFT = (0, 4, 5), (2, 3, 8, 9)  # channels of the template; the others mirror them
MAX_WIDTH = 108  # characters of a line

TEXT = '''\
# SPDX-License-Identifier: MIT
"""What was learned from rendered faces: the template and the votes of `face_detection`.

Written by `python -m tools.face_model --write`.
"""

import numpy as np

SCALE = {scale}  # the template's integers over its weights
BIAS = {bias:.2f}
VOTE_BIAS = {vote_bias:.2f}

# fmt: off
_FULL = np.array([  # gradients across and along one diagonal; mirrored, these are those of other channels
{full}
])
_LEFT = np.array([  # left half and middle column of the others: gradients down and up, gray, redness
{left}
])
VOTES = (  # side of the cell, channel, row, column, threshold, vote
{votes}
)
# fmt: on


def _template() -> np.ndarray:
    """(10, 7, 7) weights of channels, rows and columns."""
    left = np.concatenate([_LEFT, _LEFT[:, :, 2::-1]], axis=2)
    (down, up, gray, redness), (right, falling, rising) = left, _FULL
    mirror = _FULL[:, :, ::-1]
    order = [right, mirror[0], down, up, falling, rising, mirror[2], mirror[1], gray, redness]
    return np.stack(order).astype(np.float32) / SCALE


TEMPLATE = _template()
'''


def table(model: Model) -> str:
    """The text of learned_face.py."""
    template = np.rint(model.template / GRAIN).astype(int)
    return TEXT.format(
        scale=round(1 / GRAIN),
        bias=model.bias,
        vote_bias=model.vote_bias,
        full="\n".join(_matrix(template[channel]) for channel in FULL),
        left="\n".join(_matrix(template[channel, :, :4]) for channel in LEFT),
        votes=_votes(model),
    )


def _matrix(rows: np.ndarray) -> str:
    lines = ("     [" + ", ".join(f"{value:4d}" for value in row) + "]," for row in rows.tolist())
    return "\n".join(["    [", *lines, "    ],"])


def _votes(model: Model) -> str:
    """In lines that no vote is broken by: its spaces are underscores until the text is wrapped."""
    cells = (
        f"({side},_{channel},_{row},_{column},_{threshold:.2f},_{vote:.3f}),"
        for side, channel, row, column, threshold, vote in model.votes
    )
    lines = textwrap.fill(
        " ".join(cells),
        MAX_WIDTH,
        initial_indent="    ",
        subsequent_indent="    ",
        break_on_hyphens=False,
        break_long_words=False,
    )
    return lines.replace("_", " ")
