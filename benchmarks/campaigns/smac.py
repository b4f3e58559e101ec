#!/usr/bin/env python3
"""Nav2's Smac beside the runs of a campaign.

    python3 benchmarks/campaigns/smac.py ../shared/data/car/peers-one-run.csv results.csv...

Smac cannot be built here, so its paths are those of an earlier run on another build of formicar:
lengths, clearances and cusps are set beside those of the results, and times are ratios to formicar
within that earlier run. Prints Markdown.
"""

from __future__ import annotations

import csv
import statistics
import sys
from collections import defaultdict
from collections.abc import Iterable
from pathlib import Path

MOTIONS = {"rs": "reverse", "dubins": "forward"}
#: A clearance that is better by this much counts, meters.
CLEARANCE_M = 0.02

Rows = list[dict[str, str]]


def rows_of(path: str) -> Rows:
    """Return the rows of a CSV file."""
    with Path(path).open(newline="") as file:
        return list(csv.DictReader(file))


def median(values: Iterable[float]) -> float | None:
    """Return the median, or None of nothing."""
    found = list(values)
    return statistics.median(found) if found else None


def medians(rows: Rows, column: str) -> dict[str, float]:
    """Return the median over the seeds of each scenario that has values."""
    values = defaultdict(list)
    for row in rows:
        if row[column]:
            values[row["scenario"]].append(float(row[column]))
    return {scenario: statistics.median(found) for scenario, found in values.items()}


def spread(values: Iterable[float], decimals: int = 3) -> str:
    """Return median and largest."""
    found = list(values)
    if not found:
        return "-"
    return f"{statistics.median(found):.{decimals}f} ({max(found):.{decimals}f})"


def times(then: Rows, smac: Rows) -> list[str]:
    """Return formicar's time to the first path over Smac's, cold and warm, within one run."""
    theirs = medians([row for row in smac if row["solved"] == "1"], "first_s")
    cells = []
    for column in ("cold_first_s", "warm_first_s"):
        ours = medians(then, column)
        ratios = [ours[name] / theirs[name] for name in theirs if name in ours]
        n_slower = sum(ratio > 1 for ratio in ratios)
        cells.append(f"{spread(ratios)} [{n_slower}/{len(ratios)}]")
    return cells


def paths(now: Rows, smac: Rows) -> list[str]:
    """Return length, clearance and cusps of today's paths beside those of valid ones of Smac."""
    valid = [row for row in smac if row["valid"] == "1"]
    columns = {"length_m": "length_judge_m", "min_clearance_m": "clearance_m", "n_cusps": "cusps"}
    pairs = {}
    for column, other in columns.items():
        ours, theirs = medians(now, column), medians(valid, other)
        pairs[column] = [(ours[name], theirs[name]) for name in theirs if name in ours]
    lengths, clearances, cusps = pairs.values()
    n_closer = sum(theirs - ours > CLEARANCE_M for ours, theirs in clearances)
    n_more = sum(ours > theirs for ours, theirs in cusps)
    ours_m, theirs_m = (median(pair[i] for pair in clearances) for i in (0, 1))
    return [
        f"{spread([ours / theirs for ours, theirs in lengths])}",
        f"{ours_m:.3f} / {theirs_m:.3f}",
        f"{n_closer} of {len(clearances)}",
        f"{statistics.mean(a for a, _ in cusps):.2f} / {statistics.mean(b for _, b in cusps):.2f}",
        f"{n_more} of {len(cusps)}",
    ]


def main() -> None:
    """Print the table."""
    if len(sys.argv) < 3:
        raise SystemExit(__doc__)
    earlier = rows_of(sys.argv[1])
    today = [row for path in sys.argv[2:] for row in rows_of(path)]
    print(
        "| motion | Smac solved / valid | formicar's first path over Smac's, cold | warm "
        "| length over Smac's | clearance m, ours / Smac's | Smac over 2 cm better "
        "| cusps, ours / Smac's | ours more |\n|---|---|---|---|---|---|---|---|---|"
    )
    for word, motion in MOTIONS.items():
        of = [row for row in earlier if row["motion"] == word]
        smac = [row for row in of if row["planner"] == "smac"]
        then = [row for row in of if row["planner"] == "formicar" and row["solved"] == "1"]
        is_ours = {"planner": "formicar", "motion": motion, "status": "found", "valid": "true"}
        now = [row for row in today if is_ours.items() <= row.items()]
        if now:
            counts = [sum(row[key] == "1" for row in smac) for key in ("solved", "valid")]
            cells = [motion, f"{counts[0]} / {counts[1]} of {len(smac)}"]
            print("| " + " | ".join([*cells, *times(then, smac), *paths(now, smac)]) + " |")


if __name__ == "__main__":
    main()
