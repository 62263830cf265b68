#!/usr/bin/python3
"""Adds columns that friction does not follow to a campaign of `frictab twin`: what a rig records
besides. Synthetic. Of every ten, six vary within tests (drifts, waves, noise, a lag of the stroke),
three are constant within a test, one is text; the same seed makes the same columns.

Usage: wide_campaign.py CAMPAIGN [COLUMNS]      285 columns where it is not said; CAMPAIGN has
                                                training.csv and validation.csv, which are changed
"""
import csv
import math
import pathlib
import random
import sys


def within(draw, kind, position, stroke):
    """A channel along one test."""
    level, size = draw.gauss(0, 1), draw.uniform(0.5, 2)
    if kind == 0:  # drifts, with noise
        value, channel = level, []
        for _ in position:
            value += size * draw.gauss(0, 0.05)
            channel.append(value + draw.gauss(0, 0.1))
        return channel
    if kind == 1:  # a wave of its own in each test
        waves, phase = draw.uniform(0.5, 4), draw.uniform(0, 2 * math.pi)
        return [level + size * math.sin(2 * math.pi * waves * x + phase) for x in position]
    if kind == 2:  # noise
        return [level + size * draw.gauss(0, 1) for _ in position]
    return [level + size * (1 - math.exp(-s / draw.uniform(2.9, 3.1))) for s in stroke]  # lags


def columns_of(index, seed, tests):
    """Name, and the values of each test."""
    draw = random.Random(f"{seed} {index}")
    tenth = index % 10
    if tenth == 9:
        levels = [f"level_{i}" for i in range(2 + index // 10 % 4)]
        return f"label_{index}", [[draw.choice(levels)] * len(rows) for rows in tests]
    if tenth >= 6:
        one = (lambda: draw.gauss(10, 2)) if tenth < 8 else lambda: math.exp(draw.gauss(0, 0.7))
        return f"set_{index}", [[f"{one():.5g}"] * len(rows) for rows in tests]
    values = []
    for rows in tests:
        last = max(len(rows) - 1, 1)
        channel = within(draw, index % 4, [i / last for i in range(len(rows))],
                         [float(row["s_mm"]) for row in rows])
        values.append([f"{x:.5g}" for x in channel])
    return f"channel_{index}", values


def widen(path, count):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    tests = {}
    for row in rows:
        tests.setdefault(row["experiment"], []).append(row)
    tests = list(tests.values())
    for index in range(count):
        name, values = columns_of(index, path.stem, tests)
        for test, channel in zip(tests, values):
            for row, value in zip(test, channel):
                row[name] = value
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)


for part in ("training.csv", "validation.csv"):
    widen(pathlib.Path(sys.argv[1]) / part, int(sys.argv[2]) if len(sys.argv) > 2 else 285)
