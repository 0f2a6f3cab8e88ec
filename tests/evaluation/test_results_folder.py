# SPDX-License-Identifier: MIT
"""Folders of others' results, written here as the toolkits write them."""

import shutil
from dataclasses import astuple
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue.evaluation.dataset import Entry, find_entries
from tricue.evaluation.evaluate import Options, evaluate
from tricue.evaluation.markdown import markdown
from tricue.evaluation.results_folder import ResultError, results_spec, sequence_names
from tricue.evaluation.rows import make_row, score_run
from tricue.track.base.track import Status

FRAMES = 20
SEQUENCES = {"there": 20, "back": 20, "gap": 14}


@pytest.fixture
def found(patrol):
    """Boxes for the sequence "there", from 0: the first is the true one, the others are 2 px to the right."""
    boxes = np.array(patrol[1])
    boxes[1:, 0] += 2
    return boxes


@pytest.fixture
def there(folders):
    """The sequence."""
    return next(each for each in find_entries(folders) if each.name == "there").open()


def write(path, boxes, between=","):
    """A file of boxes."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("".join(between.join(f"{number:.4f}" for number in box) + "\n" for box in boxes))


def lines(boxes):
    """Lines of VOT's: the start's code, then rectangles."""
    return ["1", *(",".join(f"{number:.4f}" for number in box) for box in boxes[1:])]


def write_lines(path, texts):
    """A file of lines."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("".join(f"{text}\n" for text in texts))


@pytest.mark.parametrize("between", [",", "\t", " ", ", "])
@pytest.mark.parametrize("suffix", [".txt", ".csv"])
def test_otb(tmp_path, there, found, between, suffix):
    """It proves that boxes are read whatever separates them, and counted from 1 as the true ones are."""
    write(tmp_path / f"There{suffix}", found + [1, 1, 0, 0], between)
    spec = results_spec(f"theirs={tmp_path}")
    assert (spec.name, spec.form) == ("theirs", "otb")
    (record,), supervised, first_pixel = spec.read(there)
    np.testing.assert_allclose(record.run.boxes, found, atol=1e-4)
    assert (supervised, first_pixel, record.error) == (False, 1, "")
    assert record.run.seconds.size == 0
    np.testing.assert_array_equal(record.run.scores, 1)


def test_the_first_pixel_shows_in_the_first_box(tmp_path, there, found):
    """It proves that results counted from 0 are told from those from 1, and that a form says it for all."""
    write(tmp_path / "there.txt", found)
    assert results_spec(f"theirs={tmp_path}").read(there).first_pixel == 0
    found[0] += 0.3
    write(tmp_path / "there.txt", found)
    assert results_spec(f"theirs={tmp_path}").read(there).first_pixel == 1
    for form, pixel in (("otb0", 0), ("otb1", 1)):
        spec = results_spec(f"theirs={tmp_path}:{form}")
        (record,), _, first_pixel = spec.read(there)
        assert first_pixel == pixel
        np.testing.assert_allclose(record.run.boxes, found - [pixel, pixel, 0, 0], atol=1e-4)


def test_got10k_with_repetitions_and_times(tmp_path, there, found):
    """It proves that each repetition is a run, with its column of times; the folder may be the one above."""
    for repetition in (1, 2):
        moved = found + [[repetition * (index > 0), 0, 0, 0] for index in range(FRAMES)]
        write(tmp_path / "SiamX" / "there" / f"there_{repetition:03d}.txt", moved)
    times = np.stack([np.full(FRAMES, 0.01), np.full(FRAMES, 0.02)], axis=1)
    write(tmp_path / "SiamX" / "there" / "there_time.txt", times)
    spec = results_spec(f"SiamX={tmp_path}")
    assert spec.form == "got10k"
    records = spec.read(there).records
    assert [record.run.boxes[5, 0] - found[5, 0] for record in records] == pytest.approx([1, 2])
    assert [record.run.frames_per_second for record in records] == pytest.approx([100, 50])
    assert records[0].run.seconds.shape == (FRAMES - 1,)


def test_otb_with_times_as_got10k_writes_it(tmp_path, there, found):
    """It proves that times/Sequence_time.txt is found beside the results, and isn't taken for a result."""
    write(tmp_path / "there.txt", found)
    write(tmp_path / "times" / "there_time.txt", np.full((FRAMES, 1), 0.004))
    spec = results_spec(f"theirs={tmp_path}")
    assert spec.form == "otb"
    assert spec.read(there).records[0].run.frames_per_second == pytest.approx(250)


@pytest.mark.parametrize("experiment", ["unsupervised", "longterm"])
def test_vot_with_confidences(tmp_path, there, found, experiment):
    """It proves that a code is the start, NaN is lost, polygons and masks boxes, confidences scores."""
    texts = lines(found)
    x, y, width, height = found[3]
    texts[3] = f"{x},{y},{x + width},{y},{x + width},{y + height},{x},{y + height}"
    texts[4] = f"m{x:.0f},{y:.0f},{width:.0f},{height:.0f},0,1600"
    texts[5] = "nan,nan,nan,nan"
    place = tmp_path / experiment / "there"
    write_lines(place / "there_001.txt", texts)
    write_lines(
        place / "there_001_confidence.value", ["", *(f"{index / 100:.2f}" for index in range(1, FRAMES))]
    )
    write_lines(place / "there_001_time.value", ["0.5"] + ["0.25"] * (FRAMES - 1))
    spec = results_spec(f"theirs={tmp_path}")
    assert spec.form == "vot"
    (record,), supervised, _ = spec.read(there)
    assert not supervised
    expected = found.copy()
    expected[4], expected[5] = found[3], np.nan
    np.testing.assert_allclose(record.run.boxes, expected, atol=1e-4)
    np.testing.assert_allclose(record.run.scores, [1, *np.arange(1, FRAMES) / 100])
    assert [index for index, each in enumerate(record.run.statuses) if each is Status.LOST] == [5]
    assert record.error == "1 frame without a box"
    assert record.run.frames_per_second == pytest.approx(4)


def test_vots_confidences_are_any_numbers(tmp_path, folders, found):
    """It proves that results whose confidences are no probabilities are compared with the others."""
    write_lines(tmp_path / "longterm" / "there" / "there_001.txt", lines(found))
    told = ["", *(f"{-index}" for index in range(2, FRAMES)), "nan"]
    write_lines(tmp_path / "longterm" / "there" / "there_001_confidence.value", told)
    options = Options(("still-box",), restarts=False, results=(f"theirs={tmp_path}",))
    evaluation = evaluate(folders / "there", tmp_path / "out", options)
    assert {each.row.tracker for each in evaluation.results} == {"still-box", "theirs"}
    (theirs,) = [each for each in evaluation.results if each.row.tracker == "theirs"]
    assert theirs.scored.scores.tolist() == [1, *range(-2, -FRAMES, -1), 1]


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_results_with_a_byte_order_mark(tmp_path, there, found, encoding):
    """PowerShell may have written the boxes and the confidences, all of which are read."""
    place = tmp_path / "longterm" / "there"
    write_lines(place / "there_001.txt", lines(found))
    write_lines(place / "there_001_confidence.value", ["0.5"] * FRAMES)
    for path in place.iterdir():
        path.write_text(path.read_text(), encoding=encoding)
    (record,), *_ = results_spec(f"theirs={tmp_path}").read(there)
    assert record.run.scores.tolist() == [0.5] * FRAMES


def test_bytes_that_are_no_text_are_no_confidences(tmp_path, there, found):
    """It proves that a damaged companion file ends no evaluation: what it doesn't tell is unknown."""
    place = tmp_path / "longterm" / "there"
    write_lines(place / "there_001.txt", lines(found))
    told = b"0.5\n" * (FRAMES - 1) + b"\xff\xfe\n"
    (place / "there_001_confidence.value").write_bytes(told)
    (record,), *_ = results_spec(f"theirs={tmp_path}").read(there)
    assert record.run.scores.tolist() == [0.5] * (FRAMES - 1) + [1]


@pytest.mark.parametrize(
    ("first", "form"),
    [("1", "vot"), ("m3,4,5,6,0,30", "vot"), ("31.0,41.0,40.0,40.0", "got10k")],
)
def test_forms_are_told_apart_without_an_experiments_folder(tmp_path, found, first, form):
    """It proves that one and the same file names are VOT's if a file begins with a code or a mask."""
    write_lines(tmp_path / "there" / "there_001.txt", [first, *lines(found)[1:]])
    assert results_spec(f"theirs={tmp_path}").form == form
    assert results_spec(f"theirs={tmp_path}:vot").form == "vot"


def test_vot_with_restarts(tmp_path, folders, found, there):
    """It proves that runs with restarts have VOT's failures and accuracy, and no number of one pass."""
    texts = lines(found)
    texts[6:11] = ["2", "0", "0", "0", "0"]
    texts[11] = "1"
    write_lines(tmp_path / "baseline" / "there" / "there_001.txt", texts)
    spec = results_spec(f"theirs={tmp_path}")
    (record,), supervised, _ = spec.read(there)
    assert (supervised, record.starts, record.error) == (True, (0, 11), "")
    options, updates = Options(("still-box",), results=(f"theirs={tmp_path}",)), []
    evaluation = evaluate(folders, tmp_path / "out", options, on_progress=updates.append)
    assert all(each.done <= each.total for each in updates)
    assert updates[-1].done == updates[-1].total
    (row,) = [each.row for each in evaluation.results if each.row.tracker == "theirs"]
    assert row.failures == 1
    assert np.isnan(row.auc)
    assert np.isnan(row.iou)
    assert "started again after failures" in evaluation.notes[-1]
    assert "nan" not in markdown(evaluation)


def test_results_are_compared_as_if_they_had_been_run(tmp_path, folders, patrol):
    """It proves that the boxes of still-box, read from files, have its row; a sequence without a result
    that fits is left out, and the others go on.
    """
    first = np.array(patrol[1][0]) + [1, 1, 0, 0]
    write(tmp_path / "there.txt", [first] * 20)
    write(tmp_path / "gap.txt", [first] * 13)
    options = Options(("still-box",), restarts=False, results=(f"theirs={tmp_path}",))
    evaluation = evaluate(folders, tmp_path / "out", options)
    rows = {(each.row.tracker, each.row.sequence): each.row for each in evaluation.results}
    ours, theirs = (rows[name, "there"] for name in ("still-box", "theirs"))
    assert (theirs.auc, theirs.precision, theirs.frames) == (ours.auc, ours.precision, 20)
    assert set(rows) == {("still-box", name) for name in SEQUENCES} | {("theirs", "there")}
    assert evaluation.left_out == {
        ("theirs", "back"): f"no result in {tmp_path}",
        ("theirs", "gap"): "gap.txt: has 13 lines, the sequence 14 frames",
    }
    assert evaluation.notes == ("theirs: results in otb form, 1 of 3 sequences, pixels counted from 1",)
    assert not evaluation.failed
    shown = markdown(evaluation)
    line = next(line for line in shown.splitlines() if line.startswith("| theirs"))
    assert [cell.strip() for cell in line.split("|")[-3:]] == ["-", "-", ""]


@pytest.mark.parametrize("form", ["otb", "vot"])
def test_as_many_lines_as_rows_of_the_truth(tmp_path, there, found, form):
    """It proves that results end with the true boxes where the folder has more images, as OTB's Football1:
    the frames after them have no box, which counts for nothing and isn't told.
    """
    place = tmp_path / "there"
    shutil.copytree(there.entry.place, place)
    truth = next(path for path in place.glob("groundtruth*"))
    truth.write_text("".join(truth.read_text().splitlines(keepends=True)[:15]))
    opened = Entry("there", place).open()
    assert (opened.source.length, len(opened.boxes)) == (20, 15)
    rows = []
    for count in (15, 20):
        folder = tmp_path / str(count)
        if form == "otb":
            write(folder / "there.txt", found[:count] + [1, 1, 0, 0])
        else:
            path = folder / "unsupervised" / "there" / "there_001.txt"
            write_lines(path, lines(found[:count]))
            write_lines(path.with_name("there_001_confidence.value"), ["", *["0.5"] * (count - 1)])
            write_lines(path.with_name("there_001_time.value"), ["0.1"] * count)
        (record,), *_ = results_spec(f"theirs={folder}").read(opened)
        assert record.error == ""
        assert np.isnan(record.run.boxes[count:]).all()
        assert record.run.seconds.size == (count - 1 if form == "vot" else 0)
        rows.append(make_row(opened, "theirs", 0, score_run(record, opened)))
    np.testing.assert_equal(astuple(rows[0]), astuple(rows[1]))
    write(tmp_path / "16" / "there.txt", found[:16])
    with pytest.raises(ResultError, match="has 16 lines, the sequence 20 frames and 15 rows of true boxes"):
        results_spec(f"theirs={tmp_path / '16'}").read(opened)


def test_as_many_lines_as_frames_of_a_video(tmp_path):
    """It proves that this holds for a video, too, whose length no file tells, as of our own raw results."""
    images = np.random.default_rng(0).integers(0, 256, (20, 48, 64, 3), np.uint8)
    writer = cv2.VideoWriter(str(tmp_path / "clip.avi"), cv2.VideoWriter_fourcc(*"MJPG"), 30, (64, 48))
    for image in images:
        writer.write(image)
    writer.release()
    write_lines(tmp_path / "clip.csv", ["5,5,20,20"] * 15)
    opened = Entry("clip", tmp_path / "clip.avi").open()
    write_lines(tmp_path / "20" / "clip.txt", ["5,5,20,20"] * 20)
    (record,), *_ = results_spec(f"theirs={tmp_path / '20'}").read(opened)
    assert len(record.run.boxes) == 20
    write_lines(tmp_path / "16" / "clip.txt", ["5,5,20,20"] * 16)
    with pytest.raises(ResultError, match="has 16 lines, the sequence 20 frames and 15 rows of true boxes"):
        results_spec(f"theirs={tmp_path / '16'}").read(opened)
    write_lines(tmp_path / "clip.csv", ["5,5,20,20"] * 25)
    opened = Entry("clip", tmp_path / "clip.avi").open()
    write_lines(tmp_path / "25" / "clip.txt", ["5,5,20,20"] * 25)
    with pytest.raises(ResultError, match="has 25 lines, the sequence 20 frames"):
        results_spec(f"theirs={tmp_path / '25'}").read(opened)


def test_what_is_no_box_is_told(tmp_path, there, found):
    """It proves that the file and line are named; empty boxes are missing ones."""
    write(tmp_path / "there.txt", found)
    texts = (tmp_path / "there.txt").read_text().splitlines()
    write_lines(tmp_path / "there.txt", [*texts[:4], "0,0,0,0", *texts[5:]])
    record = results_spec(f"theirs={tmp_path}").read(there).records[0]
    assert np.isnan(record.run.boxes[4]).all()
    write_lines(tmp_path / "there.txt", [*texts[:4], "oops", *texts[5:]])
    with pytest.raises(ResultError, match=r"there.txt, line 5: expected four numbers .*'oops'"):
        results_spec(f"theirs={tmp_path}").read(there)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("folder", "results: expected NAME=FOLDER, got 'folder'"),
        ("a=nowhere", "results: nowhere: there is no such folder"),
        ("a=.", "expected Sequence.txt, .* found none"),
        ("a=.:coco", "expected a form of otb, otb0, otb1, got10k, vot, got 'coco'"),
    ],
)
def test_what_is_no_folder_of_results(tmp_path, monkeypatch, text, message):
    """It proves that the argument and what is wrong with it are named."""
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ValueError, match=message):
        results_spec(text)


def test_matlab_files_are_told(tmp_path):
    """It proves that a folder of them gets advice."""
    (tmp_path / "there.mat").touch()
    with pytest.raises(ValueError, match="MATLAB's files can't be read, write them as text"):
        results_spec(f"a={tmp_path}")


@pytest.mark.parametrize(
    ("name", "target", "names"),
    [
        ("David", None, ["david"]),
        ("color/Box 3", None, ["color/box_3", "color-box_3", "color.box_3", "color_box_3", "box_3"]),
        ("Jogging/2", "2", ["jogging/2", "jogging-2", "jogging.2", "jogging_2"]),
    ],
)
def test_names_of_sequences(name, target, names):
    """It proves that a sequence is found by its name, with its folder's, and with its target's."""
    assert sequence_names(Entry(name, Path(), target)) == names


def test_a_name_that_several_sequences_have_tells_none():
    """It proves that of sequences with one name each is found by its folder's alone."""
    assert sequence_names(Entry("a/Box", Path()), ["a/Box", "b/Box", "b/Ball"])[-1] == "a_box"
    assert sequence_names(Entry("b/Ball", Path()), ["a/Box", "b/Box", "b/Ball"])[-1] == "ball"
