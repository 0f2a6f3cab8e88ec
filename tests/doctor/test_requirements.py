# SPDX-License-Identifier: MIT
"""What tricue's metadata are taken to require."""

import importlib.util
import re
import sys
from pathlib import Path

import pytest
from tricue.doctor.requirements import Requirement, installed, parse

ROOT = Path(__file__).parents[2]
LINES = [
    "numpy>=1.24",
    'scikit-image>=0.22; extra == "demo"',
    'pooch; extra == "demo"',
    'tomli; python_version < "3.11" and extra == "toml"',
    "tricue[toml]; extra == 'evaluate'",
    'joblib (>=1.3) ; extra == "evaluate"',
    'tricue[demo,evaluate]; extra == "dev"',
    'ruff==0.17.5; extra == "dev"',
]


def test_extras_are_opened():
    """Extras of extras count, and what another Python needs doesn't."""
    found = {name: [str(each) for each in needs] for name, needs in parse(LINES).items()}
    tomli = ["tomli"] if sys.version_info < (3, 11) else []
    assert found == {
        "": ["'numpy>=1.24'"],
        "demo": ["'scikit-image>=0.22'", "pooch"],
        "toml": tomli,
        "evaluate": [*tomli, "'joblib>=1.3'"],
        "dev": ["'scikit-image>=0.22'", "pooch", *tomli, "'joblib>=1.3'", "'ruff==0.17.5'"],
    }


@pytest.mark.parametrize(
    ("versions", "admitted", "refused"),
    [
        (">=0.22", ["0.22", "0.22.0", "0.100", "1", "0.22rc1"], ["0.21.9", "0.3", ""]),
        ("==3.0.0", ["3.0.0", "3", "3.0.0.post1"], ["3.0.1", "2"]),
        (">=4.8,<5", ["4.8.0.76", "4.14.0.94"], ["5.0.0.93", "4.7"]),
        ("", ["1", "unknown"], []),
    ],
)
def test_versions_are_compared_by_their_numbers(versions, admitted, refused):
    """0.100 is newer than 0.22, and zeros at the end don't count."""
    requirement = Requirement("package", versions)
    assert all(requirement.admits(each) for each in admitted)
    assert not any(requirement.admits(each) for each in refused)


def test_a_package_that_is_not_there_has_no_version():
    """And one that is there has one."""
    assert installed("numpy")
    assert installed("no-such-package-anywhere") == ""


def test_packages_have_the_modules_that_are_tried():
    """What pyproject.toml requires for users has a module of this name, wherever it is installed."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    table = text.partition("[project.optional-dependencies]")[2].partition("\ndev = [")[0]
    needed = {re.match(r"[\w-]+", each)[0] for each in re.findall(r'"([^"]+)"', table)} - {"tricue"}
    assert {"scikit-image", "vot-trax", "av", "rerun-sdk"} <= needed
    there = [name for name in needed if installed(name)]
    missing = [name for name in there if importlib.util.find_spec(Requirement(name).module) is None]
    assert there
    assert not missing
