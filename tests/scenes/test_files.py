# SPDX-License-Identifier: MIT
import numpy as np
import pytest

pytest.importorskip("skimage", reason="scenes need scikit-image: pip install tricue[demo]")

from tricue.cli.program import main
from tricue.data.open_source import open_source
from tricue.evaluation.dataset import find_entries
from tricue.scenes.files import write_sequence
from tricue.scenes.heads.head import head
from tricue.scenes.rooms.scene import room_scene
from tricue.scenes.stress.scene import stress_scene


@pytest.mark.parametrize("channels", ["color", "rgbd", "stereo", "depth"])
def test_what_is_written_is_read_back(tmp_path, channels):
    """A data set of one scene has its frames bit for bit, its truth, who is absent, and its camera."""
    made = stress_scene("leaving", 2, (160, 120), channels)
    write_sequence(made, tmp_path / "scene")
    (entry,) = find_entries(tmp_path)
    opened, count = entry.open(), len(made.frames)
    opened.check()
    assert opened.group == channels
    assert opened.start == 0
    frames = tuple(opened.source)
    assert len(frames) == count
    for found, true in zip(frames, made.frames, strict=True):
        assert found.channels == true.channels
        for name in true.channels:
            assert np.array_equal(getattr(found, name), getattr(true, name), equal_nan=name == "depth")
    absent = made.visible == 0
    assert np.array_equal(opened.absent(count), absent)
    assert absent.sum() == 30
    true = made.boxes if channels == "stereo" else np.array([clipped(box) for box in made.boxes])
    true[absent] = np.nan
    assert opened.truth(count) == pytest.approx(true, abs=1e-4, nan_ok=True)
    assert opened.positions(count) == pytest.approx(made.positions, abs=1e-6, nan_ok=True)
    assert opened.rig == made.rig
    assert open_source(tmp_path / "scene").calibration == tmp_path / "scene" / "intrinsics.toml"
    if channels in ("rgbd", "depth"):
        assert opened.intrinsics == made.intrinsics
        assert opened.registered


def test_a_written_pair_is_tracked_in_meters(tmp_path, capsys):
    """``tricue track`` finds the rig of a stereo scene beside its images."""
    made = room_scene("walker", 0, (160, 120), "stereo", frames=3)
    write_sequence(made, tmp_path / "scene")
    command = ["track", str(tmp_path / "scene"), "--csv", str(tmp_path / "o.csv")]
    assert main(command) == 0
    assert f"calibration found: {tmp_path / 'scene' / 'intrinsics.toml'}" in capsys.readouterr().out
    rows = (tmp_path / "o.csv").read_text().splitlines()
    place = [float(cell) for cell in rows[1].split(",")[rows[0].split(",").index("X_m") :][:3]]
    assert place == pytest.approx(made.positions[0], abs=0.3)


def clipped(box, width=160, height=120):
    """The part of a box in the image."""
    ends = np.clip([box[:2], box[:2] + box[2:]], 0, [width, height])
    return np.concatenate([ends[0], ends[1] - ends[0]])


def test_a_hidden_target_is_absent_but_has_a_position(tmp_path):
    """While it is hidden the table's box is empty, and the position is told."""
    made = stress_scene("hidden", 1, (160, 120))
    write_sequence(made, tmp_path / "scene")
    opened = find_entries(tmp_path)[0].open()
    count = len(made.frames)
    assert opened.absent(count).sum() == 20
    assert np.isnan(opened.truth(count)).any(axis=1).sum() == 20
    assert not np.isnan(opened.positions(count)).any()


def test_a_full_folder_is_refused(tmp_path):
    """Nothing is written among other files."""
    made = stress_scene("plain", 0, (80, 80))
    write_sequence(made, tmp_path)
    with pytest.raises(FileExistsError, match="expected a new or an empty folder"):
        write_sequence(made, tmp_path)


def test_a_room_is_read_back_at_its_rate(tmp_path):
    """A room's frames, truth and low frame rate."""
    made = room_scene("walker", 1, (96, 80), "rgbd", frames=3)
    write_sequence(made, tmp_path / "room")
    (entry,) = find_entries(tmp_path)
    opened = entry.open()
    frames = tuple(opened.source)
    assert [frame.timestamp for frame in frames] == pytest.approx([0, 1 / made.rate, 2 / made.rate])
    assert np.array_equal(frames[2].depth, made.frames[2].depth, equal_nan=True)
    assert opened.truth(3) == pytest.approx(np.array([clipped(box, 96, 80) for box in made.boxes]), abs=1e-4)


def test_a_room_of_one_frame_keeps_its_rate(tmp_path):
    """The frame rate isn't lost where there is no interval to tell it."""
    made = room_scene("walker", 1, (96, 80), frames=1)
    write_sequence(made, tmp_path / "room")
    assert f"fps={made.rate:g}" in (tmp_path / "room" / "sequence").read_text().splitlines()


def test_a_scene_of_another_kind_is_refused(tmp_path):
    """Nothing is written of a scene without the truth of a stress scene or a room."""
    with pytest.raises(TypeError, match="scene: expected a StressScene or a RoomScene, got StereoScene"):
        write_sequence(head(0, 2), tmp_path / "head")
    assert not (tmp_path / "head").exists()
