# SPDX-License-Identifier: MIT
"""Protocols on recorded video: the orders in which a tracker sees the frames of a sequence.

"forward" and "backward" are one pass each over the whole sequence; "starts" are eight runs, from 0, 1/4, 1/2
and 3/4 of the sequence to its end and the same on the reversed sequence; "third" is one pass over every third
frame. A run starts on the first of its frames with a true box, on that box or on perturbed ones. Times
increase, also backward.
"""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation import one_pass
from tricue.evaluation.protocols import Order, forward_times, jittered, orders

from benchmarks.quality.common.frame_results import FrameResults
from benchmarks.quality.common.recordings import Recording
from benchmarks.quality.common.variants import Variant

PROTOCOLS: Mapping[str, tuple[Order, ...]] = {
    "forward": (Order(),),
    "backward": (Order(backward=True),),
    "starts": orders("starts"),
    "third": (Order(step=3),),
}
ORDERS = tuple(dict.fromkeys(order for orders in PROTOCOLS.values() for order in orders))
"""Each order once: a run may belong to several protocols."""
TRUE_BOX = (0,)
"""The draws of runs that start only on the true first box."""


def belongs(order: Order, protocol: str) -> bool:
    """Whether a run in this order, on the true first box or a perturbed one, is one of the protocol's."""
    return order._replace(noise=0) in PROTOCOLS[protocol]


def run_orders(
    variant: Variant, recording: Recording, frames: Sequence[Frame], draws: Sequence[int] = TRUE_BOX
) -> Mapping[Order, FrameResults]:
    """The tracker's runs in all orders that leave two frames or more from the first true box on.

    frames: the recording's, as the tracker gets them. draws: one run each, on the perturbed box of that draw;
    0 is the true box.
    """
    found = {
        order._replace(noise=draw): run_order(variant, recording, frames, order.numbers(len(frames)), draw)
        for order in ORDERS
        for draw in draws
    }
    return {order: run for order, run in found.items() if run is not None}


def run_order(
    variant: Variant,
    recording: Recording,
    frames: Sequence[Frame],
    numbers: NDArray[np.intp],
    draw: int = 0,
) -> FrameResults | None:
    """Track through the frames with these numbers, from the first with a true box on.

    None if fewer than two are left. draw: of the first box, as in :func:`run_orders`.
    """
    opened = recording.opened
    truth, absent = recording.truth[: len(frames)], opened.absent(len(frames))
    known = ~np.isnan(truth[numbers]).any(axis=1)
    numbers = numbers[int(np.argmax(known)) :] if known.any() else numbers[:0]
    if len(numbers) < 2:
        return None
    first = Box(*truth[numbers[0]].tolist())
    box = jittered(first, opened.entry.name, draw) if draw else first
    run = one_pass.run(variant.make(recording.inputs), in_order(frames, numbers), box)
    boxes = opened.clip(run.boxes)
    return FrameResults.of(run, boxes, truth[numbers], absent[numbers], recording.depths[numbers])


def in_order(frames: Sequence[Frame], numbers: NDArray[np.intp]) -> Iterator[Frame]:
    """The frames with these numbers; if they go backward, times are the seconds since the first frame."""
    ordered = (frames[number] for number in numbers)
    return forward_times(ordered) if numbers[-1] < numbers[0] else ordered
