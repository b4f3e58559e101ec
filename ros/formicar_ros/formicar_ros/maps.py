"""The map as messages bring it: whole, or patch by patch."""

from __future__ import annotations

import threading
from typing import Any

import formicar
import numpy as np
from numpy.typing import NDArray

from .poses import pose_of

Rectangle = tuple[int, int, int, int]
Cells = NDArray[np.int8]


class Frame:
    """Size, resolution and place of a map, and the values of its cells as they change."""

    def __init__(
        self, data: Cells, resolution: float, origin: tuple[float, float, float], stamp_s: float
    ) -> None:
        self.data = data
        self.resolution = resolution
        self.origin = origin
        self.stamp_s = stamp_s

    def lies_as(self, other: Frame) -> bool:
        """Return True if both maps have their cells at the same places."""
        return (
            self.data.shape == other.data.shape
            and self.resolution == other.resolution
            and self.origin == other.origin
        )


class MapStore:
    """The latest map. The node writes, planners and the judge read, each on its own thread.

    Every change has a number. A planner that was made for an earlier number asks for the rectangle
    of cells that have changed since.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._frame: Frame | None = None
        self._changes: list[tuple[int, Rectangle]] = []
        self._number = 0
        self._whole = 0
        self._grids: dict[bool, tuple[int, formicar.OccupancyGrid]] = {}

    @property
    def number(self) -> int:
        """The number of the latest change; 0 without a map."""
        return self._number

    @property
    def frame(self) -> Frame | None:
        """The latest map; ``None`` before it has come."""
        return self._frame

    def clear(self) -> None:
        """Forget the map."""
        with self._lock:
            self._frame = None
            self._changes.clear()
            self._grids.clear()
            self._number += 1
            self._whole = self._number

    def replace(self, frame: Frame) -> None:
        """Take a whole map.

        Raises
        ------
        formicar.InvalidMap
            Cells, a resolution or an origin that make no map. The former map stays.
        """
        formicar.OccupancyGrid(frame.data, frame.resolution, frame.origin)
        n_rows, n_cols = frame.data.shape
        with self._lock:
            former = self._frame
            self._frame = frame
            if former is not None and former.lies_as(frame):
                self._note((0, 0, n_cols, n_rows))
            else:
                self._changes.clear()
                self._number += 1
                self._whole = self._number

    def patch(self, data: Cells, col: int, row: int) -> None:
        """Put values into a rectangle of cells.

        Raises
        ------
        formicar.InvalidMap
            A rectangle off the map, values that no cell may have, or no map to patch.
        """
        n_rows, n_cols = data.shape
        with self._lock:
            frame = self._frame
            if frame is None:
                raise formicar.InvalidMap("an update came before its map; it is ignored")
            if (
                col < 0
                or row < 0
                or col + n_cols > frame.data.shape[1]
                or (row + n_rows > frame.data.shape[0])
            ):
                raise formicar.InvalidMap(
                    f"update of {n_cols} x {n_rows} cells at ({col}, {row}) reaches off the map, "
                    f"which has {frame.data.shape[1]} x {frame.data.shape[0]}"
                )
            if data.size == 0:
                return
            if data.min() < -1 or data.max() > 100:
                raise formicar.InvalidMap(
                    f"update has values from {data.min()} to {data.max()}; allowed are -1 to 100"
                )
            # Readers keep the array that they have got; they never see half a patch.
            changed = frame.data.copy()
            changed[row : row + n_rows, col : col + n_cols] = data
            self._frame = Frame(changed, frame.resolution, frame.origin, frame.stamp_s)
            self._note((col, row, n_cols, n_rows))

    def _note(self, rectangle: Rectangle) -> None:
        self._number += 1
        self._changes.append((self._number, rectangle))
        if len(self._changes) > 64:
            older, newer = self._changes[:32], self._changes[32:]
            self._changes = [(older[-1][0], _hull([area for _, area in older])), *newer]

    def changes_since(self, number: int) -> tuple[int, Rectangle | None, Frame | None]:
        """Return the latest number, what has changed since another one, and the map.

        The rectangle is ``None`` where the whole map is another one.
        """
        with self._lock:
            if number < self._whole or self._frame is None:
                return self._number, None, self._frame
            areas = [area for when, area in self._changes if when > number]
            return self._number, _hull(areas) if areas else (0, 0, 0, 0), self._frame

    def grid(self, *, unknown_is_free: bool) -> formicar.OccupancyGrid | None:
        """Return the map as formicar takes it."""
        with self._lock:
            frame, number = self._frame, self._number
            known = self._grids.get(unknown_is_free)
        if frame is None:
            return None
        if known is not None and known[0] == number:
            return known[1]
        grid = formicar.OccupancyGrid(
            decided(frame.data, unknown_is_free=unknown_is_free), frame.resolution, frame.origin
        )
        with self._lock:
            self._grids[unknown_is_free] = (number, grid)
        return grid


def decided(data: Cells, *, unknown_is_free: bool) -> Cells:
    """Return cells of which the unknown ones are free, if so asked."""
    return np.maximum(data, np.int8(0)) if unknown_is_free else data


def frame_of_grid(message: Any) -> Frame:
    """Return the map of a ``nav_msgs/OccupancyGrid``.

    Raises
    ------
    formicar.InvalidMap
        A number of values other than that of the cells.
    poses.BadPose
        An origin whose orientation is no rotation.
    """
    info = message.info
    data = np.array(message.data, dtype=np.int8)
    _check_count(data.size, info.width, info.height)
    cells = data.reshape(info.height, info.width)
    return Frame(cells, round_f32(info.resolution), pose_of(info.origin), _seconds(message))


def frame_of_costmap(message: Any) -> Frame:
    """Return the map of a ``nav2_msgs/Costmap``, whose costs are 0 to 255.

    Raises
    ------
    formicar.InvalidMap
        A number of values other than that of the cells.
    poses.BadPose
        An origin whose orientation is no rotation.
    """
    meta = message.metadata
    data = np.array(message.data, dtype=np.uint8)
    _check_count(data.size, meta.size_x, meta.size_y)
    origin = pose_of(meta.origin)
    resolution = round_f32(meta.resolution)
    costs = data.reshape(meta.size_y, meta.size_x)
    grid = formicar.OccupancyGrid(costs, resolution, origin, values="costmap")
    return Frame(np.array(grid.data), resolution, origin, _seconds(message))


def cells_of_update(message: Any) -> Cells:
    """Return the cells of a ``map_msgs/OccupancyGridUpdate``.

    Raises
    ------
    formicar.InvalidMap
        A number of values other than that of the cells.
    """
    data = np.array(message.data, dtype=np.int8)
    _check_count(data.size, message.width, message.height)
    return data.reshape(message.height, message.width)


def round_f32(value: float) -> float:
    """Return the decimal that a float32 stands for: 0.05, where the message says 0.0500000007."""
    return float(np.format_float_positional(np.float32(value), unique=True))


def _check_count(n_values: int, width: int, height: int) -> None:
    if n_values != width * height or n_values == 0:
        raise formicar.InvalidMap(
            f"map of {width} x {height} cells has {n_values} values; it must have one for each cell"
        )


def _seconds(message: Any) -> float:
    stamp = message.header.stamp
    return float(stamp.sec) + 1e-9 * float(stamp.nanosec)


def _hull(areas: list[Rectangle]) -> Rectangle:
    cols = [col for col, _, _, _ in areas] + [col + n for col, _, n, _ in areas]
    rows = [row for _, row, _, _ in areas] + [row + n for _, row, _, n in areas]
    return (min(cols), min(rows), max(cols) - min(cols), max(rows) - min(rows))
