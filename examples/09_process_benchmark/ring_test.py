#!/usr/bin/python3
"""The constant of a friction law from a ring test: inverse analysis on top of this example.

Usage: ring_test.py PROGRAM FOLDER     demonstration on SYNTHETIC rings with known constants
       ring_test.py PROGRAM FOLDER LAW RING.csv [OPTION NUMBER]...
                                       LAW shear or coulomb; RING.csv with the columns reduction
                                       (share of the height), inner_diameter_mm, force_kN; the
                                       options of process_benchmark: geometry, flow curve, speed

A ring that is compressed in steps gives inner diameter d and force F over the height. The constant
c of the law is the one whose ring, computed by PROGRAM, comes closest:
    min_c  sum ((d(c) - d_i)/0.02 mm)^2 + sum ((F(c)/F_i - 1)/0.5 %)^2
by Gauss-Newton, the derivative by a difference: c is one number, so that an iteration costs two
rings. Its standard error is (sum J^2)^-1/2. The diameter hardly depends on the flow curve; the
force does, and is only as good as that. With the right law the mean square of a residual is about 1; a
law whose best ring leaves much more is not the law of the test.
"""
import csv
import random
import subprocess
import sys
from pathlib import Path

DIAMETER, FORCE = 0.02, 0.005  # mm and share: what a ring test may be measured to
HEIGHTS = (0.1, 0.2, 0.3, 0.4, 0.5)
START, HIGHEST = {"shear": 0.2, "coulomb": 0.08}, {"shear": 1.0, "coulomb": 0.577}


def simulate(program, folder, law, constant, options):
    """The ring as a function: reduction -> (inner diameter in mm, force in kN)."""
    name = str(folder / "ring")
    subprocess.run([program, "ring", "--law", f"{law}:{constant:.12f}", "--output", name,
                    "--columns", "8", "--rows", "4", *options], check=True,
                   stdout=subprocess.DEVNULL)
    with open(name + "_force.csv") as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]

    def at(reduction):
        for a, b in zip(rows, rows[1:]):
            if b["reduction"] >= reduction - 1e-9:
                part = (reduction - a["reduction"]) / (b["reduction"] - a["reduction"])
                radius, force = (a[k] + part * (b[k] - a[k]) for k in ("inner_mid_mm", "force_kN"))
                return 2 * radius, force
        raise ValueError(f"the ring was not compressed to {reduction}")

    return at


def residuals(program, folder, law, constant, data, options):
    ring = simulate(program, folder, law, constant, options)
    values = []
    for reduction, diameter, force in data:
        d, f = ring(reduction)
        values += [(d - diameter) / DIAMETER, (f / force - 1) / FORCE]
    return values


def fit(program, folder, law, data, options):
    """(constant, standard error, mean square of a residual, rings computed)."""
    c, rings = START[law], 0
    for _ in range(12):
        step = 0.01 * c + 1e-4
        here = residuals(program, folder, law, c, data, options)
        there = residuals(program, folder, law, c + step, data, options)
        rings += 2
        slope = [(b - a) / step for a, b in zip(here, there)]
        square = sum(s * s for s in slope)
        change = -sum(s * r for s, r in zip(slope, here)) / square
        change = max(-0.5 * c, min(change, 0.5 * c + 0.02, HIGHEST[law] - step - c))
        c += change
        if abs(change) < 1e-5:
            break
    mean_square = sum(r * r for r in here) / (len(here) - 1)
    return c, square ** -0.5, mean_square, rings


def demonstrate(program, folder):
    print("SYNTHETIC rings: scatter 0.02 mm and 0.5 %, five heights\n")
    print("| ring made with | fitted law | constant | standard error | mean square residual "
          "| rings |")
    print("|---|---|--:|--:|--:|--:|")
    for truth, constant in (("shear", 0.17), ("coulomb", 0.073)):
        exact = simulate(program, folder, truth, constant, [])
        noise = random.Random(1)
        data = {"no scatter": [(h, *exact(h)) for h in HEIGHTS],
                "scatter": [(h, exact(h)[0] + noise.gauss(0, DIAMETER),
                             exact(h)[1] * (1 + noise.gauss(0, FORCE))) for h in HEIGHTS]}
        for kind, rows in data.items():
            for law in ("shear", "coulomb"):
                c, error, square, rings = fit(program, folder, law, rows, [])
                print(f"| {truth} {constant:g}, {kind} | {law} | {c:.5f} | {error:.5f} | "
                      f"{square:.2g} | {rings} |", flush=True)


def main():
    if len(sys.argv) < 3 or len(sys.argv) == 4:
        sys.exit(__doc__)
    program, folder = sys.argv[1], Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    if len(sys.argv) == 3:
        demonstrate(program, folder)
        return
    law, options = sys.argv[3], sys.argv[5:]
    if law not in START:
        sys.exit("ring_test.py: LAW must be shear or coulomb")
    with open(sys.argv[4]) as file:
        data = [tuple(float(row[k]) for k in ("reduction", "inner_diameter_mm", "force_kN"))
                for row in csv.DictReader(file)]
    c, error, square, rings = fit(program, folder, law, data, options)
    print(f"{law}: {c:.5f} +- {error:.5f}, mean square of a residual {square:.2g}, {rings} rings")


if __name__ == "__main__":
    main()
