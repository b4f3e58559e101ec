"""Maps from lidar scans, and a robot found in its map.

`Log` holds the scans of one laser with the odometry between them: from arrays, from CARMEN files,
or from bags of ROS 2. `build_map` turns a log into a map to plan on; `Mapper` takes scan after
scan and can be saved. `Localizer` finds the laser in a map and says ``lost`` instead of guessing.

All poses are those of the laser, ``(x, y, heading)`` in meters and radians, and the first one is
the origin of the map. The same scans give the same map, bit for bit, as on the command line.

Examples
--------
A robot drives along a corridor of 2 m; its laser sees half a turn.

>>> import numpy as np
>>> from formicar.mapping import Log, build_map
>>> angles = np.deg2rad(np.arange(-90, 91))
>>> x = 0.1 * np.arange(30)
>>> side = 1.0 / np.maximum(np.abs(np.sin(angles)), 1e-9)
>>> ahead = (6.0 - x[:, None]) / np.maximum(np.cos(angles), 1e-9)
>>> odometry = np.column_stack([x, 0 * x, 0 * x])
>>> log = Log(np.minimum(side, ahead), angles[0], np.deg2rad(1.0), odometry)
>>> built = build_map(log)
>>> built.trajectory.shape, bool(abs(built.trajectory[-1, 0] - 2.9) < 0.05)
((30, 3), True)
>>> built.map.resolution
0.05
"""

from __future__ import annotations

from ._formicar import InvalidLog
from ._lidar_log import Log
from ._localizer import Localizer, Located
from ._mapper import BuiltMap, Mapper, build_map

__all__ = ["BuiltMap", "InvalidLog", "Localizer", "Located", "Log", "Mapper", "build_map"]
