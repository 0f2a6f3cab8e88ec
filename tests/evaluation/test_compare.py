# SPDX-License-Identifier: MIT
"""Two evaluations against each other, as a file of numbers and as a user runs it."""

import json
import re
from pathlib import Path

import pytest
from tricue.cli import main
from tricue.evaluation.compare import compare_folders

NAMES = [f"s{index}" for index in range(8)]


def write(folder, **aucs):
    """A folder of an evaluation: by tracker the AUC of each sequence, of two seeds."""
    folder.mkdir()
    rows = [
        {"group": "color", "sequence": name, "tracker": tracker.replace("_", "-"), "seed": seed, "auc": auc}
        for tracker, values in aucs.items()
        for name, auc in zip(NAMES, values, strict=False)
        for seed in (0, 1)
    ]
    (folder / "evaluation.json").write_text(json.dumps({"rows": rows}))
    return folder


OLD = [0.5, 0.6, 0.4, 0.7, 0.5, 0.6, 0.3, 0.5]


@pytest.fixture
def folders(tmp_path):
    """One tracker that is worse on each sequence, one that is as before, one on too few sequences."""
    worse = [each - 0.05 - 0.01 * index for index, each in enumerate(OLD)]
    old = write(tmp_path / "old", fused=OLD, KCF=OLD, few=OLD[:3], gone=OLD)
    return old, write(tmp_path / "new", fused=worse, KCF=OLD, few=worse[:3])


def test_what_got_worse_is_told(folders):
    """A paired difference with an interval below 0; what is the same isn't shown to differ; three sequences
    tell nothing, and leave the others' p-values alone.
    """
    found = {each.tracker: each for each in compare_folders(*folders).changes}
    assert found["fused"].verdict == "worse"
    assert found["fused"].difference.mean == pytest.approx(-0.085)
    assert found["fused"].difference.high < -0.05
    assert found["fused"].adjusted == 2 * 2 / 256
    assert found["fused"].worst_first()[0][0] == "s7"
    assert found["KCF"].verdict == "no difference shown"
    assert found["few"].verdict == "nothing can be told"
    assert compare_folders(*folders).notes == ["only in the old one: tracker gone"]
    assert {e.tracker: e.verdict for e in compare_folders(*folders[::-1]).changes}["fused"] == "better"


def test_too_few_recordings_for_many_lines(tmp_path, capsys):
    """Of six recordings two changes have no p under 0.05 by Holm, so that nothing is told of them, as no
    tracker of tricue evaluate is marked then; one alone has.
    """
    worse = [each - 0.1 for each in OLD[:6]]
    old = write(tmp_path / "old", fused=OLD[:6], KCF=OLD[:6])
    new = write(tmp_path / "new", fused=worse, KCF=OLD[:6])
    one = write(tmp_path / "one", fused=worse)
    assert [each.verdict for each in compare_folders(old, one).changes] == ["worse"]
    assert [each.verdict for each in compare_folders(old, new).changes] == ["nothing can be told"] * 2
    assert main(["compare", str(old), str(new), "--fail-if-worse"]) == 0
    assert (
        "With so few recordings, no p of 2 lines can be under 0.05 after Holm's correction."
        in capsys.readouterr().out
    )


@pytest.mark.parametrize(
    ("options", "code", "reason"),
    [
        ([], 0, ""),
        (["--fail-if-worse"], 1, "failed: fused, one-pass: worse\n"),
        (["--fail-under", "-0.2"], 0, ""),
        (["--fail-under", "-0.08"], 1, "failed: fused, one-pass: a mean gain of -0.085, under -0.08\n"),
    ],
)
def test_the_exit_code_is_asked_for(folders, options, code, reason, capsys):
    """Without options a comparison is no failure, however bad; one is told with its reason."""
    assert main(["compare", *map(str, folders), *options]) == code
    printed, error = capsys.readouterr()
    assert error == reason
    assert "| fused " in printed
    assert "worse" in printed
    assert "lost most: s7 0.500 to 0.380" in printed


@pytest.mark.parametrize("gain", ["nan", "inf", "-1e400", "much"])
def test_a_gain_that_is_no_number_is_refused(folders, gain, capsys):
    """NaN would let everything pass, unseen in a script."""
    with pytest.raises(SystemExit) as ended:
        main(["compare", *map(str, folders), f"--fail-under={gain}"])
    assert ended.value.code == 2
    assert f"argument --fail-under: expected a finite number, got {gain!r}" in capsys.readouterr().err


def test_the_page_holds_the_same(folders, tmp_path, capsys):
    """Self-contained, with each tracker's verdict and sequences."""
    path = tmp_path / "new" / "compare.html"
    assert main(["compare", *map(str, folders), "--report", str(path)]) == 0
    text = path.read_text()
    assert "://" not in text
    assert 'class="lower"' in text
    assert "nothing can be told" in text
    assert "only in the old one: tracker gone" in text
    assert str(path) in capsys.readouterr().out


def test_a_difference_that_rounds_to_0_has_no_sign(tmp_path, capsys):
    """-0.000 would look like a loss, in the table and on the page; a real difference keeps its sign."""
    old = write(tmp_path / "old", a=OLD, b=OLD)
    new = write(tmp_path / "new", a=[each - 0.0001 for each in OLD], b=[each + 0.01 for each in OLD])
    page = tmp_path / "compare.html"
    assert main(["compare", str(old), str(new), "--report", str(page)]) == 0
    for text in capsys.readouterr().out, page.read_text():
        assert "[0.000, 0.000]" in text
        assert "+0.010" in text
        assert not re.search(r"[+-]0\.000", text)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
def test_a_full_disk_is_told_with_the_page(folders, capsys):
    """Python names a file only when it opens it."""
    assert main(["compare", *map(str, folders), "--report", "/dev/full"]) == 2
    assert capsys.readouterr().err == "tricue compare: /dev/full: No space left on device\n"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "there is no evaluation.json in it"),
        ("{", "expected the tables of tricue evaluate, got a file that isn't JSON: Expecting"),
        ("[1]", "expected the tables of tricue evaluate, found no rows of runs"),
        ('{"rows": []}', "expected the tables of tricue evaluate, found no rows of runs"),
        ('{"rows": [{"sequence": "a"}]}', "expected the tables of tricue evaluate, found no rows of runs"),
    ],
)
def test_what_is_no_evaluation_is_told(folders, tmp_path, content, message, capsys):
    """One line on standard error, exit code 2."""
    other = tmp_path / "other"
    other.mkdir()
    if content:
        (other / "evaluation.json").write_text(content)
    assert main(["compare", str(folders[0]), str(other)]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1


def test_a_folder_that_is_not_there_is_told(folders, tmp_path, capsys):
    """A misspelled name is something else than a folder without an evaluation."""
    assert main(["compare", str(tmp_path / "onee"), str(folders[1])]) == 2
    assert "onee: expected a folder of tricue evaluate, there is none of that name" in capsys.readouterr().err


def test_nothing_in_common_is_told(tmp_path, capsys):
    """Other trackers, or other sequences."""
    one, other = write(tmp_path / "one", a=OLD), write(tmp_path / "other", b=OLD)
    assert main(["compare", str(one), str(other)]) == 2
    error = capsys.readouterr().err
    assert "a tracker and a sequence that both have" in error
    assert "got none; only in the old one: tracker a; only in the new one: tracker b" in error
    assert error.count("\n") == 1


def test_an_unknown_number_is_told(folders):
    """The error names the argument, and what is known."""
    with pytest.raises(ValueError, match=r"^number: expected one of auc, .*, got 'zzz'"):
        compare_folders(*folders, "zzz")


def test_a_number_that_an_older_evaluation_lacks_is_told(folders, capsys):
    """It is in no row of both, and that is no crash."""
    assert main(["compare", *map(str, folders), "--number", "true_positive"]) == 2
    assert "that both have, with true_positive, got none" in capsys.readouterr().err
