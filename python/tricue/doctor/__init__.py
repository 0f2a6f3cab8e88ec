# SPDX-License-Identifier: MIT
"""The checks of ``tricue doctor``.

It imports nothing of the package outside of this folder, so that it also runs if nothing else can be
imported. Whatever may crash or hang is tried in a separate process (:mod:`tricue.doctor.probe`).
"""
