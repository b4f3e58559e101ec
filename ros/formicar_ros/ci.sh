#!/usr/bin/env bash
# The checks of the ROS 2 package: real rclpy of Jazzy is installed from PyPI, the interfaces that
# its wheels lack are generated from tests/interfaces, and the node is asked by clients in other
# processes. The output ends with pytest's summary.
#
# Uses the wheel that crates/formicar-py/ci.sh has built. Needs CPython 3.10 to 3.12 on Linux
# (PYTHON names one) and a C++ compiler. FORMICAR_SLOW=1 asks the node with the interfaces of
# Humble, Kilted and Lyrical as well.
set -euo pipefail
cd "$(dirname "$0")"

export PIP_DISABLE_PIP_VERSION_CHECK=1
python=${PYTHON:-python3}
venv=$PWD/target/venv
made=$PWD/target/interfaces
wheels=../../crates/formicar-py/target/wheels

step() { printf '== %s\n' "$*"; }

step "an environment with rclpy"
"$python" -c 'import sys; sys.exit(not (3, 10) <= sys.version_info < (3, 13))' || {
    echo "rclpy has wheels for CPython 3.10 to 3.12; hint: PYTHON=python3.12 $0" >&2
    exit 1
}
compgen -G "$wheels/formicar-*.whl" > /dev/null || {
    echo "no wheel of formicar in $wheels; hint: run crates/formicar-py/ci.sh first" >&2
    exit 1
}
[ -x "$venv/bin/python" ] || "$python" -m venv "$venv"
"$venv/bin/pip" install --quiet --requirement tests/requirements.txt
"$venv/bin/pip" install --quiet --force-reinstall --no-deps "$wheels"/formicar-*.whl
rm -rf build
"$venv/bin/pip" install --quiet --force-reinstall --no-deps .
export PATH="$venv/bin:$PATH"

# Generating takes a minute; what was made from the same definitions is used again.
generate() {
    local stamp="$made/$1.made" now
    now=$(find "tests/interfaces/$1" tests/interfaces/generate.py tests/interfaces/requirements.txt \
        -type f -exec sha256sum {} + | sort | sha256sum)
    if [ "$(cat "$stamp" 2> /dev/null)" != "$now" ]; then
        pip install --quiet --requirement tests/interfaces/requirements.txt
        rm -rf "${made:?}/$1"
        python tests/interfaces/generate.py "$1" target/generated "$made/$1"
        printf '%s\n' "$now" > "$stamp"
    fi
}

site=$(python -c 'import sys; print("lib/python%d.%d/site-packages" % sys.version_info[:2])')
with_interfaces_of() {
    local distribution=$1
    shift
    PYTHONPATH="$made/common/$site:$made/$distribution/$site" \
        LD_LIBRARY_PATH="$made/common/lib:$made/$distribution/lib" \
        AMENT_PREFIX_PATH="$made/common:$made/$distribution:$venv" "$@"
}

step "interfaces that the wheels lack"
mkdir -p "$made"
generate common
generate jazzy

step "formatting, lints and types"
ruff format --quiet --check .
ruff check --quiet .
with_interfaces_of jazzy mypy --no-error-summary formicar_ros tests benches

if [ -n "${FORMICAR_SLOW:-}" ]; then
    for distribution in humble kilted lyrical; do
        step "the interfaces of $distribution"
        generate "$distribution"
        with_interfaces_of "$distribution" python -m pytest --quiet tests/test_distributions.py
    done
fi

step "the node and its clients"
with_interfaces_of jazzy python -m pytest "$@"
