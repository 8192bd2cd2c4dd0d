"""The command that grows an aggregate: one subcommand per family, with the family's own parameters as options."""

from __future__ import annotations

import re
from collections.abc import Callable
from inspect import Parameter, cleandoc, signature
from pathlib import Path
from typing import Annotated, Any, get_args

import typer

from rheoclast import io as files
from rheoclast.cli import options
from rheoclast.cli.console import screen
from rheoclast.cli.presentation import show_shape
from rheoclast.cli.results import refuse_unwritable
from rheoclast.cli.signatures import with_parameters
from rheoclast.cli.speech import number, whole_number
from rheoclast.cli.tables import shape_summary
from rheoclast.generation.families import FAMILIES, Family
from rheoclast.generation.lattices import LATTICES
from rheoclast.io.contact_table import write_pairs
from rheoclast.io.files import writable
from rheoclast.io.formats import format_to_write
from rheoclast.particles.aggregate import Aggregate

RADIUS = 0.5e-6
"""Default radius in m; that of the families, one metre, suits calculations without units."""

WRITTEN_ONLY = (".vtp",)
"""Endings of files that hold contacts, but are not read."""

VALUES: dict[Any, tuple[str, Callable[[str], Any]]] = {float: ("<number>", number), int: ("<integer>", whole_number)}
"""How the value of a type is called and read."""

HELP = {
    "count": "Number of spheres.",
    "radius": "Radius of the spheres in m{}.",
    "spread": "Standard deviation of the logarithm of the radius.",
    "seed": "Equal seeds give equal aggregates.",
    "bend": "Angle in rad between successive links.",
    "torsion": "Angle in rad between the planes of successive pairs of links.",
    "arm": "Spheres along each arm.",
    "arms": "Number of arms, 4 or 6.",
    "lattice": f"One of: {', '.join(LATTICES)}.",
    "counts": "Spheres in a row, rows in a layer, layers.",
    "fractal_dimension": "Fractal dimension D in N = k (Rg/a)^D.",
    "prefactor": "Prefactor k in N = k (Rg/a)^D.",
    "migrations": "Contacts that each sphere rolls on to: 1 or 2.",
    "disorder": "Random addition, in radii, to the distance that ranks the places.",
    "coordination": "Mean number of contacts of a sphere.",
    "amount": "Share of the way from the tree (0) to the packing (1).",
}
"""Help on parameters by name, in one line; on others it is what the docstring of the family says of them."""

EXAMPLES = {
    "bent-chain": "20 --bend 0.2",
    "cross": "5",
    "lattice-block": "fcc 4 4 3",
    "lattice-ball": "hcp 100",
    "cluster-cluster": "300 --fractal-dimension 1.8 --prefactor 1.3 --seed 7",
    "thinned-fcc-ball": "200 4",
    "compacted-cluster": "200 --amount 0.5",
}
"""Arguments of an example, for families that need more than a number of spheres."""

PURPOSES = {
    "straight-chain": "Straight chain of equal spheres along x.",
    "bent-chain": "Chain of equal spheres that turns by the same angles from link to link.",
    "ring": "Ring of equal spheres in the plane z = 0.",
    "cross": "Cross of equal spheres: one at the centre, and as many along each of its arms.",
    "lattice-block": "Block of equal spheres on a lattice: spheres in a row, rows in a layer, layers.",
    "lattice-ball": "Ball of equal spheres: those sites of a lattice that are nearest to one of them.",
    "ballistic-particle-cluster": "Spheres that arrive one by one on straight lines and stick where they touch.",
    "ballistic-cluster-cluster": "Two halves that meet on a straight line, each grown in the same way.",
    "diffusion-limited-particle-cluster": "Spheres that arrive one by one by diffusion and stick where they touch.",
    "diffusion-limited-cluster-cluster": "Two halves that meet by diffusion, each grown in the same way.",
    "reaction-limited-cluster-cluster": "Clusters that stick together with a vanishing probability per touch.",
    "cluster-cluster": "Tree of prescribed fractal dimension and prefactor, made of clusters.",
    "ballistic-migration": "Spheres that arrive on straight lines and roll on to a second or third contact.",
    "random-packed-ball": "Random close-packed ball of equal spheres, each on three that were there before it.",
    "thinned-fcc-ball": "Ball of equal spheres on the face-centred cubic lattice, thinned to a mean coordination.",
    "compacted-cluster": "Tree of clusters, compacted by an amount: from the tree (0) to a packing (1).",
}
"""What a family is, in one line; of others it is what the docstring says first."""

generate = typer.Typer(rich_markup_mode="rich")


@generate.callback()
def about() -> None:
    """Grow an aggregate and write its spheres to a file that the other commands read.

    [bold]Example:[/bold] rheoclast generate cluster-cluster 300 --fractal-dimension 1.8 --output floc.dat
    """


def command_of(name: str, family: Family) -> Callable[..., None]:
    """The command of a family: it takes the family's parameters, and where to write."""

    def command(
        *,
        output: Annotated[
            Path | None,
            options.valued("<file>", "File to write; by default named after the family.", options.OUTPUT),
        ] = None,
        file_format: options.FormatToWrite = None,
        overwrite: options.Overwrite = False,
        **parameters: Any,
    ) -> None:
        path = Path(f"{name}.dat") if output is None else output
        refuse_unwritable(writable(path, overwrite).parent, str(path))  # now rather than after the growth
        format_to_write(path, file_format)
        aggregate = family(**parameters)
        contacts = _contact_file(path, aggregate, overwrite)
        files.write(path, aggregate, format=file_format, overwrite=overwrite)
        if contacts is not None:
            write_pairs(contacts, aggregate.pairs, overwrite)
        show_shape(str(path), shape_summary(aggregate), "m")
        if path.suffix not in WRITTEN_ONLY:
            read_with = "" if contacts is None else f" --contacts {contacts}"
            advice = f"next: rheoclast stress {path}{read_with} --rate 1e5 --output results"
            screen.print(advice, soft_wrap=True, markup=False)

    example = f"rheoclast generate {name} {EXAMPLES.get(name, '100')}"
    purpose = PURPOSES.get(name) or (family.__doc__ or "").splitlines()[0].replace("`", "")
    command.__doc__ = f"{purpose}\n\n[bold]Example:[/bold] {example}"
    own = [each for each in signature(command, eval_str=True).parameters.values() if each.name != "parameters"]
    taken = [_parameter(family, each) for each in signature(family, eval_str=True).parameters.values()]
    return with_parameters(command, [*taken, *own])


def _contact_file(path: Path, aggregate: Aggregate, overwrite: bool) -> Path | None:
    """Where the contacts go of an aggregate in which not all spheres that touch are joined; none for others."""
    if path.suffix in WRITTEN_ONLY or len(Aggregate.touching(aggregate.spheres).pairs) == len(aggregate.pairs):
        return None
    contacts = path.with_name(f"{path.stem}_contacts.csv")
    writable(contacts, overwrite)
    return contacts


def _parameter(family: Family, given: Parameter) -> Parameter:
    """A parameter of a family as an argument of the command, if it stands first and has no default, or as an option."""
    required = given.default is Parameter.empty
    kind = typer.Argument if required and given.kind is not Parameter.KEYWORD_ONLY else typer.Option
    default = RADIUS if given.name == "radius" else given.default
    unequal = ", the median where they are unequal" if "spread" in signature(family).parameters else ""
    help_text = HELP.get(given.name, "").format(unequal) or documented(family, given.name)
    annotation: Any = given.annotation
    metavar, parser = VALUES.get(get_args(annotation)[0] if get_args(annotation) else annotation, (None, None))
    if kind is typer.Argument:
        metavar = None  # it would stand in place of the name
    described = Annotated[annotation, kind(help=help_text, metavar=metavar, parser=parser)]
    return Parameter(given.name, Parameter.KEYWORD_ONLY, default=default, annotation=described)


def documented(family: Family, name: str) -> str:
    """What the docstring of a family says of a parameter, under its heading in the manner of NumPy."""
    found = re.search(rf"^{name}(?: : .*)?\n((?:    .*\n?)+)", cleandoc(family.__doc__ or ""), re.M)
    return " ".join(found[1].replace("`", "").split()) if found else ""


for _name, _family in FAMILIES.items():
    generate.command(_name)(command_of(_name, _family))
