# SPDX-License-Identifier: MIT
"""The tests with other versions of Python, NumPy, OpenCV and another compiler.

    python tools/matrix.py                all combinations, a table at the end
    python tools/matrix.py oldest clang   these
    python tools/matrix.py --list

Each has an environment of its own in build/matrix, builds the package there, and runs the tests; arguments
after -- go to pytest: ``python tools/matrix.py oldest -- tests/cues``. A combination whose Python or compiler
isn't on this machine is left out, and says so. The exit code is 1 if the tests of any other one fail.
"""

import argparse
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
ENVIRONMENTS = ROOT / "build" / "matrix"


class Combination(NamedTuple):
    """A Python, a C++ compiler, and what NumPy and OpenCV pip may install."""

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
    """A Python of that version which runs: on the path, or among pyenv's."""
    pyenv = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")) / "versions"
    found = [*sorted(map(str, pyenv.glob(f"{version}.*/bin/python"))), shutil.which(f"python{version}")]
    for path in filter(None, found):
        if subprocess.run([path, "--version"], capture_output=True, check=False).returncode == 0:
            return path
    return None


def missing(combination: Combination) -> str:
    """What of a combination isn't on this machine."""
    if interpreter(combination.python) is None:
        return f"no Python {combination.python}"
    return "" if shutil.which(combination.compiler) else f"no {combination.compiler}"


def prepare(name: str, combination: Combination) -> Path:
    """The environment of a combination, with the package as it is now."""
    folder = ENVIRONMENTS / name
    python = folder / "bin" / "python"
    if not python.exists():
        base = interpreter(combination.python)
        assert base is not None, missing(combination)
        subprocess.run([base, "-m", "venv", folder], check=True)
    constraints = folder / "constraints.txt"
    constraints.write_text("\n".join(combination.constraints) + "\n")
    environment = os.environ | {
        "CXX": combination.compiler,
        "SKBUILD_BUILD_DIR": str(folder / "build"),
        "PIP_CONSTRAINT": str(constraints),
        "PIP_DISABLE_PIP_VERSION_CHECK": "1",
    }
    command = [str(python), "-m", "pip", "install", "--quiet", f"{ROOT}[dev]"]
    subprocess.run(command, check=True, env=environment)
    return python


def versions(python: Path) -> str:
    """What is installed there."""
    code = "import platform, numpy, cv2; print(platform.python_version(), numpy.__version__, cv2.__version__)"
    return subprocess.run([python, "-c", code], check=True, capture_output=True, text=True).stdout.strip()


def test(python: Path, words: list[str]) -> tuple[bool, str]:
    """Run the tests; whether they pass, and pytest's closing line."""
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
    """Prepare and test each combination, and print a table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(COMBINATIONS))
    parser.add_argument("--list", action="store_true", help="the combinations")
    own, _, words = _split(sys.argv[1:])
    options = parser.parse_args(own)
    if unknown := set(options.names) - set(COMBINATIONS):
        parser.error(f"expected some of {', '.join(COMBINATIONS)}, got {', '.join(sorted(unknown))}")
    rows, failed = [], False
    for name in options.names or COMBINATIONS:
        combination = COMBINATIONS[name]
        if options.list or (absent := missing(combination)):
            what = f"{combination.python}, {combination.compiler}, {' '.join(combination.constraints)}"
            rows.append((name, what, "" if options.list else f"left out: {absent}"))
            continue
        started = time.monotonic()
        python = prepare(name, combination)
        passed, line = test(python, words)
        failed |= not passed
        rows.append(
            (
                name,
                f"{versions(python)}, {combination.compiler}",
                f"{line} [{time.monotonic() - started:.0f} s]",
            )
        )
    print("\n| combination | Python, NumPy, cv2, compiler | tests |\n| --- | --- | --- |")
    for row in rows:
        print(f"| {' | '.join(row)} |")
    return int(failed)


def _split(words: list[str]) -> tuple[list[str], str, list[str]]:
    """The words before and after --."""
    if "--" not in words:
        return words, "", []
    at = words.index("--")
    return words[:at], "--", words[at + 1 :]


if __name__ == "__main__":
    sys.exit(main())
