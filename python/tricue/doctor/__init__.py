# SPDX-License-Identifier: MIT
"""What ``tricue doctor`` says of an installation.

It imports nothing of the package outside of this folder, so that it also runs where nothing else can be
imported. What may crash or hang is tried in a process of its own (:mod:`tricue.doctor.probe`).
"""
