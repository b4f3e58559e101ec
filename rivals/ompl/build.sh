#!/bin/sh
# Builds rivals/ompl/ompl_rival against Debian's OMPL; installs the packages that
# are missing. `build.sh test` also tests what the rival adds to OMPL.
set -eu
cd "$(dirname "$0")"
packages="g++ libompl-dev libeigen3-dev nlohmann-json3-dev"
missing=""
for package in $packages; do
    dpkg -s "$package" >/dev/null 2>&1 || missing="$missing $package"
done
if [ -n "$missing" ]; then
    as_root=""
    [ "$(id -u)" = 0 ] || as_root=sudo
    $as_root apt-get update
    # The list is split on purpose.
    $as_root apt-get install --yes --no-install-recommends $missing
fi
build() {
    g++ -std=c++17 -O3 -Wall -Wextra "$1" -o "$2" \
        -isystem /usr/include/ompl-1.5 -isystem /usr/include/eigen3 -lompl
}
build main.cpp ompl_rival
if [ "${1:-}" = test ]; then
    build test.cpp ompl_test
    ./ompl_test
fi
