# SPDX-License-Identifier: MIT
import csv
import dataclasses
import json

import numpy as np
import pytest
from tricue.evaluation import tables
from tricue.evaluation.evaluate import Options, evaluate


@pytest.fixture(scope="module")
def found(folders, tmp_path_factory):
    """A few trackers with two seeds on three sequences."""
    options = Options(("color-particle", "still-box"), {"color-particle": {"particles": 60}}, seeds=2)
    return evaluate(folders, tmp_path_factory.mktemp("found"), options)


def test_a_sequence_counts_once_whatever_the_seeds(found):
    """The mean over sequences of the means over seeds."""
    line = tables.summary(found)[0]
    rows = [each.row for each in found.of("color", "color-particle")]
    means = [np.mean([row.auc for row in rows if row.sequence == name]) for name in ("back", "gap", "there")]
    assert line["auc"] == pytest.approx(np.mean(means))
    assert (line["sequences"], line["runs"]) == (3, 6)


def test_numbers_are_written_in_full_and_absent_ones_are_empty(found, tmp_path):
    """What CSV and JSON hold is what was computed, to the last bit; NaN is an empty cell, and null."""
    tables.write(found, tmp_path, {"dataset": "made"})
    with (tmp_path / tables.ROWS).open() as file:
        lines = list(csv.DictReader(file))
    assert [float(line["auc"]) for line in lines] == [each.row.auc for each in found.results]
    assert {line["position_error"] for line in lines} == {""}
    values = json.loads((tmp_path / tables.JSON).read_text(), parse_constant=pytest.fail)
    assert values["dataset"] == "made"
    assert [row["auc"] for row in values["rows"]] == [each.row.auc for each in found.results]
    assert values["rows"][0]["position_error"] is None


def test_a_name_is_no_formula(found, tmp_path):
    """A recording whose name a spreadsheet would run as a formula is written as text."""
    run = found.results[0]
    named = run._replace(row=dataclasses.replace(run.row, sequence="=cmd()"))
    tables.write(dataclasses.replace(found, results=(named,)), tmp_path, {})
    with (tmp_path / tables.ROWS).open() as file:
        assert next(csv.DictReader(file))["sequence"] == "'=cmd()"


def test_times_are_apart_from_what_is_the_same_everywhere(found, tmp_path):
    """The rows and the summary hold no time; speeds has a line a run."""
    tables.write(found, tmp_path, {})
    for name in (tables.ROWS, tables.SUMMARY):
        head = (tmp_path / name).read_text().splitlines()[0]
        assert "fps" not in head
        assert "ms" not in head
    with (tmp_path / tables.SPEEDS).open() as file:
        assert len(list(csv.DictReader(file))) == len(found.results)


def test_settings_tell_what_was_run(found):
    """Versions, machine, all parameters, and those that were changed."""
    about = tables.settings(found, jobs=3)
    assert about["jobs"] == 3
    assert about["changed"] == {"color-particle": {"particles": 60}}
    assert about["parameters"]["color-particle"]["particles"] == 60
    assert all(about[name] for name in ("tricue", "opencv", "numpy", "python", "machine"))
