# SPDX-License-Identifier: MIT
"""Figure 3 of Moreno, Tarrida, Andrade-Cetto and Sanfeliu (2002): a head in stereo."""
