"""The page: a template into which styles, scripts, text and data are put, so that one file is all there is."""

from __future__ import annotations

import html
import json
import os
from importlib import resources
from string import Template
from typing import Any

from rheoclast.io.files import replacing
from rheoclast.report.content import content
from rheoclast.report.result import Result, read_result
from rheoclast.report.summary import Figure, Group, summary
from rheoclast.report.wording import written

SCRIPTS = (
    "numbers.js",
    "colours.js",
    "camera.js",
    "webgl.js",
    "canvas.js",
    "scene.js",
    "charts.js",
    "tables.js",
    "page.js",
)


def write_report(
    folder: str | os.PathLike[str], path: str | os.PathLike[str] | None = None, *, overwrite: bool = False
) -> None:
    """Write one page on the results in a folder, with all that it needs inside: it opens anywhere, without a network.

    Parameters
    ----------
    folder
        What `rheoclast stress` or `rheoclast break` left with `--output`.
    path
        The page; by default report.html in the folder.
    overwrite
        Whether a file that is there may be replaced.

    Raises
    ------
    FileNotFoundError
        If the folder, or results in it, or the folder of the page are missing.
    FileFormatError
        If a file of the results is not as it was written.
    FileExistsError
        If the page is there and must not be replaced.
    """
    result = read_result(folder)
    text = page(result)
    with replacing(result.folder / "report.html" if path is None else path, overwrite) as temporary:
        temporary.write_text(text, encoding="utf-8")


def page(result: Result) -> str:
    """The page on a result, as HTML."""
    told = summary(result)
    return Template(_asset("page.html")).substitute(
        title=html.escape(os.path.basename(result.name)),
        kind="Breakup" if result.is_breakup else "Contact loads",
        version=html.escape(str(result.summary.get("rheoclast", ""))),
        file=html.escape(result.name),
        lead=html.escape(told.lead),
        figures="\n".join(_figure(figure) for figure in told.figures),
        groups="\n".join(_group(group) for group in told.groups),
        note=html.escape(_note(result)),
        style=_asset("page.css"),
        data=_embedded(content(result)),
        script="\n".join(_asset(name) for name in SCRIPTS),
    )


def _asset(name: str) -> str:
    return resources.files("rheoclast.report").joinpath("assets", name).read_text(encoding="utf-8")


def _embedded(data: Any) -> str:
    """JSON that cannot end the element it stands in."""
    return json.dumps(data, separators=(",", ":"), ensure_ascii=False, allow_nan=False).replace("<", "\\u003c")


def _figure(figure: Figure) -> str:
    label, value, note = (html.escape(text) for text in (figure.label, figure.value, figure.note))
    return f"<div><dt>{label}</dt><dd>{value}<small>{note}</small></dd></div>"


def _group(group: Group) -> str:
    rows = "".join(f"<dt>{html.escape(label)}</dt><dd>{html.escape(value)}</dd>" for label, value in group.rows)
    return f"<section><h3>{html.escape(group.heading)}</h3><dl>{rows}</dl></section>"


def _note(result: Result) -> str:
    """At which rate the loads are those of the intact aggregate."""
    if not result.is_breakup:
        return f"Loads in the flow as given, at the rate {written(result.flow.rate, '1/s')}."
    rate = written(result.summary["contact_loads_at_rate_per_s"], "1/s")
    if result.failures:
        return f"Loads of the whole aggregate at the initiation rate, {rate}."
    return f"Loads of the whole aggregate at the rate {rate}."
