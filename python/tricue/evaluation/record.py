# SPDX-License-Identifier: MIT
"""The result of one run as a JSON file, restored bit for bit."""

import json
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.evaluation.one_pass import Run
from tricue.track.base.track import Status

FORMAT = 1  # of the file


@dataclass(frozen=True, slots=True, eq=False)
class Record:
    """A run over M frames. starts: the frames in which the tracker was started. error: the message of the
    error that ended the tracker, or ""; boxes are NaN from there on. frames: the sequence's frame numbers
    that the tracker saw, in order; None for all.
    """

    run: Run
    starts: tuple[int, ...] = (0,)
    error: str = ""
    frames: tuple[int, ...] | None = None

    @property
    def numbers(self) -> NDArray[np.intp]:
        """The numbers (M,) of its frames in the sequence."""
        return np.array(range(len(self.run.scores)) if self.frames is None else self.frames, dtype=np.intp)

    def to_json(self, about: dict[str, Any]) -> str:
        """The file's text. about: what was run, also stored in the file."""
        run = self.run
        return json.dumps(
            {
                "format": FORMAT,
                **about,
                "trouble": self.error,
                "starts": self.starts,
                **({} if self.frames is None else {"frames": self.frames}),
                "statuses": [str(status) for status in run.statuses],
                **{name: _plain(getattr(run, name)) for name in _ARRAYS},
            },
            allow_nan=False,
        )

    @classmethod
    def from_json(cls, text: str) -> "Record":
        """The record in a file's text; ValueError for anything else."""
        try:
            values = json.loads(text)
            arrays = {name: _array(values[name], shape) for name, shape in _ARRAYS.items()}
            statuses = tuple(map(Status, values["statuses"]))
            frames = None if values.get("frames") is None else tuple(values["frames"])
            return cls(Run(statuses=statuses, **arrays), tuple(values["starts"]), values["trouble"], frames)
        except (KeyError, TypeError) as error:
            raise ValueError(f"record: expected one of this format, got none: {error!r}") from None


_ARRAYS: dict[str, tuple[int, ...]] = {
    "boxes": (4,),
    "scores": (),
    "positions": (3,),
    "covariances": (3, 3),
    "seconds": (),
}


def _plain(array: NDArray[np.float64]) -> list[Any]:
    """One flat row per frame; None for a row or a number that is NaN."""
    if array.ndim == 1:
        return [None if np.isnan(value) else value for value in array.tolist()]
    return [None if np.isnan(row).all() else _plain(row.ravel()) for row in array]


def _array(rows: list[Any], shape: tuple[int, ...]) -> NDArray[np.float64]:
    missing = [np.nan] * int(np.prod(shape))
    array = np.array([missing if row is None else row for row in rows], dtype=np.float64)
    return array.reshape(len(rows), *shape)
