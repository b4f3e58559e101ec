#!/usr/bin/env python3
"""Reference values for tests/statistics.rs, written to statistics.json beside this file.

Needs SciPy and, for Holm's correction, statsmodels; their versions stand in the file.
"""

import json
import pathlib

import numpy as np
import scipy
import statsmodels
from scipy import stats
from statsmodels.stats.multitest import multipletests

random = np.random.default_rng(20241126)


def wilson():
    for n in (1, 2, 3, 10, 31, 100, 1000, 99999):
        for n_success in sorted({0, 1, n // 3, n // 2, n - 1, n}):
            interval = stats.binomtest(n_success, n).proportion_ci(0.95, "wilson")
            yield {"n_success": n_success, "n": n, "low": interval.low, "high": interval.high}


def differences():
    """Samples with and without ties and noughts, from two to a thousand differences."""
    for n in (1, 2, 3, 5, 8, 10, 13, 14, 20, 31, 50, 51, 75, 310, 1000):
        for shift in (0.0, 0.4, -1.5):
            yield random.normal(shift, 1.0, n)
    for n in (2, 4, 7, 10, 13, 14, 20, 31, 50, 51, 120, 310):
        for shift in (0, 1):
            values = random.integers(-4 + shift, 5 + shift, n).astype(float)
            if np.any(values != 0.0):
                yield values
    yield np.array([0.25] * 31)
    yield np.array([-0.25] * 10 + [0.0] * 21)


def wilcoxon():
    for sample in differences():
        rest = sample[sample != 0.0]
        test = stats.wilcoxon(rest, zero_method="wilcox", correction=False, method="auto")
        normal = stats.wilcoxon(rest, zero_method="wilcox", correction=False, method="asymptotic")
        yield {
            "differences": sample.tolist(),
            "n": len(rest),
            "statistic": float(test.statistic),
            "p": float(test.pvalue),
            "p_normal": float(normal.pvalue),
        }


def holm():
    for n in (1, 2, 3, 7, 21, 60):
        for scale in (1.0, 0.05):
            p = random.uniform(0.0, scale, n)
            if n > 2:
                p[1] = p[0]
            yield {"p": p.tolist(), "adjusted": multipletests(p, method="holm")[1].tolist()}


def vargha_delaney():
    for n, m in ((1, 1), (3, 5), (31, 31), (10, 200)):
        for continuous in (True, False):
            a, b = random.normal(0.3, 1.0, n), random.normal(0.0, 1.0, m)
            if not continuous:
                a, b = np.round(a), np.round(b)
            u = stats.mannwhitneyu(a, b).statistic
            yield {"a": a.tolist(), "b": b.tolist(), "probability": float(u) / (n * m)}


def quantiles():
    for n in (1, 2, 5, 31, 100):
        values = random.normal(0.0, 10.0, n)
        for p in (0.0, 0.025, 0.25, 0.5, 0.75, 0.975, 1.0):
            yield {"values": values.tolist(), "p": p, "quantile": float(np.quantile(values, p))}


reference = {
    "made_with": f"SciPy {scipy.__version__}, statsmodels {statsmodels.__version__}, NumPy {np.__version__}",
    "wilson": list(wilson()),
    "wilcoxon": list(wilcoxon()),
    "holm": list(holm()),
    "vargha_delaney": list(vargha_delaney()),
    "quantiles": list(quantiles()),
}
path = pathlib.Path(__file__).with_name("statistics.json")
with path.open("w") as file:
    file.write("{\n")
    parts = [
        json.dumps(name) + ": " + (
            json.dumps(value) if isinstance(value, str)
            else "[\n" + ",\n".join(json.dumps(case) for case in value) + "\n]"
        )
        for name, value in reference.items()
    ]
    file.write(",\n".join(parts) + "\n}\n")
