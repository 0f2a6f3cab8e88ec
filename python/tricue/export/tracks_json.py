# SPDX-License-Identifier: MIT
"""Tracks as JSON: what was run, a row per frame and target, the targets, and where they are lost."""

import json
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

from tricue.export.lost_ranges import LostRanges, as_json
from tricue.export.table import PLAIN, TableForm, columns, row
from tricue.track.base.track import Track


class NamedTarget(NamedTuple):
    """A target's id and name, and the name of its tracker."""

    id: int
    name: str
    tracker: str


class TracksJson:
    """The text of one object, piece by piece, so that it can be written while tracking goes on.

    Its keys are those of ``about``, which describe the run; "tracks", a list of objects with the columns as
    keys; "targets"; "lost", the ranges of frames in which a target is lost; "fps". rate: gives the frames per
    second.
    """

    def __init__(self, rate: Callable[[], float], form: TableForm = PLAIN) -> None:
        self._rate, self._form = rate, form
        self._names = columns(form)
        self._lost: dict[int, LostRanges] = {}
        self._separator = "\n"

    def begin(self, about: Mapping[str, Any]) -> str:
        """The text before the first frame."""
        return json.dumps(about, indent=1, allow_nan=False).removesuffix("\n}") + ',\n "tracks": ['

    def add(self, number: int, seconds: float | None, tracks: Mapping[int, Track]) -> str:
        """The rows of the next frame. seconds: its time, None if unknown. tracks: by their targets' ids.

        A frame in which a target has no track ends a range in which it is lost.
        """
        time = number / self._rate() if seconds is None else seconds
        text = ""
        for target, track in tracks.items():
            values = dict(zip(self._names, row(number, seconds, track, target, self._form), strict=True))
            text += f"{self._separator}  {json.dumps(values, allow_nan=False)}"
            self._separator = ",\n"
            self._lost.setdefault(target, LostRanges()).add(number, time, track.status)
        for target in self._lost.keys() - tracks.keys():
            self._lost[target].interrupt()
        return text

    def end(self, targets: Iterable[NamedTarget]) -> str:
        """The text after the last frame."""
        lost = [
            each
            for target, found in self._lost.items()
            for each in as_json(found.ranges, target if self._form.several else None)
        ]
        rest = {"targets": [each._asdict() for each in targets], "lost": lost, "fps": self._rate()}
        entries = (f'"{name}": {json.dumps(value, allow_nan=False)}' for name, value in rest.items())
        return "\n ],\n " + ",\n ".join(entries) + "\n}\n"
