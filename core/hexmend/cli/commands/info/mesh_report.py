"""The report that `hexmend info` prints on a mesh."""

from __future__ import annotations

import argparse
from collections.abc import Mapping

import numpy as np

from hexmend.cli.output.mesh_messages import print_notes
from hexmend.cli.output.text_tables import print_spreads, print_summaries
from hexmend.doctor import examine
from hexmend.io import read
from hexmend.mesh.mesh import Mesh
from hexmend.quality import (
    ElementQuality,
    MetricStatistics,
    SecondOrder,
    Summary,
    locked_hexes,
    measure,
    metric_statistics,
    summarise,
    summarise_second_order,
)
from hexmend.quality.material_volumes import material_volumes
from hexmend.terminal_text import printable

#: Places of a problem that are printed.
_MAX_PLACES = 10


def run(args: argparse.Namespace) -> int:
    """Measure the mesh and print the report, as text or as JSON."""
    mesh = read(args.mesh, as_is=args.as_is)
    print_notes(mesh)
    quality = measure(mesh.points, mesh.hexes)
    summary = summarise(mesh, quality)
    metrics = metric_statistics(mesh, quality) if args.metrics else {}
    second_order = summarise_second_order(mesh)
    if args.json:
        _print_json(args, mesh, summary, metrics, second_order)
        return 0
    print_summaries(args.mesh, [""], [summary])
    if summary.locked_inverted:
        _print_locked(mesh, quality, summary.locked_inverted)
    if mesh.materials is not None:
        _print_materials(mesh)
    if second_order is not None:
        print(f"Second order: {second_order.phrase}.")
    if args.metrics:
        print_spreads(metrics)
    _print_problems(args, mesh)
    return 0


def _print_json(
    args: argparse.Namespace,
    mesh: Mesh,
    summary: Summary,
    metrics: Mapping[str, MetricStatistics],
    second_order: SecondOrder | None,
) -> None:
    from hexmend.report import to_json  # not loaded for a report in words

    answer = summary.to_dict()
    if args.metrics:
        answer["metrics"] = {name: spread.to_dict() for name, spread in metrics.items()}
    if mesh.materials is not None:
        counts, volumes = np.bincount(mesh.materials.of_hex).tolist(), material_volumes(mesh).items()
        pairs = zip(volumes, counts, strict=True)
        answer["materials"] = {name: {"hexes": count, "volume": volume} for (name, volume), count in pairs}
        answer["interface_nodes"] = int(np.count_nonzero(mesh.materials.interface_nodes))
    if second_order is not None:
        answer["second_order"] = second_order.to_dict()
    if args.doctor:
        answer["doctor"] = [finding.to_dict(_MAX_PLACES) for finding in examine(mesh)]
    print(to_json(answer))


def _print_materials(mesh: Mesh) -> None:
    """Print the materials with their numbers of hexes, and what happens to the interfaces between them."""
    from hexmend.run.interface_messages import describe_interfaces  # loaded only for a mesh of several materials

    materials = mesh.materials
    counts = np.bincount(materials.of_hex).tolist()
    named = [f"{name} ({count:,})" for name, count in zip(materials.names, counts, strict=True)]
    more = len(named) - _MAX_PLACES
    listed = ", ".join(named[:_MAX_PLACES]) + (f" and {more:,} more" if more > 0 else "")
    print(f"{describe_interfaces(mesh)} Hexes: {printable(listed)}.")


def _print_locked(mesh: Mesh, quality: ElementQuality, n_locked: int) -> None:
    """Print how many of the locked inverted hexes a sliding boundary frees."""
    from hexmend.boundary import freed_by_sliding  # loaded only for a mesh with locked hexes

    freed = int(freed_by_sliding(mesh, locked_hexes(mesh.points, mesh.hexes, mesh.fixed, quality.inverted)).sum())
    print(f"Locked: {freed:,} can be freed by a sliding boundary (--boundary slide), {n_locked - freed:,} cannot.")


def _print_problems(args: argparse.Namespace, mesh: Mesh) -> None:
    findings = examine(mesh, quick=not args.doctor)
    if args.doctor and not findings:
        print("The doctor finds no problems. Use hexmend smooth to improve the shape of hexes.")
    for finding in findings:
        print(f"note: {finding.message} {finding.remedy}".rstrip())
        if args.doctor and finding.location_text():
            print(f"      {finding.location_text(_MAX_PLACES)}")
        if args.doctor and finding.mendable:
            print(f"      hexmend repair {args.mesh} -o OUT --only {finding.kind}")
