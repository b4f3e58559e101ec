#!/bin/sh
# Measures the folders DATE-peers, DATE-barn and DATE-cases of benchmarks/ anew:
#
#     benchmarks/campaigns/measure.sh 2026-12-01
#
# Stores and pages are kept in target/campaigns; an interrupted measurement goes on. Maps and
# scenarios by others are read from ../shared/data.
set -eu
cd "$(dirname "$0")/../.."
date=${1:?"usage: benchmarks/campaigns/measure.sh DATE"}
data=../shared/data/car
cars="$data/hood_800x500.json $data/street_berlin1_1024.json $data/freiburg_campus.json $data/nav2_warehouse.json"
kept=target/campaigns/$date
formicar=target/release/formicar
mkdir -p "$kept"

cargo build --release -p formicar-cli --no-default-features --features lab
rivals/ompl/build.sh
for campaign in peers-reverse peers-forward barn cases; do
    "$formicar" bench "benchmarks/campaigns/$campaign.toml" --store "$kept/$campaign.sqlite"
done
# The best known costs: ten times the patience.
for motion in reverse forward; do
    # The list is split on purpose.
    "$formicar" bench $cars --motion $motion --cold --seeds 2 --deadline 10s \
        --set improve.stall_tries_per_radius=100 --store "$kept/patient-$motion.sqlite"
done

# Makes the page of some stores.
page() {
    name=$1
    shift
    "$formicar" report "$@" --out "$kept/page-$name" >/dev/null
}

peers=benchmarks/$date-peers
mkdir -p "$peers" "benchmarks/$date-barn" "benchmarks/$date-cases"
for motion in reverse forward; do
    page $motion "$kept/peers-$motion.sqlite"
    page $motion-best-known "$kept/peers-$motion.sqlite" "$kept/patient-$motion.sqlite"
    cp "$kept/page-$motion/summary.md" "$peers/$motion.md"
    sed -n '/^## Cost over time/,/^## How values/p' "$kept/page-$motion-best-known/summary.md" |
        sed -e '$d' -e 's/^##/#/' \
            -e "s|^Figure, in .index.html.: |![Cost over time]($motion-cost-over-time.svg)\n\n|" \
            >"$peers/$motion-cost-over-time.md"
    python3 benchmarks/campaigns/picture.py "$kept/page-$motion-best-known/index.html" \
        "$peers/$motion-cost-over-time.svg"
done
{
    cat "$kept/page-reverse/results.csv"
    tail -n +2 "$kept/page-forward/results.csv"
} >"$peers/results.csv"
python3 benchmarks/campaigns/smac.py $data/peers-one-run.csv "$peers/results.csv" >"$peers/smac.md"
for what in barn cases; do
    page $what "$kept/$what.sqlite"
    cp "$kept/page-$what/summary.md" "$kept/page-$what/results.csv" "benchmarks/$date-$what/"
done
