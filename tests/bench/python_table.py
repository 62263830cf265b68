"""Processor time of a million rows of a table in Python, by its C routine and by numpy.

Usage: FRICTAB=PROGRAM PYTHONPATH=python tests/bench/python_table.py TABLE.h5
"""
import os
import statistics
import sys
import time

import numpy as np

import frictab

ROWS = 10**6


def seconds(table, states):
    begin = time.process_time()
    table.tau_R(states)
    return time.process_time() - begin


table = frictab.open_table(sys.argv[1])
draw = np.random.default_rng(1)
states = {i.name: draw.uniform(i.low, i.high, ROWS) if np.isfinite(i.high - i.low) else
          draw.uniform(300.0, 500.0, ROWS) for i in table.inputs}
print(f"{len(table.axes)} axes of {table.value.shape} nodes, {table.interpolation}, {ROWS} rows; "
      f"kernel: {table.kernel}")
for choice, times in (("c", 9), ("numpy", 1)):
    os.environ["FRICTAB_PYTHON_KERNEL"] = choice
    seconds(table, {n: x[:9] for n, x in states.items()})
    all_of_them = [seconds(table, states) for _ in range(times)]
    print(f"{choice:5} {min(all_of_them):.3f} s, median {statistics.median(all_of_them):.3f} s")
