# SPDX-License-Identifier: MIT
"""``python -m tricue`` is ``tricue``."""

import sys

from tricue.cli import main

if __name__ == "__main__":
    sys.exit(main())
