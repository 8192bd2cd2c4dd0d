"""What stands in words and numbers on the page of a campaign: how much is done, key figures, and what was asked."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from operator import itemgetter
from typing import Any

import numpy as np

from rheoclast.mechanics.material import MATERIALS
from rheoclast.report.campaign.folder import CampaignResult
from rheoclast.report.campaign.kinds import Kind, met_name, parameter, parameter_name, quantiles
from rheoclast.report.campaign.tables import found_rate
from rheoclast.report.summary import MODELS, RULES, Figure, Group, Summary, matrix
from rheoclast.report.wording import written
from rheoclast.view.fragments import counted

EVENTS = {
    "first failure": "the contact that fails first, and at what rate",
    "breakup": "all failures up to the split, and the fragments",
    "history": "the first failure along every path of the fluid",
}
MODEL_NAMES = {"stokesian": "StokesianDynamics", "free-draining": "FreeDraining", "exposed-area": "ExposedArea"}
PROPERTIES = {
    "youngs_modulus": ("Young's modulus", "Pa"),
    "poisson_ratio": ("Poisson's ratio", ""),
    "work_of_adhesion": ("work of adhesion", "J/m²"),
    "pull_off": ("pull-off force", "N"),
    "friction": ("friction", ""),
    "rolling_distance": ("rolling distance", "m"),
}


def campaign_summary(result: CampaignResult, all_kinds: Sequence[Kind]) -> Summary:
    """The text of the page on a campaign."""
    families = dict.fromkeys(str(each["name"]) for each in result.request["families"])
    lead = (
        f"{counted(result.asked, 'aggregate')} of {_listed(families)}, {_met(result.request)}: {EVENTS[result.event]}."
    )
    groups = (
        Group("Aggregates", _aggregates(result.request)),
        Group("Flow", _liquid(result.request)),
        Group("Contacts", _contacts(result)),
    )
    return Summary(lead, (*_progress(result), *_extremes(result, all_kinds)), groups)


def _listed(words: Mapping[str, Any]) -> str:
    *most, last = words
    return f"{', '.join(most)} and {last}" if most else last


def _met(request: Mapping[str, Any]) -> str:
    """What the aggregates meet."""
    if request["event"] == "history":
        return "in turbulence"
    flows = _listed(dict.fromkeys(_flow_name(each) for each in request["flows"]))
    asked = request["orientations"]
    number = 1 if asked == "worst" else asked["number"]
    turned = "in the worst orientation" if asked == "worst" else f"in {counted(number, 'random orientation')}"
    return f"each {turned} in {flows}"


def _flow_name(flow: Any) -> str:
    return str(flow["name"]) if isinstance(flow, Mapping) else str(flow)


def _progress(result: CampaignResult) -> tuple[Figure, Figure]:
    """How much is done."""
    share = result.done / result.asked
    todo = "all that were asked for" if share == 1 else f"of {result.asked}; unfinished, the rest is still to come"
    nothing = len(result.failures)
    return (
        Figure("Aggregates done", str(result.done), todo),
        Figure(
            "Events", str(result.events.num_rows), f"{nothing} came to nothing" if nothing else "none came to nothing"
        ),
    )


def _extremes(result: CampaignResult, all_kinds: Sequence[Kind]) -> tuple[Figure, ...]:
    """The kinds that break most easily and least."""
    if result.event == "history":
        label, rates = "breakage rate", [0.0 if rate is None else rate.rate for rate in map(found_rate, all_kinds)]
    else:
        label = "initiation rate, median"
        rates = [float(quantiles(kind.events["initiation_rate_per_s"], (0.5,))[0]) for kind in all_kinds]
    known = [(rate, kind) for rate, kind in zip(rates, all_kinds, strict=True) if np.isfinite(rate)]
    if not known:
        return ()
    extremes = {"Lowest": min(known, key=itemgetter(0)), "Highest": max(known, key=itemgetter(0))}
    return tuple(
        Figure(f"{which} {label}", written(rate, "1/s"), _told(kind)) for which, (rate, kind) in extremes.items()
    )


def _told(kind: Kind) -> str:
    spheres = f"{kind.each('spheres').mean():.4g} spheres"
    return f"{kind.family}, {spheres}, {kind.material}, {met_name(kind.met)}"


def _aggregates(request: Mapping[str, Any]) -> tuple[tuple[str, str], ...]:
    seeds = request["seeds"]
    rows = [(str(each["name"]), _parameters(each)) for each in request["families"]]
    if request["sizes"]:
        rows.append(("Sizes", f"{_several(request['sizes'])} spheres"))
    rows.append(("Seeds", f"{seeds['number']} of every kind that is random, from {seeds['first']} on"))
    rows.append(("Seed of the campaign", str(request.get("seed", 0))))
    return tuple(rows)


def _parameters(family: Mapping[str, Any]) -> str:
    given = (f"{parameter_name(name)} {_several(value)}" for name, value in family.items() if name != "name")
    return ", ".join(given) or "as it is"


def _several(value: Any) -> str:
    """A value, or several."""
    return " or ".join(parameter(each) for each in value) if isinstance(value, list) else parameter(value)


def _liquid(request: Mapping[str, Any]) -> tuple[tuple[str, str], ...]:
    hydrodynamics = request["hydrodynamics"]
    name = (
        MODELS[MODEL_NAMES[hydrodynamics["model"]]] if hydrodynamics["model"] in MODEL_NAMES else hydrodynamics["model"]
    )
    order = f", multipole order {hydrodynamics['order']}" if hydrodynamics["model"] == "stokesian" else ""
    met = _histories(request["histories"]) if request["event"] == "history" else _flows(request)
    return (*met, ("Viscosity", written(request["viscosity"], "Pa s")), ("Hydrodynamics", f"{name}{order}"))


def _flows(request: Mapping[str, Any]) -> tuple[tuple[str, str], ...]:
    asked = request["orientations"]
    rows = [
        ("Flows", ", ".join(map(_flow, request["flows"]))),
        ("Orientations", "the worst" if asked == "worst" else f"{asked['number']} random ones of every aggregate"),
    ]
    if request.get("up_to") is not None:
        rows.append(("Raised up to", written(request["up_to"], "1/s")))
    return tuple(rows)


def _flow(flow: Any) -> str:
    """A flow by name, or also by its gradient."""
    if not isinstance(flow, Mapping):
        return str(flow)
    return f"{flow['name']} (gradient {matrix(np.array(flow['gradient']))} 1/s)"


def _histories(asked: Mapping[str, Any]) -> tuple[tuple[str, str], ...]:
    files = ", ".join(str(each["path"]) for each in asked["files"] or ())
    rows = [("Histories", str(asked["model"]) if asked["model"] else f"from {files}")]
    if asked["number"] is not None:
        rows.append(("Number", f"{asked['number']} of every aggregate"))
    if asked["duration"] is not None:
        rows.append(("Duration", f"{written(asked['duration'])} Kolmogorov times"))
    if asked["dissipations"] is not None:
        rows.append(("Dissipations", f"{_several(asked['dissipations'])} m²/s³"))
    if asked["density"] is not None:
        rows.append(("Density", written(asked["density"], "kg/m³")))
    if asked["kinematic_viscosity"] is not None:
        rows.append(("Kinematic viscosity", written(asked["kinematic_viscosity"], "m²/s")))
    return tuple(rows)


def _contacts(result: CampaignResult) -> tuple[tuple[str, str], ...]:
    request = result.request
    materials = [_material(each) for each in request["materials"]]
    versions = sorted({str(each) for each in result.aggregates["rheoclast"].unique().to_pylist()})
    return (
        *materials,
        ("Criterion", str(request["criterion"])),
        ("Rule", RULES.get(request["rule"], str(request["rule"]))),
        ("Made with Rheoclast", ", ".join(versions)),
    )


def _material(asked: Any) -> tuple[str, str]:
    """Properties as asked for, or else as the material of that name is known to have."""
    given = {key: value for key, value in asked.items() if value is not None} if isinstance(asked, Mapping) else {}
    name = str(given.get("name", asked))
    words = []
    if "stiffness" in given:
        normal, tangential, bending, twisting = (written(each) for each in given["stiffness"])
        words.append(f"stiffness {normal} and {tangential} N/m, {bending} and {twisting} N m/rad")
    elif name in MATERIALS:
        given = {**asdict(MATERIALS[name]), **given}
    words += [f"{label} {written(given[key], unit)}" for key, (label, unit) in PROPERTIES.items() if key in given]
    return name, ", ".join(words)
