"""A map from a NumPy array, a vehicle from its measures, poses as columns."""

import numpy as np

import formicar

# 16 x 10 m at 0.1 m, row 0 at the bottom: two walls with doors.
walls = np.zeros((100, 160), dtype=bool)
walls[:65, 55:57] = True
walls[35:, 105:107] = True
hall = formicar.OccupancyGrid(walls, resolution=0.1, origin=(-2.0, -1.0, 0.0))

cart = formicar.Vehicle(
    wheelbase_m=1.0,
    width_m=0.7,
    front_overhang_m=0.2,
    rear_overhang_m=0.2,
    max_steer_deg=40,
    safety_margin_m=0.05,
)
planner = formicar.Planner(hall, cart)
plan = planner.plan_or_raise(start=(-1.0, 0.5, 0.0), goal=(12.5, 0.5, 0.0), motion="forward")
print(hall, cart, plan, sep="\n")
tightest = plan.poses[np.argmin(plan.poses["clearance"])]
print(f"tightest sampled pose: {tightest['clearance']:.3f} m at x = {tightest['x']:.2f} m")
print("judged again:", formicar.check(plan.xy, hall, cart))
plan.save("from_numpy.svg")
