"""An obstacle appears on the way: the map changes, and the path keeps to what is still free."""

import numpy as np

import formicar

planner = formicar.Planner("warehouse")
start, goal = planner.map.requests["dock-to-rack"]
plan = planner.plan_or_raise(start, goal)
print("planned ", plan)

# A pallet of 0.6 x 0.6 m on the middle of the path, seen when the robot has driven 2 m.
middle = plan.poses[len(plan) // 2]
side = round(0.6 / planner.map.resolution)
cell = planner.map.cell_at(middle["x"] - 0.3, middle["y"] - 0.3)
assert cell is not None
planner.update_map(np.ones((side, side), dtype=bool), *cell)

here = plan.poses[np.searchsorted(plan.poses["s"], 2.0)]
again = planner.replan((here["x"], here["y"], here["heading"]), goal, plan)
print("mended  ", again, f"in {again.timing.query_s * 1e3:.1f} ms")
again.save("replan.svg")
