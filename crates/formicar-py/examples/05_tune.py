"""A bee colony looks for weights of a planner by an objective of your own."""

from typing import Any

import formicar

GRID = formicar.OccupancyGrid.builtin("narrow-junction")


def objective(values: dict[str, Any]) -> float:
    """Length of the path, with what turning costs, summed over the requests."""
    planner = formicar.Planner(GRID, planner="hybrid-astar", hybrid_astar=values)
    cost = 0.0
    for start, goal in GRID.requests.values():
        plan = planner.plan(start, goal, budget=20_000)
        metrics = plan.metrics
        cost += metrics.length_m + 2.0 * metrics.n_cusps if metrics else 1000.0
    return cost


space = {"weight": formicar.Real(1.0, 3.0), "change_penalty": formicar.Real(0.0, 0.5)}
found = formicar.tune(objective, space, seed=1, max_evaluations=40, n_sources=5)
print(found.best, f"cost {found.cost:.2f} after {found.n_evaluations} evaluations")
