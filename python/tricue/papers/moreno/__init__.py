# SPDX-License-Identifier: MIT
"""Figures 2 and 3 of Moreno, Tarrida, Andrade-Cetto and Sanfeliu (2002): a head in stereo."""
