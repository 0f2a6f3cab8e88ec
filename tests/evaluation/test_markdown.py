# SPDX-License-Identifier: MIT
"""The printed tables."""

import shutil

from tricue.evaluation.evaluate import Options, evaluate
from tricue.evaluation.markdown import markdown
from tricue.evaluation.raw_results import write_raw


def test_printed_tables_are_aligned_and_leave_out_empty_columns(folders, tmp_path):
    """Every line of a table is as wide as its head; no position was measured, no target was absent."""
    found = evaluate(folders, tmp_path, Options(("meanShift", "still-box")))
    table, told, by_sequence = markdown(found).split("\n\n")
    assert told.endswith("this group has 3 recordings.")
    for text in (table, by_sequence):
        assert len({len(line) for line in text.splitlines()}) == 1
    assert "position" not in table
    assert "TNR" not in table
    assert [cell.strip() for cell in by_sequence.splitlines()[0].split("|")[2:5]] == ["back", "gap", "there"]


def test_columns_of_sequences_have_names_of_their_own(folders, tmp_path):
    """Sequences of one name in two folders are told apart, and also in the names of raw results."""
    for name in ("tum", "princeton"):
        shutil.copytree(folders / "gap", tmp_path / "data" / "all" / name / "seq")
    evaluation = evaluate(tmp_path / "data", tmp_path / "out", Options(("still-box",), restarts=False))
    table = markdown(evaluation).split("\n\n")[-1]
    heads = [cell.strip() for cell in table.splitlines()[0].split("|")[1:-1]]
    assert heads == ["color: AUC", "princeton/seq", "tum/seq"]
    raw = write_raw(evaluation, tmp_path / "out", tmp_path / "raw", {}).parent
    assert {path.name for path in (raw / "got10k" / "still-box").iterdir()} == {"princeton-seq", "tum-seq"}
