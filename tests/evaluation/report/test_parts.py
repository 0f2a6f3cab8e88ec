# SPDX-License-Identifier: MIT
import base64
import dataclasses
import html
import math
import re
from types import SimpleNamespace

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tricue.evaluation import figures, tables
from tricue.evaluation.baselines import available
from tricue.evaluation.differences import BETTER
from tricue.evaluation.report import comparisons, curves, labels, timeline
from tricue.evaluation.report.columns import COLUMNS, best, with_numbers
from tricue.evaluation.report.markup import Html, joined, number, tag
from tricue.evaluation.report.plot_styles import line_styles
from tricue.evaluation.report.plots import Group
from tricue.evaluation.report.sequences import worst_first
from tricue.evaluation.report.summary import summary_table
from tricue.evaluation.report.worst_frames import MAX_WORST_FRAMES, worst_frames
from tricue.evaluation.rows import ScoredRun
from tricue.evaluation.significance import compare
from tricue.evaluation.tracker_spec import TrackerSpec
from tricue.track.base.registry import names
from tricue.track.base.track import Status

NAN = math.nan


def run(overlaps, tracked=None, absent=None):
    """A judged run with these overlaps."""
    count = len(overlaps)
    box = np.tile([0.0, 0.0, 4.0, 4.0], (count, 1))
    gone = np.zeros(count, bool) if absent is None else np.array(absent, bool)
    flags = np.ones(count, bool) if tracked is None else np.array(tracked, bool)
    statuses = tuple(Status.TRACKED if each else Status.LOST for each in flags)
    overlap, unknown = np.array(overlaps, float), np.full(count, NAN)
    return ScoredRun(0, box, box, gone, overlap, np.ones(count), statuses, flags, unknown)


@given(st.text(), st.text())
def test_text_and_attributes_are_escaped(text, value):
    """Whatever is put into an element leaves it one element, from which a reader gets the same text back."""
    made = tag("p", text, title=value)
    inner = re.fullmatch(r'<p title="([^"<>]*)">([^<>]*)</p>', made, re.DOTALL)
    assert inner
    assert inner[1] == html.escape(value)
    assert inner[2] == html.escape(text)


def test_sequences_of_which_nothing_is_known_are_last():
    """Without a frame that counts the AUC is NaN, which no other number is above or below."""
    aucs = {"a": 0.9, "b": NAN, "c": 0.2, "d": NAN, "e": 0.5}
    evaluation = SimpleNamespace(
        opened=[SimpleNamespace(entry=SimpleNamespace(name=name)) for name in aucs],
        one_pass=[
            SimpleNamespace(row=SimpleNamespace(sequence=name, tracker="t", auc=auc))
            for name, auc in aucs.items()
        ],
        trackers=[SimpleNamespace(name="t", ours=True)],
    )
    assert [each.opened.entry.name for each in worst_first(evaluation)] == ["c", "e", "a", "b", "d"]


def test_html_is_left_as_it_is():
    """HTML isn't escaped twice, None is nothing, lists are their parts, flags stand alone."""
    assert tag("p", [Html("<b>"), None, "&"], hidden=True, id=None, class_="a") == (
        '<p hidden class="a"><b>&amp;</p>'
    )
    assert joined(tag("br"), 1) == "<br>1"
    assert number(NAN) == "\N{EN DASH}"
    assert number(1234.5678, 2) == "1,234.57"


def test_worst_frames_are_apart():
    """The start, and the lowest overlaps, of which those near a lower one are left out."""
    overlaps = np.full(80, 0.9)
    overlaps[[20, 21, 40, 60, 75]] = [0.1, 0.0, 0.3, 0.2, 0.25]
    assert worst_frames(run(overlaps)) == [0, 21, 40, 60, 75]


def test_a_long_loss_is_shown_from_its_beginning():
    """Of equal overlaps the earliest is chosen, then others an eighth of the run apart."""
    overlaps = np.where(np.arange(160) < 50, 0.8, 0.0)
    assert worst_frames(run(overlaps)) == [0, 50, 70, 90, 110]


def test_false_alarms_are_worst_frames():
    """A frame without the target counts as worst if its status is TRACKED, else not at all."""
    overlaps, absent, tracked = np.full(40, 0.5), np.zeros(40, bool), np.ones(40, bool)
    absent[[10, 30]], overlaps[[10, 30]] = True, NAN
    tracked[30] = False
    chosen = worst_frames(run(overlaps, tracked, absent))
    assert 10 in chosen
    assert 30 not in chosen


@given(st.lists(st.one_of(st.floats(0, 1), st.just(NAN)), min_size=1, max_size=60))
def test_worst_frames_have_truth(overlaps):
    """Ascending, at most the first frame and four others, all but the start with a known overlap."""
    chosen = worst_frames(run(overlaps))
    assert chosen[0] == 0
    assert chosen == sorted(set(chosen))
    assert len(chosen) <= 1 + MAX_WORST_FRAMES
    assert not any(math.isnan(overlaps[index]) for index in chosen[1:])


def test_a_timeline_has_overlap_absence_and_status():
    """Columns have the shade of the overlap, of absence, of nothing known; below is the status."""
    made = timeline.timeline(run([0.0, 0.5, 1.0, NAN, NAN], [1, 1, 1, 0, 1], [0, 0, 0, 1, 0]), "label")
    data = re.search(r'src="data:image/png;base64,([^"]+)"', made)
    picture = cv2.imdecode(np.frombuffer(base64.b64decode(data[1]), np.uint8), cv2.IMREAD_COLOR)[:, :, ::-1]
    assert picture.shape[1] == 5
    assert [hexed(color) for color in picture[0]] == [
        timeline.SHADES[0], timeline.SHADES[3], timeline.SHADES[5], timeline.ABSENT_COLOR, timeline.UNKNOWN
    ]  # fmt: skip
    assert [hexed(color) for color in picture[-1]] == [timeline.TRACKED] * 3 + [
        timeline.NOT_TRACKED,
        timeline.TRACKED,
    ]


def test_a_long_timeline_keeps_short_losses():
    """One lost frame of thousands is seen: a column has the shade of its worst frame."""
    overlaps = np.ones(5000)
    overlaps[2345] = 0
    made = timeline.timeline(run(overlaps), "label")
    data = base64.b64decode(re.search(r'base64,([^"]+)"', made)[1])
    top = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)[0, :, ::-1]
    assert len(top) == timeline.MAX_COLUMNS
    assert [hexed(color) for color in top].count(timeline.SHADES[0]) == 1


def hexed(color):
    """A pixel as the page writes colors."""
    return "#" + bytes(color.tolist()).hex()


def test_shades_fall_in_lightness():
    """Worse is darker, so that timelines mean the same to readers who can't distinguish red from green."""
    lab = cv2.cvtColor(np.array([[list(bytes.fromhex(s[1:]))[::-1] for s in timeline.SHADES]], np.uint8),
                       cv2.COLOR_BGR2LAB)[0, :, 0].astype(int)  # fmt: skip
    assert (np.diff(lab[:4]) > 20).all()
    assert lab[4:].min() > lab[2]


def test_curves_are_those_of_the_summary(evaluation):
    """The mean of a success curve is the summary's AUC, and the precision curve at 20 px its P20."""
    lines = tables.summary(evaluation)
    for line in lines:
        results = evaluation.of(line["group"], line["tracker"])
        assert curves.success(results).mean() == pytest.approx(line["auc"], abs=1e-12)
        assert curves.precision(results)[20] == pytest.approx(line["precision"], abs=1e-12)
        counted = sum((~np.isnan(each.scored.overlaps) | each.scored.absent).sum() for each in results)
        assert curves.reliability(results).counts.sum() == counted


def test_line_styles_differ():
    """All trackers and baselines have different colors or dashes; tricue's are solid."""
    every = [TrackerSpec(name) for name in (*names(), *available())]
    found = line_styles(every)
    assert len({(style.color, style.dashes) for style in found.values()}) == len(every)
    assert all((found[each.name].dashes == "") == each.ours for each in every)


def test_labels_of_a_crowd_lie_apart():
    """Six points on nearly the same spot get names inside the axes that overlap neither names nor points."""
    points = [(0.5, 0.5 + 0.01 * index) for index in range(6)]
    areas = [labels._area(label, "name") for label in labels.place(points, ["name"] * 6)]
    assert all(area.shared(labels._AXES) == area.size for area in areas)
    assert not any(a.shared(b) for index, a in enumerate(areas) for b in areas[:index])
    assert not any(a.left < x < a.right and a.low < y < a.high for a in areas for x, y in points)


def test_labels_without_a_free_position_cover_no_point():
    """Where every position of "color-particle" touches something, its name covers a little of another name,
    and none of the points.
    """
    points = [
        (0.8974, 0.6515),
        (0.8012, 0.5597),
        (0.4989, 0.4398),
        (0.6226, 0.547),
        (0.1, 0.2),
        (0.087, 0.222),
    ]
    trackers = ["fused", "color-particle", "mine.py:Mine", "my_wide", "mine.py:still", "mine.py:Broken_one"]
    areas = [
        labels._area(label, name)
        for label, name in zip(labels.place(points, trackers), trackers, strict=True)
    ]
    assert any(a.shared(b) for index, a in enumerate(areas) for b in areas[:index])
    assert not any(a.left < x < a.right and a.low < y < a.high for a in areas for x, y in points)


@given(st.lists(st.tuples(st.floats(0, 1), st.floats(0, 1)), max_size=8))
def test_labels_stay_beside_their_points(points):
    """Whatever the crowd, a name begins or ends next to its point, inside the axes."""
    for (x, y), label in zip(points, labels.place(points, ["name"] * len(points)), strict=True):
        assert abs(label.x - x) < 0.05
        assert abs(label.y - y) < 0.13
        area = labels._area(label, "name")
        assert area.left >= 0
        assert area.right <= 1


def line(tracker, sequences, **values):
    """A line of the summary; NaN for what isn't given."""
    keys = [column.key for column in COLUMNS]
    return {"tracker": tracker, "sequences": sequences, **dict.fromkeys(keys, NAN), **values}


def compared(**aucs):
    """Comparisons of trackers by their AUC on each of some sequences, and of nothing else."""
    values = {
        name: {str(index): each for index, each in enumerate(numbers)} for name, numbers in aucs.items()
    }
    nothing = compare({}, {})
    return dict.fromkeys(BETTER, nothing) | {"auc": compare(values, {})}


def test_only_trackers_that_ran_on_all_can_be_best():
    """A mean over fewer sequences is noted as such, and not marked, however good it is; of times the best is
    marked.
    """
    lines = [line("a", 8, auc=0.5, fps=10.0), line("b", 8, auc=0.4, fps=20.0), line("c", 6, auc=0.9)]
    steps = [0.01 * index for index in range(8)]
    found = compared(
        a=[0.5 + each for each in steps],
        b=[0.4 - each for each in steps],
        c=[0.9 - each / 2 for each in steps[:6]],
    )
    found["auc"] = dataclasses.replace(found["auc"], means={k: found["auc"].means[k] for k in "ab"})
    styles = line_styles([TrackerSpec(name) for name in "abc"])
    made = summary_table("color", lines, 8, {"a"}, styles, found)
    assert re.findall(r"<strong>([^<]*)</strong>", made) == ["0.500", "20"]
    assert "c (6 of 8)" in made
    assert made.count('class="badge"') == 1


def test_what_cannot_be_told_apart_is_marked_the_same():
    """Eight sequences on which b is sometimes better: both are marked. Of three sequences nothing is, and the
    table says why.
    """
    lines = [line("a", 8, auc=0.53), line("b", 8, auc=0.5)]
    styles = line_styles([TrackerSpec(name) for name in "ab"])
    a, b = [0.5, 0.6, 0.4, 0.7, 0.5, 0.6, 0.4, 0.5], [0.6, 0.5, 0.5, 0.5, 0.4, 0.6, 0.5, 0.4]
    made = summary_table("color", lines, 8, {"a"}, styles, compared(a=a, b=b))
    assert re.findall(r"<strong>([^<]*)</strong>", made) == ["0.530", "0.500"]
    assert made.count('class="interval"') == 2
    few = summary_table("color", lines, 8, {"a"}, styles, compared(a=a[:3], b=b[:3]))
    assert "<strong>" not in few
    assert "this group has 3 recordings" in few


def test_columns_without_numbers_are_left_out():
    """A column needs a number; those of long-term tracking need absent frames."""
    few = line("a", 1, auc=0.5, f_score=0.6, true_positive=0.7)
    assert [column.key for column in with_numbers([few])] == ["auc"]
    heads = [column.key for column in with_numbers([few, line("b", 1, true_negative=0.1)])]
    assert heads == ["auc", "f_score", "true_positive", "true_negative"]


def test_the_best_is_the_highest_or_the_lowest():
    """By the column's direction, NaN left out."""
    auc, failures = with_numbers([line("a", 1, auc=0.1, failures=3.0)])
    lines = [line("a", 1, auc=0.1, failures=3.0), line("b", 1, auc=0.2), line("c", 1, failures=0.0)]
    assert best(auc, lines) == 0.2
    assert best(failures, lines) == 0.0
    assert math.isnan(best(auc, [line("c", 1)]))


def test_a_group_knows_its_trackers(evaluation):
    """Those that ran on it, ours apart."""
    lines = tables.summary(evaluation)
    assert Group.of(evaluation, "color", lines).ours == ["color-particle"]
    assert list(Group.of(evaluation, "depth", lines).results) == ["depth-particle", "meanShift", "still-box"]


def test_differences_that_round_to_0_have_no_sign():
    """Neither in the matrix of the report nor in the figure for a paper: "-0.00" would look like a loss."""
    found = compare({"a": {f"{n}": 0.5 for n in range(8)}, "b": {f"{n}": 0.5001 for n in range(8)}}, {})
    for first, second in ("ab", "ba"):
        cell = comparisons._pair_cell(found, first, second)
        assert ">0.000<" in cell
        assert ">[0.00, 0.00]<" in cell
    figure = pytest.importorskip("matplotlib.figure", reason="figures: pip install tricue[evaluate]")
    axes = figure.Figure().add_subplot()
    figures._matrix(found)(axes)
    assert [each.get_text() for each in axes.texts] == ["0.00", "0.00"]
