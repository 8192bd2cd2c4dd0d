"""Configuration of the documentation. Build it with `python -m sphinx -W -b html docs docs/_build`."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Any

from sphinx.util.inspect import TypeAliasForwardRef
from sphinx_gallery.sorting import ExplicitOrder

import rheoclast

DOCS = Path(__file__).parent
ROOT = DOCS.parent

project = "Rheoclast"
author = "The Rheoclast developers"
copyright = author
release = version = rheoclast.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx-mathjax-offline",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = ["_build", "_examples", "gallery_header.rst", "gallery/*.ipynb", "gallery/*.py", "gallery/*.zip"]
suppress_warnings = [
    "config.cache",  # the scraper below is a function, which is not pickled
    "ref.python",  # attributes of one name in several classes
]

html_theme = "furo"
html_title = f"Rheoclast {version}"
html_static_path = ["_static"]
html_css_files = ["rheoclast.css"]
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#2a5b84", "color-brand-content": "#2a5b84"},
    "dark_css_variables": {"color-brand-primary": "#8fb9dc", "color-brand-content": "#8fb9dc"},
}

myst_enable_extensions = ["amsmath", "deflist", "dollarmath"]
myst_dmath_double_inline = True
myst_heading_anchors = 3
math_eqref_format = "({number})"

default_role = "py:obj"
add_module_names = False
toc_object_entries_show_parents = "hide"
autodoc_default_options = {"members": True}
autodoc_member_order = "bysource"
autodoc_class_signature = "mixed"
autodoc_typehints_format = "short"
autodoc_type_aliases = {name: name for name in ("FloatArray", "IntArray", "ArrayLike", "Columns")}
autosummary_generate = False
napoleon_google_docstring = False
napoleon_use_ivar = True
napoleon_use_rtype = False
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 100


def pictures_written(block: Any, block_vars: dict[str, Any], gallery_conf: dict[str, Any]) -> str:
    """Move the pictures that an example wrote beside itself into the gallery."""
    from sphinx_gallery.scrapers import figure_rst

    pictures = []
    for written in sorted(Path(block_vars["src_file"]).parent.glob("*.png")):
        pictures.append(next(block_vars["image_path_iterator"]))
        shutil.move(written, pictures[-1])
    return figure_rst(pictures, gallery_conf["src_dir"])


FROM_EASY_TO_HARD = (
    "loads_of_a_floc_in_shear.py",
    "worst_orientation.py",
    "error_bars_and_multipole_order.py",
    "crack_through_a_packed_ball.py",
    "trees_and_packings.py",
    "cascade_of_fragments.py",
    "tumbling_in_shear.py",
    "breakage_rate_in_turbulence.py",
)
"""The examples in the order of the gallery; those that are not named here come last."""

sphinx_gallery_conf = {
    "examples_dirs": "_examples",
    "gallery_dirs": "gallery",
    "filename_pattern": r"\.py$",
    "image_scrapers": (pictures_written,),
    "remove_config_comments": True,
    "download_all_examples": False,
    "show_memory": False,
    "write_computation_times": False,
    "min_reported_time": 1e9,
    "within_subsection_order": ExplicitOrder((*FROM_EASY_TO_HARD, "*")),
    "show_signature": False,
}


def validation_pages() -> None:
    """Write one page for each folder of `validation` that tells its findings."""
    folder = DOCS / "validation"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for readme in sorted((ROOT / "validation").glob("*/README.md")):
        source = readme.relative_to(ROOT).as_posix()
        page = folder / f"{readme.parent.name}.md"
        page.write_text(f"```{{include}} ../../{source}\n:relative-images:\n```\n", encoding="utf-8")


def example_scripts() -> None:
    """Copy the examples to where the gallery runs them, so that what they write stays out of their folder."""
    folder = DOCS / "_examples"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    shutil.copy(DOCS / "gallery_header.rst", folder / "GALLERY_HEADER.rst")
    for script in (ROOT / "examples").glob("*.py"):
        shutil.copy(script, folder)


COLON = "\ua789"  # looks like one, and is not taken for the end of a type


def before_napoleon(app: Any, what: str, name: str, item: object, options: Any, lines: list[str]) -> None:
    """Keep the first line of a value whole, which Napoleon would divide into type and text at a colon."""
    if what in ("property", "attribute", "data") and lines:
        lines[0] = lines[0].replace(":", COLON)


def after_napoleon(app: Any, what: str, name: str, item: object, options: Any, lines: list[str]) -> None:
    """Tell attributes of one description apart, and take bars for those of magnitudes, not for markup."""
    lines[:] = [
        plain_bars(line.replace(COLON, ":")) for field in fields(lines) for line in one_field_per_attribute(field)
    ]


def fields(lines: list[str]) -> list[list[str]]:
    """Lines in groups, each of which begins with a field of its own."""
    groups: list[list[str]] = [[]]
    for line in lines:
        if line.startswith(":"):
            groups.append([])
        groups[-1].append(line)
    return groups


def one_field_per_attribute(field: list[str]) -> list[str]:
    """`:ivar force, moment:` as two fields with the same text."""
    several = re.match(r":ivar ([\w, ]+, \w+):", field[0]) if field else None
    if several is None:
        return field
    rest = field[0][several.end() :]
    return [line for name in several[1].split(", ") for line in (f":ivar {name}:{rest}", *field[1:])]


def plain_bars(line: str) -> str:
    """A line whose bars outside literals are escaped."""
    quoted = line.split("`")
    quoted[::2] = [plain.replace("|", r"\|") for plain in quoted[::2]]
    return "`".join(quoted)


def setup(app: Any) -> None:
    """Prepare what is generated before Sphinx looks for pages."""
    TypeAliasForwardRef.__repr__ = lambda alias: alias.name  # within other types an alias is shown by its `repr`
    app.connect("autodoc-process-docstring", before_napoleon, priority=100)
    app.connect("autodoc-process-docstring", after_napoleon, priority=900)
    validation_pages()
    example_scripts()
