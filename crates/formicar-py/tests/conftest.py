"""What the tests share."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import numpy as np
import pytest
from hypothesis import settings

import formicar

# The same cases every time, so that a green tree stays green.
N_EXAMPLES = int(os.environ.get("FORMICAR_EXAMPLES", "60"))
settings.register_profile("formicar", derandomize=True, deadline=None, max_examples=N_EXAMPLES)
settings.load_profile("formicar")


@pytest.fixture(scope="session")
def hall() -> formicar.OccupancyGrid:
    """A hall of 12 x 8 m with a wall in its middle that leaves 3 m."""
    walls = np.zeros((80, 120), dtype=bool)
    walls[:50, 60] = True
    return formicar.OccupancyGrid(walls, resolution=0.1)


@pytest.fixture(scope="session")
def planner(hall: formicar.OccupancyGrid) -> formicar.Planner:
    """The default planner in the hall."""
    return formicar.Planner(hall, "warehouse_amr")


@pytest.fixture(scope="session")
def plan(planner: formicar.Planner) -> formicar.Plan:
    """A path around the wall."""
    found = planner.plan((2.0, 2.0, 0.0), (10.0, 2.0, 0.0), seed=7)
    assert found
    return found


@pytest.fixture(scope="session")
def colony() -> formicar.Plan:
    """A path of a colony, with its ants."""
    ants = formicar.Planner("lei-map1", planner="lei2020", config={"colony.n_iterations": 12})
    found = ants.plan(*next(iter(ants.map.requests.values())), keep_ants=True)
    assert found
    return found


@pytest.fixture(scope="session")
def program() -> Path:
    """The command line of the same sources: $FORMICAR, or the one on the path."""
    found = os.environ.get("FORMICAR") or shutil.which("formicar")
    if not found:
        pytest.skip("no command line: set FORMICAR to target/debug/formicar")
    return Path(found)
