# SPDX-License-Identifier: MIT
"""Robot recordings: ROS 1 bags (RealSense's included), ROS 2 folders, MCAP files."""
