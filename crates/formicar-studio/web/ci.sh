#!/usr/bin/env bash
# The page's checks: types, modules, the committed bundle, and the page in a real browser against the
# real binary. The output ends with the summary of node's test runner.
#
# Needs the release binary (cargo build --release), or FORMICAR with the path of one.
set -euo pipefail
cd "$(dirname "$0")"

step() { printf '== %s\n' "$*"; }

# Debian's packages, where their commands are absent.
install_missing() {
    local missing=()
    command -v node > /dev/null || missing+=(nodejs)
    command -v npm > /dev/null || missing+=(npm)
    [ -x "${CHROMIUM:-/usr/bin/chromium}" ] || missing+=(chromium)
    [ "${#missing[@]}" -eq 0 ] && return
    step "installing ${missing[*]}"
    local as_root=()
    [ "$(id -u)" -eq 0 ] || as_root=(sudo)
    "${as_root[@]}" apt-get update --quiet=2
    DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install --yes --quiet=2 \
        --no-install-recommends "${missing[@]}" > /dev/null
}

install_missing

step "the page's packages"
npm ci --silent --no-audit --no-fund

step "the page's types"
npm run --silent check

step "the page's modules"
npm run --silent unit

step "the page's bundle"
built=$(mktemp -d)
trap 'rm -rf "$built"' EXIT
npm run --silent build -- --out "$built" --quiet
if ! diff -rq "$built" dist; then
    echo "web/dist is not what web/src builds; hint: npm run build in crates/formicar-studio/web, then cargo build --release, and commit both" >&2
    exit 1
fi

step "the page in a browser"
npm run --silent e2e
