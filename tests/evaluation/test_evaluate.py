# SPDX-License-Identifier: MIT
import json
import shutil
from dataclasses import replace

import numpy as np
import pytest
from tricue.camera.box import Box
from tricue.evaluation import metrics, one_pass, tables
from tricue.evaluation.baselines import StillBox
from tricue.evaluation.evaluate import RUNS, Options, evaluate
from tricue.evaluation.record import Record
from tricue.evaluation.tasks import ONE_PASS, RESTARTS, perform

FEW = Options(trackers=("color-particle", "meanShift", "still-box"), seeds=2)


class Counted:
    """Performs tasks and remembers them; breaks off in the given one."""

    def __init__(self, stop=None):
        self.tasks, self.stop = [], stop

    def __call__(self, task):
        if len(self.tasks) == self.stop:
            raise KeyboardInterrupt
        self.tasks.append(task)
        return perform(task)


def table(folder, evaluation):
    """The bytes of the tables that tell what the runs say."""
    tables.write(evaluation, folder, {})
    return [(folder / name).read_bytes() for name in (tables.ROWS, tables.SUMMARY)]


def rows_of(evaluation, tracker):
    """A tracker's rows without its name, as text, in which NaN equals itself."""
    found = [each.row for each in evaluation.results if each.row.tracker == tracker]
    return [str(replace(row, tracker="")) for row in found]


@pytest.fixture(scope="module")
def undisturbed(folders, tmp_path_factory):
    """The few trackers over the three sequences, and the folder with all of it."""
    folder = tmp_path_factory.mktemp("undisturbed")
    return folder, evaluate(folders, folder, FEW)


@pytest.mark.parametrize(
    "wrong", [{"trackers": "fused"}, {"trackers": (StillBox,)}, {"protocols": "starts"}, {"results": None}]
)
def test_options_take_several_names(wrong):
    """A single name, whose letters would be taken for names, and a class are told by the argument."""
    with pytest.raises(TypeError, match=rf"^{next(iter(wrong))}: expected a tuple of names, got "):
        Options(**wrong)
    assert Options(trackers=["fused"]).trackers == ["fused"]


def test_every_tracker_sequence_seed_and_kind_is_a_run(undisturbed):
    """Those that draw random numbers run with each seed, the others once; each also with restarts."""
    folder, evaluation = undisturbed
    runs = {(each.row.tracker, each.row.sequence, each.row.seed) for each in evaluation.results}
    assert len(runs) == 3 * (2 + 1 + 1)
    files = list((folder / RUNS).rglob("*.json"))
    assert len(files) == 2 * len(runs)
    assert {json.loads(path.read_text())["kind"] for path in files} == {ONE_PASS, RESTARTS}
    assert not evaluation.failed


def test_numbers_are_those_of_a_run_by_hand(undisturbed, patrol):
    """The row of a box that never moves has the scores of that box; its positions are unknown."""
    frames, boxes = patrol
    row = next(
        each.row
        for each in undisturbed[1].results
        if (each.row.tracker, each.row.sequence) == ("still-box", "there")
    )
    run = one_pass.run(StillBox(), frames, boxes[0])
    score = metrics.score(run.boxes, np.array(boxes))
    assert (row.auc, row.precision, row.success) == (score.auc, score.precision, score.success)
    assert (row.frames, row.tracked, row.group) == (20, 1.0, "color")
    assert np.isnan(row.position_error)
    assert np.isnan(row.true_negative)


def test_a_tracker_that_follows_is_told_from_one_that_does_not(undisturbed):
    """The particle filter holds the patrol; the box that stays loses it, and says TRACKED."""
    lines = {line["tracker"]: line for line in tables.summary(undisturbed[1])}
    assert lines["color-particle"]["auc"] > 0.8 > 0.5 > lines["still-box"]["auc"]
    assert lines["still-box"]["auroc"] == 0.5
    assert lines["color-particle"]["sequences"] == 3


def test_one_tracker_with_several_settings(undisturbed, folders, tmp_path):
    """A tracker of ours under other names: each has its parameters, and with the defaults the same rows."""
    chosen, settings = ("same=color-particle", "few=color-particle"), {"few": {"particles": 20}}
    evaluation = evaluate(folders, tmp_path, Options(chosen, settings, seeds=2))
    plain = rows_of(undisturbed[1], "color-particle")
    assert rows_of(evaluation, "same") == plain
    assert rows_of(evaluation, "few") != plain
    parameters = tables.settings(evaluation)["parameters"]
    assert [(name, each["tracker"], each["particles"]) for name, each in parameters.items()] == [
        ("same", "color-particle", 100),
        ("few", "color-particle", 20),
    ]


def test_an_interrupted_evaluation_goes_on(undisturbed, folders, tmp_path):
    """Only what is missing runs the second time, and the tables are the same to the last bit."""
    first, second, third = Counted(stop=5), Counted(), Counted()
    with pytest.raises(KeyboardInterrupt):
        evaluate(folders, tmp_path, FEW, work=first)
    again = evaluate(folders, tmp_path, FEW, work=second)
    assert len(first.tasks) == 5
    assert len(second.tasks) == 24 - 5
    assert not set(first.tasks) & set(second.tasks)
    assert table(tmp_path, again) == table(*undisturbed)
    assert table(tmp_path, evaluate(str(folders), str(tmp_path), FEW, work=third)) == table(*undisturbed)
    assert not third.tasks


def test_damaged_and_old_files_count_for_nothing(undisturbed, folders, tmp_path):
    """A file that is cut off, empty, or of other parameters is run again."""
    shutil.copytree(undisturbed[0] / RUNS, tmp_path / RUNS)
    paths = sorted((tmp_path / RUNS / ONE_PASS / "color-particle").rglob("*.json"))
    paths[0].write_text(paths[0].read_text()[:-100])
    paths[1].write_text("")
    counted = Counted()
    assert table(tmp_path, evaluate(folders, tmp_path, FEW, work=counted)) == table(*undisturbed)
    assert len(counted.tasks) == 2
    other = Options(FEW.trackers, {"color-particle": {"particles": 50}}, FEW.seeds)
    evaluate(folders, tmp_path, other, work=(changed := Counted()))
    assert {task.tracker.name for task in changed.tasks} == {"color-particle"}
    assert len(changed.tasks) == 3 * 2 * 2


def test_changed_sequences_are_run_again(folders, tmp_path):
    """A corrected true box makes old runs of that sequence worthless, and of no other."""
    shutil.copytree(folders, tmp_path / "data")
    options = Options(("still-box",), restarts=False)
    evaluate(tmp_path / "data", tmp_path / "out", options)
    path = tmp_path / "data" / "back" / "groundtruth_rect.txt"
    path.write_text(path.read_text().replace("\n", "\n\n", 0).replace("40,40", "41,40", 1))
    evaluate(tmp_path / "data", tmp_path / "out", options, work=(counted := Counted()))
    assert [task.entry.name for task in counted.tasks] == ["back"]


def test_fresh_runs_everything(folders, tmp_path):
    """What was run before doesn't count."""
    options = Options(("still-box",), restarts=False)
    evaluate(folders, tmp_path, options)
    evaluate(folders, tmp_path, options, fresh=True, work=(counted := Counted()))
    assert len(counted.tasks) == 3


def test_two_processes_say_what_one_says(undisturbed, folders, tmp_path):
    """Bit for bit the same tables by two jobs."""
    assert table(tmp_path, evaluate(folders, tmp_path, FEW, jobs=2)) == table(*undisturbed)


def test_a_broken_sequence_does_not_stop_the_others(folders, tmp_path):
    """A malformed truth and a cut-off image are told by file; the other sequences have their numbers."""
    data = tmp_path / "data"
    shutil.copytree(folders, data)
    (data / "back" / "groundtruth_rect.txt").write_text("1,2,3,4\noops\n")
    image = data / "gap" / "img" / "0005.png"
    image.write_bytes(image.read_bytes()[:300])
    evaluation = evaluate(data, tmp_path / "out", Options(("still-box",), restarts=False))
    assert [each.row.sequence for each in evaluation.results] == ["there"]
    assert set(evaluation.failed) == {"back", "one-pass/still-box/gap/seed-0"}
    assert "groundtruth_rect.txt, line 2" in evaluation.failed["back"]
    assert "0005.png" in evaluation.failed["one-pass/still-box/gap/seed-0"]


def test_a_tracker_that_breaks_finds_nothing_from_there(folders, tmp_path, monkeypatch):
    """Its error stands in the row with its frame, its boxes count as misses, and the evaluation goes on."""

    def update(self, frame):
        raise ValueError("frame: not\nthis one")

    monkeypatch.setattr(StillBox, "update", update)
    evaluation = evaluate(folders, tmp_path, Options(("still-box", "meanShift"), restarts=False))
    rows = {(each.row.tracker, each.row.sequence): each.row for each in evaluation.results}
    assert rows["still-box", "there"].trouble == "frame 1: frame: not this one"
    assert rows["still-box", "there"].auc == pytest.approx(1 / 20 * 20 / 21, abs=1e-9)
    assert rows["meanShift", "there"].trouble == ""


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            Options(("color-particel",)),
            "^trackers: expected some of color-particle, .* got 'color-particel'",
        ),
        (Options(settings={"color-particle": {"particles": -1}}), "particles"),
        (Options(settings={"still-box": {"scales": 2}}), "got one of still-box"),
        (
            Options(("color-particle", "still-box"), {"fused": {"max_speed": 3}}),
            r"^settings: expected a parameter of a tracker that runs \(color-particle, .*\), got .*'fused'",
        ),
        (Options(settings={"fussed": {"max_speed": 3}}), "^settings: .*color-particle.* got one of 'fussed'"),
    ],
)
def test_wrong_options_are_told_before_anything_runs(folders, tmp_path, options, message):
    """The error names what is wrong; nothing is written."""
    with pytest.raises(ValueError, match=message):
        evaluate(folders, tmp_path, options)
    assert not list(tmp_path.iterdir())


def test_a_folder_without_sequences_is_refused(tmp_path):
    """The error names the folder."""
    with pytest.raises(ValueError, match="expected sequences with true boxes, found none; tricue info says"):
        evaluate(tmp_path, tmp_path / "out", FEW)


def test_boxes_are_the_trackers_own(undisturbed, patrol):
    """A run's file holds what the tracker says when it is run by hand with the same seed."""
    import tricue

    frames, boxes = patrol
    path = undisturbed[0] / RUNS / ONE_PASS / "color-particle" / "there" / "seed-1.json"
    record = Record.from_json(path.read_text())
    run = one_pass.run(tricue.create("color-particle", seed=1), frames, Box(*boxes[0]))
    np.testing.assert_array_equal(record.run.boxes, run.boxes)
    np.testing.assert_array_equal(record.run.scores, run.scores)


def test_a_folder_that_cant_be_written_is_told_before_the_first_run(folders, tmp_path):
    """It proves that no run is lost for it."""
    file = tmp_path / "file"
    file.touch()
    with pytest.raises(OSError, match="file"):
        evaluate(folders, file, Options(("still-box",)), work=lambda _: pytest.fail("it ran"))


def test_a_first_box_alone_is_no_success(folders, tmp_path):
    """If only the box is known on which trackers start, as in test sets, no tracker is perfect."""
    for name in ("back", "there"):
        shutil.copytree(folders / name, tmp_path / "data" / name)
    path = tmp_path / "data" / "there" / "groundtruth_rect.txt"
    path.write_text(path.read_text().splitlines()[0] + "\n")
    options = Options(("still-box",), protocols=("every-3",))
    evaluation = evaluate(tmp_path / "data", tmp_path / "out", options)
    back, there = (each.row for each in evaluation.one_pass)
    assert there.frames == 20
    assert np.isnan([there.auc, there.precision, there.iou, there.tracked, there.failures]).all()
    assert tables.summary(evaluation)[0]["auc"] == back.auc
    assert [note.partition(":")[0] for note in evaluation.notes] == ["there"]
