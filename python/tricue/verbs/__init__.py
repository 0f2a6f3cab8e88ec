# SPDX-License-Identifier: MIT
"""The verbs of the command line: one module each, with its options and examples."""

from tricue.verbs import demo, evaluate, info, reproduce, track, vot_workspace

VERBS = (demo.VERB, track.VERB, info.VERB, evaluate.VERB, reproduce.VERB, vot_workspace.VERB)
