# SPDX-License-Identifier: MIT
"""What an evaluation shows in a notebook."""

from pathlib import Path

import pytest
from tricue.evaluation.evaluate import Evaluation, Options, evaluate
from tricue.scenes import stress_scene, write_sequence


@pytest.fixture(scope="module")
def evaluation(tmp_path_factory: pytest.TempPathFactory) -> Evaluation:
    """Of two quick baselines on one scene."""
    root: Path = tmp_path_factory.mktemp("evaluation")
    write_sequence(stress_scene("fast", size=(160, 120)), root / "data" / "a <b> scene")
    return evaluate(root / "data", root / "out", Options(trackers=("meanShift", "still-box"), restarts=False))


def test_an_evaluation_shows_the_trackers_numbers(evaluation: Evaluation) -> None:
    """It proves that each tracker has a line with its mean numbers, the best of a column in bold."""
    html = evaluation._repr_html_()
    for tracker in ("meanShift", "still-box"):
        assert f">{tracker}</td>" in html
        (result,) = evaluation.of("color", tracker)
        assert f"{result.row.auc:.3f}" in html
    best = max(evaluation.results, key=lambda each: each.row.auc)
    assert f"<strong>{best.row.auc:.3f}</strong>" in html
    assert "color, 1 sequence<" in html
    assert html.count("<tr>") == 3
    assert repr(evaluation) == "Evaluation(opened=<1>, trackers=<2>, results=<2>, failed=<0>)"


def test_what_failed_is_told(evaluation: Evaluation) -> None:
    """It proves that an unreadable sequence is named, escaped."""
    failed = Evaluation(Options(), (), (), (), {}, {"a <b>": "no images"})
    assert failed._repr_html_() == "a &lt;b&gt;: no images"
