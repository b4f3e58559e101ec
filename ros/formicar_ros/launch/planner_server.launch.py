"""Starts the planner server; `autostart:=false` leaves it to a lifecycle manager."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Return the node and its arguments."""
    defaults = PathJoinSubstitution(
        [FindPackageShare("formicar_ros"), "config", "planner_server.yaml"]
    )
    switches = {
        name: ParameterValue(LaunchConfiguration(name), value_type=bool)
        for name in ("autostart", "use_sim_time")
    }
    return LaunchDescription(
        [
            DeclareLaunchArgument("params_file", default_value=defaults),
            DeclareLaunchArgument("autostart", default_value="true"),
            DeclareLaunchArgument("use_sim_time", default_value="false"),
            Node(
                package="formicar_ros",
                executable="planner_server",
                name="planner_server",
                output="screen",
                parameters=[LaunchConfiguration("params_file"), switches],
            ),
        ]
    )
