#!/usr/bin/python3
"""What values in the source cost, and in a file beside it: seconds and memory to compile, size of
the object, seconds of the first call. Synthetic campaign.

Usage: large_tables.py FRICTAB
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

MAIN = """
#include <stdio.h>
#include <time.h>
#include "frictab_tau_R.h"
int main(void) {
  struct timespec a, b;
  double tau;
  timespec_get(&a, TIME_UTC);
  tau = frictab_tau_R(1000, 2, 50, 100, 0, 480);
  timespec_get(&b, TIME_UTC);
  printf("%.4f %.9g", b.tv_sec - a.tv_sec + 1e-9 * (b.tv_nsec - a.tv_nsec), tau);
  return 0;
}
"""


def measure(frictab, work, nodes, choice):
    sets = [f"table.axes.{axis}.nodes={n}" for axis, n in
            zip(("sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C"), nodes)]
    sets += ['table.interpolation="linear"', 'export.targets=["c","fortran"]',
             f'export.options.values="{choice}"', 'table.model="log_coulomb"']
    arguments = [word for text in sets for word in ("--set", text)]
    for command in ("tabulate", "export"):
        subprocess.run([frictab, command, "job.toml", "-q", *arguments], cwd=work, check=True,
                       stdout=subprocess.DEVNULL)
    for target, source, compiler in (("c", "frictab_tau_R.c", "gcc"),
                                     ("fortran", "frictab_tau_R.f90", "gfortran")):
        directory = work / "out" / "export" / target
        (directory / "main.c").write_text(MAIN)
        header = work / "out" / "export" / "c" / "frictab_tau_R.h"
        if target == "fortran":
            (directory / header.name).write_text(header.read_text())
        start = time.perf_counter()
        process = subprocess.Popen([compiler, "-O2", "-ffp-contract=off", "-c", source, "-o",
                                    "law.o"], cwd=directory)
        _, status, usage = os.wait4(process.pid, 0)  # with the compiler proper below its driver
        if status:
            sys.exit(f"{compiler} failed")
        seconds, mib = time.perf_counter() - start, usage.ru_maxrss / 1024
        size = (directory / "law.o").stat().st_size / 2**20
        subprocess.run(["gcc", "main.c", "law.o", "-o", "first", "-lgfortran", "-lm"],
                       cwd=directory, check=True)
        first = subprocess.run(["./first"], cwd=directory, check=True, capture_output=True,
                               text=True).stdout
        count = 1
        for n in nodes:
            count *= n
        print(f"{count:>12,} nodes  {choice:<7} {compiler:<9} {seconds:6.1f} s  "
              f"{mib:6.0f} MiB  object {size:7.2f} MiB  first call {first.split()[0]} s")


def main():
    frictab = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        subprocess.run([frictab, "twin", "data", "--seed", "3"], cwd=work, check=True,
                       stdout=subprocess.DEVNULL)
        (work / "job.toml").write_text('[data]\ntraining = "data/training.csv"\n'
                                       '[models]\nuse = ["log_coulomb"]\n')
        subprocess.run([frictab, "calibrate", "job.toml", "-q"], cwd=work, check=True,
                       stdout=subprocess.DEVNULL)
        for nodes, choice in (((10, 10, 10, 20), "file"), ((10, 10, 10, 20), "source"),
                              ((20, 20, 25, 29), "file"), ((40, 50, 60, 100), "file"),
                              ((20, 20, 25, 29), "source")):
            measure(frictab, work, nodes, choice)


if __name__ == "__main__":
    main()
