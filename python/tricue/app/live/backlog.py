# SPDX-License-Identifier: MIT
"""The last frames of a camera, because a box belongs to the frame that was shown when it was drawn."""

from collections.abc import Hashable

from tricue.camera.frame import Frame

MAX_BYTES = 192 << 20  # of frames
SECONDS = 2.0  # for which frames are kept, unless a page holds one
FEWEST = 2  # frames to keep, however large


class Backlog:
    """Keeps the frames of the last seconds, and all since a frame that a page holds, in bounded memory.

    If these are too many, it drops some of them evenly, and a tracker that catches up sees its target at a
    lower frame rate. Not thread-safe.
    """

    def __init__(self) -> None:
        self._frames: dict[int, tuple[float, Frame]] = {}  # by number, ascending
        self._held: dict[Hashable, int] = {}

    def add(self, number: int, seconds: float, frame: Frame) -> None:
        """Add the newest frame, with its number and its time."""
        self._frames[number] = seconds, frame
        first_held = min(self._held.values(), default=number)
        for old in [at for at, (then, _) in self._frames.items() if then < seconds - SECONDS]:
            if old < first_held:
                del self._frames[old]
        while len(self._frames) > FEWEST and self._bytes() > MAX_BYTES:
            self._thin_out()

    def hold(self, holder: Hashable, number: int | None) -> None:
        """Keep a frame for a holder, instead of its previous one; None to keep none."""
        self._held.pop(holder, None)
        if number is not None and number in self._frames:
            self._held[holder] = number

    def get(self, number: int) -> Frame:
        """A frame by its number; ValueError if it was dropped."""
        if number not in self._frames:
            raise ValueError("the frame is gone; draw the box in the picture that is shown now")
        return self._frames[number][1]

    def since(self, number: int) -> list[tuple[int, Frame]]:
        """The frames after this number, with their numbers."""
        return [(at, frame) for at, (_, frame) in self._frames.items() if at > number]

    def clear(self) -> None:
        """Forget all."""
        self._frames.clear()
        self._held.clear()

    def _bytes(self) -> int:
        images = ((each.color, each.depth, each.right) for _, each in self._frames.values())
        return sum(image.nbytes for three in images for image in three if image is not None)

    def _thin_out(self) -> None:
        """Drop the oldest frame, or, if it is held, the one whose neighbors are closest to each other."""
        numbers, held = [*self._frames], set(self._held.values())
        if not held or numbers[0] < min(held):
            del self._frames[numbers[0]]
            return
        gaps = {
            at: after - before
            for before, at, after in zip(numbers, numbers[1:], numbers[2:], strict=False)
            if at not in held
        }
        if gaps:
            del self._frames[min(gaps, key=lambda at: gaps[at])]
        else:
            self._held.clear()  # held frames alone need too much memory
