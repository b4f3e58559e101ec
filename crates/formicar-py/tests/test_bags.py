"""Bags between formicar and others.

`rosbags` and `mcap-ros2-support` write what formicar reads, and read what it writes.
"""

from __future__ import annotations

import dataclasses
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap.writer import CompressionType
from mcap_ros2.decoder import DecoderFactory
from mcap_ros2.writer import Writer as McapWriter
from rosbags.interfaces import ConnectionExtRosbag2
from rosbags.rosbag1 import Writer as Ros1Writer
from rosbags.rosbag2 import CompressionFormat, CompressionMode, Reader, StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from formicar import InvalidLog
from formicar.mapping import Log, build_map

from .conftest import Room

ROS2 = get_typestore(Stores.ROS2_JAZZY)
ROS2.register(
    get_types_from_msg("geometry_msgs/TransformStamped[] transforms", "tf2_msgs/msg/TFMessage")
)
ROS1 = get_typestore(Stores.ROS1_NOETIC)
SCAN, ODOMETRY = "sensor_msgs/msg/LaserScan", "nav_msgs/msg/Odometry"
TF = "tf2_msgs/msg/TFMessage"
# The laser on the robot.
MOUNT = (0.2, 0.05, 0.1)


def quaternion(store: Any, heading: float) -> Any:
    of = store.types["geometry_msgs/msg/Quaternion"]
    return of(x=0.0, y=0.0, z=float(np.sin(heading / 2)), w=float(np.cos(heading / 2)))


def header(store: Any, frame: str, time: float) -> Any:
    seconds, nanoseconds = divmod(round(time * 1e9), 10**9)
    stamp = store.types["builtin_interfaces/msg/Time"](sec=seconds, nanosec=nanoseconds)
    of = store.types["std_msgs/msg/Header"]
    more = {"seq": 0} if store is ROS1 else {}
    return of(stamp=stamp, frame_id=frame, **more)


def messages(room: Room, store: Any) -> Any:
    """Yield topic, type, time in nanoseconds and message of a drive."""
    types = store.types
    point, vector = types["geometry_msgs/msg/Point"], types["geometry_msgs/msg/Vector3"]
    x, y, turn = MOUNT
    if store is not ROS1:
        transform = types["geometry_msgs/msg/Transform"](
            translation=vector(x=x, y=y, z=0.3), rotation=quaternion(store, turn)
        )
        link = types["geometry_msgs/msg/TransformStamped"](
            header=header(store, "base_link", room.times[0]),
            child_frame_id="laser",
            transform=transform,
        )
        yield "/tf_static", TF, round(room.times[0] * 1e9), types[TF](transforms=[link])
    none = vector(x=0.0, y=0.0, z=0.0)
    for ranges, pose, time in zip(room.ranges, room.poses, room.times, strict=True):
        heading = pose[2] - turn
        base = pose[:2] - [
            np.cos(heading) * x - np.sin(heading) * y,
            np.sin(heading) * x + np.cos(heading) * y,
        ]
        where = types["geometry_msgs/msg/Pose"](
            position=point(x=base[0], y=base[1], z=0.0), orientation=quaternion(store, heading)
        )
        odometry = types[ODOMETRY](
            header=header(store, "odom", time),
            child_frame_id="base_link",
            pose=types["geometry_msgs/msg/PoseWithCovariance"](pose=where, covariance=np.zeros(36)),
            twist=types["geometry_msgs/msg/TwistWithCovariance"](
                twist=types["geometry_msgs/msg/Twist"](linear=none, angular=none),
                covariance=np.zeros(36),
            ),
        )
        yield "/odom", ODOMETRY, round(time * 1e9), odometry
        scan = types[SCAN](
            header=header(store, "laser", time),
            angle_min=room.ANGLE_MIN,
            angle_max=-room.ANGLE_MIN,
            angle_increment=room.ANGLE_INCREMENT,
            time_increment=0.0,
            scan_time=0.25,
            range_min=0.05,
            range_max=30.0,
            ranges=ranges,
            intensities=np.zeros(0, dtype=np.float32),
        )
        yield "/scan", SCAN, round(time * 1e9), scan


def write_rosbag2(
    room: Room,
    path: Path,
    mode: CompressionMode = CompressionMode.NONE,
    storage: StoragePlugin = StoragePlugin.MCAP,
) -> Path:
    writer = Writer(path, version=9, storage_plugin=storage)
    writer.set_compression(mode, CompressionFormat.ZSTD)
    with writer:
        connections: dict[str, Any] = {}
        for topic, kind, time, message in messages(room, ROS2):
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=ROS2)
            writer.write(connections[topic], time, ROS2.serialize_cdr(message, kind))
    return path


def as_lists(message: Any) -> Any:
    """Return a message as dicts, lists and numbers."""
    if dataclasses.is_dataclass(message):
        names = [field.name for field in dataclasses.fields(message)]
        return {name: as_lists(getattr(message, name)) for name in names if name != "__msgtype__"}
    if isinstance(message, np.ndarray):
        return message.tolist()
    return [as_lists(item) for item in message] if isinstance(message, list) else message


def write_mcap(room: Room, path: Path, compression: CompressionType) -> Path:
    """Write by the support package of MCAP, which serializes by itself."""
    with path.open("wb") as file:
        writer = McapWriter(file, compression=compression, chunk_size=20_000)
        schemas: dict[str, Any] = {}
        for topic, kind, time, message in messages(room, ROS2):
            if kind not in schemas:
                text, _ = ROS2.generate_msgdef(kind, ros_version=2)
                schemas[kind] = writer.register_msgdef(kind, text)
            writer.write_message(topic, schemas[kind], as_lists(message), time, time)
        writer.finish()  # type: ignore[no-untyped-call]
    return path


def check_log(log: Log, room: Room) -> None:
    assert np.array_equal(log.ranges, room.ranges)
    assert log.odometry is not None
    assert np.abs(log.odometry - room.poses).max() < 1e-9
    assert np.abs(log.times - room.times).max() < 1e-6
    assert log.angle_min == np.float32(room.ANGLE_MIN)


@pytest.mark.parametrize("mode", [CompressionMode.NONE, CompressionMode.STORAGE])
def test_bags_of_rosbags_are_read(room: Room, tmp_path: Path, mode: CompressionMode) -> None:
    bag = write_rosbag2(room, tmp_path / "drive", mode)
    check_log(Log.read(bag), room)
    (file,) = bag.glob("*.mcap")
    check_log(Log.read(file), room)


@pytest.mark.parametrize("kind", [CompressionType.NONE, CompressionType.LZ4, CompressionType.ZSTD])
def test_files_of_mcap_ros2_support_are_read(
    room: Room, tmp_path: Path, kind: CompressionType
) -> None:
    check_log(Log.read(write_mcap(room, tmp_path / "drive.mcap", kind)), room)


def test_a_bag_that_was_cut_off_is_read(room: Room, tmp_path: Path) -> None:
    file = write_mcap(room, tmp_path / "drive.mcap", CompressionType.LZ4)
    whole = file.read_bytes()
    file.write_bytes(whole[: len(whole) // 2])
    log = Log.read(file)
    assert 10 < len(log) < 40
    assert "cut off" in log.warnings[0]


def test_a_bag_becomes_the_map_of_its_arrays(program: Path, room: Room, tmp_path: Path) -> None:
    bag = write_rosbag2(room, tmp_path / "drive", CompressionMode.STORAGE)
    words = ("map", "build", str(bag), "--out", "theirs.yaml")
    ran = subprocess.run(
        [program, *words], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert ran.returncode == 0, ran.stderr
    build_map(Log.read(bag)).map.save(tmp_path / "ours.yaml")
    ours, theirs = (tmp_path / "ours.pgm").read_bytes(), (tmp_path / "theirs.pgm").read_bytes()
    assert ours == theirs
    locate = ("locate", str(bag), "--map", "theirs.yaml", "--start", "0,0,0")
    ran = subprocess.run(
        [program, *locate], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert ran.returncode == 0 and "lost        0" in ran.stdout


def converted(refused: str, folder: Path) -> None:
    """Carry out the command that a refusal names."""
    found = re.search(r"&& (rosbags-convert .*)$", refused)
    assert found
    scripts = str(Path(sys.executable).parent)
    environment = {**os.environ, "PATH": scripts + os.pathsep + os.environ["PATH"]}
    subprocess.run(found[1].split(), cwd=folder, env=environment, check=True, capture_output=True)


def test_a_bag_in_sqlite_is_refused_with_a_command_that_works(
    room: Room, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    write_rosbag2(room, tmp_path / "drive", storage=StoragePlugin.SQLITE3)
    for name in ("drive", "drive/drive.db3"):
        with pytest.raises(InvalidLog, match="SQLite") as raised:
            Log.read(name)
        assert "--src drive --dst drive-mcap" in str(raised.value)
    converted(str(raised.value), tmp_path)
    check_log(Log.read("drive-mcap"), room)


def test_a_bag_of_ros1_is_refused_with_a_command_that_works(
    room: Room, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with Ros1Writer(tmp_path / "drive.bag") as writer:
        connections: dict[str, Any] = {}
        for topic, kind, time, message in messages(room, ROS1):
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=ROS1)
            writer.write(connections[topic], time, ROS1.serialize_ros1(message, kind))
    with pytest.raises(InvalidLog, match="ROS 1") as raised:
        Log.read("drive.bag")
    converted(str(raised.value), tmp_path)
    with pytest.raises(InvalidLog, match="--laser-pose"):
        Log.read("drive")
    check_log(Log.read("drive", laser_pose=MOUNT), room)
    assert Log.read("drive", use_odometry=False).odometry is None


def test_packed_files_and_messages_are_refused(room: Room, tmp_path: Path) -> None:
    whole = write_rosbag2(room, tmp_path / "file", CompressionMode.FILE)
    with pytest.raises(InvalidLog, match="zstd -d .*mcap.zstd"):
        Log.read(whole)
    single = write_rosbag2(room, tmp_path / "message", CompressionMode.MESSAGE)
    with pytest.raises(InvalidLog, match="packed by zstd"):
        Log.read(single)


@pytest.fixture(scope="module")
def recorded(program: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("recorded")
    words = ("plan", "--map", "parking-lot", "--request", "back-in", "--record", "plan.mcap")
    ran = subprocess.run([program, *words], cwd=folder, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    return folder / "plan.mcap"


def test_a_recorded_plan_is_read_by_mcap_ros2_support(recorded: Path) -> None:
    found: dict[str, list[Any]] = {}
    with recorded.open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        for _, channel, _, message in reader.iter_decoded_messages():
            found.setdefault(channel.topic, []).append(message)
    (grid,) = found["/map"]
    assert len(grid.data) == grid.info.width * grid.info.height
    assert set(grid.data) == {0, 100}
    (path,) = found["/plan"]
    assert path.header.frame_id == "map" and len(path.poses) > 100
    (gears,) = found["/plan_gears"]
    assert [marker.ns for marker in gears.markers] == ["forward", "reverse"]
    assert all(len(marker.points) > 2 and marker.type == 4 for marker in gears.markers)
    assert len(found["/footprint"]) == len(found["/tf"]) > 100
    assert len(found["/footprint"][0].polygon.points) >= 4
    last, end = found["/tf"][-1].transforms[0].transform, path.poses[-1].pose
    assert (last.translation.x, last.translation.y) == (end.position.x, end.position.y)


def test_a_recorded_plan_is_read_by_rosbags(recorded: Path) -> None:
    with Reader(recorded) as reader:
        durable = {}
        for connection in reader.connections:
            assert isinstance(connection.ext, ConnectionExtRosbag2)
            durable[connection.topic] = connection.ext.offered_qos_profiles[0].durability.name
        for connection, _, data in reader.messages():
            message = ROS2.deserialize_cdr(data, connection.msgtype)
            # Equal bytes: the same alignment, padding and lengths.
            assert bytes(ROS2.serialize_cdr(message, connection.msgtype)) == bytes(data)
            own, _ = ROS2.generate_msgdef(connection.msgtype, ros_version=2)
            assert fields(connection.msgdef.data) == fields(own)
    assert durable["/map"] == durable["/plan"] == "TRANSIENT_LOCAL"
    assert durable["/tf"] == durable["/footprint"] == "VOLATILE"


def fields(definition: str) -> dict[str, list[str]]:
    """Return the fields of each message in a definition, without constants."""
    parts = re.split(r"^=+\nMSG: ", "MSG\n" + definition, flags=re.M)
    found = {}
    for part in parts:
        name, *lines = part.splitlines()
        found[name.replace("/msg/", "/")] = [
            line.replace("/msg/", "/").strip() for line in lines if line.strip() and "=" not in line
        ]
    return found
