# SPDX-License-Identifier: MIT
import csv

import numpy as np
import pytest
from tricue.papers.moreno import curves as stereo_curves
from tricue.papers.moreno.curves import StereoCurve, lag
from tricue.track.base.track import Status

FRAMES = 60
TIME = np.arange(FRAMES, dtype=np.float64)


def place(time):
    """(M, 3) of a head on a smooth way."""
    return np.stack([0.3 * np.sin(time / 7), 0.1 * np.cos(time / 9), 2 + 0.5 * np.sin(time / 11)], axis=1)


def curve(**changes):
    """A tracker that is right in every frame, but for the changes."""
    known = {
        "model": "m",
        "scene": "s",
        "seed": 0,
        "boxes": np.tile([10.0, 20.0, 30.0, 40.0], (FRAMES, 1)),
        "positions": place(TIME),
        "truth": place(TIME),
        "covariances": np.tile(np.diag([1e-4, 4e-4, 9e-4]), (FRAMES, 1, 1)),
        "overlaps": np.ones(FRAMES),
        "visible": np.ones(FRAMES),
        "statuses": (Status.TRACKED,) * FRAMES,
        "seconds": {"search": 2e-4, "rest": 1e-4},
    }
    return StereoCurve(**(known | changes))


def cells(*curves):
    """The first line of their table, by column."""
    line = stereo_curves.summarize(curves).splitlines()[2]
    return dict(
        zip(stereo_curves.COLUMNS, (cell.strip() for cell in line.strip("|").split("|")), strict=True)
    )


def test_errors_are_shares_of_the_distance():
    """2 % farther along the line of sight is an error of 2 %."""
    run = curve(positions=1.02 * place(TIME))
    np.testing.assert_allclose(run.errors, 0.02)
    assert (cells(run)["error %: median"], cells(run)["95 %"]) == ("2.00", "2.0")


def test_consistent_covariances_have_a_mean_of_three():
    """Errors drawn from the covariances have a mean normalized square of 3; twice as large ones, of 12."""
    off = np.random.default_rng(1).normal(0, [0.01, 0.02, 0.03], (20, FRAMES, 3))
    for scale, expected in ((1, 3), (2, 12)):
        means = [curve(positions=place(TIME) + scale * each).nees.mean() for each in off]
        assert np.mean(means) == pytest.approx(expected, rel=4 * np.sqrt(2 / 3 / FRAMES / 20))


def test_deviation_is_the_root_of_the_trace():
    """1, 2 and 3 cm along the axes are a distance of the root of 14 cm^2."""
    np.testing.assert_allclose(curve().deviations, np.sqrt(14) / 100)


@pytest.mark.parametrize("late", [0.0, 0.37, 1.0, 2.4, -0.5])
def test_lag_is_what_the_track_is_late(late):
    """A track that is where the head was some frames ago is late by them; one ahead has a negative lag."""
    assert lag([curve(positions=place(TIME - late))]) == pytest.approx(late, abs=0.02)


def test_lag_is_of_frames_with_the_head_tracked():
    """Where it is lost the track may be anywhere."""
    held = TIME < 40
    positions = np.where(held[:, None], place(TIME - 1), 5.0)
    assert lag([curve(positions=positions, overlaps=held.astype(float))]) == pytest.approx(1, abs=0.02)
    assert np.isnan(lag([curve(overlaps=np.zeros(FRAMES))]))


def test_hidden_head_has_to_be_released_and_recovered():
    """Frames under 15 % visible want another status than TRACKED; from half on there are 15 frames."""
    hidden = (TIME >= 20) & (TIME < 30)
    visible = np.where(hidden, 0.0, 1.0)

    def run(coasting, wrong):
        statuses = tuple(Status.OCCLUDED if at in coasting else Status.TRACKED for at in range(FRAMES))
        return curve(visible=visible, statuses=statuses, overlaps=(~np.isin(TIME, wrong)).astype(float))

    assert run(range(20, 30), range(20, 30)).recovered is True
    assert run(range(20, 45), []).recovered is True
    assert run(range(20, 46), []).recovered is False
    assert run(range(20, 30), range(20, 46)).recovered is False
    assert curve().recovered is None
    assert cells(run(range(25, 30), []))["hidden, not TRACKED"] == "50.0%"
    assert cells(curve())["hidden, not TRACKED"] == "-"


def test_frames_in_which_the_head_is_hidden_have_no_error():
    """Errors and overlaps count where half of the head is visible."""
    hidden = TIME < 20
    run = curve(
        positions=np.where(hidden[:, None], 9.0, place(TIME)),
        visible=np.where(hidden, 0.4, 0.5),
        overlaps=np.where(hidden, 0.0, 1.0),
    )
    assert (cells(run)["error %: median"], cells(run)["IoU > 0.5"]) == ("0.00", "100.0%")


def test_end_is_correct_if_every_last_frame_is():
    """One of the last five frames off the head, or not TRACKED, makes the end incorrect."""
    off = np.ones(FRAMES)
    off[-5] = 0.4
    statuses = (Status.TRACKED,) * (FRAMES - 1) + (Status.LOST,)
    assert curve().correct_at_end
    assert not curve(overlaps=off).correct_at_end
    assert not curve(statuses=statuses).correct_at_end


def test_times_are_listed_per_module():
    """Medians over the runs, in microseconds, and their sum."""
    table = stereo_curves.summarize([curve(), curve(seconds={"search": 4e-4, "rest": 1e-4})])
    assert table.splitlines()[-1] == "| s | 300 | 0 | 0 | 100 | 400 |"


def test_table_holds_every_frame(tmp_path):
    """A line a frame with estimated and true positions; without an estimate they are empty."""
    unknown = {"positions": np.full((FRAMES, 3), np.nan), "covariances": np.full((FRAMES, 3, 3), np.nan)}
    stereo_curves.write_csv(tmp_path / "all.csv", [curve(), curve(seed=1, **unknown)])
    with (tmp_path / "all.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["frame"] for row in rows] == [str(at) for at in range(FRAMES)] * 2
    assert float(rows[7]["true_z"]) == pytest.approx(place(TIME)[7, 2], abs=6e-5)
    assert rows[7]["z"] == rows[7]["true_z"]
    assert (rows[-1]["x"], rows[-1]["nees"], rows[-1]["deviation_m"]) == ("", "", "")
    assert rows[-1]["status"] == "tracked"
