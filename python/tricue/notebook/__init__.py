# SPDX-License-Identifier: MIT
"""The rich display of values in a notebook, which their ``_repr_html_`` methods return.

Only these methods import it, when a notebook calls them. So it costs trackers nothing.
"""
