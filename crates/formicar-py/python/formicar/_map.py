"""Occupancy grids."""

from __future__ import annotations

import os
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

from . import _formicar
from ._arrays import frozen, number_of, plain, pose_of, whole_of
from ._formicar import InvalidMap
from ._hints import suggests
from ._records import Pose

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike, NDArray


class OccupancyGrid:
    """A map of square cells: -1 unknown, 0 free, 1 to 99 graded, 100 occupied.

    Occupied and unknown cells stop a vehicle; graded ones are preferences at most. The map is
    immutable and holds a copy of its array: what happens to the array afterwards does not matter.

    Parameters
    ----------
    data : array_like, shape (n_rows, n_cols)
        Booleans, ``True`` where occupied, or integers of any width as in ``nav_msgs``. An integer
        array of 0 and 1 alone is refused, since a 1 of 100 is as good as free. The array may be of
        any order and stride; one copy is made.
    resolution : float
        Side of a cell, meters.
    origin : (float, float, float), optional
        World pose ``(x, y, yaw)`` of the lower left corner, meters and radians; a yaw beyond a turn
        is refused, since it is in degrees.
    values : {"occupancy", "costmap", "grey"}, optional
        ``"costmap"`` reads uint8 costs of Nav2 (0 free, 254 lethal, 255 unknown), ``"grey"`` uint8
        or uint16 shades of an image (black occupied, white free) by the thresholds of the map
        savers of ROS.
    row0 : {"bottom", "top"}, optional
        Where row 0 of the array lies: at the bottom, as in ``nav_msgs``, or on top, as in images.

    Raises
    ------
    InvalidMap
        No cells, more than 2**28, a resolution or an origin out of range, or a value that no cell
        may have.
    TypeError
        Another dtype.

    Examples
    --------
    >>> import numpy as np
    >>> walls = np.zeros((3, 4), dtype=bool)
    >>> walls[0, 3] = True
    >>> depot = OccupancyGrid(walls, resolution=0.5)
    >>> depot
    OccupancyGrid(3 rows x 4 columns, 0.5 m per cell, 2 x 1.5 m, 1 occupied)
    >>> depot.data[0]
    array([  0,   0,   0, 100], dtype=int8)
    """

    _core: _formicar.Grid

    @suggests
    def __init__(
        self,
        data: ArrayLike,
        resolution: float,
        origin: tuple[float, float, float] = (0.0, 0.0, 0.0),
        *,
        values: Literal["occupancy", "costmap", "grey"] = "occupancy",
        row0: Literal["bottom", "top"] = "bottom",
    ) -> None:
        if row0 not in ("bottom", "top"):
            raise InvalidMap(f'row0 = {row0!r}; expected "bottom" or "top"')
        self._core = _formicar.Grid.of_array(
            plain(data, "the map's array"),
            number_of(resolution, "resolution", " of meters per cell", InvalidMap),
            pose_of(origin, "origin", InvalidMap),
            values,
            row0 == "top",
        )

    @classmethod
    def _of(cls, core: _formicar.Grid) -> OccupancyGrid:
        grid = cls.__new__(cls)
        grid._core = core
        return grid

    @classmethod
    @suggests
    def load(
        cls,
        path: str | os.PathLike[str],
        *,
        resolution: float | None = None,
        unknown_grey: int | None = None,
    ) -> OccupancyGrid:
        """Read a map file.

        ROS maps (``.yaml`` with PGM, PNG or BMP), bare images, MovingAI maps (``.map``), matrices
        of 0 and 1 (``.txt``, ``.csv``), and TPCAP cases.

        Parameters
        ----------
        path : path
            The file.
        resolution : float, optional
            Side of a cell in meters, for formats that do not say.
        unknown_grey : int, optional
            A gray of 0 to 255 that stands for unknown cells, whatever the file's thresholds say;
            map savers write 205.

        Returns
        -------
        OccupancyGrid
            The map; doubts about the file are in `warnings`.

        Raises
        ------
        FileNotFoundError
            No such file.
        InvalidMap
            A file that is no map.
        """
        if resolution is not None:
            resolution = number_of(resolution, "resolution", " of meters per cell", InvalidMap)
        if unknown_grey is not None:
            unknown_grey = whole_of(unknown_grey, "unknown_grey", InvalidMap)
            if not 0 <= unknown_grey <= 255:
                raise InvalidMap(f"unknown_grey = {unknown_grey}; it must be 0 to 255")
        return cls._of(_formicar.Grid.load(os.fspath(path), resolution, unknown_grey))

    @classmethod
    def builtin(cls, name: str) -> OccupancyGrid:
        """Return a built-in map; `builtin_maps` lists them.

        Examples
        --------
        >>> OccupancyGrid.builtin("parking-lot").requests["back-in"].goal[2]  # doctest: +ELLIPSIS
        1.57...
        """
        return cls._of(_formicar.Grid.builtin(name))

    @cached_property
    def data(self) -> NDArray[np.int8]:
        """The values, shape ``(n_rows, n_cols)``, row 0 at the bottom; read-only."""
        return frozen(self._core.values())

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self._core.shape

    @property
    def resolution(self) -> float:
        """Side of a cell, meters."""
        return self._core.resolution_m

    @property
    def origin(self) -> Pose:
        """World pose ``(x, y, yaw)`` of the lower left corner, meters and radians."""
        return self._core.origin

    @property
    def extent(self) -> tuple[float, float]:
        """Width and height along the map's own axes, meters."""
        n_rows, n_cols = self.shape
        return (n_cols * self.resolution, n_rows * self.resolution)

    @property
    def name(self) -> str:
        """File or built-in name."""
        return self._core.name

    @property
    def warnings(self) -> list[str]:
        """Doubts about the file, in words; none of most maps."""
        return self._core.warnings

    @property
    def requests(self) -> dict[str, BuiltinRequest]:
        """Start and goal of each request of a built-in map; empty for other maps."""
        return {name: BuiltinRequest(start, goal) for name, start, goal in self._core.requests()}

    @property
    def vehicle_name(self) -> str | None:
        """The preset that a built-in map is made for; ``None`` for other maps."""
        return self._core.own_vehicle()

    @suggests
    def distance_field(self, *, max_distance: float | None = None) -> NDArray[np.float64]:
        """Return the distance from each cell's center to that of the nearest lethal cell.

        Parameters
        ----------
        max_distance : float, optional
            Where to stop, meters: larger distances are this one, rounded up to whole cells. At most
            255 cells, which is the default.

        Returns
        -------
        ndarray of float64, shape (n_rows, n_cols)
            Meters, exact up to `max_distance`; 0 on lethal cells (occupied or unknown). The border
            of the map is no obstacle here.

        Examples
        --------
        >>> import numpy as np
        >>> walls = np.zeros((1, 5), dtype=bool)
        >>> walls[0, 0] = True
        >>> OccupancyGrid(walls, 0.5).distance_field()
        array([[0. , 0.5, 1. , 1.5, 2. ]])
        """
        if max_distance is not None:
            max_distance = number_of(max_distance, "max_distance", " of meters", InvalidMap)
        return self._core.distance_field(max_distance)

    def with_unknown(self, policy: Literal["free", "occupied"]) -> OccupancyGrid:
        """Return the map with its unknown cells free or occupied; otherwise they are lethal.

        Examples
        --------
        >>> import numpy as np
        >>> OccupancyGrid(np.full((1, 2), -1), 1.0).with_unknown("free").data
        array([[0, 0]], dtype=int8)
        """
        return self._of(self._core.with_unknown(policy))

    def with_keep_out(self, areas: Any) -> OccupancyGrid:
        """Return the map with areas occupied.

        Parameters
        ----------
        areas : sequence of array_like, each of shape (n, 2)
            Polygons in world coordinates, meters; every cell that one touches is occupied.
        """
        return self._of(self._core.with_keep_out(polygons(areas)))

    def cell_at(self, x: float, y: float) -> tuple[int, int] | None:
        """Return ``(column, row)`` of the cell under a world point; ``None`` off the map."""
        return self._core.cell_at(x, y)

    def center(self, col: int, row: int) -> tuple[float, float]:
        """Return the world point at the center of a cell, meters."""
        return self._core.center(col, row)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the map in the format that the name's ending tells.

        ``.yaml`` (with a PGM beside it), ``.pgm``, ``.png``, ``.map``, ``.txt`` or ``.csv``.
        """
        self._core.save(os.fspath(path))

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the map with matplotlib, in world coordinates, and return the axes."""
        from ._draw import draw_map

        return draw_map(self, ax)

    def __repr__(self) -> str:
        n_rows, n_cols = self.shape
        width, height = self.extent
        unknown, _, graded, occupied = self._core.counts()
        counts = [(occupied, "occupied"), (unknown, "unknown"), (graded, "graded")]
        told = [f"{n} {word}" for n, word in counts if n] or ["all free"]
        return (
            f"OccupancyGrid({n_rows} rows x {n_cols} columns, {self.resolution:g} m per cell, "
            f"{width:g} x {height:g} m, {', '.join(told)})"
        )

    def _repr_svg_(self) -> str:
        return _formicar.grid_svg(self._core, repr(self))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, OccupancyGrid):
            return NotImplemented
        return self._core.same_as(other._core)

    def __hash__(self) -> int:
        return hash(self._core.hash)

    def __copy__(self) -> OccupancyGrid:
        return self

    def __deepcopy__(self, memo: object) -> OccupancyGrid:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return (_grid_of_state, self._core.state())


class BuiltinRequest(tuple[Pose, Pose]):
    """Start and goal of a request of a built-in map: ``planner.plan(*request)`` plans it."""

    __slots__ = ()

    def __new__(cls, start: Any, goal: Any) -> BuiltinRequest:
        """Make a request of two poses."""
        return super().__new__(cls, (tuple(start), tuple(goal)))

    @property
    def start(self) -> Pose:
        """The start pose ``(x, y, heading)``, meters and radians."""
        return self[0]

    @property
    def goal(self) -> Pose:
        """The goal pose ``(x, y, heading)``, meters and radians."""
        return self[1]

    def __repr__(self) -> str:
        return f"BuiltinRequest(start={self.start}, goal={self.goal})"

    def __getnewargs__(self) -> tuple[Pose, Pose]:
        return (self.start, self.goal)


def _grid_of_state(record: str, cells: bytes) -> OccupancyGrid:
    return OccupancyGrid._of(_formicar.Grid.of_state(record, cells))


def polygons(areas: Any) -> list[list[list[float]]]:
    """Return polygons as lists of corners."""
    from ._formicar import InvalidRequest

    try:
        return [[[float(x), float(y)] for x, y in area] for area in areas]
    except (TypeError, ValueError):
        raise InvalidRequest(
            "keep_out: expected a sequence of polygons, each a sequence of corners (x, y) in "
            "meters, for instance [[(0, 0), (2, 0), (2, 1)]]"
        ) from None


def builtin_maps() -> dict[str, str]:
    """Return the built-in maps, each with its description.

    Examples
    --------
    >>> "warehouse" in builtin_maps()
    True
    """
    return dict(_formicar.builtin_maps())
