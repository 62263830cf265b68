#!/usr/bin/python3
"""What calibrating and tracing cost, by tests, rows per test and columns: processor seconds and
peak memory on one core. Synthetic campaigns (`frictab twin`), with the job that comes with them; a
trace calibrates first, and repeats its search in folds where it has found something.

Usage: scale_table.py FRICTAB [ROW ...]      all rows of SIZES where none is named, "81x550x300"
"""
import os
import pathlib
import subprocess
import sys
import tempfile

SIZES = ["81x550", "81x5500", "81x55000", "810x550", "2025x22", "2025x550", "8100x55", "81x550x300"]
OWN_COLUMNS = 15  # those of the twin; wide_campaign.py adds the others


def cost(work, command, size):
    """Processor seconds and peak MiB of one command."""
    process = subprocess.Popen([FRICTAB, command, "job.toml", "-j1", "-q", "-o", f"{command}_out"],
                               cwd=work, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        sys.exit(f"{command} of {size} failed")
    return f"{usage.ru_utime + usage.ru_stime:.1f} s, {usage.ru_maxrss / 1024:,.0f} MiB"


def campaign(work, size):
    tests, rows, *columns = (int(n) for n in size.split("x"))
    subprocess.run([FRICTAB, "twin", ".", "-q", "--design",
                    f"replicates={tests // 81};points={rows}"],
                   cwd=work, stdout=subprocess.DEVNULL, check=True)
    if columns:
        subprocess.run([sys.executable, pathlib.Path(__file__).with_name("wide_campaign.py"), work,
                        str(columns[0] - OWN_COLUMNS)], check=True)


FRICTAB = str(pathlib.Path(sys.argv[1]).resolve())
for size in sys.argv[2:] or SIZES:
    with tempfile.TemporaryDirectory() as folder:
        campaign(folder, size)
        print(f"{size}: calibrate {cost(folder, 'calibrate', size)}; "
              f"trace {cost(folder, 'trace', size)}; load {os.getloadavg()[0]:.1f}", flush=True)
