# SPDX-License-Identifier: MIT
import shutil

import numpy as np
import pytest
from tricue.camera.frame import Frame
from tricue.evaluation.dataset import Entry

from benchmarks.quality.common.protocols import (
    ORDERS,
    PROTOCOLS,
    belongs,
    in_order,
    run_order,
    run_orders,
)
from benchmarks.quality.common.recordings import MirroredRecording, Recording
from benchmarks.quality.common.variants import parse_variants


def numbers(protocol, frames):
    """The frames of each run."""
    return [order.numbers(frames).tolist() for order in PROTOCOLS[protocol]]


def test_orders():
    """One pass on each way; every third frame; eight starts, four on each way, at the quarters."""
    assert numbers("forward", 4) == [[0, 1, 2, 3]]
    assert numbers("backward", 4) == [[3, 2, 1, 0]]
    assert numbers("third", 8) == [[0, 3, 6]]
    starts = numbers("starts", 4)
    assert starts[::2] == [[0, 1, 2, 3], [1, 2, 3], [2, 3], [3]]
    assert starts[1::2] == [[3, 2, 1, 0], [2, 1, 0], [1, 0], [0]]


def test_each_order_runs_once():
    """The passes are two of the eight starts."""
    assert len(ORDERS) == len(set(ORDERS)) == 9
    assert {*PROTOCOLS["forward"], *PROTOCOLS["backward"]} < set(PROTOCOLS["starts"])


def test_a_start_waits_for_truth(folders, tmp_path):
    """Frames before the first true box aren't tracked; a run of fewer than two frames doesn't count."""
    folder = shutil.copytree(folders / "there", tmp_path / "there")
    lines = (folder / "groundtruth_rect.txt").read_text().splitlines()
    (folder / "groundtruth_rect.txt").write_text("\n".join(["NaN,NaN,NaN,NaN"] * 3 + lines[3:]))
    (variant,) = parse_variants(["still-box"])
    there = Recording(Entry("there", folder).open())
    results = run_order(variant, there, there.frames, np.arange(20))
    assert len(results.overlaps) == 17
    assert results.overlaps[0] == 1
    assert run_order(variant, there, there.frames, np.arange(4)) is None
    assert run_order(variant, there, there.frames, np.arange(3)) is None
    # With truth from the fourth of five frames on, backward starts behind it and "third" have no run.
    ran = [order for order in ORDERS if order in run_orders(variant, there, there.frames[:5])]
    assert [order.start for order in ran if not order.backward] == [0, 0.25, 0.5, 0.75]
    assert [order.start for order in ran if order.backward] == [0, 0.25]
    assert {order.step for order in ran} == {1}


def test_boxes_beside_the_true_one(folders):
    """Each order runs from each drawn box, which overlaps the true one; all belong to its protocols."""
    (variant,) = parse_variants(["still-box"])
    there = Recording(Entry("there", folders / "there").open())
    runs = run_orders(variant, there, there.frames, draws=(1, 2))
    assert len(runs) == 2 * len(ORDERS)
    assert {order.noise for order in runs} == {1, 2}
    first = [run.overlaps[0] for run in runs.values()]
    assert 0.5 < min(first) <= max(first) < 1
    assert len(set(first)) > 2
    for protocol, orders in PROTOCOLS.items():
        assert sum(belongs(order, protocol) for order in runs) == 2 * len(orders)


def test_a_mirrored_recording(folders):
    """A box that stays has the same overlaps; its pixels are the others', column by column."""
    (variant,) = parse_variants(["still-box"])
    there = Recording(Entry("there", folders / "there").open())
    mirrored = MirroredRecording(there.opened)
    assert (mirrored.frames[0].color == there.frames[0].color[:, ::-1]).all()
    overlaps = [run_order(variant, each, each.frames, np.arange(20)).overlaps for each in (there, mirrored)]
    assert overlaps[0] == pytest.approx(overlaps[1])
    x, width = there.truth[3, 0], there.truth[3, 2]
    assert mirrored.truth[3, 0] + width + x == there.opened.source.size[0]
    assert there.truth[3, 0] == x


def test_times_increase():
    """Forward they are the frames' own, backward the seconds since the first; unknown ones stay so."""
    image = np.zeros((2, 2, 3), np.uint8)
    frames = [Frame(image, timestamp=seconds) for seconds in (5.0, 5.1, 5.3, 5.4)]

    def times(numbers):
        return [frame.timestamp for frame in in_order(frames, np.array(numbers))]

    assert times([0, 1, 3]) == [5.0, 5.1, 5.4]
    np.testing.assert_allclose(times([2, 1, 0]), [0, 0.2, 0.3])
    frames = [Frame(image)] * 4
    assert times([3, 2]) == [None, None]
