"""The other side of benches/compare/vegas: `peaks.py default|sum SEED` prints seconds and estimates;
`peaks.py summary FILE` compares."""

import sys
import time
from math import erf, pi, sqrt

import numpy as np
import vegas

CENTRES = np.array([[0.5, 0.5, 0.5, 0.5], [0.4, 0.6, 0.5, 0.45], [0.7, 0.35, 0.6, 0.55]])
SHARPNESS = 50.0


def exact():
    """The integrals: products of error functions."""
    root = sqrt(SHARPNESS)
    side = lambda c: sqrt(pi) / (2 * root) * (erf(root * (1 - c)) + erf(root * c))
    return np.array([np.prod([side(c) for c in centre]) for centre in CENTRES])


@vegas.lbatchintegrand
def default(x):
    f = np.empty((len(x), 3))
    for k, centre in enumerate(CENTRES):
        f[:, k] = np.exp(-SHARPNESS * ((x - centre) ** 2).sum(axis=1))
    return f


@vegas.lbatchintegrand
def summed(x):
    f = default(x)
    return np.column_stack([f.sum(axis=1), f])


def sample(setting, seed):
    """One run: iterations to adapt, which are thrown away, then ten to count."""
    np.random.seed(seed)
    integrand = summed if setting == "sum" else default
    start = time.perf_counter()
    integrator = vegas.Integrator(4 * [[0, 1]])
    integrator(integrand, nitn=5, neval=20_000)
    result = integrator(integrand, nitn=10, neval=150_000)
    seconds = time.perf_counter() - start
    print(seconds, *(output.mean for output in result[-3:]))


def summary(path):
    rows = {}
    for line in open(path):
        side, *numbers = line.split()
        rows.setdefault(side, []).append([float(number) for number in numbers])
    print(f"{'':16}{'seconds':>9}{'output 0':>11}{'output 1':>11}{'output 2':>11}   relative error, root mean square")
    at_equal_time = {}
    for side, runs in rows.items():
        seconds, values = np.array(runs)[:, 0], np.array(runs)[:, 1:]
        error = np.sqrt(np.mean((values / exact() - 1) ** 2, axis=0))
        at_equal_time[side] = error * sqrt(np.mean(seconds))
        print(f"{side:16}{np.mean(seconds):9.3f}" + "".join(f"{e:11.2e}" for e in error))
    for side in ("default", "sum"):
        ratio = at_equal_time[side] / at_equal_time["ours"]
        print(f"{side + '/ours':16}{'':9}" + "".join(f"{r:11.1f}" for r in ratio) + "   at equal time")
    better = np.minimum(at_equal_time["default"], at_equal_time["sum"]) / at_equal_time["ours"]
    print(f"{'better/ours':16}{'':9}" + "".join(f"{r:11.1f}" for r in better) + "   the better setting of each output")
    worst = min(at_equal_time["default"].max(), at_equal_time["sum"].max()) / at_equal_time["ours"].max()
    print(f"the better setting's worst output against our worst: {worst:.1f}")


if sys.argv[1] == "summary":
    summary(sys.argv[2])
else:
    sample(sys.argv[1], int(sys.argv[2]))
