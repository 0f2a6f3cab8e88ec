# SPDX-License-Identifier: MIT
import csv

import cv2
import numpy as np
import pytest
from tricue.evaluation import compare, metrics, peers, sequences
from tricue.evaluation.one_pass import run


@pytest.fixture
def folder(patrol, tmp_path):
    """The patrol as an OTB sequence on disk, without truth for its last two frames."""
    frames, boxes = patrol
    (tmp_path / "patrol" / "img").mkdir(parents=True)
    for index, frame in enumerate(frames, start=1):
        cv2.imwrite(str(tmp_path / "patrol" / "img" / f"{index:04d}.png"), frame.color)
    lines = [f"{box.x + 1:g},{box.y + 1:g}\t{box.width:g} {box.height:g}" for box in boxes[:-2]]
    (tmp_path / "patrol" / "groundtruth_rect.txt").write_text("\n".join(lines) + "\n")
    return tmp_path


def test_sequence_comes_back_as_written(folder, patrol):
    """Frames are those written, boxes count from 0 whatever parts them, frames past the truth have NaN."""
    (path,) = sequences.find(folder)
    sequence = sequences.load(path)
    assert sequence.name == "patrol"
    assert all(np.array_equal(a.color, b.color) for a, b in zip(sequence.frames, patrol[0], strict=True))
    np.testing.assert_array_equal(sequence.truth[:18], patrol[1][:18])
    assert np.isnan(sequence.truth[18:]).all()


def test_comparison_scores_what_the_tracker_said(folder, patrol, tmp_path, capsys):
    """The CSV's numbers are the metrics of the same run made by hand; the table shows each tracker once."""
    path = tmp_path / "runs.csv"
    arguments = [str(folder), "--trackers", "still-box,script-pf", "--seeds", "2", "--csv", str(path)]
    assert compare.main(arguments) == 0
    with path.open() as file:
        rows = list(csv.DictReader(file))
    assert [(row["tracker"], row["seed"]) for row in rows] == [
        ("still-box", "0"),
        ("script-pf", "0"),
        ("script-pf", "1"),
    ]
    sequence = sequences.load(folder / "patrol")
    for row in rows:
        result = run(peers.available()[row["tracker"]](int(row["seed"])), *patrol[:1], patrol[1][0])
        score = metrics.score(result.boxes, sequence.truth)
        assert float(row["auc"]) == score.auc
        assert float(row["mean_error"]) == score.mean_error
    table = capsys.readouterr().out
    assert table.count("| still-box |") == table.count("| script-pf |") == 1


@pytest.mark.parametrize("text", ["", "nan,nan,nan,nan\n1,2,3,4\n"])
def test_sequence_without_a_first_box_is_named(text, folder):
    """A sequence whose first frame has no true box can't be started on, and is named."""
    (folder / "patrol" / "groundtruth_rect.txt").write_text(text)
    with pytest.raises(ValueError, match="patrol: expected a true box in the first frame"):
        sequences.load(folder / "patrol")


def test_unknown_tracker_is_named(folder, capsys):
    """A name that no tracker has ends with one line that lists the known ones, and exit code 2."""
    with pytest.raises(SystemExit) as error:
        compare.main([str(folder), "--trackers", "still-box,magic"])
    assert error.value.code == 2
    assert "--trackers: expected some of color-particle, " in (message := capsys.readouterr().err)
    assert "got 'magic'" in message


def test_folder_without_sequences_is_an_error(tmp_path, capsys):
    """An empty folder ends with one line and exit code 2."""
    with pytest.raises(SystemExit) as error:
        compare.main([str(tmp_path)])
    assert error.value.code == 2
    assert "expected sequences with true boxes" in capsys.readouterr().err


def test_recorded_sequences_load(data):
    """The recorded sequences decode, and every one has a first true box inside its first frame."""
    for path in sequences.find(data):
        sequence = sequences.load(path)
        height, width = sequence.frames[0].color.shape[:2]
        x, y, box_width, box_height = sequence.truth[0]
        assert 0 <= x < x + box_width <= width
        assert 0 <= y < y + box_height <= height
        assert len(sequence.truth) == len(sequence.frames) > 70


def test_peer_gets_the_published_score(data):
    """CSRT follows Crossing as measured elsewhere (AUC 0.70): loop, truth and metric are right."""
    if "CSRT" not in peers.available():
        pytest.skip("this cv2 has no CSRT: opencv-contrib-python-headless has")
    row = compare.measure("CSRT", peers.available()["CSRT"], 0, sequences.load(data / "color" / "Crossing"))
    assert row.auc == pytest.approx(0.70, abs=0.03)
    assert row.precision > 0.99
