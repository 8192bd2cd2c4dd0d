"""What the ensembles tell, as rows of tables: rates and laws for them, scaling lengths, fragments, a kernel."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from ensembles import Ensemble, Interval, bounds, local_exponents, resampled
from numpy.typing import NDArray

import rheoclast as rc

WINDOWS = {"all": (0.0, np.inf), "slow": (0.0, 0.03), "fast": (0.3, np.inf)}  # failures per Kolmogorov time
LENGTHS = ("gyration", "enclosing", "hydrodynamic", "spheres")
RATE_OF_LENGTHS = 0.01
RATES_OF_FRAGMENTS = (0.001, 0.01, 0.1, 1.0)
EROSIVE = 0.05  # mass fraction
LARGE = (128, 256)  # spheres, for shares of some hundredths to exist
RADIUS, STRENGTH, VISCOSITY, KINEMATIC_VISCOSITY = 0.5e-6, 1e-10, 1e-3, 1e-6  # the example of the kernel, SI units
MODEL_OF_KERNEL = "recent-deformation"
Row = dict[str, str | float]


def kind(ensemble: Ensemble) -> Row:
    """The columns that tell what a row is about."""
    return {"model": ensemble.model, "family": ensemble.family, "spheres": ensemble.spheres}


def rate_rows(ensemble: Ensemble) -> list[Row]:
    """Every rate with its intervals: of a Poisson count, and from resampling clusters with their paths."""
    rates = ensemble.rates
    return [
        kind(ensemble)
        | {
            "gyration": ensemble.mean("gyration"),
            "dissipation": each.dissipation,
            "rate": each.measured.rate,
            "rate_low": each.interval[0],
            "rate_high": each.interval[1],
            "poisson_low": each.measured.interval[0],
            "poisson_high": each.measured.interval[1],
            "failures": each.measured.events,
            "overloaded_at_start": each.overloaded,
            "local_exponent": exponent,
        }
        for each, exponent in zip(rates, local_exponents(rates).tolist(), strict=True)
    ]


def fit_rows(ensemble: Ensemble) -> list[Row]:
    """Power law and exponential law of the rate, two parameters each, in every window; Kusters' law has one."""
    rows = []
    for window, (least, most) in WINDOWS.items():
        rates = [each for each in ensemble.rates if least <= each.measured.rate < most]
        if len(rates) < 4:
            continue
        dissipation = np.array([each.dissipation for each in rates])
        scaled = np.array([each.measured.rate for each in rates])
        rate = scaled * np.sqrt(dissipation)
        power = rc.power_law(dissipation, rate)
        slope, intercept = np.polyfit(1 / dissipation, np.log(scaled), 1)
        row = kind(ensemble) | {"window": window, "points": len(rates)}
        row |= {"decades_of_dissipation": float(np.log10(dissipation[-1] / dissipation[0]))}
        row |= {"decades_of_rate": float(np.log10(rate[-1] / rate[0])), "exponent": power.exponent}
        row |= {"power_misfit": _misfit(rate, power(dissipation))}
        row |= {"exponential_critical": -slope, "exponential_prefactor": float(np.exp(intercept))}
        row |= {"exponential_misfit": _misfit(scaled, np.exp(intercept + slope / dissipation))}
        rows.append(row | _kusters(dissipation, rate))
    return rows


def _kusters(dissipation: NDArray[np.float64], rate: NDArray[np.float64]) -> Row:
    """Critical dissipation and misfit; not numbers where the rates exceed what the law allows."""
    try:
        critical = rc.fitted_critical_dissipation(dissipation, rate, kinematic_viscosity=1.0).value
    except ValueError:
        return {"kusters_critical": np.nan, "kusters_misfit": np.nan}
    law = rc.turbulent_breakage_rate(dissipation, 1.0, critical)
    return {"kusters_critical": critical, "kusters_misfit": _misfit(rate, law)}


def _misfit(measured: NDArray[np.float64], law: NDArray[np.float64]) -> float:
    """Root mean square of the logarithm of measured over law: 0.1 is ten per cent."""
    return float(np.sqrt(np.mean(np.log(measured / law) ** 2)))


def length_rows(found: Sequence[Ensemble]) -> list[Row]:
    """How mean tension, and dissipation at a given rate, grow with measures of size: one family, and all."""
    rows = []
    trees = [each for each in found if each.family != "doublet"]
    for model in dict.fromkeys(each.model for each in trees):
        for family in (*dict.fromkeys(each.family for each in trees), "all"):
            own = [each for each in trees if each.model == model and family in (each.family, "all")]
            critical = np.array([each.dissipation_at(RATE_OF_LENGTHS) for each in own])
            tension = np.concatenate([each.clusters["tension"] for each in own])
            for length in LENGTHS:
                sizes = [each.clusters[length] for each in own]
                laws = {
                    "tension": _law(np.concatenate(sizes), tension),
                    "critical_dissipation": _law(np.array([each.mean(length) for each in own]), critical),
                }
                columns = {f"{what}_{name}": value for what, law in laws.items() for name, value in law.items()}
                rows.append({"model": model, "family": family, "length": length, **columns})
    return rows


def _law(length: NDArray[np.float64], value: NDArray[np.float64]) -> Row:
    known = np.isfinite(value)
    law = rc.power_law(length[known], value[known])
    return {
        "exponent": law.exponent,
        "exponent_low": law.exponent_interval[0],
        "exponent_high": law.exponent_interval[1],
        "prefactor": law.prefactor,
        "misfit": _misfit(value[known], law(length[known])),
    }


def breakages(found: Sequence[Ensemble], rate: float) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Mass fractions of the smaller fragments, and seeds, of ensembles that all break at the same rate."""
    parts = [each.smaller_shares(each.dissipation_at(rate)) for each in found]
    return np.concatenate([share for share, _ in parts]), np.concatenate([seed for _, seed in parts])


def large(found: Sequence[Ensemble], model: str, family: str) -> list[Ensemble]:
    """The ensembles whose fragments are looked at."""
    return [each for each in found if (each.model, each.family) == (model, family) and each.spheres in LARGE]


def fragment_rows(found: Sequence[Ensemble]) -> list[Row]:
    """Sizes of fragments of large trees at several dissipations, held against a uniform and a linear density."""
    rows = []
    for model, family in dict.fromkeys((each.model, each.family) for each in found if each.family != "doublet"):
        own = large(found, model, family)
        lowest = own[0].dissipation_at(RATES_OF_FRAGMENTS[0])
        for rate in RATES_OF_FRAGMENTS:
            share, seed = breakages(own, rate)
            dissipation = own[0].dissipation_at(rate) / lowest
            row: Row = {"model": model, "family": family, "rate": rate, "dissipation_over_lowest": dissipation}
            row |= {"breakages": len(share)} | _named("smaller", _mean(share, seed))
            row |= _named("erosive", _mean(share < EROSIVE, seed))
            broad = share >= EROSIVE
            row |= _named("broad_exponent", _exponent(share[broad], seed[broad]))
            rows.append(row | _distances(share[broad]))
    return rows


def _named(name: str, estimate: tuple[float, Interval]) -> Row:
    value, (low, high) = estimate
    return {name: value, f"{name}_low": low, f"{name}_high": high}


def _mean(value: NDArray[np.generic], seed: NDArray[np.intp]) -> tuple[float, Interval]:
    total, count = resampled(seed, value, np.ones(len(value)))
    return float(value.mean()), bounds(total / count)


def _exponent(share: NDArray[np.float64], seed: NDArray[np.intp]) -> tuple[float, Interval]:
    """The q of maximum likelihood for a number of smaller fragments up to y that grows as y^q − EROSIVE^q, y ≤ ½."""
    total, count = resampled(seed, np.log(2 * share), np.ones(len(share)))
    trials = np.linspace(0.05, 20, 4000)
    lost = (2 * EROSIVE) ** trials
    expected = -lost * np.log(2 * EROSIVE) / (1 - lost) - 1 / trials  # of ln 2y; it grows with q
    low, high = bounds(np.interp(total / count, expected, trials))
    return float(np.interp(np.log(2 * share).mean(), expected, trials)), (low, high)


def _distances(share: NDArray[np.float64]) -> Row:
    """Largest distance of the cumulative number of smaller fragments from y − EROSIVE and from y² − EROSIVE²."""
    place = np.unique(share)
    cumulative = np.searchsorted(np.sort(share), place, side="right") / len(share)
    laws = {"uniform": 1, "linear": 2}
    return {
        f"distance_{name}": float(
            np.abs(cumulative - (place**q - EROSIVE**q) / (0.5**q - EROSIVE**q))[place < 0.5].max()
        )
        for name, q in laws.items()
    }


def kernel(found: Sequence[Ensemble]) -> dict[str, NDArray[np.float64]]:
    """The breakage kernel of trees of one material, in SI units."""
    unit = KINEMATIC_VISCOSITY * (STRENGTH / (VISCOSITY * RADIUS**2)) ** 2
    entries = []
    for ensemble in found:
        if ensemble.model != MODEL_OF_KERNEL or ensemble.family == "doublet":
            continue
        slow = [row for row in fit_rows(ensemble) if row["window"] == "slow"]
        critical = unit * float(slow[0]["kusters_critical"]) if slow else None
        for each in ensemble.rates[::2]:
            shares, _ = ensemble.smaller_shares(each.dissipation)
            dissipation = unit * each.dissipation
            time = each.measured.time * rc.kolmogorov_time(dissipation, KINEMATIC_VISCOSITY)
            entries.append(
                rc.KernelEntry(
                    ensemble.spheres,
                    RADIUS * ensemble.mean("gyration"),
                    dissipation,
                    rc.poisson_rate(each.measured.events, time),
                    critical,
                    rc.fragment_distribution(np.stack([shares, 1 - shares], axis=1), bins=1),  # moments need no bins
                )
            )
    return rc.kernel_table(entries)
