# SPDX-License-Identifier: MIT
"""The tests with other versions of Python, NumPy and OpenCV, and another compiler.

    python -m tools.matrix                all combinations, a table at the end
    python -m tools.matrix oldest clang   these
    python -m tools.matrix --write        all, and their section of docs/reliability.md
    python -m tools.matrix --list

Each combination has its own environment in build/matrix, in which the package is built and the tests are run;
arguments after -- go to pytest: ``python -m tools.matrix oldest -- tests/cues``. A combination whose Python
or compiler isn't on this machine is skipped, with a message. The exit code is 1 if any other one can't be
built, or its tests fail. Its line is stored in build/matrix; --write makes a section of docs/reliability.md
from all lines.
"""

import argparse
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

from tools.page_sections import with_section

ROOT = Path(__file__).parents[1]
ENVIRONMENTS = ROOT / "build" / "matrix"
PAGE = ROOT / "docs" / "reliability.md"
HEAD = "| combination | Python, NumPy, cv2, compiler | tests |\n| --- | --- | --- |\n"
TEXT = """\
## Versions

`python -m tools.matrix --write` builds the package for each combination of versions and runs the tests; `.ci/run` runs some of them with
the oldest versions.

"""


class Combination(NamedTuple):
    """A Python, a C++ compiler, and the NumPy and OpenCV that pip may install."""

    python: str
    compiler: str
    constraints: tuple[str, ...]


COMBINATIONS = {
    "oldest": Combination("3.10", "g++", ("numpy==1.24.*", "opencv-python-headless==4.8.*")),
    "numpy-1": Combination("3.11", "g++", ("numpy==1.26.*", "opencv-python-headless==4.9.*")),
    "clang": Combination("3.11", "clang++", ("opencv-python-headless==4.*",)),
    "python-3.12": Combination("3.12", "g++", ("opencv-python-headless==4.*",)),
    "python-3.13": Combination("3.13", "g++", ("opencv-python-headless==5.*",)),
    "python-3.14": Combination("3.14", "g++", ("opencv-python-headless==5.*",)),
}


def interpreter(version: str) -> str | None:
    """A working Python of that version, on the path or among pyenv's; None without one."""
    pyenv = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")) / "versions"
    found = [*sorted(map(str, pyenv.glob(f"{version}.*/bin/python"))), shutil.which(f"python{version}")]
    for path in filter(None, found):
        if subprocess.run([path, "--version"], capture_output=True, check=False).returncode == 0:
            return path
    return None


def compiler(name: str) -> str | None:
    """The compiler of that name, or the newest with a version in its name, such as Debian's clang++-14."""
    folders = map(Path, os.environ.get("PATH", os.defpath).split(os.pathsep))
    versioned = {each.name for folder in folders for each in folder.glob(f"{name}-*")}
    numbered = [each for each in versioned if each.rpartition("-")[2].isdigit()]
    newest_first = sorted(numbered, key=lambda each: int(each.rpartition("-")[2]), reverse=True)
    return next(filter(shutil.which, [name, *newest_first]), None)


def missing(combination: Combination) -> str:
    """What a combination needs that isn't on this machine; "" if nothing."""
    if interpreter(combination.python) is None:
        return f"no Python {combination.python}"
    return "" if compiler(combination.compiler) else f"no {combination.compiler}"


def prepare(name: str, combination: Combination) -> Path:
    """Make the environment of a combination, with the package in its current state."""
    folder = ENVIRONMENTS / name
    python = folder / "bin" / "python"
    if not python.exists():
        base = interpreter(combination.python)
        assert base is not None, missing(combination)
        subprocess.run([base, "-m", "venv", folder], check=True)
    constraints = folder / "constraints.txt"
    constraints.write_text("\n".join(combination.constraints) + "\n")
    environment = os.environ | {
        "CXX": compiler(combination.compiler) or combination.compiler,
        "SKBUILD_BUILD_DIR": str(folder / "build"),
        "PIP_CONSTRAINT": str(constraints),
        "PIP_DISABLE_PIP_VERSION_CHECK": "1",
    }
    command = [str(python), "-m", "pip", "install", "--quiet", f"{ROOT}[dev]"]
    subprocess.run(command, check=True, env=environment)
    return python


def versions(python: Path) -> str:
    """The installed versions."""
    code = "import platform, numpy, cv2; print(platform.python_version(), numpy.__version__, cv2.__version__)"
    return subprocess.run([python, "-c", code], check=True, capture_output=True, text=True).stdout.strip()


def test(python: Path, words: list[str]) -> tuple[bool, str]:
    """Run the tests; returns whether they pass, and pytest's closing line."""
    command = [str(python), "-m", "pytest", "-q", "-n", "auto", "--dist", "loadfile", "--benchmark-disable"]
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    process = subprocess.Popen(
        [*command, *words], cwd=ROOT, env=environment, stdout=subprocess.PIPE, text=True, errors="replace"
    )
    last = ""
    assert process.stdout is not None
    for line in process.stdout:
        print(line, end="", flush=True)
        last = line.strip() or last
    return process.wait() == 0, last


def main() -> int:
    """Test combinations, and print a table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(COMBINATIONS))
    parser.add_argument("--list", action="store_true", help="the combinations")
    parser.add_argument("--write", action="store_true", help="the section, of all that was ever tested here")
    own, _, words = _split(sys.argv[1:])
    options = parser.parse_args(own)
    if unknown := set(options.names) - set(COMBINATIONS):
        parser.error(f"expected some of {', '.join(COMBINATIONS)}, got {', '.join(sorted(unknown))}")
    if options.list:
        print(HEAD + "\n".join(map(planned, COMBINATIONS)))
        return 0
    codes = [tested(name, words) for name in options.names or COMBINATIONS]
    rows = [kept(name).read_text() for name in COMBINATIONS if kept(name).exists()]
    print(HEAD + "\n".join(rows))
    if options.write:
        PAGE.write_text(with_section(PAGE.read_text(), TEXT + HEAD + "\n".join(rows) + "\n"))
    return max(codes)


def kept(name: str) -> Path:
    """The file with the last line of a combination."""
    return ENVIRONMENTS / f"{name}.txt"


def planned(name: str, tests: str = "") -> str:
    """The table's line for a combination that isn't tested."""
    wanted = COMBINATIONS[name]
    return f"| {name} | {wanted.python}, {' '.join(wanted.constraints)}, {wanted.compiler} | {tests} |"


def tested(name: str, words: list[str]) -> int:
    """Build and test a combination, and store its line; returns 1 if that fails."""
    combination = COMBINATIONS[name]
    failed, line = 0, planned(name, f"left out: {missing(combination)}")
    if not missing(combination):
        try:
            python = prepare(name, combination)
        except subprocess.CalledProcessError:
            failed, line = 1, planned(name, "can't be built")
        else:
            passed, last = test(python, words)
            failed, chosen = int(not passed), f" of `{' '.join(words)}`" if words else ""
            used = f"{versions(python)}, {compiler(combination.compiler)}"
            line = f"| {name} | {used} | {last.strip('= ')}{chosen} |"
    ENVIRONMENTS.mkdir(parents=True, exist_ok=True)
    kept(name).write_text(line)
    return failed


def _split(words: list[str]) -> tuple[list[str], str, list[str]]:
    """The words before and after --."""
    if "--" not in words:
        return words, "", []
    at = words.index("--")
    return words[:at], "--", words[at + 1 :]


if __name__ == "__main__":
    sys.exit(main())
