# SPDX-License-Identifier: MIT
"""The boxes that we publish: whole, of this version, and as good as docs/results.md says."""

import io
import json
import re
import tarfile
from pathlib import Path

import numpy as np
import pytest
import tricue
from tricue.evaluation.dataset import find_entries
from tricue.evaluation.metrics import score

ROOT = Path(__file__).parents[2]
ARCHIVE = ROOT / "benchmarks" / "results" / f"tricue-{tricue.__version__}.tar.xz"
MAX_BYTES = 1_000_000  # in the repository, once a release


@pytest.fixture(scope="module")
def contents() -> dict[str, bytes]:
    """The archive's files by name."""
    with tarfile.open(ARCHIVE) as packed:
        return {each.name: packed.extractfile(each).read() for each in packed.getmembers()}


@pytest.fixture(scope="module")
def manifest(contents):
    """What the archive says of itself."""
    return json.loads(contents["manifest.json"])


def test_they_are_of_this_version(manifest):
    """A release has results of its own; the commit says of which code."""
    assert manifest["tricue"] == tricue.__version__
    assert re.fullmatch(r"[0-9a-f]{40}", manifest["commit"]), "made from files that aren't committed"
    assert manifest["license"].startswith("MIT")
    assert f"tricue-{tricue.__version__}.tar.xz" in (ROOT / "docs" / "results.md").read_text(encoding="utf-8")


def test_they_are_whole(contents, manifest):
    """Every file has a box in each frame of its sequence, and every sequence has results of a tracker."""
    assert len(manifest["sequences"]) >= 40
    found = set()
    for name, content in contents.items():
        if name == "manifest.json":
            continue
        match = re.fullmatch(r"got10k/([\w-]+)/([\w.+-]+)/\2_00[123]\.txt", name)
        assert match, name
        found.add(match[2])
        boxes = np.loadtxt(io.BytesIO(content), delimiter=",", ndmin=2)
        assert boxes.shape == (manifest["sequences"][match[2]]["frames"], 4)
    assert found == set(manifest["sequences"])


def test_they_are_small():
    """They grow the repository a little, once a release."""
    assert ARCHIVE.stat().st_size <= MAX_BYTES


def test_their_scores_are_those_of_the_page(contents, manifest, data):
    """docs/results.md's mean AUC of each tracker and group, computed from the files alone."""
    opened = {each.name: each.open() for each in find_entries(data)}
    scores: dict[tuple[str, str], list[float]] = {}
    for tracker in manifest["trackers"]:
        for name, about in manifest["sequences"].items():
            sequence = opened[about["name"]]
            files = sorted(each for each in contents if each.startswith(f"got10k/{tracker}/{name}/"))
            if files and not sequence.clipped:
                boxes = [np.loadtxt(io.BytesIO(contents[each]), delimiter=",") for each in files]
                truth = sequence.truth(about["frames"])
                auc = np.mean([score(each, truth).auc for each in boxes])
                scores.setdefault((tracker, sequence.group), []).append(float(auc))
    page = (ROOT / "docs" / "results.md").read_text(encoding="utf-8")
    heads, _, *rows = [
        [cell.strip() for cell in line.strip("| \n").split("|")]
        for line in re.findall(r"^\|.*$", page.partition("<!-- end -->")[0], re.MULTILINE)
    ]
    column = next(index for index, head in enumerate(heads) if head.startswith("color,"))
    for row in rows:
        if (row[0], "color") in scores:
            assert float(row[column]) == pytest.approx(np.mean(scores[row[0], "color"]), abs=6e-4)
            assert heads[column] == f"color, {len(scores[row[0], 'color'])}"
    assert sum((row[0], "color") in scores for row in rows) == 3
