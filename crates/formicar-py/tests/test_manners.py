"""Manners: threads, cancellation, Ctrl-C, copies, imports."""

from __future__ import annotations

import copy
import pickle
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

import formicar
from formicar import OccupancyGrid, Plan, Planner

START, GOAL = (2.0, 2.0, 0.0), (10.0, 2.0, 0.0)

# A query that takes minutes.
LONG = {"colony.n_ants": 200, "colony.n_iterations": 100_000}


def long_planner() -> Planner:
    return Planner("lei-map3", planner="lei2020", config=LONG)


def test_the_import_does_not_load_what_is_not_used() -> None:
    code = "import sys, formicar; print([m for m in sys.modules if m in sys.argv[1].split()])"
    heavy = "numpy matplotlib pandas polars ray tqdm"
    ran = subprocess.run(
        [sys.executable, "-c", code, heavy], capture_output=True, text=True, check=True
    )
    assert ran.stdout.strip() == "[]"


def test_the_version_is_that_of_the_package() -> None:
    from importlib.metadata import version

    assert formicar.__version__ == version("formicar")


def test_everything_public_is_exported_and_documented() -> None:
    for name in formicar.__all__:
        item = getattr(formicar, name)
        assert name.startswith("__") or item.__doc__, name


def test_a_plan_survives_pickling_bit_for_bit(plan: Plan, colony: Plan) -> None:
    for one in (plan, colony):
        other = pickle.loads(pickle.dumps(one))
        assert other == one and hash(other) == hash(one) and repr(other) == repr(one)
        assert (other.poses == one.poses).all() and (other.segments == one.segments).all()
        assert other.certificate == one.certificate and other.metrics == one.metrics
        assert other.timing == one.timing and other.map == one.map
        assert other.vehicle == one.vehicle and other.to_json() == one.to_json()
        assert (other.cells == one.cells).all() and (other.nodes == one.nodes).all()
        assert pickle.loads(pickle.dumps(other)) == one
        assert formicar.check(other) and other.to_svg().startswith("<svg")
        assert copy.copy(one) == one and copy.deepcopy(one) == one
    again = pickle.loads(pickle.dumps(colony))
    assert again.ants == []
    np.testing.assert_array_equal(again.pheromone, colony.pheromone)


def test_a_plan_without_a_path_survives_pickling(planner: Planner) -> None:
    cut = planner.plan(START, GOAL, budget=3)
    other = pickle.loads(pickle.dumps(cut))
    assert other == cut and not other and other.reason == cut.reason
    assert other.explanation == cut.explanation and other.to_svg().startswith("<svg")
    error = pickle.loads(pickle.dumps(formicar.NoPath(cut)))
    assert error.plan == cut


def test_exceptions_survive_pickling(planner: Planner) -> None:
    with pytest.raises(formicar.InvalidRequest) as raised:
        planner.plan(START, (99.0, 2.0, 0.0))
    other = pickle.loads(pickle.dumps(raised.value))
    assert type(other) is formicar.InvalidRequest and str(other) == str(raised.value)


def test_plans_differ_where_anything_but_times_does(planner: Planner, plan: Plan) -> None:
    assert plan != planner.plan(START, (10.0, 2.1, 0.0), seed=7)
    assert plan != planner.plan(START, GOAL, seed=7, budget=10)
    assert (plan == 3) is False


def _plan_elsewhere(planner: Planner) -> Plan:
    return planner.plan(START, GOAL, seed=7)


def test_a_plan_from_another_process_is_equal(planner: Planner, plan: Plan) -> None:
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        assert pool.submit(_plan_elsewhere, planner).result() == plan


def test_copies_of_a_planner_plan_alike(planner: Planner, plan: Plan) -> None:
    changed = copy.deepcopy(planner)
    changed.update_map(np.ones((8, 2), dtype=bool), col=60, row=50)
    assert planner.plan(START, GOAL, seed=7) == plan
    for other in (pickle.loads(pickle.dumps(changed)), copy.copy(changed)):
        assert other.map == changed.map and other.config == changed.config
        assert other.plan(START, GOAL, seed=7) == changed.plan(START, GOAL, seed=7)


def test_threads_may_share_a_planner(planner: Planner, plan: Plan) -> None:
    with ThreadPoolExecutor(4) as pool:
        plans = list(pool.map(lambda seed: planner.plan(START, GOAL, seed=seed), [7, 8, 7, 9]))
    assert plans[0] == plan and plans[2] == plan
    assert plans[1] == planner.plan(START, GOAL, seed=8)


def test_other_threads_run_while_a_query_does() -> None:
    counts = [0]
    planner = long_planner()
    is_over = threading.Event()

    def count() -> None:
        while not is_over.is_set():
            counts[0] += 1
            if counts[0] > 2000:
                planner.cancel()

    thread = threading.Thread(target=count)
    ends = next(iter(planner.map.requests.values()))
    thread.start()
    plan = planner.plan(*ends)
    is_over.set()
    thread.join()
    assert counts[0] > 2000
    assert plan.status == "cancelled" or plan.history.iterations.size


def test_a_query_is_cancelled_from_another_thread(planner: Planner) -> None:
    planner.cancel()  # Nothing is under way.
    assert planner.plan(START, GOAL)
    slow = long_planner()
    ends = next(iter(slow.map.requests.values()))
    began = threading.Event()

    def end() -> None:
        began.wait()
        slow.cancel()

    thread = threading.Thread(target=end)
    thread.start()
    plan = slow.plan(*ends, on_progress=lambda event: began.set())
    thread.join()
    stop = plan.to_dict()["colony"]["stop"]
    assert stop == "cancelled" and len(plan.history.iterations) < 100_000
    # The next query is not.
    assert slow.plan(*ends, budget=20_000).status != "cancelled"


def test_queries_that_wait_are_cancelled_too() -> None:
    slow = long_planner()
    ends = next(iter(slow.map.requests.values()))
    began = threading.Event()
    with ThreadPoolExecutor(2) as pool:
        first = pool.submit(slow.plan, *ends, on_progress=lambda event: began.set())
        began.wait()
        second = pool.submit(slow.plan, *ends)
        while not second.running():
            time.sleep(0.001)
        while not (first.done() and second.done()):
            slow.cancel()
            time.sleep(0.001)
    for plan in (first.result(), second.result()):
        assert not plan or plan.to_dict()["colony"]["stop"] == "cancelled"


def test_a_nested_query_of_the_same_planner_is_refused(planner: Planner) -> None:
    with pytest.raises(RuntimeError, match="planner of its own"):
        planner.plan(START, GOAL, on_progress=lambda event: planner.plan(START, GOAL))
    other = copy.copy(planner)
    found: list[Plan] = []
    planner.plan(START, GOAL, on_progress=lambda event: found.append(other.plan(START, GOAL)))
    assert found and all(found)


INTERRUPTED = """
import formicar, signal, sys, threading
planner = formicar.Planner("lei-map3", planner="lei2020", config={config})
ends = next(iter(planner.map.requests.values()))
def began(event):
    if not told:
        told.append(print("began", flush=True))
told = []
try:
    planner.plan(*ends, on_progress=began)
    print("ended")
except KeyboardInterrupt:
    print("interrupted", bool(planner.plan(*ends, budget=1000) or True))
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_ctrl_c_ends_a_query() -> None:
    code = INTERRUPTED.format(config=LONG)
    child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert child.stdout is not None
    assert child.stdout.readline() == "began\n"
    child.send_signal(signal.SIGINT)
    out, _ = child.communicate(timeout=60)
    assert (out, child.returncode) == ("interrupted True\n", 0)


def test_a_map_that_changes_while_it_is_planned_on_is_a_copy() -> None:
    walls = np.zeros((80, 120), dtype=bool)
    planner = Planner(OccupancyGrid(walls, 0.1), "warehouse_amr")

    def scribble(event: object) -> None:
        walls[:] = True

    plan = planner.plan(START, GOAL, on_progress=scribble)
    assert plan and plan == Planner(
        OccupancyGrid(np.zeros((80, 120), dtype=bool), 0.1), "warehouse_amr"
    ).plan(START, GOAL)
