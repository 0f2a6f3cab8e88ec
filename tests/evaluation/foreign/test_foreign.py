# SPDX-License-Identifier: MIT
"""Trackers that aren't ours, in processes of their own."""

import os
import pickle
import re
import shutil
import time
from contextlib import closing
from functools import cache
from importlib.metadata import EntryPoint
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue.camera.frame import Frame
from tricue.evaluation import baselines
from tricue.evaluation.dataset import find_entries
from tricue.evaluation.evaluate import RUNS, Options, evaluate
from tricue.evaluation.foreign import process
from tricue.evaluation.foreign.spec import ForeignSpec, foreign_spec, is_foreign, split_name
from tricue.evaluation.record import Record
from tricue.evaluation.report.page import write_report
from tricue.evaluation.tasks import RESTARTS, Task, perform
from tricue.evaluation.trackers import tracker_specs
from tricue.track.base import registry
from tricue.track.base.track import Status

ODD = Path(__file__).with_name("odd_trackers.py")
LIMIT = 4.0  # seconds; only for those that hang
PATIENT = 120.0  # for the others, on a busy machine
AT = 4  # the frame in which the odd ones are odd


@pytest.fixture
def there(folders):
    """The patrol, as a data set's entry."""
    return next(entry for entry in find_entries(folders) if entry.name == "there")


def run(name, entry, limit=PATIENT, seed=0, **settings):
    """The record of one of the odd trackers on a sequence."""
    spec = odd(name, limit) if not settings else foreign_spec(f"{ODD}:{name}", settings, limit)
    return perform(Task(spec, entry, seed))


@cache
def odd(name, limit=PATIENT):
    """The spec of one of the odd trackers."""
    return foreign_spec(f"{ODD}:{name}", {}, limit)


@pytest.mark.parametrize("name", ["Still", "AsFrame", "make", "Reads"])
def test_a_class_or_function_of_a_file(name, there, patrol):
    """It proves that any of them runs on images as they are read, whatever it prints and reads."""
    record = run(name, there)
    np.testing.assert_array_equal(record.run.boxes, [patrol[1][0]] * 20)
    assert set(record.run.statuses) == {Status.TRACKED}
    assert record.run.seconds.shape == (19,)
    assert record.error == ""


def test_parameters_reach_the_class(there, patrol):
    """It proves that settings are the keywords it is made with; wrong ones are told before anything runs."""
    record = run("Still", there, step=2.0)
    np.testing.assert_array_equal(record.run.boxes, patrol[1])
    with pytest.raises(ValueError, match=r"odd_trackers.py:Still: .*unexpected keyword argument 'stride'"):
        run("Still", there, stride=1)


def test_answers_as_opencv_gives_them(there, patrol):
    """It proves that (found, box) is understood: while nothing is found, the last box is kept and lost."""
    record = run("LikeOpenCv", there)
    np.testing.assert_array_equal(record.run.boxes, [patrol[1][0]] * 20)
    assert [index for index, each in enumerate(record.run.statuses) if each is Status.LOST] == [AT]


def test_a_box_of_nan_is_none(there, patrol):
    """It proves that a box of NaN is a lost target in its frame, and that the run goes on."""
    record = run("Nan", there)
    assert record.error == ""
    np.testing.assert_array_equal(record.run.boxes, [patrol[1][0]] * 20)
    assert [index for index, each in enumerate(record.run.statuses) if each is Status.LOST] == [AT]


def test_answers_with_scores(there):
    """It proves that (box, score) gives the scores."""
    np.testing.assert_allclose(run("Scores", there).run.scores[1:], 1 / np.arange(1, 20))


@pytest.mark.parametrize(
    ("name", "error"),
    [
        ("Raises", "KeyError: 'no\\\\nsuch thing'"),
        ("Text", "update: expected a Track, a box .*, got 'here'"),
        ("Five", r"update returned a box: expected four numbers .*, got \[1, 2, 3, 4, 5\]"),
        ("Table", "update: expected a Track, a box .*, got array"),
        ("Negative", r"update returned a box: expected width and height above 0, got \([^()]*\)$"),
        ("NanScore", "update: expected a finite score, got nan"),
        ("Exits", r"it called sys.exit\('enough'\)"),
        ("ExitsAtOnce", "its process ended with exit code 3; its last words: a last line"),
        ("Crashes", "its process was ended by SIGSEGV"),
        ("Hangs", r"no answer within 4 s \(time_limit\)"),
        ("HangsInC", r"no answer within 4 s \(time_limit\)"),
    ],
)
def test_what_goes_wrong_in_an_update(name, error, there, patrol):
    """It proves that the record says what and in which frame, and keeps what was tracked before it."""
    record = run(name, there, LIMIT if name.startswith("Hangs") else PATIENT)
    assert record.error.startswith(f"frame {AT}: ")
    assert re.match(error, record.error.removeprefix(f"frame {AT}: "))
    np.testing.assert_array_equal(record.run.boxes[:AT], [patrol[1][0]] * AT)
    assert np.isnan(record.run.boxes[AT:]).all()
    assert set(record.run.statuses[AT:]) == {Status.LOST}
    assert len(record.run.seconds) == AT - 1


@pytest.mark.parametrize(
    ("name", "limit", "error"),
    [
        ("FailsWhileMade", PATIENT, "no weights here"),
        ("HangsWhileMade", LIMIT, "not loaded within 4 s (time_limit)"),
        (
            "make_nothing",
            PATIENT,
            "TypeError: make_nothing: expected to make a tracker with init and update, got int",
        ),
    ],
)
def test_what_goes_wrong_while_it_is_made(name, limit, error, there, monkeypatch):
    """It proves that such a run is told, and lost from the first frame."""
    odd(name, limit)
    monkeypatch.setattr(process, "LOADING_LIMIT", limit)
    record = run(name, there, limit)
    assert record.error == f"frame 0: {error}"
    assert np.isnan(record.run.boxes).all()
    assert record.run.seconds.size == 0


def test_a_hanging_tracker_is_waited_for_once(there):
    """It proves that restarts don't wait again for a process that was ended."""
    record = perform(Task(odd("HangsInC", LIMIT), there, kind=RESTARTS))
    assert record.error == f"frame {AT}: no answer within 4 s (time_limit)"
    assert len(record.starts) > 1
    assert np.isfinite(record.run.boxes).all(axis=1).sum() == AT


def test_a_limit_that_ends_between_two_requests(monkeypatch):
    """It proves that an answer that the time limit overtakes is late, and that no crash is made of it."""
    load = pickle.load

    def slow_load(stream):
        answer = load(stream)
        time.sleep(2 * limit)
        return answer

    limit = 0.5
    with closing(process.WorkerProcess(f"{ODD}:Still", limit)) as worker:
        worker.load("describe", {})
        monkeypatch.setattr(process.pickle, "load", slow_load)
        for _ in range(2):
            with pytest.raises(process.WorkerError, match=re.escape(process.no_answer(limit))):
                worker.ask("close")


def test_time_is_measured_where_the_tracker_runs(there):
    """It proves that the update that sleeps has its time, and the others have none of the process's."""
    seconds = run("Slow", there).run.seconds
    assert seconds[AT - 1] >= 0.2
    assert np.median(seconds) < 0.1


def test_random_trackers_are_repeated(there):
    """It proves that one that takes a seed is run with each, and that the usual generators are seeded."""
    assert odd("Seeded").random
    assert not odd("Draws").random
    for name in ("Seeded", "Draws"):
        first, again, other = (run(name, there, seed=seed).run.boxes for seed in (0, 0, 1))
        np.testing.assert_array_equal(first, again)
        assert not np.array_equal(first, other)


@pytest.mark.parametrize("jobs", [1, 2])
def test_the_others_finish(folders, tmp_path, jobs, capfd):
    """It proves that an evaluation with bad trackers has all rows, and that prints stay out of its output."""
    names = ["Still", "Raises", "Crashes", "ExitsAtOnce"]
    chosen = ("still-box", *(f"{ODD}:{name}" for name in names))
    evaluation = evaluate(folders, tmp_path, Options(chosen, restarts=False, time_limit=PATIENT), jobs=jobs)
    rows = {(each.row.tracker, each.row.sequence): each.row for each in evaluation.results}
    assert len(rows) == 5 * 3
    assert not evaluation.failed
    for sequence in ("there", "back", "gap"):
        assert rows["odd_trackers.py:Still", sequence].auc == rows["still-box", sequence].auc
        assert rows["odd_trackers.py:Crashes", sequence].trouble.startswith(f"frame {AT}: ")
    assert capfd.readouterr() == ("", "")


def test_scores_of_any_range_have_their_rows(folders, tmp_path):
    """It proves that scores above 1 and below 0 leave all trackers their rows, and have an AUROC and F."""
    options = Options(("still-box", f"{ODD}:Logits"), restarts=False, time_limit=PATIENT)
    evaluation = evaluate(folders / "there", tmp_path, options)
    rows = {each.row.tracker: each for each in evaluation.results}
    assert rows["odd_trackers.py:Logits"].scored.scores[1:].tolist() == list(range(2, -17, -1))
    assert rows["odd_trackers.py:Logits"].row.auc == rows["still-box"].row.auc
    assert rows["odd_trackers.py:Logits"].row.auroc > 0.9 > rows["still-box"].row.auroc
    assert rows["odd_trackers.py:Logits"].row.f_score > rows["still-box"].row.f_score
    assert "odd_trackers.py:Logits" in write_report(evaluation, tmp_path, {}).read_text(encoding="utf-8")


def test_runs_are_repeated_for_other_code(folders, tmp_path):
    """It proves that a changed file, or one that it imports from beside it, makes old runs worthless."""
    for path in (ODD, ODD.with_name("odd_helper.py")):
        shutil.copy(path, tmp_path)
    options = Options((f"{tmp_path}/odd_trackers.py:Still",), restarts=False, time_limit=PATIENT)

    def count():
        tasks = []
        evaluate(folders, tmp_path / "out", options, work=lambda task: tasks.append(task) or perform(task))
        return len(tasks)

    assert (count(), count()) == (3, 0)
    for name in ("odd_helper.py", "odd_trackers.py"):
        with (tmp_path / name).open("a") as file:
            file.write("# changed\n")
        assert count() == 3


def test_another_time_limit_repeats_what_it_ended(folders, tmp_path):
    """It proves that such runs alone are run again."""
    done = []

    def work(task):
        done.append(task.tracker.name)
        return perform(task)

    chosen = (f"{ODD}:Hangs", f"{ODD}:Raises")
    for limit in (LIMIT, LIMIT, LIMIT + 1):
        evaluate(folders / "there", tmp_path, Options(chosen, restarts=False, time_limit=limit), work=work)
    assert sorted(done) == ["odd_trackers.py:Hangs"] * 2 + ["odd_trackers.py:Raises"]
    (path,) = (tmp_path / RUNS).rglob("*Hangs/**/*.json")
    assert Record.from_json(path.read_text()).error == f"frame {AT}: no answer within 5 s (time_limit)"


@pytest.mark.parametrize(
    ("error", "repeated"),
    [
        ("frame 0: not loaded within 60 s (time_limit)", False),
        ("frame 0: not loaded within 90 s (time_limit)", True),
        ("frame 4: no answer within 4 s (time_limit)", False),
        ("frame 4: no answer within 60 s (time_limit)", True),
        ("frame 4: RuntimeError: no answer within the beam", False),
        ("", False),
    ],
)
def test_what_no_other_limit_ended_is_kept(error, repeated):
    """It proves that a run that was ended while it loaded, where the limit is a minute at least, isn't run
    again and again, nor one whose own error sounds alike.
    """
    assert ForeignSpec("theirs", time_limit=LIMIT).outdated(error) is repeated


def test_an_infinite_position_is_unknown(folders, tmp_path):
    """It proves that it doesn't end the evaluation, whose files have no infinity."""
    chosen = Options((f"{ODD}:InfinitePosition",), restarts=False, time_limit=PATIENT)
    (result,) = evaluate(folders / "there", tmp_path, chosen).results
    assert result.row.trouble == ""


def test_trackers_of_cv2_by_their_names(there, patrol):
    """It proves that MIL, which every cv2 has, follows, also where a function makes it, and that the package
    of others is named.
    """
    for place in ("cv2:TrackerMIL", f"{ODD}:mil"):
        record = perform(Task(foreign_spec(place, {}, PATIENT), there))
        assert np.linalg.norm(record.run.boxes[-1] - patrol[1][-1]) < 12
    if not hasattr(cv2, "legacy"):
        with pytest.raises(
            ValueError, match=r"has no legacy.TrackerMOSSE; opencv-contrib-python-headless has"
        ):
            foreign_spec("cv2:legacy.TrackerMOSSE", {}, PATIENT)
    with pytest.raises(
        ValueError, match=r"^cv2:TrackerBest: cv2 [\d.]+ has no TrackerBest; it has .*TrackerMIL"
    ):
        foreign_spec("cv2:TrackerBest", {}, PATIENT)


def test_a_missing_baseline_is_told(folders, tmp_path, monkeypatch):
    """It proves that one that was asked for is left out with the package that has it; alone it is refused."""
    rest = {name: make for name, make in baselines.available().items() if name != "CSRT"}
    monkeypatch.setattr(baselines, "available", lambda: rest)
    evaluation = evaluate(folders, tmp_path, Options(("CSRT", "still-box"), restarts=False))
    reasons = {why for (tracker, _), why in evaluation.left_out.items() if tracker == "CSRT"}
    assert len(reasons) == 1
    assert "has no CSRT; opencv-contrib-python-headless has" in reasons.pop()
    with pytest.raises(ValueError, match=r"^trackers: cv2 .* has no CSRT; opencv-contrib"):
        tracker_specs(("CSRT",), {})


@pytest.mark.parametrize(
    ("text", "name", "place"),
    [
        ("package.module:Class", "package.module:Class", "package.module:Class"),
        ("/a/b.py:Class", "b.py:Class", "/a/b.py:Class"),
        ("mine=/a/b.py:Class", "mine", "/a/b.py:Class"),
        ("cv2:legacy.TrackerMOSSE", "cv2:legacy.TrackerMOSSE", "cv2:legacy.TrackerMOSSE"),
        ("trax:/usr/bin/theirs --x=1:2 3", "trax:theirs", "trax:/usr/bin/theirs --x=1:2 3"),
        ("theirs=trax:./theirs --x=1", "theirs", "trax:./theirs --x=1"),
        ("trax:'/my programs/theirs' --x=1", "trax:theirs", "trax:'/my programs/theirs' --x=1"),
    ],
)
def test_names_and_places(text, name, place):
    """It proves which part is the name in tables, and which says where the tracker is."""
    assert split_name(text) == (name, place)


def test_a_registered_tracker_under_another_name(monkeypatch):
    """It proves that NAME= is understood before the name of another package's tracker, too."""
    theirs = EntryPoint("theirs", "package:Theirs", registry.GROUP)
    monkeypatch.setattr(registry, "_installed_entry_points", lambda: {"theirs": theirs})
    assert [is_foreign(text) for text in ("theirs", "mine=theirs", "mine=fused")] == [True, True, False]
    assert split_name("mine=theirs") == ("mine", "package:Theirs")
    assert split_name("theirs") == ("theirs", "package:Theirs")


def test_a_program_needs_a_command():
    """It proves that a place without the rest is told in words."""
    with pytest.raises(ValueError, match="trax: expected a command after it, got none"):
        tracker_specs(("trax:",), {})


@pytest.mark.parametrize(
    ("chosen", "message"),
    [
        ((f"{ODD}:Nobody",), "odd_trackers.py has no Nobody"),
        ((f"{ODD}:ODD",), "expected a class with init and update, got int"),
        (("/nowhere/x.py:Class",), "/nowhere/x.py: there is no such file"),
        (("missing.module:Class",), "there is no module missing"),
        ((f"still-box={ODD}:Still",), "expected another name than 'still-box', which is taken"),
        (("fused=color-particle",), "expected another name than 'fused', which is taken"),
        (("few=still-box",), "expected some of color-particle.*got 'few=still-box'"),
    ],
)
def test_wrong_places_are_told_before_anything_runs(chosen, message):
    """It proves that a place without a tracker, and names that don't do, are named in one line."""
    with pytest.raises(ValueError, match=message) as caught:
        tracker_specs(chosen, {})
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("chosen", "message"),
    [
        (("fused", f"a={ODD}:Still", f"a={ODD}:Raises"), "expected different names, got 'a' twice"),
        (("still-box", "still-box"), "expected different names, got 'still-box' twice"),
        (("fused", "a=fused", "a=color-particle"), "expected different names, got 'a' twice"),
        ((f"..={ODD}:Still",), r"expected a name without slashes, got '\.\.'"),
    ],
)
def test_names_are_names_of_folders(chosen, message, folders, tmp_path):
    """It proves that each tracker has a name of its own, under which its runs are kept."""
    with pytest.raises(ValueError, match=message):
        evaluate(folders, tmp_path, Options(chosen))
    assert not list(tmp_path.iterdir())


def test_a_tracker_of_depth_pictures():
    """It proves that on boxes of a depth image one for color gets the depth as a picture."""

    class Depth:
        channels, channel, registered, intrinsics, rig = ("depth",), "depth", True, None, None

    spec = odd("Still")
    assert spec.unsupported_reason(Depth()) == ""
    for depth in (np.arange(1.0, 73.0).reshape(8, 9), np.full((8, 9), 2.0)):  # also of a wall
        assert spec.view(Depth())(Frame(depth=depth)).channels == ("color",)


def test_traits_alone_choose_the_channels():
    """It proves that a class with traits but no Params gets its channels; its settings are checked without
    its camera.
    """

    class Depth:
        channels, channel, registered, intrinsics, rig = ("depth",), "depth", True, None, None

    spec = foreign_spec(f"{ODD}:OnDepth", {"step": 1.0}, PATIENT)
    assert spec.view(Depth())(Frame(depth=np.ones((8, 9)))).channels == ("depth",)
    assert spec.keywords(Depth()) == {"intrinsics": None, "step": 1.0}
    with pytest.raises(ValueError, match=r"odd_trackers.py:OnDepth: .*unexpected keyword argument 'stride'"):
        foreign_spec(f"{ODD}:OnDepth", {"stride": 1}, PATIENT)


def test_processes_are_gone_afterwards(there):
    """It proves that no child of this process is left by a run that was whole, crashed or hung."""
    for name, limit in (("Still", PATIENT), ("Crashes", PATIENT), ("HangsInC", LIMIT)):
        run(name, there, limit)
    children = Path(f"/proc/{os.getpid()}/task/{os.getpid()}/children")
    if not children.is_file():
        pytest.skip("this system doesn't list a process's children")
    commands = [Path(f"/proc/{pid}/cmdline").read_bytes() for pid in children.read_text().split()]
    assert not [each for each in commands if b"foreign.worker" in each]
