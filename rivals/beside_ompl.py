#!/usr/bin/env python3
"""formicar's Python package beside that of OMPL: car scenarios, one process, one run.

    python3 rivals/beside_ompl.py cars/*.json --out benchmarks/DATE-python-ompl [--seconds 1]

Needs the packages `formicar`, `ompl` and `numpy`. Both sides plan on the same cells with the same
body, the curves of both are judged by `formicar.check`, and both are written in Python as a user
would: formicar with a warm planner for each map and vehicle, OMPL with the validity checker of
ompl_planner.py (NumPy), which its wheels leave to the user. Reverse is allowed.

Writes results.csv and summary.md. Licensed like formicar itself: MIT or Apache-2.0.
"""

from __future__ import annotations

import argparse
import csv
import importlib.metadata
import platform
import statistics
import sys
import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import ompl
import ompl.base
import ompl.geometric
import ompl.util

import formicar

sys.path.insert(0, str(Path(__file__).parent))
import ompl_planner

PLANNERS = ["RRTConnect", "BITstar"]
COLUMNS = [
    "scenario", "planner", "status", "valid", "setup_ms", "first_ms", "query_ms", "length_m",
    "clearance_m", "n_cusps", "reason",
]  # fmt: skip


def ours(
    name: str, scenario: formicar.Scenario, planner: formicar.Planner, setup_ms: float
) -> dict[str, Any]:
    """Return the row of formicar: the second asking counts, that of a warm planner."""
    planner.plan(scenario.start, scenario.goal)
    plan = planner.plan(scenario.start, scenario.goal)
    row = {"scenario": name, "planner": "formicar", "status": plan.status, "reason": plan.reason}
    row |= {"setup_ms": setup_ms, "query_ms": plan.timing.query_s * 1e3, "valid": False}
    if plan and plan.metrics:
        first_s = plan.timing.first_feasible_s or plan.timing.query_s
        row |= {"valid": bool(formicar.check(plan)), "first_ms": first_s * 1e3}
        row |= {"length_m": plan.metrics.length_m, "n_cusps": plan.metrics.n_cusps}
        row["clearance_m"] = plan.metrics.min_clearance_m
    return row


def question(scenario: formicar.Scenario) -> dict[str, Any]:
    """Return a scenario as ompl_planner.py takes it."""
    grid, vehicle = scenario.map, scenario.vehicle
    n_rows, n_cols = grid.shape
    lethal = (grid.data == 100) | (grid.data == -1)
    return {
        "map": {
            "n_cols": n_cols,
            "n_rows": n_rows,
            "resolution_m": grid.resolution,
            "origin": grid.origin,
            "lethal": np.packbits(lethal, axis=1).tobytes().hex(),
        },
        "vehicle": {
            "motion": "car",
            "footprint": vehicle.footprint.tolist(),
            "min_turning_radius_m": vehicle.min_turning_radius,
        },
        "start": scenario.start,
        "goal": scenario.goal,
        "motion": "reverse",
        "seed": 0,
    }


def theirs(name: str, scenario: formicar.Scenario, planner: str, seconds: float) -> dict[str, Any]:
    """Return the row of a planner of OMPL."""
    args = SimpleNamespace(
        planner=planner, simplify=planner not in ompl_planner.ANYTIME, range=None, slack=None,
        time_limit=seconds,
    )  # fmt: skip
    found = ompl_planner.plan(question(scenario), args, ompl, np)
    row = {"scenario": name, "planner": planner, "status": found["status"], "valid": False}
    row |= {"reason": found.get("reason"), "setup_ms": found["map_setup_s"] * 1e3}
    if "query_s" in found:
        row["query_ms"] = found["query_s"] * 1e3
    if found["status"] == "found":
        judged = formicar.check(found["poses"], scenario.map, scenario.vehicle)
        measured = formicar.metrics(found["poses"], scenario.map, scenario.vehicle)
        row |= {"valid": judged.valid, "first_ms": found["first_feasible_s"] * 1e3}
        row |= {"length_m": measured.length_m, "n_cusps": measured.n_cusps}
        row["clearance_m"] = measured.min_clearance_m
        if not judged:
            row["reason"] = judged.certificate.violations[0].message
    return row


def median(rows: list[dict[str, Any]], column: str) -> str:
    """Return the median of the rows that have a value."""
    values = [row[column] for row in rows if row.get(column) is not None]
    return f"{statistics.median(values):.3g}" if values else "-"


def ratios(rows: list[dict[str, Any]], beside: dict[str, dict[str, Any]], column: str) -> str:
    """Return the median ratio to formicar's row, over scenarios that both solve."""
    pairs = [(row[column], beside[row["scenario"]].get(column)) for row in rows if row["valid"]]
    found = [theirs / ours for theirs, ours in pairs if ours]
    return f"{statistics.median(found):.3g}" if found else "-"


def summary(rows: list[dict[str, Any]], seconds: float) -> str:
    """Return the table of all planners."""
    beside = {row["scenario"]: row for row in rows if row["planner"] == "formicar"}
    text = [
        f"formicar {formicar.__version__} and OMPL {importlib.metadata.version('ompl')} from "
        f"Python {platform.python_version()}, {len(beside)} car scenarios, reverse allowed, one "
        f"seed, one process; OMPL has {seconds:g} s a query.",
        "",
        "| planner | certified | set-up ms | first path ms | query ms | length m | clearance m "
        "| cusps | first path, ratio | length, ratio |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for planner in ["formicar", *PLANNERS]:
        own = [row for row in rows if row["planner"] == planner]
        valid = [row for row in own if row["valid"]]
        cells = [planner, f"{len(valid)} of {len(own)}", median(own, "setup_ms")]
        columns = ("first_ms", "query_ms", "length_m", "clearance_m", "n_cusps")
        cells += [median(valid, column) for column in columns]
        cells += [ratios(own, beside, "first_ms"), ratios(own, beside, "length_m")]
        text.append("| " + " | ".join(cells) + " |")
    text.append("")
    text.append(
        "Medians over certified paths. Ratios: to formicar on the same scenario, medians over "
        "those where the planner's path is certified. *certified*: by `formicar.check`, which "
        "reads OMPL's path from its poses with 5 % of slack on the curvature."
    )
    return "\n".join(text) + "\n"


def main() -> None:
    """Plan everything and write the results."""
    parser = argparse.ArgumentParser(description="formicar and OMPL from Python, side by side.")
    parser.add_argument("files", nargs="+", metavar="F.json", help="car scenarios")
    parser.add_argument("--out", required=True, type=Path, metavar="DIR", help="for the results")
    parser.add_argument("--seconds", type=float, default=1.0, metavar="S", help="time for OMPL")
    parser.add_argument("--limit", type=int, metavar="N", help="scenarios of each file")
    args = parser.parse_args()
    ompl.util.setLogLevel(ompl.util.LOG_ERROR)
    rows: list[dict[str, Any]] = []
    for file in args.files:
        scenarios = list(formicar.load_scenarios(file).items())[: args.limit]
        for name, scenario in scenarios:
            begun = time.perf_counter()
            planner = formicar.Planner(scenario.map, scenario.vehicle)
            setup_ms = (time.perf_counter() - begun) * 1e3
            rows.append(ours(name, scenario, planner, setup_ms))
            rows += [theirs(name, scenario, other, args.seconds) for other in PLANNERS]
            print(*(f"{row['planner']} {row['status']}" for row in rows[-3:]), name, flush=True)
    args.out.mkdir(parents=True, exist_ok=True)
    with (args.out / "results.csv").open("w", newline="") as table:
        writer = csv.DictWriter(table, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)
    text = summary(rows, args.seconds)
    (args.out / "summary.md").write_text(f"# formicar and OMPL from Python\n\n{text}")
    print(text)


if __name__ == "__main__":
    main()
