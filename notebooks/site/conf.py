"""Sphinx's settings for the site; `build.py` calls Sphinx with them."""

from __future__ import annotations

import sys
from pathlib import Path

import graphcam

sys.path.insert(0, str(Path(__file__).parent))

project = "graphcam"
author = "The graphcam developers"
project_copyright = author
version = release = graphcam.__version__
language = "en"

extensions = ["myst_nb", "sphinx.ext.autodoc", "docstrings", "mathml"]
nitpicky = True
root_doc = "index"

# The notebooks come with their outputs, or without: nothing is executed here.
nb_execution_mode = "off"
nb_render_markdown_format = "myst"
# Where no kernel runs the stills stand in the place of sliders, so no script for these is fetched either.
nb_mime_priority_overrides = [("html", "application/vnd.jupyter.widget-view+json", None)]
nb_ipywidgets_js: dict[str, dict[str, str]] = {}
myst_enable_extensions = ["dollarmath", "colon_fence", "deflist"]
myst_heading_anchors = 3
# Addresses that need the network are left as they are; what has no scheme must be there.
myst_url_schemes = ["http", "https"]

autodoc_member_order = "bysource"
autodoc_typehints = "none"
add_module_names = False

html_theme = "furo"
html_title = "graphcam"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_math_renderer = "mathml"
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
