"""The site of the Python package: `sphinx-build docs/python OUTPUT`, with the package importable."""

import chetaev

project = "Chetaev"
author = "the authors of Chetaev"
version = release = chetaev.__version__
extensions = ["sphinx.ext.autodoc", "sphinx.ext.napoleon", "myst_nb"]
exclude_patterns = ["_build"]
html_theme = "alabaster"
html_title = f"Chetaev {release} from Python"
html_theme_options = {"description": "Analytical mechanics with nonholonomic constraints", "page_width": "72em", "body_max_width": "60em"}
html_show_sphinx = False
autodoc_member_order = "bysource"
autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
napoleon_google_docstring = False
napoleon_use_ivar = False
# Notebooks are run when the site is built, unless they have been run already.
nb_execution_mode = "auto"
nb_execution_timeout = 120
nb_execution_raise_on_error = True
nb_merge_streams = True
myst_enable_extensions = ["dollarmath"]
