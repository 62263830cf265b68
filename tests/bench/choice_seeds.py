#!/usr/bin/python3
"""How good is `best` on fresh tests? SYNTHETIC campaigns of few tests.

    /usr/bin/python3 tests/bench/choice_seeds.py build/release/frictab [CAMPAIGNS] [TESTS ...]

CAMPAIGNS: of each size, default 100, half of them of the twin's own physics, half of a law of the
registry (orowan, log_coulomb, exp_coulomb, wanheim_bay in turn). TESTS: sizes, default 12 24 48. Each
campaign is judged as a job without validation files does it, and by one held-out quarter; the truth
are 100 fresh tests of the same campaign, on which the delivered laws are judged.
"""
import csv
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

DESIGN = "p=1725,2005;psi=1,20;v=5,500;T=20,200;points=100;validation={}"
LAWS = ["orowan", "log_coulomb", "exp_coulomb", "wanheim_bay"]
FRESH = 100


def calibrated(binary, where, name, *settings):
    job = where / f"{name}.toml"
    job.write_text('[data]\ntraining = "train.csv"\n')
    more = [word for setting in settings for word in ("--set", setting)]
    subprocess.run([binary, "calibrate", job, "-q", "-j1", "-o", where / name, *more], check=True,
                   capture_output=True)
    return json.loads((where / name / "calibration.json").read_text())


def write_tests(file, header, rows, names):
    with open(file, "w", newline="") as out:
        csv.writer(out).writerows([header, *(r for r in rows if r[header.index("experiment")] in names)])


def errors_of(calibration):
    return {m["name"]: m["validation"]["mae_MPa"] for m in calibration["models"]}


def judged(binary, where, name, split, *settings):
    """The choice of one way of judging, and what its laws do on fresh tests."""
    header, rows, names = split
    write_tests(where / "train.csv", header, rows, names)
    choice = calibrated(binary, where, name, "calibration.bootstrap=300", *settings)
    if choice["judged_by"] == "held_out":
        names = names - set(choice["validation_experiments"])
        write_tests(where / "train.csv", header, rows, names)
    truth = errors_of(calibrated(binary, where, name + "_truth", 'data.validation="fresh.csv"',
                                 "calibration.bootstrap=0"))
    best = choice["models"][0]["name"]
    return {"right": best == min(truth, key=truth.get), "error": truth[best],
            "regret": truth[best] - min(truth.values()),
            "naive": choice["choice"]["mae_MPa"] - truth[best],
            "expected": choice["choice"]["expected_mae_MPa"] - truth[best]}


def campaign(binary, tests, seed):
    with tempfile.TemporaryDirectory() as directory:
        where = pathlib.Path(directory)
        law = [] if seed % 2 else ["--law", LAWS[seed // 2 % len(LAWS)]]
        subprocess.run([binary, "twin", where, "--seed", str(seed), "--no-bystanders", "-q", "--design",
                        DESIGN.format(tests + FRESH), *law], check=True, capture_output=True)
        with open(where / "validation.csv") as file:
            header, *rows = csv.reader(file)
        names = list(dict.fromkeys(r[header.index("experiment")] for r in rows))
        write_tests(where / "fresh.csv", header, rows, set(names[tests:]))
        split = header, rows, set(names[:tests])
        quarter = judged(binary, where, "quarter", split, "data.holdout=0.25")
        return judged(binary, where, "each", split) if tests < 30 else quarter, quarter


def line(what, results):
    mean = {key: statistics.mean(r[key] for r in results) for key in results[0]}
    off = {key: statistics.mean(abs(r[key]) for r in results) for key in ("naive", "expected")}
    print(f"{what:<22}{100 * mean['right']:10.0f} %{mean['error']:10.2f}{mean['regret']:10.2f}"
          f"{mean['naive']:+12.2f} ({off['naive']:.2f}){mean['expected']:+12.2f} ({off['expected']:.2f})",
          flush=True)


def main():
    binary = str(pathlib.Path(sys.argv[1]).resolve())
    count, *sizes = [int(a) for a in sys.argv[2:]] or [100]
    print("SYNTHETIC data; MPa; in brackets the mean size")
    print(f"{'tests, judged by':<22}{'best is best':>12}{'its error':>10}{'too much':>10}"
          f"{'printed off by':>19}{'expected off by':>19}")
    for tests in sizes or [12, 24, 48]:
        with ThreadPoolExecutor(2) as pool:
            runs = list(pool.map(lambda s: campaign(binary, tests, s), range(1, count + 1)))
        if tests < 30:
            line(f"{tests}, each left out", [r[0] for r in runs])
        line(f"{tests}, one quarter", [r[1] for r in runs])


if __name__ == "__main__":
    main()
