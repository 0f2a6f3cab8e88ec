# SPDX-License-Identifier: MIT
"""What others' services read of the repository: citation, forms, hooks."""

import importlib.util
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import tricue
from tricue.track.base import registry

ROOT = Path(__file__).parents[1]
FORMS = sorted((ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml"))
SCHEMAS = {
    ROOT / "CITATION.cff": "vendor.citation-file-format",
    ROOT / ".github" / "dependabot.yml": "vendor.dependabot",
    **{
        form: "vendor.github-issue-config" if form.stem == "config" else "vendor.github-issue-forms"
        for form in FORMS
    },
}


@pytest.mark.parametrize("file", SCHEMAS, ids=lambda file: file.name)
def test_it_follows_its_schema(file):
    """By the schemas that come with check-jsonschema."""
    pytest.importorskip("check_jsonschema", reason="needs check-jsonschema: pip install tricue[dev]")
    command = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", SCHEMAS[file], str(file)]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr


def test_the_citation_has_this_version():
    """And the three papers."""
    text = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert re.search(r"^version: (.+)$", text, re.MULTILINE)[1] == tricue.__version__
    assert re.findall(r"^    year: (\d+)$", text, re.MULTILINE) == ["2008", "1996", "2002"]


def test_reports_ask_for_what_helps():
    """What doctor says, and of wrong tracks the tracker, all of which can be chosen."""
    for name in ("bug", "wrong-track"):
        text = (ROOT / ".github" / "ISSUE_TEMPLATE" / f"{name}.yml").read_text(encoding="utf-8")
        assert "tricue doctor" in text
    options = re.search(r"options: \[(.+)\]", text)[1].split(", ")
    assert set(options) == {*registry.names(), "another"}


def test_the_hooks_are_those_of_lint():
    """pre-commit runs the same tools as make lint, of the same environment."""
    hooks = (ROOT / ".pre-commit-config.yaml").read_text(encoding="utf-8")
    lint = (ROOT / "Makefile").read_text(encoding="utf-8").partition("\nlint:")[2].partition("\n\n")[0]
    tools = set(re.findall(r"\$\(BIN\)/([\w-]+)", lint))
    assert tools == {"ruff", "mypy", "clang-format"}
    assert tools <= set(re.findall(r"entry: ([\w-]+)", hooks))
    assert hooks.count("language: system") == hooks.count("- id:")
    assert "repo: local" in hooks
    assert hooks.count("repo:") == 1


def test_pre_commit_accepts_them():
    """By its own schema."""
    if importlib.util.find_spec("pre_commit") is None or shutil.which("git") is None:
        pytest.skip("needs pre-commit: pip install tricue[dev]")
    command = [sys.executable, "-m", "pre_commit", "validate-config", str(ROOT / ".pre-commit-config.yaml")]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
