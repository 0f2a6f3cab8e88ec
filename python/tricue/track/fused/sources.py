# SPDX-License-Identifier: MIT
"""The source given for default parameters that are neither from a paper nor from an experiment."""

PROTOTYPE = "our prototype, or a choice not yet compared with others"
