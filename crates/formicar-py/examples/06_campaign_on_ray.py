"""A campaign on a Ray cluster, here of this machine alone, into the store of the command line."""

import os
from pathlib import Path

# On a machine of one's own; a cluster of several keeps Ray's token authentication.
os.environ.setdefault("RAY_AUTH_MODE", "disabled")

import formicar.ray  # noqa: E402

CAMPAIGN = """
seeds = 3

[[scenarios]]
builtin = ["narrow-aisle"]
ids = ["next-aisle"]

[[planner]]
planner = "formicar"

[[planner]]
planner = "hybrid-astar"
"""

Path("campaign.toml").write_text(CAMPAIGN)
done = formicar.ray.bench("campaign.toml", store="runs.sqlite")
print(done.summary, end="")
print(f"{done.n_done} of {done.n_runs} runs were missing, {done.n_retried} tried again")
