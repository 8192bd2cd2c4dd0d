"""The page: a template into which styles, scripts, text and data are put, so that one file is all there is."""

from __future__ import annotations

import html
import json
import os
import re
from importlib import resources
from pathlib import Path
from string import Template
from typing import Any

from rheoclast.io.files import replacing
from rheoclast.report.campaign.charts import campaign_charts
from rheoclast.report.campaign.folder import CampaignResult, is_campaign, read_campaign_result
from rheoclast.report.campaign.kinds import kinds
from rheoclast.report.campaign.summary import campaign_summary
from rheoclast.report.campaign.tables import campaign_tables
from rheoclast.report.content import content
from rheoclast.report.result import Result, read_result
from rheoclast.report.summary import Figure, Group, Summary, summary
from rheoclast.report.wording import written

SHARED_SCRIPTS = ("numbers.js", "colours.js", "scales.js", "charts.js", "tables.js")
SCRIPTS = {
    "aggregate": ("camera.js", "webgl.js", "canvas.js", "scene.js", "cascade.js", "aggregate.js"),
    "campaign": ("campaign.js",),
}
_INSIDE_QUANTITY = re.compile(
    r"(?<=[\d⁰¹²³⁴⁵⁶⁷⁸⁹]) (?=× 10|%|1/s|Pa|J/m²|kg/m³|m²/s|[afpnµmk]?(?:N|m)(?![\w²³]))|(?<=×) (?=10)"
)


def write_report(
    folder: str | os.PathLike[str], path: str | os.PathLike[str] | None = None, *, overwrite: bool = False
) -> None:
    """Write one page on the results in a folder, with all that it needs inside: it opens anywhere, without a network.

    Parameters
    ----------
    folder
        What `rheoclast stress`, `rheoclast break` or `rheoclast survey` left with `--output`; of a campaign that goes
        on, what is done.
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
    ImportError
        If the folder is that of a campaign and pyarrow is not installed.
    """
    text = campaign_page(read_campaign_result(folder)) if is_campaign(folder) else page(read_result(folder))
    with replacing(Path(folder) / "report.html" if path is None else path, overwrite) as temporary:
        temporary.write_text(text, encoding="utf-8")


def page(result: Result) -> str:
    """The page on an aggregate, as HTML."""
    version = str(result.summary.get("rheoclast", ""))
    body = Template(_asset("aggregate.html")).substitute(note=html.escape(_note(result)))
    kind = "Breakup" if result.is_breakup else "Contact loads"
    source = f"{result.name} · Rheoclast {version}"
    told = summary(result)
    return _framed("aggregate", kind, os.path.basename(result.name), told, body, content(result), source)


def campaign_page(result: CampaignResult) -> str:
    """The page on a campaign, as HTML."""
    all_kinds = kinds(result)
    data = {**campaign_charts(all_kinds, result.event), "tables": campaign_tables(result, all_kinds)}
    told, name = campaign_summary(result, all_kinds), result.folder.resolve().name
    return _framed(
        "campaign", f"Campaign: {result.event}", name, told, _asset("campaign.html"), data, str(result.folder)
    )


def _framed(subject: str, kind: str, title: str, told: Summary, body: str, data: Any, source: str) -> str:
    return Template(_asset("page.html")).substitute(
        title=html.escape(title),
        kind=html.escape(kind),
        lead=_text(told.lead),
        figures="\n".join(_figure(figure) for figure in told.figures),
        groups="\n".join(_group(group) for group in told.groups),
        body=body,
        reading=_asset(f"{subject}_reading.html"),
        source=html.escape(source),
        style=_asset("page.css"),
        data=_embedded(data),
        script="\n".join(_asset(name) for name in (*SHARED_SCRIPTS, *SCRIPTS[subject])),
    )


def _asset(name: str) -> str:
    return resources.files("rheoclast.report").joinpath("assets", name).read_text(encoding="utf-8")


def _embedded(data: Any) -> str:
    """JSON that cannot end the element it stands in."""
    return json.dumps(data, separators=(",", ":"), ensure_ascii=False, allow_nan=False).replace("<", "\\u003c")


def _text(text: str) -> str:
    """Text in which no line ends between a number, its power of ten, and its unit."""
    return _INSIDE_QUANTITY.sub("\N{NO-BREAK SPACE}", html.escape(text))


def _figure(figure: Figure) -> str:
    label, value, note = (_text(text) for text in (figure.label, figure.value, figure.note))
    return f"<div><dt>{label}</dt><dd>{value}<small>{note}</small></dd></div>"


def _group(group: Group) -> str:
    rows = "".join(f"<dt>{_text(label)}</dt><dd>{_text(value)}</dd>" for label, value in group.rows)
    return f"<section><h3>{html.escape(group.heading)}</h3><dl>{rows}</dl></section>"


def _note(result: Result) -> str:
    """At which rate the loads are those of the intact aggregate."""
    if not result.is_breakup:
        return f"Loads in the flow as given, at the rate {written(result.flow.rate, result.units['flow_rate'])}."
    rate = written(result.summary["contact_loads_at_rate_per_s"], result.units["flow_rate"])
    if result.failures:
        return f"Loads of the whole aggregate at the initiation rate, {rate}."
    return f"Loads of the whole aggregate at the rate {rate}."
