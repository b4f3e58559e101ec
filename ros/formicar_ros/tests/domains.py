"""ROS domains that no other test on this machine uses at the same time."""

from __future__ import annotations

import fcntl
import itertools
import os
import tempfile
from pathlib import Path
from typing import IO

_next = itertools.count(os.getpid())
_held: dict[int, IO[bytes]] = {}


def claim() -> int:
    """Return a domain of one's own, until `release` or the end of the process."""
    for _ in range(100):
        domain = 1 + next(_next) % 100
        file = (Path(tempfile.gettempdir()) / f"formicar_ros_domain_{domain}.lock").open("wb")
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            file.close()
            continue
        _held[domain] = file
        return domain
    raise RuntimeError("all ROS domains from 1 to 100 are in use")


def release(domain: int) -> None:
    """Leave a domain to others."""
    _held.pop(domain).close()
