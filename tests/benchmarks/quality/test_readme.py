# SPDX-License-Identifier: MIT
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
QUALITY = ROOT / "benchmarks" / "quality"
SCRIPTS = sorted(file for folder in (QUALITY, QUALITY / "cues") for file in folder.glob("*.py"))


def module_of(file):
    """The name by which ``python -m`` runs a script."""
    return ".".join(file.relative_to(ROOT).with_suffix("").parts)


def test_readme_lists_each_script():
    """Each script has a command in the README, and each command there is a script's."""
    listed = re.findall(r"`python -m (\S+?)[ `]", (QUALITY / "README.md").read_text())
    assert sorted(listed) == sorted(map(module_of, SCRIPTS))


@pytest.mark.parametrize("file", SCRIPTS, ids=lambda file: file.stem)
def test_script_has_its_command(file):
    """A script runs its main, and its docstring shows the command."""
    text = file.read_text()
    assert 'if __name__ == "__main__":\n    sys.exit(main())' in text
    assert f"\n    python -m {module_of(file)}" in text


def test_the_package_does_without_benchmarks():
    """No module of the package imports benchmarks, which aren't in the wheel."""
    modules = (ROOT / "python" / "tricue").rglob("*.py")
    imports = re.compile(r"^\s*(from|import) benchmarks\b", re.MULTILINE)
    assert not [file for file in modules if imports.search(file.read_text())]
