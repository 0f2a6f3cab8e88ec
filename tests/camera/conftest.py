# SPDX-License-Identifier: MIT
import os
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of real sequences."""
    folder = Path(os.environ.get("TRICUE_DATA", ROOT.parent / "shared" / "data"))
    if not folder.is_dir():
        pytest.skip(f"no real sequences in {folder}; TRICUE_DATA names their folder")
    return folder
