# SPDX-License-Identifier: MIT
"""Whether this process was started to run ``tricue doctor``."""

import sys
from pathlib import Path


def is_called() -> bool:
    """Whether the command line is ``tricue doctor`` or ``python -m tricue doctor``.

    ``import tricue`` then leaves out what may be broken.
    """
    words = sys.orig_argv
    if "doctor" not in words[2:]:
        return False
    before, program = words[words.index("doctor", 2) - 2 :][:2]
    return (
        program == "tricue" if before == "-m" else Path(program).stem == "tricue" and Path(program).is_file()
    )
