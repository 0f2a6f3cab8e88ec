# SPDX-License-Identifier: MIT
"""Extras as doctor sees them: whole, in part, old, broken."""

from concurrent.futures import Future, ThreadPoolExecutor

import pytest
from tricue.doctor import extras
from tricue.doctor.finding import Verdict
from tricue.doctor.probe import ProbeAnswer
from tricue.doctor.requirements import Requirement

VERSIONS = {"here": "2.0", "old": "0.9", "odd-one": "1.0"}


@pytest.fixture
def judge(monkeypatch):
    """``judge(requirement, ...)``: the finding on an extra of these packages."""
    monkeypatch.setattr(extras, "installed", lambda package: VERSIONS.get(package, ""))
    imports: dict[str, Future[ProbeAnswer]] = {}
    for module, error in {"here": "", "old": "", "odd_one": "OSError: libodd.so: cannot open"}.items():
        imports[module] = Future()
        imports[module].set_result(ProbeAnswer({}, error))
    return lambda *needs: extras.judge("some", needs, imports)


def test_a_whole_extra(judge):
    """Its versions are told, and nothing is to fix."""
    found = judge(Requirement("here", ">=1"))
    assert (found.verdict, found.text, found.fix) == (Verdict.OK, "here 2.0", "")


def test_a_missing_package(judge):
    """The command installs what is missing, and not what is there."""
    found = judge(Requirement("here"), Requirement("gone", ">=3"), Requirement("lost"))
    assert found.verdict is Verdict.ABSENT
    assert found.text == "here 2.0; gone, lost missing"
    assert found.fix.endswith("-m pip install 'gone>=3' lost")


def test_an_old_package(judge):
    """The command upgrades it."""
    found = judge(Requirement("old", ">=1.2"), Requirement("here"))
    assert found.verdict is Verdict.WARNING
    assert "old 0.9 is too old, >=1.2 is needed" in found.text
    assert found.fix.endswith("-m pip install --upgrade 'old>=1.2'")


def test_a_broken_package(judge):
    """It is there, and its error is told."""
    found = judge(Requirement("odd-one", ">=1"), Requirement("gone"))
    assert found.verdict is Verdict.BROKEN
    assert "odd-one 1.0 can't be imported: OSError: libodd.so: cannot open" in found.text
    assert found.fix.endswith("-m pip install --force-reinstall 'odd-one>=1' gone")


def test_only_what_is_installed_is_imported(monkeypatch):
    """One process a package, and none for what isn't there."""
    needs = {
        "": (Requirement("numpy"),),
        "a": (Requirement("here"), Requirement("gone")),
        "dev": (Requirement("x"),),
    }
    tried = []
    monkeypatch.setattr(extras, "required", lambda: needs)
    monkeypatch.setattr(extras, "installed", lambda package: VERSIONS.get(package, ""))
    monkeypatch.setattr(extras, "probe", lambda code: tried.append(code) or ProbeAnswer({}))
    with ThreadPoolExecutor(1) as pool:
        (found,) = extras.find_extras(pool)
    assert (found.name, found.verdict) == ("a", Verdict.ABSENT)
    assert tried == ["import here\nreport()"]


def test_without_metadata_nothing_is_known(monkeypatch):
    """A copied folder has none."""
    monkeypatch.setattr(extras, "required", dict)
    with ThreadPoolExecutor(1) as pool:
        (found,) = extras.find_extras(pool)
    assert "unknown" in found.text
