"""Campaigns on a Ray cluster: two nodes as separate processes, one of which is killed."""

from __future__ import annotations

import csv
import os
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import formicar

# Not the machine's own business in a test.
os.environ.update(RAY_AUTH_MODE="disabled", RAY_USAGE_STATS_ENABLED="0", RAY_worker_niceness="0")

ray = pytest.importorskip("ray")
from ray.cluster_utils import Cluster  # noqa: E402

from formicar import _formicar  # noqa: E402
from formicar import ray as on_ray  # noqa: E402

pytestmark = [
    pytest.mark.ray,
    pytest.mark.filterwarnings("ignore::ResourceWarning"),
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),
    pytest.mark.filterwarnings("ignore::FutureWarning"),
    pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"),
]

CAMPAIGN = """
name = "two hundred"
seeds = 50

[[scenarios]]
builtin = ["narrow-aisle"]
ids = ["next-aisle"]

[[scenarios]]
builtin = ["lei-map1"]

[[planner]]
planner = "hybrid-astar"

[[planner]]
planner = "astar"
"""

# Columns that a repetition on another machine may change.
MEASURED = {
    "map_setup_s", "first_feasible_s", "query_s", "cpu_s", "peak_rss_bytes", "cold_first_s",
    "map_setup_cpu_s", "first_feasible_cpu_s", "cold_first_cpu_s", "query_cpu_s",
    "judge_s", "total_s", "machine", "build", "source",
    # The best path by then depends on the time.
    "length_0.1s_m", "min_clearance_0.1s_m", "n_cusps_0.1s",
    "length_1s_m", "min_clearance_1s_m", "n_cusps_1s",
}  # fmt: skip


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    """A head without processors and one node; nodes may be added."""
    # A dead node is noticed within seconds rather than half a minute.
    watch = {"health_check_period_ms": 500, "health_check_failure_threshold": 4}
    head = {"num_cpus": 0, "include_dashboard": False, "_system_config": watch}
    made = Cluster(initialize_head=True, head_node_args=head)
    made.add_node(num_cpus=1)
    ray.init(address=made.address, log_to_driver=False)
    made.wait_for_nodes()
    yield made
    ray.shutdown()
    made.shutdown()  # type: ignore[no-untyped-call]


def campaign(folder: Path, text: str = CAMPAIGN) -> Path:
    file = folder / "campaign.toml"
    file.write_text(text)
    return file


def results(file: Path) -> list[tuple[tuple[str, str], ...]]:
    """Return the rows of a table without what was measured, sorted."""
    with file.open() as rows:
        kept = (
            tuple((key, value) for key, value in row.items() if key not in MEASURED)
            for row in csv.DictReader(rows)
        )
        return sorted(kept)


def test_a_node_that_is_killed_loses_and_repeats_no_run(
    cluster: Any, program: Path, tmp_path: Path
) -> None:
    file = campaign(tmp_path)
    doomed = cluster.add_node(num_cpus=1)
    cluster.wait_for_nodes()
    store = tmp_path / "cluster.sqlite"
    done = threading.Event()
    killed_at: list[int] = []

    def kill_one_node() -> None:
        # In the middle: the store has taken some runs, and most are missing.
        while not done.is_set() and n_rows(store) < 40:
            time.sleep(0.05)
        killed_at.append(n_rows(store))
        cluster.remove_node(doomed, allow_graceful=False)

    def n_rows(store: Path) -> int:
        import sqlite3

        if not store.exists():
            return 0
        connection = sqlite3.connect(f"file:{store}?mode=ro", uri=True)
        try:
            return int(connection.execute("SELECT count(*) FROM run").fetchone()[0])
        except sqlite3.OperationalError:
            return 0
        finally:
            connection.close()

    killer = threading.Thread(target=kill_one_node)
    killer.start()
    try:
        ended = on_ray.bench(file, store, progress=False)
    finally:
        done.set()
        killer.join()
    assert (ended.n_runs, ended.n_done) == (200, 200)
    assert n_rows(store) == 200 and 40 <= killed_at[0] < 200
    assert "50 of 50 found" in ended.summary

    local = tmp_path / "local.sqlite"
    words = [str(program), "bench", str(file), "--store", str(local), "--jobs", "2"]
    subprocess.run(words, check=True, capture_output=True)
    assert results(ended.csv) == results(local.with_suffix(".csv"))
    compared = subprocess.run(
        [str(program), "compare", str(local), str(store), "--results-only"],
        check=True, capture_output=True, text=True,
    ).stdout  # fmt: skip
    assert "worse" not in compared.split("## ", 1)[1].replace("better or worse", "")

    # Nothing is left to do, also not in the store that `formicar bench` has filled.
    for filled in (store, local):
        again = on_ray.bench(file, filled, progress=False)
        assert (again.n_done, again.n_runs) == (0, 200)


def test_a_store_is_gone_on_with_where_it_was_stopped(
    cluster: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = campaign(tmp_path, CAMPAIGN.replace("seeds = 50", "seeds = 4"))
    store = tmp_path / "runs.sqlite"
    add = _formicar.CampaignStore
    n_taken = [0]

    class Stops:
        """A store after whose fifth run the driver dies."""

        def __init__(self, *words: str) -> None:
            self.store = add(*words)

        def __getattr__(self, name: str) -> Any:
            return getattr(self.store, name)

        def add(self, *words: Any) -> None:
            if n_taken[0] == 5:
                raise KeyboardInterrupt
            self.store.add(*words)
            n_taken[0] += 1

    with monkeypatch.context() as patch:
        patch.setattr(_formicar, "CampaignStore", Stops)
        with pytest.raises(KeyboardInterrupt):
            on_ray.bench(file, store, progress=False, in_flight=2)
    rest = on_ray.bench(file, store, progress=False)
    assert rest.n_done == rest.n_runs - 5


def test_a_run_that_crashes_is_a_result(
    cluster: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = campaign(tmp_path, CAMPAIGN.replace("seeds = 50", "seeds = 1"))
    made = _formicar.CampaignStore

    class Torn:
        """A store that hands out a parcel that no process understands."""

        def __init__(self, *words: str) -> None:
            self.store = made(*words)

        def __getattr__(self, name: str) -> Any:
            return getattr(self.store, name)

        def parcel(self, index: int) -> tuple[str, str]:
            text, key = self.store.parcel(index)
            return (text if index else "{", key)

    monkeypatch.setattr(_formicar, "CampaignStore", Torn)
    ended = on_ray.bench(file, tmp_path / "runs.sqlite", progress=False)
    with ended.csv.open() as rows:
        statuses = [(row["status"], row["reason"]) for row in csv.DictReader(rows)]
    assert [status for status, _ in statuses].count("crashed") == 1
    assert "the run" in statuses[0][1]


def test_maps_travel_once_to_a_node_and_are_removed(
    cluster: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = Path(tempfile.gettempdir()) / f"formicar-{ray.get_runtime_context().get_job_id()}"
    seen: dict[str, list[str]] = {}
    tidy = on_ray._Work.tidy

    def look(work: Any) -> None:
        for place in folder.iterdir():
            seen[place.name] = sorted(file.name for file in place.iterdir())
        assert sorted(work.maps) == seen[alive]
        tidy(work)

    (alive,) = (
        node["NodeID"] for node in ray.nodes() if node["Alive"] and node["Resources"].get("CPU")
    )
    monkeypatch.setattr(on_ray._Work, "tidy", look)
    file = campaign(tmp_path, CAMPAIGN.replace("seeds = 50", "seeds = 2"))
    on_ray.bench(file, tmp_path / "runs.sqlite", progress=False)
    assert len(seen[alive]) == 2, "one file for each map, however many runs"
    assert not (folder / alive).exists()


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("seeds = 'many'", r"campaign\.toml"),
        (CAMPAIGN.replace("hybrid-astar", "hybrid"), "hybrid-astar"),
        (CAMPAIGN + '\n[[planner]]\nname = "other"\ncommand = ["true"]\n', "program"),
    ],
)
def test_a_campaign_with_a_mistake_is_refused_before_anything_is_run(
    cluster: Any, tmp_path: Path, text: str, told: str
) -> None:
    with pytest.raises(ValueError, match=told):
        on_ray.bench(campaign(tmp_path, text), tmp_path / "runs.sqlite")
    with pytest.raises(ValueError, match="in_flight = 0"):
        on_ray.bench(campaign(tmp_path), tmp_path / "runs.sqlite", in_flight=0)


def test_workers_of_another_version_are_refused(
    cluster: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(_formicar, "__version__", "9.9.9")
    with pytest.raises(RuntimeError, match=r"the driver 9\.9\.9"):
        on_ray.bench(campaign(tmp_path), tmp_path / "runs.sqlite", progress=False)


def cost(values: dict[str, Any]) -> float:
    return float((values["x"] - 1) ** 2 + values["n"])


def test_tuning_on_a_cluster_is_tuning_on_one_machine(cluster: Any) -> None:
    space = {"x": (-5.0, 5.0), "n": (0, 9)}
    here = formicar.tune(cost, space, seed=2, max_evaluations=60)
    # Workers do not have this file.
    there = on_ray.tune(lambda v: (v["x"] - 1) ** 2 + v["n"], space, seed=2, max_evaluations=60)
    assert there.best == here.best and (there.history == here.history).all()


def test_the_command_says_what_it_does(cluster: Any, tmp_path: Path) -> None:
    file = campaign(tmp_path, CAMPAIGN.replace("seeds = 50", "seeds = 1"))
    words = [sys.executable, "-m", "formicar.ray", "bench", str(file), "--address", cluster.address]
    ran = subprocess.run(
        [*words, "--store", str(tmp_path / "runs.sqlite")], capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert ran.returncode == 0, ran.stderr
    assert ran.stdout.splitlines()[-1].startswith("4 runs: see ")
    (tmp_path / "runs.csv").unlink()
    wrong = subprocess.run(
        [*words, "--store", str(tmp_path / "runs.csv")], capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert wrong.returncode == 2 and wrong.stderr.splitlines()[-1].startswith("error: ")
