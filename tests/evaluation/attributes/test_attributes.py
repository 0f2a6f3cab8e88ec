# SPDX-License-Identifier: MIT
"""What sequences show, measured on sequences that were made to show it."""

import dataclasses
import json
import os
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue.camera.frame import Frame
from tricue.evaluation.attributes.definitions import ATTRIBUTES, BY_KEY
from tricue.evaluation.attributes.depth_values import depth_values
from tricue.evaluation.attributes.image_values import image_values
from tricue.evaluation.attributes.measure import FOLDER, SequenceAttributes, measure, measure_all
from tricue.evaluation.attributes.results import sequence_lines, tracker_lines
from tricue.evaluation.attributes.truth_values import truth_values
from tricue.evaluation.dataset import Entry, ReadOptions
from tricue.evaluation.evaluate import Options, evaluate

SIZE = (160, 120)
RNG = np.random.default_rng(0)
GROUND = cv2.GaussianBlur(RNG.integers(40, 80, (120, 160, 3), dtype=np.uint8), (0, 0), 1)
PATCH = cv2.resize(RNG.integers(90, 255, (6, 6, 3), dtype=np.uint8), (24, 24)) // np.array(
    [5, 5, 1], np.uint8
)
BOX = [60.0, 50.0, 24.0, 24.0]


def scene(x=60, y=50, *, second=None, ground=GROUND, patch=PATCH):
    """The patch on the ground, and a second one."""
    image = ground.copy()
    for left, top in [(x, y), *([second] if second else [])]:
        image[top : top + patch.shape[0], left : left + patch.shape[1]] = patch
    return Frame(color=image)


def values_of(frames, boxes):
    """The values of images, by attribute."""
    return image_values(frames, np.array(boxes, np.float64))


def flagged(key, values):
    """Which frames have an attribute."""
    return BY_KEY[key].flags(np.asarray(values)).tolist()


def test_definitions_are_complete():
    """Each has a unit or none, a meaning, a source, and its own key."""
    assert len(BY_KEY) == len(ATTRIBUTES)
    assert all(each.meaning and each.source and each.title for each in ATTRIBUTES)
    assert BY_KEY["scale"].rule == "outside 1/2 to 2 times"
    assert flagged("scale", [0.49, 0.5, 1.0, 2.0, 2.1, np.nan]) == [True, False, False, False, True, False]
    assert flagged("low_resolution", [399.0, 400.0]) == [True, False]


def otb(folder: Path, boxes, frames=None):
    """A sequence as OTB lays it out."""
    (folder / "img").mkdir(parents=True)
    for index, frame in enumerate(frames or [scene()] * len(boxes), 1):
        cv2.imwrite(str(folder / "img" / f"{index:04d}.png"), frame.color)
    lines = [",".join("NaN" if b is None else f"{v:g}" for v in (b or [0] * 4)) for b in boxes]
    (folder / "groundtruth_rect.txt").write_text("\n".join(lines) + "\n")
    return Entry("made", folder).open()


def test_boxes_tell_size_shape_motion_and_edge(tmp_path):
    """A box that grows, becomes wide, jumps, gets small and leaves the image has each in its own frame."""
    boxes = [
        [61, 51, 24, 24],
        [55, 45, 36, 36],  # 2.25 times the area
        [61, 51, 36, 16],  # 2.25 times as wide as high
        [90, 51, 24, 24],  # 23 px further
        [97, 61, 18, 18],  # 324 px²
        [150, 61, 24, 24],  # beyond the right edge, after a jump
    ]
    found = measure(otb(tmp_path / "made", boxes))
    frames = np.arange(len(boxes))
    assert found.flags("scale", frames).tolist() == [False, True, False, False, False, False]
    assert found.flags("aspect", frames).tolist() == [False, False, True, False, False, False]
    assert found.flags("fast", frames).tolist() == [False, False, False, True, False, True]
    assert found.flags("low_resolution", frames).tolist() == [False, False, False, False, True, False]
    assert found.flags("out_of_view", frames).tolist() == [False] * 5 + [True]
    assert found.has("scale")
    assert found.share("scale") == pytest.approx(1 / 6)
    assert not found.flags("scale", np.array([17]))[0]


def test_the_rate_is_that_of_the_file(tmp_path):
    """Images without times have none; where it was given, a low one is an attribute."""
    opened = otb(tmp_path / "made", [[61, 51, 24, 24]] * 3)
    assert measure(opened).known("low_rate") == 0
    assert not measure(opened).has("low_rate")
    slow = Entry("made", tmp_path / "made", None, ReadOptions(fps=10)).open()
    assert measure(slow).has("low_rate")


def test_boxes_after_the_end_of_a_video_show_nothing(tmp_path):
    """A jump in rows that no frame belongs to is no attribute, as with images."""
    writer = cv2.VideoWriter(str(tmp_path / "clip.avi"), cv2.VideoWriter.fourcc(*"MJPG"), 25, SIZE)
    for _ in range(3):
        writer.write(scene().color)
    writer.release()
    (tmp_path / "groundtruth.txt").write_text("60,50,24,24\n" * 3 + "10,10,90,90\n")
    found = measure(Entry("clip", tmp_path).open())
    assert found.known("fast") == 2
    assert not found.has("fast")
    assert not found.has("scale")


def test_blur_is_told_from_light_and_contrast():
    """A frame that is smeared is blurred; one that is only darker isn't."""
    clear = [scene() for _ in range(30)]
    smeared = cv2.blur(clear[0].color, (15, 15))
    frames = [*clear[:10], Frame(color=smeared), *clear[:10], Frame(color=clear[0].color // 2), *clear[:5]]
    flags = flagged("blur", values_of(frames, [BOX] * len(frames))["blur"])
    assert flags == [index == 10 for index in range(len(frames))]


def test_light_changes_target_and_surround():
    """A darker picture is a change of light; a hidden target, or another background, isn't."""
    dark = Frame(color=(scene().color * 0.6).astype(np.uint8))
    hidden = scene(patch=PATCH // 3)
    elsewhere = scene(ground=np.asarray(GROUND * 2.5, np.uint8))
    frames = [scene(), dark, hidden, elsewhere]
    assert flagged("light", values_of(frames, [BOX] * 4)["light"]) == [False, True, False, False]


def test_a_second_one_near_by_is_a_look_alike():
    """The same patch beside the target is found; far away it doesn't count, and alone there is none."""
    frames = [scene(), scene(second=(100, 50)), scene(10, 20, second=(130, 90))]
    found = values_of(frames, [BOX, BOX, [10.0, 20.0, 24.0, 24.0]])["look_alike"]
    assert flagged("look_alike", found) == [False, True, False]
    assert found[1] > 0.9


def test_clutter_is_common_color():
    """On a ground of the target's own colors the histograms are alike."""
    tiled = np.tile(PATCH, (5, 7, 1))[:120, :160]
    found = values_of([scene(), scene(ground=tiled)], [BOX] * 2)["clutter"]
    assert flagged("clutter", found) == [False, True]


def test_the_camera_moves_if_all_moves():
    """A shifted picture is camera motion, of the shift's length; a target that moves alone isn't."""
    wide = cv2.GaussianBlur(RNG.integers(0, 255, (120, 200, 3), dtype=np.uint8), (0, 0), 3)
    frames = [Frame(color=wide[:, 10:170].copy()), Frame(color=wide[:, 18:178].copy())]
    found = values_of(frames, [BOX] * 2)["camera"]
    assert np.isnan(found[0])
    assert found[1] == pytest.approx(8 / np.hypot(*SIZE), rel=0.1)
    assert flagged("camera", values_of([scene(), scene(70)], [BOX] * 2)["camera"])[1] is False


def test_depth_tells_what_hides_the_target():
    """Something at half of the distance before half of the target is occlusion, its approach isn't."""

    def frame(distance, hidden):
        depth = np.full((120, 160), 4.0, np.float32)
        depth[50:74, 60:84] = distance
        if hidden:
            depth[50:74, 60:72] = distance / 2
        return Frame(depth=depth)

    frames = [frame(2.0 - 0.02 * index, index == 6) for index in range(12)]
    found = depth_values(frames, np.array([BOX] * 12))["occlusion"]
    assert flagged("occlusion", found) == [index == 6 for index in range(12)]


def test_frames_without_truth_or_color_are_unknown():
    """They have NaN, and are no error; so is a box of which too little is in the image."""
    boxes = [BOX, [np.nan] * 4, [-30.0, 0.0, 31.0, 24.0], BOX]
    found = values_of([scene(), scene(), scene(), Frame(depth=np.ones((120, 160), np.float32))], boxes)
    assert np.isnan(found["clutter"]).tolist() == [False, True, True, True]
    assert np.isnan(found["camera"]).tolist() == [True, False, False, True]


def test_they_are_measured_once(tmp_path, monkeypatch):
    """A second evaluation reads what the first has stored; a damaged file, or another truth, is measured."""
    opened = otb(tmp_path / "made", [[61, 51, 24, 24]] * 4)
    first = measure_all([opened], tmp_path / "out")["made"]
    (path,) = (tmp_path / "out" / FOLDER).iterdir()
    assert json.loads(path.read_text())["sequence"] == "made"
    calls = []
    whole = measure
    monkeypatch.setattr(
        "tricue.evaluation.attributes.measure.measure", lambda each: calls.append(each) or whole(each)
    )
    again = measure_all([opened], tmp_path / "out")["made"]
    assert not calls
    for key, values in first.values.items():
        np.testing.assert_array_equal(again.values[key], values)
    path.write_text(path.read_text()[:-20])
    measure_all([opened], tmp_path / "out")
    assert len(calls) == 1
    truth = tmp_path / "made" / "groundtruth_rect.txt"
    truth.write_text(truth.read_text().replace("61,51", "62,51", 1))
    measure_all([Entry("made", tmp_path / "made").open()], tmp_path / "out")
    assert len(calls) == 2


def test_attributes_that_cannot_be_stored_are_an_error(tmp_path):
    """A full disk isn't taken for a sequence that can't be read: measured attributes never vanish."""
    opened = otb(tmp_path / "made", [[61, 51, 24, 24]] * 4)
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / FOLDER).write_text("no folder")
    with pytest.raises(FileExistsError):
        measure_all([opened], tmp_path / "out")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
def test_a_full_disk_is_told_with_the_file(tmp_path):
    """With the name of the attributes' file, not of the one that is to become it."""
    opened = otb(tmp_path / "made", [[61, 51, 24, 24]] * 4)
    path = tmp_path / "out" / FOLDER / "made.json"
    path.parent.mkdir(parents=True)
    path.with_suffix(f".{os.getpid()}.part").symlink_to("/dev/full")
    with pytest.raises(OSError, match=f"No space left on device: '{path}'"):
        measure_all([opened], tmp_path / "out")


def test_results_by_attribute(folders, tmp_path):
    """A line per attribute that a sequence has and tracker; over frames alone it is those frames' AUC."""
    evaluation = evaluate(folders, tmp_path, Options(("still-box",), restarts=False))
    found = measure_all(evaluation.opened, tmp_path)
    # Let one sequence be fast from its tenth frame on.
    values = dict(found["there"].values)
    values["fast"] = np.where(np.arange(20) >= 10, 30.0, 0.0)
    found["there"] = dataclasses.replace(found["there"], values=values)
    evaluation = dataclasses.replace(evaluation, attributes=found)
    line = next(each for each in tracker_lines(evaluation) if each["attribute"] == "fast")
    run = next(each for each in evaluation.results if each.row.sequence == "there")
    others = [each.row.auc for each in evaluation.results if each.row.sequence != "there"]
    assert (line["sequences"], line["auc"], line["without"]) == (1, run.row.auc, 2)
    assert line["auc_without"] == pytest.approx(np.mean(others))
    assert line["frames_auc"] < run.row.auc
    share = next(
        each
        for each in sequence_lines(evaluation)
        if (each["sequence"], each["attribute"]) == ("there", "fast")
    )
    assert (share["has"], share["share"], share["frames"]) == (1, 0.5, 20)


def test_otbs_labels_where_definitions_have_numbers(data):
    """On the fifteen sequences of OTB those attributes are the published ones, without an exception."""
    published = {
        "scale": "Car1 Couple Crossing David Diving Girl Human3 Human7 MotorRolling Skiing Woman",
        "fast": "Couple Human7 Jumping MotorRolling Woman",
        "low_resolution": "Car1 Skiing",
        "out_of_view": "",
    }
    others = "Bolt FaceOcc2 Football1 Jumping"
    names = {*published["scale"].split(), *others.split()}
    assert len(names) == 15
    for name in names:
        found = SequenceAttributes(truth_values(Entry(name, data / "color" / name).open()))
        assert {key: found.has(key) for key in published} == {
            key: name in labeled.split() for key, labeled in published.items()
        }
