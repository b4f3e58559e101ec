"""Build the interfaces that the wheels of ROS lack, for the tests.

    python generate.py DISTRIBUTION BUILD_DIRECTORY PREFIX

The definitions beside this file are built by ROS's own generators, as a workspace would. On a robot
all of these interfaces come with ROS.
"""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
from pathlib import Path

HERE = Path(__file__).parent
USED = ("builtin_interfaces", "std_msgs", "geometry_msgs", "nav_msgs", "action_msgs")

PACKAGE = """<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.1.0</version>
  <description>Interfaces for the tests of formicar_ros.</description>
  <maintainer email="nobody@example.com">nobody</maintainer>
  <license>MIT</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <buildtool_depend>rosidl_default_generators</buildtool_depend>
  {depends}
  <member_of_group>rosidl_interface_packages</member_of_group>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""

CMAKE = """cmake_minimum_required(VERSION 3.16)
project({name})
find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
{finds}
rosidl_generate_interfaces(${{PROJECT_NAME}}
  {files}
  DEPENDENCIES {used})
ament_package()
"""


def build(package: Path, work: Path, prefix: Path) -> None:
    """Build one package and install it into the prefix."""
    source, objects = work / package.name, work / f"{package.name}-build"
    _write_sources(package, source)
    definitions = {
        "CMAKE_INSTALL_PREFIX": prefix,
        "CMAKE_PREFIX_PATH": sys.prefix,
        "CMAKE_BUILD_TYPE": "None",
        "CMAKE_CXX_FLAGS": "-O0",
        "CMAKE_C_FLAGS": "-O0",
        "BUILD_TESTING": "OFF",
        "Python3_EXECUTABLE": sys.executable,
    }
    options = [f"-D{name}={value}" for name, value in definitions.items()]
    environment = {**os.environ, "AMENT_PREFIX_PATH": sys.prefix}
    path = os.pathsep.join([str(Path(sys.prefix) / "bin"), os.environ["PATH"]])
    environment["PATH"] = path
    for command in (
        ["cmake", "-G", "Ninja", "-S", str(source), "-B", str(objects), *options],
        ["cmake", "--build", str(objects), "--target", "install"],
    ):
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"{package.name}: {' '.join(command)}\n{done.stdout}\n{done.stderr}")


def _write_sources(package: Path, source: Path) -> None:
    files = sorted(p for p in package.glob("*/*") if p.suffix in (".msg", ".srv", ".action"))
    for file in files:
        to = source / file.relative_to(package)
        to.parent.mkdir(parents=True, exist_ok=True)
        to.write_text(file.read_text())
    depends = "\n  ".join(f"<depend>{name}</depend>" for name in USED)
    (source / "package.xml").write_text(PACKAGE.format(name=package.name, depends=depends))
    (source / "CMakeLists.txt").write_text(
        CMAKE.format(
            name=package.name,
            finds="\n".join(f"find_package({name} REQUIRED)" for name in USED),
            files="\n  ".join(f'"{file.relative_to(package)}"' for file in files),
            used=" ".join(USED),
        )
    )


def repair_wheels() -> None:
    """Let the CMake files of the wheels name this Python instead of their builder's."""
    import numpy

    for file in (Path(sys.prefix) / "share").glob("*/cmake/*Export.cmake"):
        text = file.read_text()
        if "/opt/python/" not in text:
            continue
        first, _, rest = text.partition('"/opt/python/')
        includes = f"{sysconfig.get_path('include')};{numpy.get_include()}"
        file.write_text(f'{first}"{includes}"{rest.partition(chr(34))[2]}')


def main() -> None:
    """Build all packages of a distribution."""
    distribution, work, prefix = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    repair_wheels()
    for package in sorted([*(HERE / distribution).iterdir()]):
        build(package, work.absolute() / distribution, prefix.absolute())


if __name__ == "__main__":
    main()
