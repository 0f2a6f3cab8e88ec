# SPDX-License-Identifier: MIT
"""Whether this process was started to run ``tricue doctor``."""

import sys
from pathlib import Path


def is_called() -> bool:
    """Whether the command line is ``tricue doctor`` or ``python -m tricue doctor``.

    ``import tricue`` then leaves out what may be broken.
    """
    words = sys.orig_argv
    for index, word in enumerate(words[:-1]):
        if words[index + 1] == "doctor":
            return Path(word).stem == "tricue" and (words[index - 1] == "-m" or Path(word).is_absolute())
    return False
