# SPDX-License-Identifier: MIT
"""tricue's trackers with got10k's interface, so that its experiments can run them.

    from got10k.experiments import ExperimentOTB
    from tricue.evaluation.toolkits.got10k import as_got10k

    ExperimentOTB("data/OTB").run(as_got10k(tricue.create("color-particle", seed=0), "color-particle"))

got10k provides color images only: a tracker that needs another channel raises at its first ``init``.
"""

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box, as_box
from tricue.doctor.install import install_extra
from tricue.track.base.adapter import check_is_tracker, with_known_numbers
from tricue.track.base.track import Tracker

try:
    from got10k.trackers import Tracker as _Got10kTracker
    from PIL.Image import Image
except ImportError as error:
    raise ImportError(
        f"{__name__}: got10k can't be loaded ({error}); install it: {install_extra('got10k')}"
    ) from error


class Got10kTracker(_Got10kTracker):  # type: ignore[misc]  # got10k has no types
    """Wraps a tracker with ``init`` and ``update`` as in ``got10k.trackers.Tracker``.

    Boxes are (4,) arrays x, y, width, height, passed on unchanged, while tricue counts pixels from 0. OTB's
    files count from 1; got10k neither shifts them nor informs trackers which experiment runs. So in
    ``ExperimentOTB`` a tracker starts one pixel to the right of and below the true box, and its boxes are
    compared with the truth in the same convention.
    """

    def __init__(self, tracker: Tracker, name: str) -> None:
        # tricue's trackers are seeded, so got10k needn't repeat runs.
        super().__init__(name=name, is_deterministic=True)
        self.tracker = tracker
        self._box = Box(0, 0, 0, 0)

    def init(self, image: Image, box: NDArray[np.float64]) -> None:
        """Start, or start again, on the box."""
        self._box = as_box(box)
        self.tracker.init(_bgr(image), box)

    def update(self, image: Image) -> NDArray[np.float64]:
        """The box in the next image, (4,), not rounded.

        For a lost target without a box it is the last box, because NaN would make the sequence's mean NaN.
        """
        self._box = with_known_numbers(self.tracker.update(_bgr(image)), self._box).box
        return np.array(self._box, dtype=np.float64)


def as_got10k(tracker: Tracker, name: str | None = None) -> Got10kTracker:
    """The tracker with the interface of got10k's; TypeError for anything but a tracker.

    name: of got10k's result folders; by default the tracker's class name.
    """
    check_is_tracker(tracker)
    return Got10kTracker(tracker, type(tracker).__name__ if name is None else name)


def _bgr(image: Image) -> NDArray[np.uint8]:
    """A PIL image of any mode as (H, W, 3) uint8 BGR; a gray one gets three equal channels."""
    return np.ascontiguousarray(np.asarray(image.convert("RGB"))[:, :, ::-1])
