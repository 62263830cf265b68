"""Batch queries: a generated C library against scipy's RegularGridInterpolator, in one run.

usage: /usr/bin/python3 tests/bench/kernels_against_scipy.py build/dev/tests/frictab_bench

The bench program writes the table (17x9x9x9x17 nodes on arbitrary axes, random values: synthetic)
and its generated source, which is compiled here by the command of its recipe. Both evaluate the
same 262,144 random states; the values must agree. Thread CPU time, the smallest of the rounds.
"""
import ctypes
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.interpolate import RegularGridInterpolator

STATES = 262144
AXES = ["sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C", "s_mm"]


def smallest(work, rounds):
    times = []
    for _ in range(rounds):
        start = time.thread_time_ns()
        result = work()
        times.append((time.thread_time_ns() - start) / STATES)
    return min(times), result


def library(directory):
    """The batch entry, compiled as the recipe says."""
    recipe = json.loads((directory / "recipe.json").read_text())
    command = [line for line in recipe["compile"] if "-shared" in line][0]
    subprocess.run(command.split(), cwd=directory, check=True)
    batch = ctypes.CDLL(str(directory / "libfrictab_tau_R.so")).frictab_tau_R_batch
    pointer = np.ctypeslib.ndpointer(dtype=np.float64, flags="C_CONTIGUOUS")
    batch.argtypes = [ctypes.c_size_t] + [pointer] * 5 + [ctypes.c_void_p, pointer]
    batch.restype = None
    return batch


def main():
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        subprocess.run([sys.argv[1], f"--write={name}"], check=True)
        table = json.loads((directory / "table.json").read_text())
        nodes = [np.array(table["nodes"][axis]) for axis in AXES]
        value = np.array(table["value"]).reshape([len(x) for x in nodes])
        batch = library(directory)
        random = np.random.default_rng(1)
        states = random.random((STATES, len(AXES)))
        columns = [np.ascontiguousarray(states[:, d]) for d in range(len(AXES))]
        tau = np.empty(STATES)
        ours, _ = smallest(lambda: batch(STATES, *columns, None, tau), 30)
        peer = RegularGridInterpolator(nodes, value, method="linear")
        theirs, truth = smallest(lambda: peer(states), 5)
        worst = float(np.max(np.abs(tau - truth)))
        if worst > 1e-13:
            sys.exit(f"values differ by {worst}")
        print(f"{value.size:,} nodes, batches of {STATES:,} states, largest difference {worst:.1e}")
        print(f"generated C, -O2: {ours:.1f} ns per state; scipy: {theirs:.0f} ns; "
              f"ratio {ours / theirs:.3f}")


if __name__ == "__main__":
    main()
