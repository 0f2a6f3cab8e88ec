# SPDX-License-Identifier: MIT
"""Robots' recordings: ROS 1 bags (RealSense's, too), ROS 2 folders, MCAP."""
