"""A sedan backs into a bay: a path, its certificate, a picture."""

import formicar

planner = formicar.Planner("parking-lot")
plan = planner.plan_or_raise(*planner.map.requests["back-in"], seed=0)
assert plan.metrics and plan.certificate
print(plan)
print(f"{plan.metrics.length_m:.2f} m, of which {plan.metrics.reverse_length_m:.2f} in reverse")
print(f"clearance {plan.certificate.min_clearance_m:.3f} m at {plan.certificate.tightest}")
print("path", plan.certificate.path_hash)
plan.save("first_plan.svg")
