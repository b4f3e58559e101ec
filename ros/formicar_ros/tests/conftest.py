"""A server in a process of its own, and a peer of it, each test in a domain of its own."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from . import domains
from .peer import Peer


class Server:
    """The node as a robot starts it."""

    def __init__(self, domain: int, log: Path, parameters: dict[str, Any]) -> None:
        given = [part for item in parameters.items() for part in ("-p", "{}:={}".format(*item))]
        self.log = log
        with log.open("ab") as file:
            self.process = subprocess.Popen(
                [sys.executable, "-m", "formicar_ros.planner_server", "--ros-args", *given],
                env={**os.environ, "ROS_DOMAIN_ID": str(domain), "PYTHONFAULTHANDLER": "1"},
                stdout=file,
                stderr=subprocess.STDOUT,
            )

    @property
    def is_alive(self) -> bool:
        return self.process.poll() is None

    def said(self, words: str) -> bool:
        return words in self.log.read_text()

    def end(self) -> int:
        if self.is_alive:
            self.process.send_signal(signal.SIGINT)
        try:
            return self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise


class World:
    """A domain with a peer and, once started, servers."""

    def __init__(self, directory: Path) -> None:
        self.domain = domains.claim()
        self.directory = directory
        self.peer = Peer(self.domain)
        self.servers: list[Server] = []

    def start(self, **parameters: Any) -> Server:
        """Start a server: active at once, for the vehicle of the tests, unless told otherwise."""
        given = {"autostart": "true", "vehicle.preset": "warehouse_amr"}
        given |= {name.replace("__", "."): value for name, value in parameters.items()}
        given = {name: value for name, value in given.items() if value is not None}
        server = Server(self.domain, self.directory / "server.log", given)
        self.servers.append(server)
        return server

    def close(self) -> None:
        codes = [server.end() for server in self.servers if server.is_alive]
        self.peer.close()
        domains.release(self.domain)
        logs = "\n".join(server.log.read_text() for server in self.servers)
        assert all(code == 0 for code in codes), f"servers ended with {codes}:\n{logs}"


@pytest.fixture
def world(tmp_path: Path) -> Iterator[World]:
    world = World(tmp_path)
    yield world
    world.close()


@pytest.fixture(scope="module")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Iterator[World]:
    """A server with the hall as its map, for tests that change nothing."""
    world = World(tmp_path_factory.mktemp("shared"))
    world.start()
    world.peer.send_map(hall())
    yield world
    world.close()


def hall() -> np.ndarray:
    """A hall of 12 x 8 m with a wall from the south that ends before the north."""
    cells = np.zeros((80, 120), dtype=np.int8)
    cells[:50, 60] = 100
    return cells


Start = Callable[..., Server]
