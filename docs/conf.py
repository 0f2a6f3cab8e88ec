# SPDX-License-Identifier: MIT
"""The site: ``make docs`` builds it from this folder into build/site."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "extensions"))

import tricue
from pygments.lexers.special import TextLexer
from sphinx.application import Sphinx

project = "tricue"
author = "the tricue authors"
project_copyright = f"{author}; MIT license"
release = version = tricue.__version__

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx_design",
    "sphinx_copybutton",
    "docstrings",
    "pages",
]
exclude_patterns = ["extensions", "_build", "**/.ipynb_checkpoints"]
nitpicky = True

# Markdown. The same files are read on code hosts, so the syntax is mostly CommonMark's.
myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 4
myst_links_external_new_tab = False

# Notebooks run once, and again when they change.
nb_execution_mode = "cache"
nb_execution_cache_path = str(Path(__file__).parents[1] / "build" / "notebooks")
nb_execution_raise_on_error = True
nb_execution_timeout = 300
nb_ipywidgets_js: dict[str, dict[str, str]] = {}  # the site fetches nothing from elsewhere

highlight_language = "text"
autodoc_member_order = "bysource"
autodoc_class_signature = "mixed"
default_role = "code"
python_maximum_signature_line_length = 88
add_module_names = False
toc_object_entries_show_parents = "hide"

pygments_dark_style = "github-dark"
html_theme = "furo"
html_title = f"tricue {release}"
html_static_path = ["_static", "../build/gallery"]  # tools/gallery.py makes the second
html_css_files = ["site.css"]
html_show_sourcelink = False
html_show_sphinx = False
html_copy_source = False
html_theme_options = {"sidebar_hide_name": False}
copybutton_exclude = ".linenos, .gp, .go"

linkcheck_timeout = 30
linkcheck_anchors = False


def setup(app: Sphinx) -> None:
    """Show what Pygments has no lexer for as text."""
    app.add_lexer("csv", TextLexer)
