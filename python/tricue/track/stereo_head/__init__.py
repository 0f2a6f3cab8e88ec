# SPDX-License-Identifier: MIT
"""The stereo head tracker of Moreno, Tarrida, Andrade-Cetto, Sanfeliu (2002); :mod:`tracker` is its loop."""
