# SPDX-License-Identifier: MIT
"""tricue's extras: whether their packages are installed, new enough, and importable."""

from collections.abc import Iterable, Mapping
from concurrent.futures import Executor, Future

from tricue.doctor.finding import Finding, Verdict
from tricue.doctor.install import pip
from tricue.doctor.probe import ProbeAnswer, probe
from tricue.doctor.requirements import FOR_DEVELOPERS, Requirement, installed, required

SECTION = "Extras"


def find_extras(pool: Executor) -> list[Finding]:
    """A finding for each extra; installed packages are imported, each in its own process."""
    extras = {name: needs for name, needs in required().items() if name and name not in FOR_DEVELOPERS}
    if not extras:
        return [Finding(SECTION, "extras", Verdict.ABSENT, "unknown, as pip didn't install this tricue")]
    modules = {each.module: each.package for needs in extras.values() for each in needs}
    imports: dict[str, Future[ProbeAnswer]] = {
        module: pool.submit(probe, f"import {module}\nreport()")
        for module, package in modules.items()
        if installed(package)
    }
    return [judge(name, needs, imports) for name, needs in extras.items()]


def judge(name: str, needs: Iterable[Requirement], imports: Mapping[str, Future[ProbeAnswer]]) -> Finding:
    """The finding on an extra's packages. imports: the results of importing the installed ones."""
    there, missing, old, broken = [], [], [], []
    for each in needs:
        version = installed(each.package)
        if not version:
            missing.append(each)
        elif not each.admits(version):
            old.append(each)
        elif error := imports[each.module].result().error:
            broken.append((each, error))
        else:
            there.append(f"{each.package} {version}")
    parts = [*there]
    parts += [
        f"{each.package} {installed(each.package)} is too old, {each.versions} is needed" for each in old
    ]
    parts += [
        f"{each.package} {installed(each.package)} can't be imported: {error}" for each, error in broken
    ]
    if missing:
        parts.append(f"{', '.join(each.package for each in missing)} missing")
    text = "; ".join(parts) or "needs nothing here"
    if broken:
        again = pip("--force-reinstall", *(str(each) for each, _ in broken), *map(str, old + missing))
        return Finding(SECTION, name, Verdict.BROKEN, text, again)
    if old:
        return Finding(SECTION, name, Verdict.WARNING, text, pip("--upgrade", *map(str, old + missing)))
    if missing:
        return Finding(SECTION, name, Verdict.ABSENT, text, pip(*map(str, missing)))
    return Finding(SECTION, name, Verdict.OK, text)
