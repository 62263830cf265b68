#!/usr/bin/python3
"""Rows per second of frictab's reader against pandas.read_csv, in turns, on the same files.

usage: csv_reader.py BENCH_PROGRAM [ROUNDS]      (BENCH_PROGRAM: built from csv_reader.cpp)
Best wall time of ROUNDS of five; frictab's includes mapping, checks and derived columns, pandas' does not.
"""
import os
import subprocess
import sys
import tempfile
import time

import numpy
import pandas


def campaign(rows=44550, experiments=81):
    random = numpy.random.default_rng(1)
    per = rows // experiments
    table = {"experiment": numpy.repeat(numpy.arange(experiments), per),
             "time_s": numpy.tile(numpy.arange(per) * 0.01, experiments)}
    ranges = {"sigma_n_MPa": (500, 2750), "psi": (1, 20), "v_rel_mm_s": (5, 500),
              "T_contact_C": (20, 200), "T_tool_C": (20, 200), "s_mm": (0, 20),
              "sigma_f_MPa": (300, 900), "tau_R_MPa": (10, 200), "F_R_N": (1, 9),
              "F_N_N": (10, 99), "room_C": (18, 25), "humidity_pct": (30, 60)}
    for name, (low, high) in ranges.items():
        table[name] = random.uniform(low, high, rows)
    table["lot"] = numpy.where(numpy.arange(rows) % 2, "A", "B")
    return pandas.DataFrame(table)


def main():
    program, rounds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 7
    table = campaign()
    with tempfile.TemporaryDirectory() as directory:
        for name, data in (("4 decimals", table.round(4)), ("17 digits", table)):
            file = os.path.join(directory, "rows.csv")
            data.to_csv(file, index=False)
            ours, theirs = [], []
            for _ in range(rounds):
                ours.append(float(subprocess.run([program, file], check=True, capture_output=True,
                                                 text=True).stdout))
                for _ in range(5):  # as often as the program reads it
                    start = time.perf_counter()
                    pandas.read_csv(file)
                    theirs.append(time.perf_counter() - start)
            print(f"{name}: {len(data)} x {data.shape[1]}, frictab {min(ours) * 1e3:.1f} ms "
                  f"({len(data) / min(ours):,.0f} rows/s), pandas {pandas.__version__} "
                  f"{min(theirs) * 1e3:.1f} ms ({len(data) / min(theirs):,.0f} rows/s), "
                  f"ratio {min(theirs) / min(ours):.2f}")


if __name__ == "__main__":
    main()
