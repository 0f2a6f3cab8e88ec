# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.papers import plots

figure = pytest.importorskip("matplotlib.figure", reason="figures need matplotlib: pip install tricue[demo]")


def test_every_hidden_frame_is_shaded():
    """From half a frame before it to half a frame after, also where it is the only one."""
    axes = figure.Figure().subplots()
    visible = np.array([0.2, 1.0, 0.5, 0.4, 1.0, 0.1, 0.3, 0.9, 0.0])
    plots.shade_hidden(axes, visible)
    (shade,) = axes.collections
    spans = sorted((path.vertices[:, 0].min(), path.vertices[:, 0].max()) for path in shade.get_paths())
    assert spans == [(-0.5, 0.5), (2.5, 3.5), (4.5, 6.5), (7.5, 8.5)]
    assert axes.get_xlim() == (0, 8)


def test_shades_lie_behind_bands():
    """Also where the band is drawn first."""
    axes = figure.Figure().subplots()
    runs = np.array([[0.2, 0.4, 0.6], [0.4, 0.6, 0.8]])
    plots.plot_band(axes, runs.mean(axis=0), runs, "red", "model")
    plots.shade_hidden(axes, np.array([1.0, 0.2, 1.0]))
    band, shade = axes.collections
    assert shade.get_zorder() < band.get_zorder()
