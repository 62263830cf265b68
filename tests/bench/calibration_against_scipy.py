#!/usr/bin/python3
"""Fits of the closed-form laws against scipy.optimize.least_squares, in turns, on the same rows.

usage: calibration_against_scipy.py BENCH_PROGRAM [ROUNDS]   (built from calibration_times.cpp)
Needs Debian's python3-scipy. The rows are synthetic (frictab's twin, 44,550 of them). scipy: method
'lm' with its own differences for L2 and soft_l1 (f_scale 0.1 MPa) for L1, default tolerances, from
the laws' default starts, logarithms computed beforehand and not timed. Both sides: best wall time
of the rounds on one thread. The ratio leaves out, on both sides, what is prepared from the columns
(logarithms; frictab's thinned copies), and frictab's standard errors. The gate: frictab's
half mean square (L2) or mean absolute error (L1) is nowhere more than 1e-6 above scipy's.
"""
import csv
import os
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.optimize import least_squares


def laws(d):
    s, psi, v, T, sf = (d[n] for n in ("sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C",
                                       "sigma_f_MPa"))
    k = sf / np.sqrt(3)
    ls, lpsi, lv, lT = np.log(s / 1000), np.log(psi), np.log(v / 100), np.log(T / 100)
    wp, wv, wT = (np.log(np.maximum(x, low) / at)
                  for x, low, at in ((s, 1, 1000), (v, 10, 100), (T, 20, 100)))
    lev = k * (1 - np.exp(-1.25 * s / sf))
    q = s / sf

    def limited(tau):
        return np.minimum(np.maximum(tau, 0), k)

    def shaw(p):
        u = np.maximum(p[0] * s / (p[1] * k), 1e-100)
        ln_u = np.log(u)
        w_n = np.exp(-p[2] * np.abs(ln_u))
        return limited(p[1] * k * np.minimum(u, 1) * np.exp(-np.log1p(w_n) / p[2]))

    def wanheim_bay(p):
        f = p[0]
        root = np.sqrt(1 - f)
        t1 = 1 - root
        q1 = (1 + np.pi / 2 + np.arccos(f) + np.sqrt(1 - f * f)) / (np.sqrt(3) * (1 + root))
        curve = t1 * (1 + root * (1 - np.exp(np.minimum(1 - q / q1, 0) / root)))
        return limited(k * np.where(q <= q1, t1 * q / q1, curve))

    return {
        "coulomb": ([0.08], lambda p: limited(p[0] * s)),
        "shear": ([0.12], lambda p: limited(p[0] * k)),
        "orowan": ([0.08, 0.3], lambda p: limited(np.minimum(p[0] * s, p[1] * k))),
        "shaw": ([0.1, 0.5, 2], shaw),
        "wanheim_bay": ([0.3], wanheim_bay),
        "levanov": ([0.2], lambda p: limited(p[0] * lev)),
        "log_coulomb": ([0.08, 0, 0, 0, 0], lambda p: limited(
            s * (p[0] + p[1] * ls + p[2] * lpsi + p[3] * lv + p[4] * lT))),
        "exp_coulomb": ([0.08, 0, 0], lambda p: limited(s * p[0] * np.exp(p[1] * ls +
                                                                         p[2] * (T - 20)))),
        "wzl": ([0.0198, -0.1542, -0.1192, 0.1017], lambda p: limited(
            s * p[0] * np.exp(p[1] * wp + p[2] * wv + p[3] * wT))),
    }


BOUNDS = {"shaw": ([0, 1e-3, 0.5], [2, 1, 20]), "wanheim_bay": ([1e-4], [1])}


def fit(name, start, tau, measured, loss):
    """scipy's own choice: 'lm' where it can, 'trf' where a law has bounds that matter or for L1."""
    options = {}
    if loss == "L1":
        options = {"loss": "soft_l1", "f_scale": 0.1}
    elif name not in BOUNDS:
        options = {"method": "lm"}
    if name in BOUNDS:
        options["bounds"] = BOUNDS[name]
    return least_squares(lambda p: tau(p) - measured, start, **options).x


def cost(residual, loss):
    return np.mean(residual ** 2) / 2 if loss == "L2" else np.mean(np.abs(residual))


def main():
    program, rounds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 3
    with tempfile.TemporaryDirectory() as directory:
        file = os.path.join(directory, "twin.csv")
        ours, theirs = {}, {}
        for turn in range(rounds):
            out = subprocess.run([program, file, "3"], check=True, capture_output=True, text=True)
            for line in out.stdout.splitlines():
                name, loss, prepare, fit_ms, errors, *p = line.split()
                best = ours.get((name, loss), ([1e9] * 3, None))[0]
                times = [min(a, float(b)) for a, b in zip(best, (prepare, fit_ms, errors))]
                ours[name, loss] = (times, [float(x) for x in p])
            if turn == 0:
                with open(file, encoding="utf-8") as lines:
                    rows = list(csv.DictReader(lines))
                needed = ("sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C", "sigma_f_MPa",
                          "tau_R_MPa")
                data = {n: np.array([float(r[n]) for r in rows]) for n in needed}
                models = laws(data)
            for name, loss in ours:
                if name == "all":
                    continue
                start, tau = models[name]
                begin = time.perf_counter()
                p = fit(name, start, tau, data["tau_R_MPa"], loss)
                ms = 1e3 * (time.perf_counter() - begin)
                theirs[name, loss] = (min(ms, theirs.get((name, loss), (1e9,))[0]), p)
    worse = 0
    for wanted in ("L2", "L1"):
        sums = np.zeros(4)
        for (name, loss), (times, p) in ours.items():
            if loss != wanted or name == "all":
                continue
            tau = models[name][1]
            scipy_ms, scipy_p = theirs[name, loss]
            gap = (cost(tau(p) - data["tau_R_MPa"], loss) /
                   cost(tau(scipy_p) - data["tau_R_MPa"], loss) - 1)
            worse += gap > 1e-6
            sums += (*times, scipy_ms)
            print(f"{loss} {name:12s} frictab {times[1]:6.2f} ms (preparing {times[0]:5.2f}, errors "
                  f"{times[2]:5.2f}), scipy {scipy_ms:6.1f} ms, ratio {scipy_ms / times[1]:5.1f}, "
                  f"frictab's loss over scipy's {gap:+.1e}")
        print(f"{wanted} sum          frictab {sums[1]:6.2f} ms (preparing {sums[0]:5.2f}, errors "
              f"{sums[2]:5.2f}), scipy {sums[3]:6.1f} ms, ratio {sums[3] / sums[1]:5.1f}; with all "
              f"that is in brackets {sums[3] / sums[:3].sum():.1f}")
        print(f"{wanted} all of frictab's at once on {os.cpu_count()} cores: "
              f"{ours['all', wanted][0][1]:.2f} ms")
    print("frictab's loss is nowhere more than 1e-6 above scipy's" if not worse else
          f"{worse} fits are worse than scipy's by more than 1e-6")
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
