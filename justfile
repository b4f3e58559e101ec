# Each recipe is a script of its own: just is not needed.

# Formatting, lints and unit tests.
quick:
    .ci/quick

# What protects main.
ci:
    .ci/run

# What takes too long for every change.
nightly:
    .ci/nightly

# Every fuzz target for so many seconds.
fuzz seconds="60" *targets:
    .ci/fuzz {{seconds}} {{targets}}
