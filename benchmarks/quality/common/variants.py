# SPDX-License-Identifier: MIT
"""Who is compared: trackers by name, ours with settings, and with fewer channels than a sequence has."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from tricue.camera.frame import Frame
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.evaluation.tracker_spec import Entrant, Guarded, Offer, View, entrants
from tricue.track.base.settings import read_settings

CHANNELS = ("color", "depth", "right")


@dataclass(frozen=True)
class Offered:
    """An offer of our own making. channel: the one whose pixels the boxes count."""

    channels: tuple[str, ...]
    intrinsics: Intrinsics | None = None
    rig: StereoRig | None = None
    registered: bool = True

    @property
    def channel(self) -> str:
        """Depth's only where there is no color."""
        return "color" if "color" in self.channels else "depth"


@dataclass(frozen=True)
class Participant:
    """An entrant by a label of its own. only: the channels that it is shown, None for all it can use."""

    label: str
    entrant: Entrant
    only: tuple[str, ...] | None = None

    def refuses(self, offer: Offer) -> str:
        """Why it can't run, "" where it can."""
        missing = [name for name in self.only or () if name not in offer.channels]
        return f"no {missing[0]}" if missing else self.entrant.refuses(self._cut(offer))

    def contender(self, offer: Offer) -> Guarded:
        """The tracker with its cameras, from seed 0."""
        return self.entrant.contender(self._cut(offer), 0)

    def view(self, offer: Offer) -> View:
        """What it is shown of a frame."""
        cut, view = self.only, self.entrant.view(self._cut(offer))
        if cut is None:
            return view
        return lambda frame: view(
            Frame(**{name: getattr(frame, name) for name in cut}, timestamp=frame.timestamp)
        )

    def _cut(self, offer: Offer) -> Offer:
        if self.only is None:
            return offer
        return Offered(
            self.only,
            offer.intrinsics if "depth" in self.only else None,
            offer.rig if "right" in self.only else None,
            offer.registered,
        )


def participants(words: Sequence[str], settings: Sequence[str] = ()) -> list[Participant]:
    """From names such as CSRT, fused, or fused:color and fused:color+depth, which see these channels alone.

    settings: "name.parameter=value", for our trackers. ValueError for what isn't known.
    """
    names = [word.partition(":")[0] for word in words]
    values = parse_settings(settings)
    if unused := [name for name in values if name not in names]:
        raise ValueError(f"--set: expected one of {', '.join(names)}, got {unused[0]!r}")
    found = entrants(names, values)
    return [Participant(word, each, _channels(word)) for word, each in zip(words, found, strict=True)]


def parse_settings(settings: Sequence[str]) -> dict[str, dict[str, Any]]:
    """Parameters by tracker from "name.parameter=value"; ValueError for what has no such form."""
    lines: dict[str, list[str]] = {}
    for setting in settings:
        name, dot, rest = setting.partition(".")
        if not dot or "=" in name:
            raise ValueError(f"--set: expected tracker.name=value, got {setting!r}")
        lines.setdefault(name, []).append(rest)
    return {name: read_settings(name, None, each) for name, each in lines.items()}


def with_settings(participant: Participant, label: str, values: Mapping[str, Any]) -> Participant:
    """The same tracker under another label with further parameters."""
    settings = dict(participant.entrant.settings) | dict(values)
    return replace(
        participant, label=label, entrant=replace(participant.entrant, settings=tuple(settings.items()))
    )


def _channels(word: str) -> tuple[str, ...] | None:
    _, colon, text = word.partition(":")
    if not colon:
        return None
    channels = tuple(text.split("+"))
    if unknown := [name for name in channels if name not in CHANNELS]:
        raise ValueError(f"--trackers: expected channels of {', '.join(CHANNELS)}, got {unknown[0]!r}")
    return channels
