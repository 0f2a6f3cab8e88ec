# SPDX-License-Identifier: MIT
"""Fixtures that all tests share."""

import pytest
from tricue.kernels import Kernels, load


@pytest.fixture(params=["native", "reference"], scope="session")
def kernels(request: pytest.FixtureRequest) -> Kernels:
    """Both sets of kernels, one after the other: what holds for one must hold for the other."""
    return load(request.param)
