#!/usr/bin/python3
"""The benchmark table on several SYNTHETIC campaigns: validation MAE per law, mean and spread.

    /usr/bin/python3 tests/bench/twin_seeds.py build/release/frictab [SEEDS [FIRST]] [--twin=OPTIONS] [--distance] [--set KEY=VALUE ...]

SEEDS: how many seeds of `frictab twin`, default 10, from FIRST (1) on; --twin: options of it, "--set-name W --noise t4".
Each campaign has 81 experiments to train and 30 to validate, unless --twin says otherwise; the oracle
is the twin's noise-free stress. --distance: also the root-mean-square distance of each law from it on
the validation rows (slower).
"""
import csv
import io
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile


def distance(binary, where, law):
    """Of tau_R by a calibrated law from the noise-free stress, on the validation rows; MPa."""
    with open(f"{where}/validation_oracle.csv") as file:
        truth = [float(row["tau_oracle_MPa"]) for row in csv.DictReader(file)]
    text = subprocess.run([binary, "predict", f"{where}/out/models/{law}.json", f"{where}/validation.csv", "-q"],
                          check=True, capture_output=True, text=True).stdout
    rows = csv.DictReader(io.StringIO(text))
    return math.sqrt(statistics.mean((float(row["tau_R_MPa"]) - t) ** 2 for row, t in zip(rows, truth)))


def campaign(binary, seed, twin, more, distances):
    with tempfile.TemporaryDirectory() as where:
        def run(*arguments):
            subprocess.run([binary, *arguments], check=True, capture_output=True)
        run("twin", where, "--seed", str(seed), "--oracle", "--format", "csv" if distances is not None else "hdf5", "-q", *twin)
        run("calibrate", f"{where}/job.toml", "-q", "--set", "calibration.bootstrap=0", *more)
        result = json.loads(pathlib.Path(where, "out/calibration.json").read_text())
        for model in result["models"] if distances is not None else []:
            distances.setdefault(model["name"], []).append(distance(binary, where, model["name"]))
    errors = {m["name"]: m["validation"]["mae_MPa"] for m in result["models"]}
    floor = result["noise_floor"]
    assert floor["method"] == "oracle" and floor["part"] == "validation"
    errors["oracle"] = floor["mae_MPa"]
    return errors


def main():
    binary = str(pathlib.Path(sys.argv[1]).resolve())
    numbers = [a for a in sys.argv[2:] if a.isdigit()]
    twin = [w for a in sys.argv[2:] if a.startswith("--twin=") for w in a.removeprefix("--twin=").split()]
    more = [a for a in sys.argv[2:]
            if not a.isdigit() and not a.startswith("--twin=") and a != "--distance"]
    distances = {} if "--distance" in sys.argv else None
    first = int(numbers[1]) if len(numbers) > 1 else 1
    seeds = range(first, first + (int(numbers[0]) if numbers else 10))
    runs = [campaign(binary, seed, twin, more, distances) for seed in seeds]
    print(f"SYNTHETIC data, {len(runs)} seeds of frictab twin; validation MAE, MPa")
    print(f"{'law':<16}{'mean':>8}{'sd':>7}{'least':>8}{'most':>8}{'over the oracle':>18}{'sd':>7}")
    for law in sorted(runs[0], key=lambda name: statistics.mean(r[name] for r in runs)):
        values = [r[law] for r in runs]
        over = [100 * (r[law] / r["oracle"] - 1) for r in runs]
        print(f"{law:<16}{statistics.mean(values):8.2f}{statistics.stdev(values):7.2f}"
              f"{min(values):8.2f}{max(values):8.2f}{statistics.mean(over):16.1f} %"
              f"{statistics.stdev(over):7.1f}")
    for law, values in (distances or {}).items():
        print(f"{law:<16}{statistics.mean(values):8.2f} MPa from the truth (root mean square)")


if __name__ == "__main__":
    main()
