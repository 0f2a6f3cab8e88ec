# SPDX-License-Identifier: MIT
"""The names of models and scenes, for the experiment and its figure."""

COLOR = "color-particle, head"
PRINTED_COLOR = "color-particle, head, as printed"
PRINTED = "depth-particle, as printed"
HEAD_MODELS = (COLOR, PRINTED_COLOR)
"""Models that follow the head, as the paper's color tracker does."""

DUSK, SUNRISE = "dusk", "sunrise"
MIN_REFLECTANCE = 0.15
RANGE_SCENES = {
    "range 15 m": (15.0, 0.0),
    "range 10 m": (10.0, 0.0),
    "range 7.5 m": (7.5, 0.0),
    "range 5 m": (5.0, 0.0),
    "range 7.5 m, amplitude": (7.5, MIN_REFLECTANCE),
    "range 5 m, amplitude": (5.0, MIN_REFLECTANCE),
}
"""The unambiguous range, meters, and the least reflectance that the amplitude must imply; 0: unchecked."""
