# SPDX-License-Identifier: MIT
import shutil

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.data.open_source import open_source
from tricue.evaluation import metrics, protocols, tables
from tricue.evaluation.dataset import Entry
from tricue.evaluation.evaluate import RUNS, Options, evaluate
from tricue.evaluation.markdown import markdown
from tricue.evaluation.protocols import NOISE, Order, forward_times, jittered, orders, read_frames
from tricue.evaluation.tasks import perform

ALL = ("backward", "starts", "every-3", "noisy-2")


def numbers(protocol, frames):
    """The frames of each run."""
    return [order.numbers(frames).tolist() for order in orders(protocol)]


def test_orders():
    """One pass on each way; every n-th frame; eight starts, four on each way, at the quarters."""
    assert numbers("one-pass", 4) == [[0, 1, 2, 3]]
    assert numbers("backward", 4) == [[3, 2, 1, 0]]
    assert numbers("every-3", 8) == [[0, 3, 6]]
    starts = numbers("starts", 4)
    assert starts[::2] == [[0, 1, 2, 3], [1, 2, 3], [2, 3], [3]]
    assert starts[1::2] == [[3, 2, 1, 0], [2, 1, 0], [1, 0], [0]]
    assert [order.noise for order in orders("noisy-3")] == [1, 2, 3]


@pytest.mark.parametrize(
    "name", ["restart", "every", "every-1", "every-x", "noisy-0", "noisy-1001", "starts-3", ""]
)
def test_unknown_protocols_are_told(name):
    """The error names those that there are, and what came."""
    with pytest.raises(ValueError, match=r"^protocols: expected some of one-pass, restarts, .* got "):
        orders(name)


@given(
    st.sampled_from(protocols.START_SHARES),
    st.booleans(),
    st.integers(1, 30),
    st.integers(0, 30),
)
def test_a_name_is_of_one_order(start, backward, step, noise):
    """A run's file says in which order it was: the name gives the order back."""
    order = Order(start, backward, step, noise)
    assert Order.named(order.name) == order


@given(st.floats(0, 500), st.floats(0, 500), st.floats(2, 200), st.floats(2, 200), st.integers(1, 50))
def test_a_noisy_box_is_near(x, y, width, height, draw):
    """Its center is a tenth of the size away, its sides are at most a tenth longer or shorter."""
    box, moved = Box(x, y, width, height), jittered(Box(x, y, width, height), "here", draw)
    offset = (np.array(moved.center) - box.center) / [width, height]
    assert np.hypot(*offset) == pytest.approx(NOISE)
    for side, other in ((moved.width, width), (moved.height, height)):
        assert 1 / (1 + NOISE) - 1e-9 <= side / other <= 1 + NOISE + 1e-9
    assert jittered(box, "here", draw) == moved
    assert jittered(box, "there", draw) != moved


def test_times_increase_backward():
    """They are the seconds since the first frame that is seen; unknown ones stay so."""
    image = np.zeros((2, 2, 3), np.uint8)
    frames = [Frame(image, timestamp=seconds) for seconds in (5.4, 5.3, 5.1)]
    np.testing.assert_allclose([each.timestamp for each in forward_times(frames)], [0, 0.1, 0.3])
    assert [each.timestamp for each in forward_times([Frame(image)] * 2)] == [None, None]


@pytest.mark.parametrize("block", [1, 7, 1000])
def test_a_reversed_sequence_is_read_in_blocks(folders, patrol, monkeypatch, block):
    """Whatever the size of a block, the frames are those of the sequence, last first."""
    monkeypatch.setattr(protocols, "BLOCK_PIXELS", block * 160 * 120)
    found = list(read_frames(open_source(folders / "there"), np.arange(20)[::-1]))
    assert len(found) == 20
    for frame, true in zip(found, patrol[0][::-1], strict=True):
        np.testing.assert_array_equal(frame.color, true.color)


def test_a_start_waits_for_truth(folders, tmp_path):
    """Frames before the first true box aren't seen; fewer than two frames are no run."""
    folder = shutil.copytree(folders / "there", tmp_path / "there")
    lines = (folder / "groundtruth_rect.txt").read_text().splitlines()
    (folder / "groundtruth_rect.txt").write_text("\n".join(["NaN,NaN,NaN,NaN"] * 17 + lines[17:]))
    opened = Entry("there", folder).open()
    assert Order().seen(opened).tolist() == [17, 18, 19]
    assert Order(start=0.75).seen(opened).tolist() == [17, 18, 19]
    assert Order(backward=True).seen(opened).tolist() == list(range(19, -1, -1))
    assert Order(start=0.25, backward=True).seen(opened).tolist() == []
    assert Order(step=3).seen(opened).tolist() == []


@pytest.fixture(scope="module")
def evaluated(folders, tmp_path_factory):
    """Two baselines by all protocols, and the folder."""
    folder = tmp_path_factory.mktemp("evaluated")
    return folder, evaluate(folders, folder, Options(("still-box", "meanShift"), protocols=ALL))


def test_a_run_of_several_protocols_is_run_once(evaluated):
    """One pass and backward are two of the eight starts: 1 + 1 + 6 + 1 + 2 runs, and restarts."""
    folder, evaluation = evaluated
    kinds = {each.name for each in (folder / RUNS).iterdir()}
    assert len(kinds) == 11 + 1
    assert {each.row.run for each in evaluation.results} == kinds - {"restarts"}
    assert len(evaluation.of("color", "still-box")) == 3
    assert len(evaluation.of("color", "still-box", "starts")) == 3 * 8
    assert {each.row.run for each in evaluation.of("color", "still-box", "noisy-2")} == {"noise-1", "noise-2"}
    assert not evaluation.failed


def test_runs_are_judged_in_their_order(evaluated, patrol):
    """Backward, a box that stays on the last true one is judged against truth that goes backward."""
    boxes = np.array(patrol[1])
    row = next(
        each
        for each in evaluated[1].results
        if (each.row.sequence, each.row.tracker, each.row.run) == ("there", "still-box", "backward")
    )
    true = boxes[::-1]
    expected = metrics.score(np.tile(true[0], (20, 1)), true)
    assert row.row.auc == expected.auc
    assert row.scored.frames.tolist() == list(range(19, -1, -1))
    thirds = next(
        each.row
        for each in evaluated[1].results
        if (each.row.sequence, each.row.tracker, each.row.run) == ("there", "still-box", "every-3")
    )
    assert thirds.frames == 7
    assert thirds.auc == metrics.score(np.tile(boxes[0], (7, 1)), boxes[::3]).auc


def test_a_protocol_is_a_line_of_the_summary(evaluated, tmp_path):
    """Its mean is that over sequences of the means over its runs; the printed table has a column for it."""
    evaluation = evaluated[1]
    line = next(each for each in tables.summary(evaluation, "starts") if each["tracker"] == "still-box")
    rows = [each.row for each in evaluation.of("color", "still-box", "starts")]
    means = [np.mean([row.auc for row in rows if row.sequence == name]) for name in ("back", "gap", "there")]
    assert line["auc"] == pytest.approx(np.mean(means))
    assert (line["protocol"], line["runs"]) == ("starts", 24)
    tables.write(evaluation, tmp_path, {})
    assert len((tmp_path / tables.SUMMARY).read_text().splitlines()) == 1 + 2 * 5
    assert "| one-pass | backward | starts | every-3 | noisy-2 |" in " ".join(markdown(evaluation).split())


def test_further_protocols_reuse_what_was_run(folders, tmp_path, monkeypatch):
    """One pass and restarts of an earlier evaluation count, also when the code of the protocols changes."""
    ran = []

    def counted(task):
        ran.append(task.kind)
        return perform(task)

    options = Options(("still-box",))
    evaluate(folders, tmp_path, options)
    evaluate(folders, tmp_path, Options(("still-box",), protocols=("backward",)), work=counted)
    assert ran == ["backward"] * 3
    monkeypatch.setattr("tricue.evaluation.tasks._digest_of", lambda path: "changed")
    evaluate(folders, tmp_path, Options(("still-box",), protocols=("backward",)), work=counted)
    assert ran == ["backward"] * 6


def test_the_noisy_box_is_where_the_tracker_starts(evaluated):
    """A box that stays is on the same box beside the true one in every frame."""
    noisy = next(
        each.scored
        for each in evaluated[1].results
        if (each.row.run, each.row.sequence, each.row.tracker) == ("noise-1", "there", "still-box")
    )
    true = Box(*noisy.truth[0].tolist())
    assert tuple(noisy.boxes[5]) == pytest.approx(tuple(jittered(true, "there", 1)))


def test_true_boxes_after_the_end_of_a_video_are_ignored(tmp_path, patrol):
    """Orders cover the frames that a video has, as they do for images, so that no run asks for another."""
    frames, boxes = patrol
    (tmp_path / "clip").mkdir()
    size = frames[0].color.shape[1::-1]
    writer = cv2.VideoWriter(str(tmp_path / "clip" / "clip.avi"), cv2.VideoWriter.fourcc(*"MJPG"), 25, size)
    for frame in frames:
        writer.write(frame.color)
    writer.release()
    rows = [*boxes, *boxes[-3:]]
    text = "".join(f"{','.join(map(str, box))}\n" for box in rows)
    (tmp_path / "clip" / "groundtruth.txt").write_text(text)
    opened = Entry("clip", tmp_path / "clip").open()
    assert Order(backward=True).seen(opened).tolist() == list(range(len(frames)))[::-1]
    evaluation = evaluate(tmp_path, tmp_path / "out", Options(("still-box",), protocols=ALL))
    assert not evaluation.failed
    assert max(each.row.frames for each in evaluation.results) == len(frames)
