# SPDX-License-Identifier: MIT
"""Which tricue runs: version, folder, commit, native core."""

import json
import platform
import shutil
import subprocess
import sys
from importlib import metadata
from pathlib import Path
from urllib.parse import urlparse
from urllib.request import url2pathname

from tricue.doctor.finding import Finding, Verdict
from tricue.doctor.probe import probe
from tricue.doctor.requirements import Requirement, installed, required

SECTION = "Versions"
PACKAGE = Path(__file__).resolve().parents[1]
OLDEST_PYTHON = (3, 10)
BUILD = (
    "apt-get install g++ libeigen3-dev libopencv-imgproc-dev python3-dev, then pip install . in the sources"
)
GIT_SECONDS = 10


def find_versions() -> list[Finding]:
    """Findings on tricue itself, Python, NumPy, and the native core."""
    return [_package(), _python(), _numpy(), *_core()]


def pip(*packages: str) -> str:
    """The command that installs packages for this Python."""
    return f"{short(sys.executable)} -m pip install {' '.join(packages)}"


def install_extra(name: str) -> str:
    """The command that installs what an extra of tricue lacks, for messages.

    ``pip install 'tricue[...]'`` also installs opencv-python-headless, over any other package of cv2.
    """
    needs = required().get(name, ())
    versions = {each: installed(each.package) for each in needs}
    lacking = [each for each, version in versions.items() if not (version and each.admits(version))]
    return pip(*map(str, lacking or needs)) if needs else pip(f"'tricue[{name}]'")


def short(path: str | Path) -> str:
    """A path with ~ for the home folder."""
    try:
        return f"~/{Path(path).relative_to(Path.home()).as_posix()}"
    except (RuntimeError, ValueError):
        return str(path)


def commit() -> str:
    """The commit that the package was built from, with "+" appended if files were changed; "" if unknown."""
    if (PACKAGE.parents[1] / "pyproject.toml").is_file():
        return _git_commit(PACKAGE.parents[1])
    try:
        origin = json.loads(metadata.distribution("tricue").read_text("direct_url.json") or "{}")
    except (metadata.PackageNotFoundError, ValueError):
        return ""
    if known := origin.get("vcs_info", {}).get("commit_id"):
        return str(known)
    address = urlparse(origin.get("url", ""))
    return _git_commit(Path(url2pathname(address.path))) if address.scheme == "file" else ""


def _abbreviated(commit: str) -> str:
    return commit[:12] + commit[40:]


def _git_commit(folder: Path) -> str:
    if shutil.which("git") is None or not (folder / ".git").exists():
        return ""
    try:
        head = _git(folder, "rev-parse", "HEAD")
        return f"{head}+" if _git(folder, "status", "--porcelain", "--untracked-files=no") else head
    except (OSError, subprocess.SubprocessError):
        return ""


def _git(folder: Path, *arguments: str) -> str:
    command = ["git", "-C", str(folder), *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=GIT_SECONDS)
    return done.stdout.strip()


def _package() -> Finding:
    version, where = installed("tricue"), short(PACKAGE)
    if not version:
        return Finding(
            SECTION,
            "tricue",
            Verdict.WARNING,
            f"{where}, not installed by pip: version and extras are unknown",
        )
    built = commit()
    text = f"{version}{f', commit {_abbreviated(built)}' if built else ''}, {where}"
    home = Path(str(metadata.distribution("tricue").locate_file("tricue"))).resolve()
    if home != PACKAGE and home.is_dir():
        text += f"; version and extras are those of {short(home)}"
        return Finding(SECTION, "tricue", Verdict.WARNING, text)
    return Finding(SECTION, "tricue", Verdict.OK, text)


def _python() -> Finding:
    text = f"{platform.python_version()}, {platform.python_implementation()}, {platform.python_compiler()}"
    if sys.version_info < OLDEST_PYTHON:
        return Finding(SECTION, "Python", Verdict.FAILED, f"{text}; 3.10 or newer is needed")
    return Finding(SECTION, "Python", Verdict.OK, f"{text}, {short(sys.executable)}")


def _numpy() -> Finding:
    needed = next((each for each in required().get("", ()) if each.package == "numpy"), Requirement("numpy"))
    answer = probe("import numpy\nnumpy.ones(3) @ numpy.ones(3)\nreport(version=numpy.__version__)")
    if answer.error:
        return Finding(SECTION, "NumPy", Verdict.FAILED, answer.error, pip("--force-reinstall", str(needed)))
    version = str(answer.values["version"])
    if not needed.admits(version):
        return Finding(
            SECTION, "NumPy", Verdict.FAILED, f"{version}; {needed.versions} is needed", pip(str(needed))
        )
    return Finding(SECTION, "NumPy", Verdict.OK, version)


def _core() -> list[Finding]:
    """The finding on the native core, which is loaded without the rest of the package."""
    files = [*PACKAGE.glob("_core*.so"), *PACKAGE.glob("_core*.pyd")]
    if not files:
        return [Finding(SECTION, "native core", Verdict.FAILED, f"there is none in {short(PACKAGE)}", BUILD)]
    answer = probe(_LOAD_CORE.format(package=str(PACKAGE)))
    if answer.error:
        text = f"{', '.join(sorted(file.name for file in files))} can't be loaded: {answer.error}"
        return [Finding(SECTION, "native core", Verdict.FAILED, text, BUILD)]
    info = answer.values["info"]
    if not info:
        return [Finding(SECTION, "native core", Verdict.OK, "loads; older than the Python around it")]
    text = f"{info['compiler']}, OpenCV {info['opencv']}, Eigen {info['eigen']}"
    return [
        Finding(SECTION, "native core", Verdict.OK, text),
        Finding("Machine", "kernels run as", Verdict.OK, str(info["instructions"])),
    ]


_LOAD_CORE = """
import importlib.machinery, importlib.util
spec = importlib.machinery.PathFinder.find_spec("_core", [{package!r}])
if spec is None:
    raise ImportError("it was built for another Python, or another system")
core = importlib.util.module_from_spec(spec)
spec.loader.exec_module(core)
report(info=getattr(core, "_build_info", None))
"""
