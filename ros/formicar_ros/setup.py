"""Installs the package, by colcon in a workspace and by pip beside `formicar`."""

from glob import glob

from setuptools import setup

NAME = "formicar_ros"

setup(
    name=NAME,
    version="0.1.0",
    description="Certified path planning for car-like robots in Nav2",
    author="The formicar developers",
    license="MIT OR Apache-2.0",
    python_requires=">=3.10",
    packages=[NAME],
    package_data={NAME: ["py.typed"]},
    install_requires=["setuptools", "formicar>=0.1.0", "numpy>=1.24", "pyyaml>=5.4"],
    zip_safe=True,
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{NAME}"]),
        (f"share/{NAME}", ["package.xml"]),
        (f"share/{NAME}/config", glob("config/*")),
        (f"share/{NAME}/launch", glob("launch/*")),
    ],
    entry_points={"console_scripts": [f"planner_server = {NAME}.planner_server:main"]},
)
