"""Campaigns and tuning on many machines, with Ray.

``pip install "formicar[ray]"`` on every machine of the cluster, the same version everywhere.

::

    python -m formicar.ray bench campaign.toml --store runs.sqlite --address auto

The runs of a campaign are Ray tasks; each is carried out in a process of its own on a worker, as
``formicar bench`` does on one machine. Results go into the store that ``formicar bench`` fills too,
one transaction a run, from this process alone. A run is counted once, whatever dies meanwhile: the
store knows the runs that it has, so that the same command goes on where it was stopped, and a run
whose worker or node dies is given to another one.

Maps and vehicles travel once to each node, by the hash of their contents. At most so many tasks are
in flight, so that the results of a million runs are never in memory together.
"""

from __future__ import annotations

import logging
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Generator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _formicar
from ._tune import Tuning, _dimension, search

if TYPE_CHECKING:
    from collections import deque

__all__ = ["Bench", "bench", "tune"]

# Times that a run is given to another worker after one has died under it.
_MAX_DEATHS = 20
# Tasks in flight for each processor of the cluster, where nothing else is asked for.
_TASKS_PER_CPU = 3
# Seconds between two looks at the size of the cluster.
_LOOK_EVERY_S = 5.0

_CHILD = """
import importlib.util, sys
spec = importlib.util.spec_from_file_location("formicar._formicar", sys.argv[1])
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
module.carry_out_parcel(sys.argv[2])
"""


class Bench(NamedTuple):
    """What `bench` has done.

    Attributes
    ----------
    n_runs : int
        Runs of the campaign.
    n_done : int
        Those carried out by this call; the others were in the store before.
    store, csv : pathlib.Path
        The store, and its rows as a table.
    summary : str
        A line for each scenario file and planner.
    n_retried : int
        Runs that were given to another worker, since one had died.
    """

    n_runs: int
    n_done: int
    store: Path
    csv: Path
    summary: str
    n_retried: int


def bench(
    campaign: str | os.PathLike[str],
    store: str | os.PathLike[str],
    address: str | None = None,
    *,
    in_flight: int | None = None,
    progress: bool = True,
) -> Bench:
    """Carry out what is missing of a campaign on a Ray cluster.

    Parameters
    ----------
    campaign : path
        The campaign file, as ``formicar bench`` reads it; the files that it names are needed on
        this machine alone.
    store : path
        The SQLite file for the results: a new one, or one of the same campaign, also one that
        ``formicar bench`` has begun. A ``.csv`` of the same name takes the rows in the end.
    address : str, optional
        The cluster: ``"auto"``, ``"host:port"`` or ``"ray://..."``. Without one, Ray's own choice:
        ``$RAY_ADDRESS``, or a new cluster on this machine. Where Ray is connected already, that
        connection is used.
    in_flight : int, optional
        Most tasks that are waiting or running at once; 3 for each processor of the cluster by
        default.
    progress : bool, optional
        Show a tqdm bar where it is installed and stderr is a terminal.

    Returns
    -------
    Bench
        Counts and files.

    Raises
    ------
    ValueError
        A campaign file or a store with a mistake, in the words of ``formicar bench``; a campaign
        with a planner that is a program.
    RuntimeError
        A worker with another version of formicar, or a run whose workers died again and again.
    """
    ray = _ray()
    if in_flight is not None and in_flight < 1:
        raise ValueError(f"in_flight = {in_flight}; it must be at least 1")
    sink = _formicar.CampaignStore(os.fspath(campaign), os.fspath(store))
    try:
        with _connected(ray, address):
            work = _Work(ray, sink, in_flight)
            shown = _bar(len(work.waiting), progress)
            try:
                work.carry_out(shown)
            finally:
                if shown is not None:
                    shown.close()
                work.tidy()
        summary = sink.finish()
    finally:
        sink.close()
    return Bench(sink.n_runs, work.n_done, Path(store), sink.csv, summary, work.n_retried)


class _Work:
    """The runs of a campaign under way."""

    def __init__(self, ray: Any, sink: _formicar.CampaignStore, in_flight: int | None) -> None:
        from collections import deque

        self.ray = ray
        self.sink = sink
        self.in_flight = in_flight
        self.waiting: deque[int] = deque(sink.missing())
        self.deaths: dict[int, int] = {}
        self.n_done = 0
        self.n_retried = 0
        self.task = ray.remote(num_cpus=1, max_retries=0)(_run)
        # The maps in the object store, by the hash of their contents.
        self.maps: dict[str, Any] = {}
        self.folder = f"formicar-{ray.get_runtime_context().get_job_id()}"
        self.limit = 0
        self.looked_at = 0.0

    def carry_out(self, shown: Any) -> None:
        """Give out runs and take their results until none is missing."""
        under_way: dict[Any, int] = {}
        if self.waiting:
            self.sink.note_runs_at_once(max(1, self._limit() // _TASKS_PER_CPU))
        while self.waiting or under_way:
            while self.waiting and len(under_way) < self._limit():
                index = self.waiting.popleft()
                under_way[self._send(index)] = index
            # Whatever is ready is taken at once; its place is free for the next.
            ready, _ = self.ray.wait(list(under_way), num_returns=1, timeout=_LOOK_EVERY_S)
            for ref in ready:
                index = under_way.pop(ref)
                if self._take(ref, index) and shown is not None:
                    shown.update(1)

    def _limit(self) -> int:
        """Return how many tasks may be in flight: nodes come and go."""
        if self.in_flight is not None:
            return self.in_flight
        if self.limit == 0 or time.monotonic() - self.looked_at > _LOOK_EVERY_S:
            n_cpus = self.ray.cluster_resources().get("CPU", 1)
            self.limit = max(1, int(n_cpus)) * _TASKS_PER_CPU
            self.looked_at = time.monotonic()
        return self.limit

    def _send(self, index: int) -> Any:
        parcel, key = self.sink.parcel(index)
        if key not in self.maps:
            self.maps[key] = self.ray.put(self.sink.map_bytes(index))
        # In a list the reference travels, and a node that has the map does not fetch it again.
        return self.task.remote(parcel, key, [self.maps[key]], self.folder, _formicar.__version__)

    def _take(self, ref: Any, index: int) -> bool:
        """Store a result, or give its run to another worker where one has died."""
        errors = self.ray.exceptions
        deaths = (
            errors.WorkerCrashedError,
            errors.NodeDiedError,
            errors.LocalRayletDiedError,
            errors.ObjectLostError,
            errors.OutOfMemoryError,
            errors.TaskCancelledError,
        )
        try:
            run, reason, machine, build = self.ray.get(ref)
        except deaths as error:
            self._mourn(index, error)
            return False
        except errors.RayTaskError as error:
            cause = error.cause
            if isinstance(cause, deaths):
                self._mourn(index, cause)
                return False
            raise RuntimeError(str(cause)) from error
        if run is None:
            self.sink.add_crashed(index, reason, machine, build)
        else:
            self.sink.add(index, run, machine, build)
        self.n_done += 1
        return True

    def _mourn(self, index: int, error: Exception) -> None:
        self.deaths[index] = self.deaths.get(index, 0) + 1
        self.n_retried += 1
        if self.deaths[index] > _MAX_DEATHS:
            raise RuntimeError(
                f"run {index} of the campaign: {_MAX_DEATHS} workers died under it, the last by "
                f"{type(error).__name__}; hint: the memory of the nodes"
            ) from error
        self.waiting.append(index)

    def tidy(self) -> None:
        """Remove the maps from the nodes, as far as these live."""
        from ray.util.scheduling_strategies import NodeAffinitySchedulingStrategy

        remove = self.ray.remote(num_cpus=0, max_retries=0)(_tidy)
        refs = []
        try:
            for node in self.ray.nodes():
                if node["Alive"]:
                    strategy = NodeAffinitySchedulingStrategy(node["NodeID"], soft=False)
                    task = remote_on(remove, strategy)
                    refs.append(task.remote(self.folder))
            self.ray.wait(refs, num_returns=len(refs), timeout=_LOOK_EVERY_S) if refs else None
        except self.ray.exceptions.RayError:
            # What is left lies in the folder for temporary files.
            pass


def remote_on(task: Any, strategy: Any) -> Any:
    """Return a task for one node."""
    return task.options(scheduling_strategy=strategy)


def _run(
    parcel: str, key: str, maps: list[Any], folder: str, version: str
) -> tuple[str | None, str, str, str]:
    """Carry out a run on a worker: the run or why its process crashed, machine and build."""
    if _formicar.__version__ != version:
        raise RuntimeError(
            f"a worker has formicar {_formicar.__version__}, the driver {version}; hint: install "
            "the same version on every machine of the cluster"
        )
    file = _map_file(key, maps, folder)
    machine, build = _formicar.machine()
    child = subprocess.run(
        [sys.executable, "-I", "-S", "-c", _CHILD, _formicar.__file__, str(file)],
        input=parcel.encode(),
        capture_output=True,
        check=False,
    )
    if child.returncode == 0:
        return child.stdout.decode(), "", machine, build
    lines = [line.strip() for line in child.stderr.decode(errors="replace").splitlines()]
    told = " ".join([line for line in lines if line][-3:])
    status = f"exit status: {child.returncode}"
    if child.returncode < 0:
        status = f"signal: {-child.returncode}"
    return None, f"{status}: {told}".rstrip(": "), machine, build


def _map_file(key: str, maps: list[Any], folder: str) -> Path:
    """Return the file of a map on this node, fetched where it is not there yet."""
    import ray

    place = _place(folder)
    file = place / key
    if not file.exists():
        place.mkdir(parents=True, exist_ok=True)
        # Another worker of this node may write the same bytes: whoever is last replaces them.
        handle, name = tempfile.mkstemp(dir=place)
        with os.fdopen(handle, "wb") as written:
            written.write(ray.get(maps[0]))
        os.replace(name, file)
    return file


def _place(folder: str) -> Path:
    import ray

    node = ray.get_runtime_context().get_node_id()
    return Path(tempfile.gettempdir()) / folder / node


def _tidy(folder: str) -> None:
    import shutil

    place = _place(folder)
    shutil.rmtree(place, ignore_errors=True)
    try:
        place.parent.rmdir()
    except OSError:
        # Another node of this machine still has maps there, or nobody ever had.
        pass


def tune(
    objective: Callable[[dict[str, Any]], float],
    space: Mapping[str, Any],
    address: str | None = None,
    *,
    seed: int = 0,
    max_evaluations: int = 500,
    n_sources: int = 10,
    limit: int | None = None,
    variant: str = "variable-strategy",
    known: Sequence[Mapping[str, Any]] = (),
    progress: bool = False,
) -> Tuning:
    """Look for the parameters of least cost as `formicar.tune` does, evaluated on a Ray cluster.

    The same space, settings and seed give the same result as on one machine. The parameters are
    those of `formicar.tune`; `address` is that of `bench`.

    Returns
    -------
    formicar.Tuning
        The best values.
    """
    ray = _ray()
    dimensions = {name: _dimension(name, values) for name, values in space.items()}
    settings = {
        "max_evaluations": max_evaluations,
        "n_sources": n_sources,
        "limit": limit,
        "variant": variant,
    }
    with _connected(ray, address):
        task = ray.remote(num_cpus=1)(_cost)
        shared = ray.put(objective)

        def evaluate(candidates: list[dict[str, Any]]) -> list[float]:
            costs = ray.get([task.remote(shared, values) for values in candidates])
            return [float(cost) for cost in costs]

        return search(evaluate, dimensions, seed, settings, known, progress)


def _cost(objective: Callable[[dict[str, Any]], float], values: dict[str, Any]) -> float:
    return objective(values)


def _ray() -> Any:
    try:
        import ray
    except ImportError:
        raise ImportError("a cluster needs Ray; hint: pip install 'formicar[ray]'") from None
    return ray


@contextmanager
def _connected(ray: Any, address: str | None) -> Generator[None, None, None]:
    """Connect with a cluster, unless a caller has done so, and leave it as it was."""
    if ray.is_initialized():
        yield
        return
    # Ray lowers the priority of its workers on a cluster that it starts here, and with it times.
    os.environ.setdefault("RAY_worker_niceness", "0")
    ray.init(address=address, log_to_driver=False, logging_level=logging.WARNING)
    try:
        yield
    finally:
        ray.shutdown()


def _bar(total: int, is_wanted: bool) -> Any:
    if not is_wanted or not sys.stderr.isatty():
        return None
    try:
        from ._progress import tqdm_of

        return tqdm_of(total, "runs")
    except ImportError:
        return None


def _main(words: Sequence[str] | None = None) -> int:
    from argparse import ArgumentParser

    parser = ArgumentParser(prog="python -m formicar.ray", description=(__doc__ or "")[:69])
    commands = parser.add_subparsers(dest="command", required=True)
    about = "carry out what is missing of a campaign on a Ray cluster"
    flags = commands.add_parser("bench", help=about, description=about)
    flags.add_argument(
        "campaign", metavar="F.toml", help="the campaign, as formicar bench reads it"
    )
    flags.add_argument(
        "--store", required=True, metavar="F.sqlite", help="the results; a .csv lies beside them"
    )
    flags.add_argument("--address", help="the cluster: auto, host:port or ray://...")
    flags.add_argument(
        "--in-flight", type=int, metavar="N", help="most tasks at once; 3 for each processor"
    )
    given = parser.parse_args(words)
    try:
        done = bench(given.campaign, given.store, given.address, in_flight=given.in_flight)
    except (ValueError, RuntimeError, ImportError, ConnectionError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    sys.stdout.write(done.summary)
    kept = done.n_runs - done.n_done
    before = f", {kept} kept from before" if kept else ""
    print(f"{done.n_done} runs{before}: see {done.store} and {done.csv}")
    return 0


if __name__ == "__main__":
    # Workers import the module by its name.
    from formicar.ray import _main as main

    sys.exit(main())
