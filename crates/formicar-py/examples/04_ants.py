"""An ant colony at work: iterations, pheromone, ways of ants."""

import numpy as np

import formicar

planner = formicar.Planner("lei-map1", planner="lei2020", config={"colony.n_iterations": 40})
start, goal = next(iter(planner.map.requests.values()))
plan = planner.plan(start, goal, seed=1, keep_ants=True)
print(plan)
for row in plan.history.iterations[::10]:
    print(f"iteration {row['iteration']:2}: {row['n_arrived']:3} of {row['n_ants']} ants arrived")
assert plan.pheromone is not None
row, col = np.unravel_index(np.nanargmax(plan.pheromone), plan.pheromone.shape)
print(f"most pheromone on cell ({col}, {row}); {len(plan.ants)} iterations are kept")
with open("ants.svg", "w") as file:
    file.write(plan.to_svg(ants=True))
