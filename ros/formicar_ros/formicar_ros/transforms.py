"""A small buffer of transforms: chains on the ground, interpolated in time."""

from __future__ import annotations

import bisect
import threading
from collections.abc import Iterator
from dataclasses import dataclass, field

from .poses import Pose, compose, inverse, turn_between

# How much of the past is kept of a moving frame, seconds.
KEPT_S = 10.0
# No chain has more links; a longer one goes round in a circle.
MAX_LINKS = 64


class NoTransform(LookupError):
    """Two frames that are not connected, or not at the time asked for."""


@dataclass
class _Link:
    """The way from a frame to its parent over time; a static one has a single entry."""

    parent: str
    is_static: bool
    times: list[float] = field(default_factory=list)
    poses: list[Pose] = field(default_factory=list)

    def add(self, time_s: float, pose: Pose) -> None:
        if self.is_static:
            self.times, self.poses = [time_s], [pose]
            return
        if self.times and time_s < self.times[-1] - KEPT_S:
            # The clock has been set back, as at the start of a replayed bag.
            self.times, self.poses = [], []
        at = bisect.bisect_left(self.times, time_s)
        if at < len(self.times) and self.times[at] == time_s:
            self.poses[at] = pose
            return
        self.times.insert(at, time_s)
        self.poses.insert(at, pose)
        n_old = bisect.bisect_left(self.times, self.times[-1] - KEPT_S)
        del self.times[:n_old], self.poses[:n_old]

    def at(self, time_s: float) -> Pose:
        if self.is_static:
            return self.poses[0]
        after = bisect.bisect_left(self.times, time_s)
        if after < len(self.times) and self.times[after] == time_s:
            return self.poses[after]
        if not 0 < after < len(self.times):
            raise NoTransform(
                f"known from {self.times[0]:.3f} to {self.times[-1]:.3f} s, not at {time_s:.3f} s"
            )
        begin, end = self.times[after - 1], self.times[after]
        return _between(self.poses[after - 1], self.poses[after], (time_s - begin) / (end - begin))


class Transforms:
    """Transforms as they come; any thread may add and look up."""

    def __init__(self) -> None:
        self._links: dict[str, _Link] = {}
        self._lock = threading.Lock()

    def add(self, parent: str, child: str, time_s: float, pose: Pose, *, is_static: bool) -> None:
        """Add the pose of a child frame in its parent.

        A frame that gets another parent forgets the former one.
        """
        parent, child = parent.lstrip("/"), child.lstrip("/")
        with self._lock:
            link = self._links.get(child)
            if link is None or link.parent != parent or link.is_static != is_static:
                link = self._links[child] = _Link(parent, is_static)
            link.add(time_s, pose)

    def clear(self) -> None:
        """Forget everything."""
        with self._lock:
            self._links.clear()

    def look_up(
        self, target: str, source: str, time_s: float | None = None
    ) -> tuple[Pose, float | None]:
        """Return the pose of the source frame in the target frame, and its time.

        Parameters
        ----------
        target, source : str
            Frames.
        time_s : float, optional
            The time asked for; by default the latest at which the whole chain is known.

        Returns
        -------
        pose : Pose
            ``(x, y, yaw)``.
        time_s : float or None
            The time of the pose; ``None`` if all of the chain is static.

        Raises
        ------
        NoTransform
            Frames that are not connected, or not at that time.
        """
        target, source = target.lstrip("/"), source.lstrip("/")
        with self._lock:
            up, down = self._chains(target, source)
            moving = [link for _, link in up + down if not link.is_static]
            if moving and time_s is None:
                time_s = min(link.times[-1] for link in moving)
            elif not moving:
                time_s = None
            return self._composed(up, down, time_s), time_s

    def _chains(
        self, target: str, source: str
    ) -> tuple[list[tuple[str, _Link]], list[tuple[str, _Link]]]:
        """Return the links from the source and from the target to their common ancestor."""
        from_source, from_target = list(self._ancestors(source)), list(self._ancestors(target))
        above = [source, *(link.parent for _, link in from_source)]
        for n_down, frame in enumerate([target, *(link.parent for _, link in from_target)]):
            if frame in above:
                return from_source[: above.index(frame)], from_target[:n_down]
        known = ", ".join(sorted({*self._links, *(link.parent for link in self._links.values())}))
        raise NoTransform(
            f"no chain of transforms from {target!r} to {source!r}; known frames: {known or 'none'}"
        )

    def _ancestors(self, frame: str) -> Iterator[tuple[str, _Link]]:
        for _ in range(MAX_LINKS):
            link = self._links.get(frame)
            if link is None:
                return
            yield frame, link
            frame = link.parent

    @staticmethod
    def _composed(
        up: list[tuple[str, _Link]], down: list[tuple[str, _Link]], time_s: float | None
    ) -> Pose:
        pose: Pose = (0.0, 0.0, 0.0)
        base: Pose = (0.0, 0.0, 0.0)
        for frame, link in up:
            pose = compose(_at(frame, link, time_s), pose)
        for frame, link in down:
            base = compose(_at(frame, link, time_s), base)
        return compose(inverse(base), pose)


def _at(frame: str, link: _Link, time_s: float | None) -> Pose:
    try:
        return link.at(0.0 if time_s is None else time_s)
    except NoTransform as error:
        raise NoTransform(f"transform from {link.parent!r} to {frame!r}: {error}") from None


def _between(start: Pose, end: Pose, share: float) -> Pose:
    return (
        start[0] + share * (end[0] - start[0]),
        start[1] + share * (end[1] - start[1]),
        start[2] + share * turn_between(start[2], end[2]),
    )
