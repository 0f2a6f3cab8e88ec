# SPDX-License-Identifier: MIT
"""What the verbs of the command line do; each module imports what it needs, so that ``--help`` is quick."""
