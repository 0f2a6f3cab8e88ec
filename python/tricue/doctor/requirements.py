# SPDX-License-Identifier: MIT
"""tricue's requirements, by its installed metadata, and the installed versions."""

import re
import sys
from dataclasses import dataclass
from functools import cache
from importlib import metadata

MODULES = {
    "opencv-python-headless": "cv2",
    "rerun-sdk": "rerun",
    "scikit-image": "skimage",
    "vot-trax": "trax",
}
"""Modules by package, if the names differ by more than hyphens."""
FOR_DEVELOPERS = {"dev", "docs"}
_REQUIREMENT = re.compile(
    r"(?P<name>[A-Za-z0-9][\w.-]*)\s*(\[(?P<extras>[^\]]*)\])?\s*(?P<versions>[^;]*)(;(?P<marker>.*))?"
)


@dataclass(frozen=True)
class Requirement:
    """A package that tricue needs, or that one of its extras needs. versions: such as ">=0.22", or ""."""

    package: str
    versions: str = ""

    @property
    def module(self) -> str:
        """The name of the module to import."""
        return MODULES.get(self.package, self.package.replace("-", "_"))

    def __str__(self) -> str:
        return f"'{self.package}{self.versions}'" if self.versions else self.package

    def admits(self, version: str) -> bool:
        """Whether a version satisfies the requirement, by its leading numbers."""
        return all(
            _holds(version, *clause) for clause in re.findall(r"(>=|<=|==|!=|<|>)\s*([\w.]+)", self.versions)
        )


def installed(package: str) -> str:
    """The version of a package, "" if it isn't installed."""
    try:
        return metadata.version(package) or "unknown"
    except metadata.PackageNotFoundError:
        return ""


@cache
def required() -> dict[str, tuple[Requirement, ...]]:
    """The requirements by extra, "" for the core; empty if tricue has no metadata."""
    try:
        lines = metadata.requires("tricue") or []
    except metadata.PackageNotFoundError:
        return {}
    return parse(lines)


def parse(lines: list[str]) -> dict[str, tuple[Requirement, ...]]:
    """The requirements in lines of metadata, by extra, "" for the core; tricue's own extras are expanded."""
    direct: dict[str, list[Requirement]] = {}
    nested: dict[str, list[str]] = {}
    for line in lines:
        found = _REQUIREMENT.match(line)
        if found is None:
            continue
        marker = found["marker"] or ""
        extra = re.search(r"""extra\s*==\s*['"]([\w.-]+)['"]""", marker)
        name = extra[1] if extra else ""
        direct.setdefault(name, [])
        if found["name"] == "tricue":
            nested.setdefault(name, []).extend(re.split(r"\s*,\s*", found["extras"] or ""))
        elif _for_this_python(marker):
            direct[name].append(Requirement(found["name"], found["versions"].strip(" ()")))
    return {name: tuple(dict.fromkeys(_open(name, direct, nested))) for name in direct}


def _open(name: str, direct: dict[str, list[Requirement]], nested: dict[str, list[str]]) -> list[Requirement]:
    inner = [each for other in nested.get(name, []) for each in _open(other, direct, nested)]
    return [*inner, *direct.get(name, [])]


def _for_this_python(marker: str) -> bool:
    """Whether a marker holds; in tricue's metadata markers are only extras and Python versions."""
    clauses = re.findall(r"""python_version\s*(>=|<=|==|!=|<|>)\s*['"]([\d.]+)['"]""", marker)
    version = ".".join(map(str, sys.version_info[:2]))
    return all(_holds(version, *clause) for clause in clauses)


def _holds(version: str, comparison: str, other: str) -> bool:
    ours, theirs = _numbers(version), _numbers(other)
    length = max(len(ours), len(theirs))
    a, b = (numbers + (0,) * (length - len(numbers)) for numbers in (ours, theirs))
    return {">=": a >= b, "<=": a <= b, "==": a == b, "!=": a != b, "<": a < b, ">": a > b}[comparison]


def _numbers(version: str) -> tuple[int, ...]:
    found = re.match(r"\d+(\.\d+)*", version)
    return tuple(map(int, found[0].split("."))) if found else ()
