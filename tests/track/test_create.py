# SPDX-License-Identifier: MIT
import pytest
import tricue
from tricue.track import create as registry


def test_a_tracker_by_its_name(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that create finds the class behind a name, imports it and passes the keywords on."""
    monkeypatch.setitem(registry._TRACKERS, "fraction", "fractions:Fraction")
    assert tricue.create("fraction", numerator=1, denominator=3).numerator == 1  # type: ignore[attr-defined]
    assert registry.names() == (*[name for name in registry.names() if name != "fraction"], "fraction")


@pytest.mark.parametrize("name", ["colour-particle", "", None, 3])
def test_unknown_names_list_the_known(name: str) -> None:
    """It proves that an unknown name is an error that lists the names there are."""
    with pytest.raises(ValueError, match=r"^name: expected one of .*'color-particle'.*, got "):
        tricue.create(name)
