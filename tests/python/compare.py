"""Compares the package frictab with frictab itself.

Usage: compare.py DIRECTORY   of NAME.h5 (tables) or NAME.json (laws), each with NAME.csv, tabs
between: a column per input, tau_R_MPa, and for each axis and held input outside:NAME (1 where a
state lies outside). Prints a line for each file that differs, then "ok" and the count.
"""
import pathlib
import sys
import warnings

import numpy as np

import frictab


def read_columns(file):
    lines = file.read_text().splitlines()
    numbers = [[float(cell) for cell in line.split("\t")] for line in lines[1:]]
    return dict(zip(lines[0].split("\t"), np.array(numbers).T))


def difference(made, wanted):
    """Largest relative one; infinite where one is NaN and the other is not."""
    if not np.array_equal(np.isnan(made), np.isnan(wanted)):
        return np.inf
    return np.nanmax(np.abs(made - wanted) / np.maximum(np.abs(wanted), 1e-3))


def compare(file):
    columns = read_columns(file.with_suffix(".csv"))
    wanted = columns.pop("tau_R_MPa")
    outside = {n.split(":")[1]: columns.pop(n) for n in list(columns) if n.startswith("outside:")}
    law = frictab.open(file) if file.suffix == ".h5" else frictab.read_model(file)
    assert {i.name for i in law.inputs} == set(columns), (file.name, law.inputs)
    off = difference(law.tau_R(columns), wanted)
    if off > 1e-12:
        print(f"{file.name}: differs by {off:.1e}")
    sides = law.outside(columns)
    for name, bits in outside.items():
        if not np.array_equal(sides[name] != 0, bits != 0):
            print(f"{file.name}: differs on what lies outside along {name}")
    return off


with warnings.catch_warnings():
    warnings.simplefilter("ignore", frictab.OutsideWarning)
    files = sorted(f for f in pathlib.Path(sys.argv[1]).iterdir() if f.suffix in (".h5", ".json"))
    largest = max(compare(file) for file in files)
print("ok" if largest <= 1e-12 else "differs", len(files), f"largest {largest:.1e}")
