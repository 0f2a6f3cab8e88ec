# SPDX-License-Identifier: MIT
"""cv2: its package, whether several share its folder, and which trackers it has."""

from importlib import metadata

from tricue.doctor.finding import Finding, Verdict
from tricue.doctor.install import pip, short
from tricue.doctor.probe import ProbeAnswer, probe
from tricue.doctor.requirements import Requirement, installed, required

SECTION = "cv2, OpenCV for Python"
HEADLESS = "opencv-python-headless"
CONTRIB = "opencv-contrib-python-headless"
TRACKERS = ("CSRT", "KCF", "MIL", "MOSSE", "MedianFlow")
"""OpenCV's trackers, with which tricue evaluate compares."""
_LOAD = """
import cv2
names = {trackers!r}
legacy = getattr(cv2, "legacy", None)
report(
    version=getattr(cv2, "__version__", ""),
    file=getattr(cv2, "__file__", None) or "",
    trackers=[name for name in names if hasattr(cv2, "Tracker" + name) or hasattr(legacy, "Tracker" + name)],
    threads=cv2.getNumThreads() if hasattr(cv2, "getNumThreads") else 0,
)
"""


def find_opencv() -> list[Finding]:
    """Findings on cv2."""
    answer = probe(_LOAD.format(trackers=TRACKERS))
    providers = provider_packages()
    found = [_import(answer, providers)]
    if len(providers) > 1:
        found.append(_several(providers))
    if answer.values.get("version"):
        found.append(_trackers(answer.values["trackers"]))
    return found


def provider_packages() -> dict[str, str]:
    """The installed packages that put a cv2 into the same folder, with their versions."""
    names = {
        str(each.metadata["Name"]).lower().replace("_", "-")
        for each in metadata.distributions()
        if each.metadata["Name"]
    }
    chosen = sorted(name for name in names if name.startswith("opencv-") and "python" in name)
    return {name: installed(name) for name in chosen}


def _needed() -> Requirement:
    core = required().get("", ())
    return next((each for each in core if each.package == HEADLESS), Requirement(HEADLESS))


def _import(answer: ProbeAnswer, providers: dict[str, str]) -> Finding:
    needed = _needed()
    again = pip("--force-reinstall", "--no-deps", next(iter(providers), str(needed)))
    if answer.error:
        where = "" if providers else "; no package of it is installed"
        return Finding(SECTION, "cv2", Verdict.FAILED, answer.error + where, again)
    version, file = str(answer.values["version"]), str(answer.values["file"])
    if not version:
        text = "an empty folder, which another package left behind when it was uninstalled"
        return Finding(SECTION, "cv2", Verdict.FAILED, text, again)
    by = ", ".join(f"{name} {number}" for name, number in providers.items()) or "no package that pip knows"
    text = f"{version}, {short(file)}, by {by}"
    if not needed.admits(version):
        newer = (
            pip("--upgrade", str(needed)) if set(providers) <= {HEADLESS} else pip("--upgrade", *providers)
        )
        return Finding(SECTION, "cv2", Verdict.FAILED, f"{text}; {needed.versions} is needed", newer)
    return Finding(SECTION, "cv2", Verdict.OK, text)


def _several(providers: dict[str, str]) -> Finding:
    """A finding on the known trap: the last one installed wins, and uninstalling either breaks the other."""
    kept = max(providers, key=lambda name: ("contrib" in name, "headless" in name))
    text = (
        f"{', '.join(providers)} share one folder: the last one installed counts, to uninstall one breaks all"
    )
    remove = f"{pip().replace('install', 'uninstall')}-y {' '.join(providers)}"
    fix = f"{remove}, then {pip(f'{kept}=={providers[kept]}')}"
    return Finding(SECTION, "several packages", Verdict.WARNING, text, fix)


def _trackers(present: list[str]) -> Finding:
    missing = [name for name in TRACKERS if name not in present]
    if not missing:
        return Finding(SECTION, "baselines", Verdict.OK, ", ".join(present))
    text = f"{', '.join(present) or 'none'}; {', '.join(missing)} missing, for comparisons by tricue evaluate"
    remove = f"{pip().replace('install', 'uninstall')}-y {' '.join(provider_packages()) or HEADLESS}"
    return Finding(SECTION, "baselines", Verdict.ABSENT, text, f"{remove}, then {pip(CONTRIB)}")
