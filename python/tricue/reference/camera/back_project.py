# SPDX-License-Identifier: MIT
"""Points from a stereo pair's measurements (Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, section 3.2)."""

import numpy as np

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_covariance, require_shape
from tricue.reference.base.depth_pixels import require_camera


def back_project(
    measurements: Floats, variances: Floats, camera: Floats, baseline: float
) -> tuple[Floats, Floats]:
    """Back-projects one measurement at a time, and computes J S J^T."""
    count = len(measurements)
    require_shape("measurements", measurements, (count, 3))
    if variances.ndim == 1:
        require_shape("variances", variances, (3,))
        noises = np.tile(np.diag(variances), (count, 1, 1))
        require_covariance("variances", np.diag(variances), 3)
    else:
        require_shape("variances", variances, (len(variances), 3, 3))
        if len(variances) != count:
            refuse("variances", f"one covariance for each of {count} measurements", len(variances))
        noises = variances
    for noise in noises:
        require_covariance("variances", noise, 3)
    require_camera(camera)
    fx, fy, cx, cy = camera
    if not 0 < baseline < np.inf:
        refuse("baseline", "a finite number above 0", float(baseline))

    points, covariances = np.full((count, 3), np.nan), np.full((count, 3, 3), np.nan)
    for i, (u, v, d) in enumerate(measurements):
        if not (d > 0 and np.isfinite([u, v, d]).all()):
            continue
        z = fx * baseline / d
        x, y = (u - cx) * z / fx, (v - cy) * z / fy
        points[i] = x, y, z
        jacobian = np.array([[z / fx, 0, -x / d], [0, z / fy, -y / d], [0, 0, -z / d]])
        covariance = jacobian @ noises[i] @ jacobian.T
        covariances[i] = (covariance + covariance.T) / 2
    return points, covariances
