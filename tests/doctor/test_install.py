# SPDX-License-Identifier: MIT
"""The command that messages give to install an extra."""

import pytest
from tricue.doctor import install
from tricue.doctor.requirements import Requirement

NEEDS = {"": (Requirement("opencv-python-headless"),), "some": tuple(map(Requirement, ("here", "gone")))}


@pytest.mark.parametrize(
    ("there", "packages"), [({"here"}, "gone"), (set(), "here gone"), ({"here", "gone"}, "here gone")]
)
def test_an_extra_leaves_cv2_alone(monkeypatch: pytest.MonkeyPatch, there: set[str], packages: str) -> None:
    """Only its own packages are named, not tricue, for which pip would install opencv-python-headless."""
    monkeypatch.setattr(install, "required", lambda: NEEDS)
    monkeypatch.setattr(install, "installed", lambda package: "1.0" if package in there else "")
    assert install.install_extra("some").endswith(f" -m pip install {packages}")


def test_an_old_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """As if it were missing."""
    monkeypatch.setattr(
        install, "required", lambda: {"some": (Requirement("here"), Requirement("old", ">=2"))}
    )
    monkeypatch.setattr(install, "installed", lambda _: "1.0")
    assert install.install_extra("some").endswith(" -m pip install 'old>=2'")


def test_without_metadata_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """A copied folder doesn't know its extras' packages."""
    monkeypatch.setattr(install, "required", dict)
    assert install.install_extra("some").endswith(" -m pip install 'tricue[some]'")
