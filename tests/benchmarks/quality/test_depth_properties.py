# SPDX-License-Identifier: MIT
import csv

import cv2
import numpy as np
import pytest

from benchmarks.quality import depth_properties

FRAMES, WIDTH, HEIGHT = 9, 320, 240
CAMERA = "fx = 200.0\nfy = 200.0\ncx = 159.5\ncy = 119.5\n"


@pytest.fixture
def dataset(tmp_path):
    """A bright board at 1 m that goes 4 px right a frame, a shadow of 7 px at its left, before a dark wall at
    2 m; no depth in the first ten columns; a second target that is the wall's middle.
    """
    folder = tmp_path / "data" / "board"
    for name in ("color", "depth"):
        (folder / name).mkdir(parents=True)
    truth = []
    for index in range(FRAMES):
        left = 80 + 4 * index
        depth, color = np.full((HEIGHT, WIDTH), 2000, np.uint16), np.full((HEIGHT, WIDTH, 3), 40, np.uint8)
        depth[60:180, left : left + 100], color[60:180, left : left + 100] = 1000, 220
        depth[60:180, left - 7 : left] = 0
        depth[:, :10] = 0
        cv2.imwrite(str(folder / "depth" / f"{index + 1:08}.png"), depth)
        cv2.imwrite(str(folder / "color" / f"{index + 1:08}.png"), color)
        truth.append(f"{left},60,100,120\n")
    (folder / "groundtruth.txt").write_text("".join(truth))
    (folder / "groundtruth_wall.txt").write_text("120,200,40,30\n" * FRAMES)
    channels = "".join(f"channels.{name}={name}/%08d.png\n" for name in ("color", "depth"))
    (folder / "sequence").write_text(f"name=board\nfps=15\nlength={FRAMES}\n{channels}")
    (folder / "intrinsics.toml").write_text(CAMERA)
    return folder.parent


def test_the_command_measures_recordings(dataset, tmp_path, capsys):
    """Rate, view, holes by brightness, the shadow with its side and baseline, edges and surround of a known
    recording, and the median over recordings.
    """
    assert depth_properties.main([str(dataset), "--csv", str(tmp_path / "o.csv")]) == 0
    assert "| board | median |" in capsys.readouterr().out
    lines = csv.DictReader((tmp_path / "o.csv").read_text().splitlines())
    found = {line["property"]: float(line["board"] or "nan") for line in lines}
    assert found["frames/s"] == 15
    assert found["outside of the depth's view, %"] == pytest.approx(100 * 10 / WIDTH)
    shadow = 7 * 120 / (HEIGHT * (WIDTH - 10))
    assert found["no depth, all, %"] == pytest.approx(100 * shadow)
    assert found["no depth, bright, %"] == 0
    assert found["shadow left: steps with one, %"] == 100
    assert found["shadow left: width, px"] == 7
    assert found["shadow left: baseline, mm"] == pytest.approx(1000 * 7 / (200 * 0.5))
    assert found["shadow right: baseline, mm"] == 0
    assert found["flying pixels per step"] == 0
    assert abs(found["edges: shift along x, px"]) <= 1
    assert found["same depth below, %"] == pytest.approx(50)  # of the board 0, of the wall 100
    assert found["target's step, 90 %, sides"] == pytest.approx(4 / np.sqrt(12000), rel=0.01)


def test_the_command_measures_rooms(monkeypatch, capsys):
    """A column per kind and seed."""
    monkeypatch.setattr(depth_properties, "measure", lambda recording: {"frames/s": recording.rate})
    monkeypatch.setattr(depth_properties, "rendered", FakeRecording)
    assert depth_properties.main(["--rooms", "table", "walker", "--seeds", "0:2"]) == 0
    printed = capsys.readouterr().out
    assert "|  | table 0 | table 1 | walker 0 | walker 1 | median |" in printed
    assert "| frames/s | 0.00 | 1.00 | 0.00 | 1.00 | 0.50 |" in printed


class FakeRecording:
    """A recording whose rate is its seed."""

    def __init__(self, kind, seed):
        self.name, self.rate = f"{kind} {seed}", float(seed)


def test_a_folder_without_depth_is_refused(tmp_path, capsys):
    """The error names the folder."""
    with pytest.raises(SystemExit):
        depth_properties.main([str(tmp_path)])
    assert str(tmp_path) in capsys.readouterr().err
