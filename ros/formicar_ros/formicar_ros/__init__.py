"""formicar in a ROS 2 system: thin nodes on rclpy, whose thinking is done by `formicar`.

`formicar_ros.planner_server` takes the place of Nav2's planner server, and
`python -m formicar_ros.migrate` turns the parameters of SmacPlannerHybrid into its own.
"""
