"""Times of the package itself: import, the overhead of a call, and how soon a query ends.

python benches/manners.py
"""

from __future__ import annotations

import os
import signal
import statistics
import subprocess
import sys
import threading
import time
from typing import Any

import formicar

# A query of each planner that takes long enough to be ended.
LONG: dict[str, dict[str, Any]] = {
    "formicar": {"improve.max_tries": 1_000_000, "improve.polish_passes": 1000},
    "hybrid-astar": {"hybrid_astar.weight": 1.0},
    "lei2020": {"colony.n_ants": 2000, "colony.n_iterations": 2000},
    "faco2024": {},
    "ga": {},
}


def imported() -> float:
    """Return the median seconds that the import takes in a fresh interpreter."""
    code = "import time; t = time.perf_counter(); import formicar; print(time.perf_counter() - t)"
    runs = [
        float(subprocess.run([sys.executable, "-c", code], capture_output=True, check=True).stdout)
        for _ in range(9)
    ]
    return statistics.median(runs)


def overhead() -> tuple[float, float]:
    """Return the median seconds of a call beyond the planner's own time, and of the call.

    The vehicle stands at its goal, so that the planner itself has next to nothing to do.
    """
    planner = formicar.Planner("narrow-aisle")
    start, _ = next(iter(planner.map.requests.values()))
    calls, beyond = [], []
    for seed in range(3000):
        begun = time.perf_counter()
        plan = planner.plan(start, start, seed=seed % 4)
        taken = time.perf_counter() - begun
        calls.append(taken)
        beyond.append(taken - plan.timing.query_s)
    return statistics.median(beyond), statistics.median(calls)


def cancelled(name: str) -> tuple[float, float]:
    """Return the largest seconds from a cancel to the end of the query, waited and worked.

    The second is processor time of the planning thread, which other load does not lengthen.
    """
    planner = formicar.Planner("li-neighborhood", planner=name, config=LONG[name])
    ends = next(iter(planner.map.requests.values()))
    planner.plan(*ends, budget=1)
    work_clock = time.pthread_getcpuclockid(threading.get_ident())
    waited, worked = 0.0, 0.0
    for wait in (0.003, 0.01, 0.02, 0.04, 0.1):
        at = [0.0, 0.0]

        def end(wait: float = wait, at: list[float] = at) -> None:
            time.sleep(wait)
            at[:] = time.perf_counter(), time.clock_gettime(work_clock)
            planner.cancel()

        thread = threading.Thread(target=end)
        thread.start()
        plan = planner.plan(*ends)
        ended = time.perf_counter(), time.clock_gettime(work_clock)
        thread.join()
        if plan.status == "cancelled" or plan.cut_by == "cancelled":
            waited = max(waited, ended[0] - at[0])
            worked = max(worked, ended[1] - at[1])
    return waited, worked


def interrupted(name: str) -> float:
    """Return the largest seconds from Ctrl-C to the exception."""
    planner = formicar.Planner("li-neighborhood", planner=name, config=LONG[name])
    ends = next(iter(planner.map.requests.values()))
    planner.plan(*ends, budget=1)
    worst = 0.0
    for wait in (0.005, 0.02, 0.05, 0.1):
        at = [0.0]

        def end(wait: float = wait, at: list[float] = at) -> None:
            time.sleep(wait)
            at[0] = time.perf_counter()
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=end)
        thread.start()
        try:
            planner.plan(*ends)
            thread.join()
            time.sleep(0.01)
        except KeyboardInterrupt:
            worst = max(worst, time.perf_counter() - at[0])
        thread.join()
    return worst


def main() -> None:
    """Print all times."""
    beyond, call = overhead()
    print(f"import             {imported() * 1e3:8.1f} ms")
    print(f"call               {call * 1e6:8.1f} us, of which the package {beyond * 1e6:.1f}")
    for name in LONG:
        waited, worked = cancelled(name)
        print(f"cancel {name:12}{waited * 1e3:8.1f} ms, of work {worked * 1e3:.1f}")
        print(f"Ctrl-C {name:12}{interrupted(name) * 1e3:8.1f} ms")


if __name__ == "__main__":
    main()
