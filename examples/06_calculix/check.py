#!/usr/bin/python3
"""Compares the shear stress at every contact point of CalculiX with tau_R of the generated routine.

Usage: check.py sliding.dat libfrictab.so TOLERANCE [psi T sigma_f]
The points are those of the last increment of each step of deck.py; the slip speed taken is
the prescribed one. Exit code 1: a point is further off than TOLERANCE (a difference of tau/p).
"""
import ctypes
import re
import sys

from deck import PRESSURES, SPEEDS, STEP


def contact_stresses(path):
    """(time, [(pressure, shear stress), ...]) per increment, from what *CONTACT PRINT wrote."""
    found, current = [], None
    for line in open(path):
        title = re.search(r"^ contact stress .* time +(\S+)", line)
        words = line.split()
        if title:
            current = []
            found.append((float(title.group(1)), current))
        elif words and (len(words) != 5 or not words[0].isdigit()):
            current = None  # the next block
        elif words and current is not None:
            pressure, first, second = map(float, words[2:])
            current.append((pressure, (first**2 + second**2) ** 0.5))
    return found


def main():
    path, library, tolerance = sys.argv[1], sys.argv[2], float(sys.argv[3])
    psi, temperature, sigma_f = map(float, sys.argv[4:7]) if len(sys.argv) > 6 else (2, 150, 480)
    routine = ctypes.CDLL(library).frictab_tau_R
    routine.restype = ctypes.c_double
    routine.argtypes = [ctypes.c_double] * 6
    last = {}
    for time, points in contact_stresses(path):
        last[round(time / STEP, 6)] = points
    worst_of_all = 0.0
    print("speed mm/s  points  pressure MPa      tau/p             largest |tau/p - tau_R/p|")
    slid = 0.0
    for step, speed in enumerate(SPEEDS, 1):
        points = [p for p in last[float(step + 1)] if p[0] > 0]
        slid += speed * STEP
        ratios, worst = [], 0.0
        for p, tau in points:
            law = routine(p, psi, speed, temperature, slid, sigma_f) / p
            ratios.append(tau / p)
            worst = max(worst, abs(tau / p - law))
        pressures = [p for p, _ in points]
        print(f"{speed:9}  {len(points):6}  {min(pressures):6.1f} .. {max(pressures):6.1f}  "
              f"{min(ratios):.5f} .. {max(ratios):.5f}  {worst:.1e}")
        worst_of_all = max(worst_of_all, worst)
    print(f"largest of all: {worst_of_all:.1e} (allowed {tolerance:g}), {PRESSURES} MPa pressed")
    return worst_of_all > tolerance


if __name__ == "__main__":
    sys.exit(main())
