#!/usr/bin/python3
"""Compares the changes of force that `frictab process` predicts with those of reruns (SYNTHETIC).

pairs.py JOB RUNS SYMMETRY [FRICTAB]
RUNS/LAW/contact.csv and tool.csv: a run of the process with each LAW of the job. Every law is the
one that was used, every other one is predicted from its contact states and compared with its own
run: mean force over the late half of the time, in % of the law that was used.
"""
import csv
import json
import subprocess
import sys
from pathlib import Path

BINS = ((0, 1), (1, 3), (3, 10), (10, 30), (30, 1000))  # |predicted|, %


def read_tool(path):
    with path.open() as file:
        rows = list(csv.DictReader(file))
    return [float(r["time_s"]) for r in rows], [float(r["force_kN"]) for r in rows]


def at(x, y, place):
    """Linear between the rows."""
    for i in range(1, len(x)):
        if x[i] >= place:
            return y[i - 1] + (y[i] - y[i - 1]) * (place - x[i - 1]) / (x[i] - x[i - 1])
    return y[-1]


def quantile(values, q):
    values = sorted(values)
    place = q * (len(values) - 1)
    low = int(place)
    return values[low] + (place - low) * (values[min(low + 1, len(values) - 1)] - values[low])


def judged(frictab, job, folder, law, symmetry):
    """process.json with this law as the one that was used."""
    command = [frictab, "process", job, str(folder / "contact.csv"), "--tool",
               str(folder / "tool.csv"), "--used", law, "--symmetry", symmetry, "--tests", "1",
               "--set", "process.resamples=0", "--json", "-q"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return json.loads(done.stdout)["process"]


def pairs_of(frictab, job, runs, symmetry):
    folders = {f.name: f for f in sorted(runs.iterdir()) if (f / "tool.csv").exists()}
    tools = {law: read_tool(folder / "tool.csv") for law, folder in folders.items()}
    for used, folder in folders.items():
        found = judged(frictab, job, folder, used, symmetry)
        times = found["time_s"]
        steps = [b - a for a, b in zip([tools[used][0][0]] + times, times)]
        late = [(t, dt) for t, dt in zip(times, steps) if t >= times[-1] / 2]
        mean = {law: sum(dt * at(*tool, t) for t, dt in late) for law, tool in tools.items()}
        for law in found["assessment"]["laws"]:
            if law["law"] != used and law["law"] in tools:
                yield (law["late_percent"], 100 * (mean[law["law"]] / mean[used] - 1),
                       law["late_percent_range"])


def main(job, runs, symmetry, frictab):
    pairs = list(pairs_of(frictab, job, Path(runs), symmetry))
    print(f"{runs}: {len(pairs)} pairs, SYNTHETIC")
    print("|predicted| %   pairs  sign right  median error   90 %   in the range   true/predicted 10, 50, 90 %")
    for low, high in BINS:
        inside = [p for p in pairs if low <= abs(p[0]) < high]
        if not inside:
            continue
        errors = [abs(p - t) for p, t, _ in inside]
        ratios = [t / p for p, t, _ in inside if abs(p) > 0.2] or [float("nan")]
        print(f"{low:4} to {high:<5} {len(inside):7} {sum(p * t > 0 for p, t, _ in inside):10} "
              f"{quantile(errors, 0.5):13.2f} {quantile(errors, 0.9):8.2f} "
              f"{100 * sum(r[0] <= t <= r[1] for _, t, r in inside) / len(inside):11.0f} %   "
              + "  ".join(f"{quantile(ratios, q):5.2f}" for q in (0.1, 0.5, 0.9)))
    said = [p for p in pairs if abs(p[0]) >= 1]
    right = sum(p * t > 0 for p, t, _ in said)
    inside = sum(r[0] <= t <= r[1] for _, t, r in pairs)
    print(f"sign right where 1 % or more is said: {right} of {len(said)}; "
          f"in the range shown: {inside} of {len(pairs)}")
    return right < 0.99 * len(said) or inside < 0.9 * len(pairs)


if __name__ == "__main__":
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:4], sys.argv[4] if len(sys.argv) == 5 else "frictab"))
