# SPDX-License-Identifier: MIT
"""Entries of a data set, and what each tracker is shown of them."""

import pickle
import shutil
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue.camera.box import Box
from tricue.evaluation.baselines import StillBox
from tricue.evaluation.dataset import Entry, ReadOptions, find_entries, short_names
from tricue.evaluation.one_pass import Run
from tricue.evaluation.record import Record
from tricue.evaluation.rows import make_row, measure_robustness, score_run
from tricue.evaluation.tasks import RESTARTS, Task, perform
from tricue.evaluation.tracker_spec import TrackerSpec
from tricue.evaluation.trackers import tracker_specs
from tricue.track.base.track import Status, Track

from tests.data.recordings.written import compressed, jpeg, write_mcap

BOX = "8,6,16,20\n"


def color(index):
    """A picture of 48x36 px with texture that moves."""
    rng = np.random.default_rng(3)
    return np.roll(rng.integers(0, 255, (36, 48, 3), dtype=np.uint8), index, axis=1)


def depth(index):
    """Somebody 2 m away before a wall at 4 m, in millimeters."""
    image = np.full((36, 48), 4000, np.uint16)
    image[6:26, 8 + index : 24 + index] = 2000
    return image


def write_rgbd(folder, count=6, truth=BOX, cameras=None, positions=False):
    """VOT's layout with depth; cameras: the text of intrinsics.toml."""
    for channel in ("color", "depth"):
        (folder / channel).mkdir(parents=True)
    for index in range(count):
        cv2.imwrite(str(folder / "color" / f"{index + 1:08d}.png"), color(index))
        cv2.imwrite(str(folder / "depth" / f"{index + 1:08d}.png"), depth(index))
    (folder / "sequence").write_text("channels.color=color/%08d.png\nchannels.depth=depth/%08d.png\nfps=10\n")
    (folder / "groundtruth.txt").write_text(truth * count)
    if cameras:
        (folder / "intrinsics.toml").write_text(cameras)
    if positions:
        (folder / "position_z_mm.txt").write_text("2000\n" * count)
    return folder


def write_pair(folder, count=4):
    """left/ and right/ with true boxes in the left images."""
    for side in ("left", "right"):
        (folder / side).mkdir(parents=True)
        for index in range(count):
            cv2.imwrite(str(folder / side / f"{index}.png"), color(index))
    (folder / "groundtruth.txt").write_text(BOX * count)
    return folder


ONE = "[depth]\nfx = 50\nfy = 50\ncx = 24\ncy = 18\nscale = 0.001\n"
TWO = f"{ONE}[color]\nfx = 60\nfy = 60\ncx = 24\ncy = 18\n"


def test_entries_are_named_by_their_folders_and_can_be_sent(tmp_path):
    """Names are unique and relative; an entry survives pickling and opens to the same digest."""
    write_rgbd(tmp_path / "a" / "walk")
    write_pair(tmp_path / "b" / "walk")
    found = find_entries(tmp_path)
    assert [entry.name for entry in found] == ["a/walk", "b/walk"]
    for entry in found:
        assert pickle.loads(pickle.dumps(entry)).open().digest == entry.open().digest
    assert [entry.name for entry in find_entries(tmp_path / "a" / "walk")] == ["walk"]


@pytest.mark.parametrize(
    ("names", "short"),
    [
        (["color/David", "color/Girl"], ["David", "Girl"]),
        (["data/tum/seq", "data/princeton/seq", "seq"], ["tum/seq", "princeton/seq", "seq"]),
        (["a/x/one", "b/x/one", "b/x/two"], ["a/x/one", "b/x/one", "two"]),
        (["OTB/Jogging/1:", "OTB/Jogging/2:"], ["Jogging/1", "Jogging/2"]),
        (["a/Jogging/1:", "b/Jogging/1:"], ["a/Jogging/1", "b/Jogging/1"]),
    ],
)
def test_short_names_tell_sequences_apart(names, short):
    """The fewest last parts that no other name ends with; of a target (here with a colon) two at least."""
    entries = [Entry(name.rstrip(":"), Path(), "1" if name.endswith(":") else None) for name in names]
    assert list(short_names(entries).values()) == short


def test_a_digest_is_of_the_images_not_of_their_place(tmp_path):
    """Two copies have one digest; another image, truth or reading has another."""
    first, second = (
        Entry("walk", write_rgbd(tmp_path / name)).open().digest for name in ("here", "elsewhere")
    )
    assert first == second
    assert Entry("walk", tmp_path / "here", None, ReadOptions(depth_scale=0.002)).open().digest != first
    cv2.imwrite(str(tmp_path / "here" / "color" / "00000003.png"), color(9) // 7)
    assert Entry("walk", tmp_path / "here").open().digest != first


def test_a_digest_is_of_the_times(tmp_path):
    """A list that gives the same images another frame rate gives trackers other times."""
    entry = Entry("walk", write_rgbd(tmp_path / "walk"))
    first, listed = entry.open().digest, tmp_path / "walk" / "sequence"
    listed.write_text(f"{listed.read_text().rstrip()}\nfps=5\n")
    assert entry.open().source.fps == 5
    assert entry.open().digest != first


def test_a_key_that_is_no_cameras_tells_of_no_other_camera(tmp_path):
    """The unit of depth, in its table alone, or a size that one table leaves out, makes no two cameras."""
    camera = "fx = 40.0\nfy = 40.0\ncx = 24.0\ncy = 18.0\n"
    for name, more in (("unit", "scale = 0.001\n"), ("size", "width = 48\nheight = 36\n")):
        cameras = f"[color]\n{camera}[depth]\n{camera}{more}"
        opened = Entry("walk", write_rgbd(tmp_path / name, cameras=cameras)).open()
        assert opened.registered


def test_a_scale_of_depth_is_for_formats_without_one(tmp_path):
    """VOT's depth stays in millimeters; depth images alone, which can't be opened without it, have it."""
    vot = Entry("walk", write_rgbd(tmp_path / "vot"), None, ReadOptions(depth_scale=0.01)).open()
    assert next(iter(vot.source)).depth.max() == pytest.approx(4)
    alone = write_rgbd(tmp_path / "alone")
    (alone / "sequence").unlink()
    shutil.rmtree(alone / "color")
    opened = Entry("walk", alone, None, ReadOptions(depth_scale=0.01)).open()
    assert next(iter(opened.source)).depth.max() == pytest.approx(40)


def test_a_digest_is_of_the_recording(tmp_path):
    """A robot's recording that is replaced is another one."""
    place = tmp_path / "walk"
    place.mkdir()
    (place / "boxes.csv").write_text("frame,x,y,width,height\n0,8,6,16,20\n")

    def digest(count):
        images = [(10**8 * index, jpeg(color(index))) for index in range(count)]
        write_mcap(place / "a.mcap", [compressed("/a/compressed", *each, "jpeg") for each in images])
        return Entry("walk", place).open().digest

    assert digest(5) == digest(5) != digest(6)


@pytest.mark.parametrize(
    ("cameras", "positions", "told", "channel", "group"),
    [
        (None, False, None, "color", "rgbd"),
        (None, True, None, "color", "rgbd"),
        (ONE, True, None, "color", "rgbd"),
        (TWO, False, None, "color", "rgbd"),
        (TWO, True, None, "depth", "depth"),
        (TWO, True, "color", "color", "rgbd"),
        (None, False, "depth", "depth", "depth"),
    ],
)
def test_whose_pixels_the_truth_counts(tmp_path, cameras, positions, told, channel, group):
    """The color image's, but the depth image's where its camera is another and the target was measured in it;
    what the user says goes before all.
    """
    folder = write_rgbd(tmp_path / "walk", cameras=cameras, positions=positions)
    opened = Entry("walk", folder, None, ReadOptions(truth=told)).open()
    assert (opened.channel, opened.group) == (channel, group)


def test_trackers_are_shown_what_they_can_use(tmp_path):
    """Channels by tracker and kind of sequence; who can't run says why."""
    rgbd = Entry("rgbd", write_rgbd(tmp_path / "rgbd", cameras=ONE)).open()
    apart = Entry("apart", write_rgbd(tmp_path / "apart", cameras=TWO, positions=True)).open()
    pair = Entry("pair", write_pair(tmp_path / "pair")).open()
    expected = {
        "color-particle": (("color",), "boxes of the depth image", ("color",)),
        "depth-particle": (("depth",), ("depth",), "no depth"),
        "stereo-head": ("no stereo pair", "no stereo pair", ("color", "right")),
        "flow-depth": (("color", "depth"), ("depth",), ("color", "right")),
        "fused": (("color", "depth"), ("depth",), ("color", "right")),
        "still-box": (("color",), ("color",), ("color",)),
    }
    for name, each in expected.items():
        spec = TrackerSpec(name)
        for opened, wanted in zip((rgbd, apart, pair), each, strict=True):
            if isinstance(wanted, str):
                assert spec.unsupported_reason(opened) == wanted
            else:
                assert spec.unsupported_reason(opened) == ""
                frame = next(iter(opened.source))
                assert spec.view(opened)(frame).channels == wanted


def test_depth_of_another_camera_is_not_taken_for_the_colors(tmp_path):
    """Where the true boxes are in the color image and the depth isn't registered, only color is used."""
    opened = Entry("walk", write_rgbd(tmp_path / "walk", cameras=TWO)).open()
    assert TrackerSpec("depth-particle").unsupported_reason(opened) == "depth not registered to color"
    for name in ("flow-depth", "fused"):
        assert TrackerSpec(name).view(opened)(next(iter(opened.source))).channels == ("color",)


def test_peers_see_depth_as_a_picture_with_steady_shades(tmp_path):
    """Gray by the first frame's range, so that the same distance keeps its shade."""
    opened = Entry("walk", write_rgbd(tmp_path / "walk", cameras=TWO, positions=True)).open()
    view = TrackerSpec("CSRT").view(opened)
    pictures = [view(frame).color for frame in opened.source]
    assert len({picture[15, 20].tobytes() for picture in pictures}) == 1
    assert pictures[0][15, 16].tolist() != pictures[0][0, 0].tolist()


def test_a_depth_tracker_is_judged_in_meters(tmp_path):
    """The position's error along z against the median depth of the target."""
    folder = write_rgbd(tmp_path / "walk", count=8, cameras=TWO, positions=True)
    entry = Entry("walk", folder)
    record = perform(Task(TrackerSpec("flow-depth"), entry))
    row = make_row(entry.open(), "flow-depth", 0, score_run(record, entry.open()))
    assert record.error == ""
    assert row.position_error < 0.2
    assert row.group == "depth"


def made_run(boxes):
    """A run with these boxes, all TRACKED."""
    count = len(boxes)
    nothing = np.full((count, 3), np.nan), np.full((count, 3, 3), np.nan)
    return Run(boxes, np.ones(count), (Status.TRACKED,) * count, *nothing, np.ones(count - 1))


def test_of_boxes_beyond_the_edge_only_the_part_inside_counts(tmp_path):
    """In VOT's sequences, and in no others."""
    inside = np.tile([40.0, 6, 8, 20], (4, 1))
    run = made_run(inside + [0, 0, 20, 0])
    vot = Entry("vot", write_rgbd(tmp_path / "vot", 4, "40,6,8,20\n")).open()
    pair = write_pair(tmp_path / "pair")
    (pair / "groundtruth.txt").write_text("40,6,8,20\n" * 4)
    np.testing.assert_array_equal(score_run(Record(run), vot).overlaps, 1)
    np.testing.assert_allclose(score_run(Record(run), Entry("pair", pair).open()).overlaps, 8 / 28)


def test_of_truth_beyond_the_edge_only_the_part_inside_counts(tmp_path):
    """Whoever says the true boxes, or their parts in the image, overlaps wholly with all that are in it, with
    and without restarts; a true box outside of it counts for nothing.
    """
    truth = np.array([[x, 6.3, 16.7, 20.1] for x in (8.1, 24.3, 40.6, 47.9, 60)] + [[-9.5, 20, 16, 30]])
    folder = write_rgbd(tmp_path / "walk", len(truth))
    np.savetxt(folder / "groundtruth.txt", truth, fmt="%.17g", delimiter=",")
    opened = Entry("walk", folder).open()
    parts = np.concatenate(
        [low := truth[:, :2].clip(0), (truth[:, :2] + truth[:, 2:]).clip(0, (48, 36)) - low], 1
    )
    parts[4] = np.nan
    for boxes in (truth, parts):
        record = Record(made_run(boxes))
        row = make_row(opened, "oracle", 0, score_run(record, opened), measure_robustness(record, opened))
        assert (row.auc, row.precision, row.failures) == (pytest.approx(20 / 21), 1, 0)
        np.testing.assert_allclose(score_run(record, opened).overlaps, [1, 1, 1, 1, np.nan, 1])
    np.testing.assert_array_equal(opened.boxes, truth)
    np.testing.assert_array_equal(opened.truth(6)[0], truth[0])


def test_a_failure_is_one_in_the_image(tmp_path, monkeypatch):
    """A box that overlaps the true one beyond the image alone has lost it; the next starts on all of it."""
    folder = write_rgbd(tmp_path / "walk", 12, "40,6,16,20\n")
    entry = Entry("walk", folder)
    monkeypatch.setattr(StillBox, "update", lambda self, frame: Track(Box(50, 6, 16, 20), 1, Status.TRACKED))
    record = perform(Task(TrackerSpec("still-box"), entry, kind=RESTARTS))
    assert record.starts == (0, 6)
    np.testing.assert_array_equal(record.run.boxes[[0, 6]], [[40, 6, 16, 20]] * 2)
    assert measure_robustness(record, entry.open()).failures == 2


def test_runs_start_where_the_truth_starts(tmp_path):
    """Frames before the first true box aren't tracked, and don't count."""
    folder = write_rgbd(tmp_path / "walk")
    (folder / "groundtruth.txt").write_text("nan,nan,nan,nan\n" * 2 + BOX * 4)
    entry = Entry("walk", folder)
    record = perform(Task(TrackerSpec("still-box"), entry))
    assert record.starts == (2,)
    assert np.isnan(record.run.boxes[:2]).all()
    row = make_row(entry.open(), "still-box", 0, score_run(record, entry.open()))
    assert (row.frames, row.success) == (4, 1.0)
    assert np.isnan(row.true_negative)


LAYOUTS = {"otb": ("img", "groundtruth_rect.txt", 4), "vot": ("color", "groundtruth.txt", 8)}
LAYOUTS |= {"lasot": ("img", "groundtruth.txt", 8), "got10k": (".", "groundtruth.txt", 8)}


def write_numbered(folder, layout, numbers, boxes):
    """A sequence of a benchmark with images of these numbers, and so many true boxes."""
    place, truth, digits = LAYOUTS[layout]
    (folder / place).mkdir(parents=True)
    for number in numbers:
        cv2.imwrite(str(folder / place / f"{number:0{digits}d}.png"), color(number))
    (folder / truth).write_text(BOX * boxes)
    if layout == "vot":
        (folder / "sequence").write_text("channels.color=color/%08d.png\nfps=10\n")
    return Entry(folder.name, folder).open()


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_missing_image_is_named(tmp_path, layout):
    """Later true boxes would be those of other images."""
    place, _, digits = LAYOUTS[layout]
    opened = write_numbered(tmp_path / "walk", layout, [1, 2, 4, 5, 6], 6)
    missing = (
        rf"{tmp_path / 'walk' / place}: expected images 0*1 to 0*6, .* 6 true boxes, got .* {3:0{digits}d}$"
    )
    with pytest.raises(ValueError, match=missing):
        opened.check()


@pytest.mark.parametrize(
    ("numbers", "boxes"),
    [
        ([1, 2, 3, 4], 4),
        ([1, 3, 5, 7], 4),
        ([1, 2, 4, 5], 4),
        ([1, 2, 3, 4], 6),
        ([5, 6, 7], 2),
        ([1, 2, 4], 2),
    ],
)
def test_images_that_no_true_box_needs_are_not_missing(tmp_path, numbers, boxes):
    """Every other image with its box, other gaps without a row, and boxes that end before or after."""
    write_numbered(tmp_path / "walk", "otb", numbers, boxes).check()


def test_a_missing_image_of_those_that_otbs_boxes_are_for(tmp_path):
    """Football1's boxes are for 74 of 81 images; without the last of all nothing is shifted."""
    numbers = [number for number in range(1, 82) if number != 9]
    with pytest.raises(ValueError, match=r"expected images 0001 to 0074, .* 74 true boxes, got .* 0009$"):
        write_numbered(tmp_path / "Football1", "otb", numbers, 74).check()
    write_numbered(tmp_path / "a" / "Football1", "otb", [*range(1, 80), 81], 74).check()


def test_a_start_without_a_frame_after_it_is_refused(tmp_path):
    """Where the first true box is that of the last image, no tracker can run."""
    opened = write_numbered(tmp_path / "walk", "vot", [1, 2, 3], 3)
    opened.check()
    (tmp_path / "walk" / "groundtruth.txt").write_text("nan,nan,nan,nan\n" * 2 + BOX)
    with pytest.raises(ValueError, match=r"walk: expected a frame after the first true box, got 3 frames"):
        Entry("walk", tmp_path / "walk").open().check()


def test_absent_frames_make_rates(tmp_path):
    """A box that never moves says TRACKED where the target is gone: no true negative."""
    folder = write_rgbd(tmp_path / "walk")
    (folder / "groundtruth.txt").write_text(BOX * 3 + "nan,nan,nan,nan\n" * 3)
    entry = Entry("walk", folder)
    record = perform(Task(TrackerSpec("still-box"), entry))
    row = make_row(entry.open(), "still-box", 0, score_run(record, entry.open()))
    assert (row.true_positive, row.true_negative, row.ok_while_lost) == (1.0, 0.0, 0.5)


def test_frames_of_unknown_truth_are_not_counted_as_tracked(tmp_path):
    """TRACKED in the two labeled frames of four; of frames without the target all count."""
    pair = write_pair(tmp_path / "pair", 4)
    (pair / "groundtruth.txt").write_text(BOX * 2)
    walk = write_rgbd(tmp_path / "walk", 4)
    (walk / "groundtruth.txt").write_text(BOX * 2 + "nan,nan,nan,nan\n" * 2)
    run = replace(made_run(np.tile([8.0, 6, 16, 20], (4, 1))), statuses=(Status.TRACKED, *[Status.LOST] * 3))
    for folder, share in ((pair, 0.5), (walk, 0.25)):
        opened = Entry(folder.name, folder).open()
        assert make_row(opened, "made", 0, score_run(Record(run), opened)).tracked == share


def test_kitti_has_ten_pairs_a_second(data):
    """Its files don't tell, but its cameras had no other rate; what the user says goes before it."""
    folder = data / "stereo" / "kitti-tracking"
    for reading, rate in ((ReadOptions(), 10), (ReadOptions(fps=25), 25)):
        assert Entry("car", folder, "Car 31", reading).open().source.fps == rate


def test_all_trackers_of_this_package_and_of_cv2_take_part():
    """Without names everybody does, each once."""
    found = [spec.name for spec in tracker_specs(None, {})]
    assert len(set(found)) == len(found)
    ours = {"color-particle", "depth-particle", "stereo-head", "flow-depth", "fused"}
    assert ours | {"CamShift", "meanShift"} <= set(found)


@pytest.mark.parametrize(
    "name", ["CSRT", "KCF", "MIL", "MOSSE", "MedianFlow", "color-particle", "depth-particle"]
)
def test_a_seed_gives_the_same_run_whoever_ran_before(tmp_path, name):
    """Peers included: OpenCV's own generator starts from the task's seed."""
    if name not in {spec.name for spec in tracker_specs(None, {})}:
        pytest.skip(f"this cv2 has no {name}")
    task = Task(TrackerSpec(name), Entry("walk", write_rgbd(tmp_path / "walk", cameras=ONE)), seed=4)
    first = perform(task)
    cv2.setRNGSeed(99)
    np.testing.assert_array_equal(first.run.boxes, perform(task).run.boxes)


def measured(name, entry):
    """The row of a tracker on a recorded sequence."""
    record = perform(Task(TrackerSpec(name), entry))
    return make_row(entry.open(), name, 0, score_run(record, entry.open()))


def test_ours_follows_real_people(data):
    """On a recorded sequence the person is followed: mean IoU above 0.6, depth within 10 cm."""
    row = measured("depth-particle", Entry("queue", data / "rgbd" / "queue-first"))
    assert row.iou > 0.6
    assert row.position_error < 0.1


def test_a_peer_gets_the_published_score(data):
    """CSRT follows Crossing as measured elsewhere (AUC 0.70): loop, truth and metric are right."""
    if "CSRT" not in {spec.name for spec in tracker_specs(None, {})}:
        pytest.skip("this cv2 has no CSRT: opencv-contrib-python-headless has")
    row = measured("CSRT", Entry("Crossing", data / "color" / "Crossing"))
    assert row.auc == pytest.approx(0.70, abs=0.03)
    assert row.precision > 0.99
