# SPDX-License-Identifier: MIT
"""What came of one run, as a file: a JSON object that is the same again, bit for bit, when it is read."""

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
    """A run over M frames. starts: the frames in which the tracker was started, the first of them by the rule
    of every run. trouble: the error with which it refused to start or stopped, "" without one; its boxes are
    NaN from there.
    """

    run: Run
    starts: tuple[int, ...] = (0,)
    trouble: str = ""

    def to_json(self, about: dict[str, Any]) -> str:
        """The file's text. about: what was run, so that the file explains itself."""
        run = self.run
        return json.dumps(
            {
                "format": FORMAT,
                **about,
                "trouble": self.trouble,
                "starts": self.starts,
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
            return cls(Run(statuses=statuses, **arrays), tuple(values["starts"]), values["trouble"])
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
    """A row a frame, flat; None for one without numbers, and for a number that isn't there."""
    if array.ndim == 1:
        return [None if np.isnan(value) else value for value in array.tolist()]
    return [None if np.isnan(row).all() else _plain(row.ravel()) for row in array]


def _array(rows: list[Any], shape: tuple[int, ...]) -> NDArray[np.float64]:
    missing = [np.nan] * int(np.prod(shape))
    array = np.array([missing if row is None else row for row in rows], dtype=np.float64)
    return array.reshape(len(rows), *shape)
