#!/usr/bin/python3
"""What studies cost: keys planned and reported, a run with nothing to do, two shards beside one.
Synthetic campaigns; the results that are reported are copies of one with other parameters.

Usage: study_scale.py FRICTAB [KEYS]      100,000 keys where it is not said
"""
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

DESIGN = "p=1725,2005;psi=1,20;v=5,500;T=20;points=10;validation=4"
JOB = '[models]\nuse = ["coulomb", "shear", "log_coulomb"]\n[calibration]\nbootstrap = 100\n'


def start(work, *arguments, out=subprocess.DEVNULL):
    return subprocess.Popen([FRICTAB, "study", *arguments, "-q"], cwd=work, stdout=out)


def end(process):
    """What the process used."""
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        sys.exit(f"{process.args} failed")
    return usage


def run(work, *arguments, out=subprocess.DEVNULL):
    """Seconds, peak MiB and processor seconds."""
    begin = time.perf_counter()
    usage = end(start(work, *arguments, out=out))
    return (time.perf_counter() - begin, usage.ru_maxrss / 1024, usage.ru_utime + usage.ru_stime)


def write_study(work, keys, design=DESIGN, job=JOB, stage="calibrate"):
    (work / "job.toml").write_text(job)
    (work / "study.toml").write_text(
        f'job = "job.toml"\nstage = "{stage}"\n' + "".join(
            f'[[twin]]\nname = "{oil}"\nseed = "1..{keys // 2}"\ndesign = "{design}"\n'
            f'noise_scale = {scale}\nfactors = {{ oil = "{oil}" }}\n'
            for oil, scale in (("a", 1), ("b", 1.1))))


def copy_results(work):
    """A result for every key of the plan."""
    with open(work / "plan.json", "w") as out:
        seconds, mib, _ = run(work, "plan", "--json", out=out)
    print(f"plan: {seconds:.1f} s, {mib:.0f} MiB")
    run(work, "run", "--shard", "1/10000" if KEYS >= 10000 else "1/1")
    results = work / "study" / "results"
    one = json.loads(next(results.glob("*/study.json")).read_text())
    draw = random.Random(1)
    for entry in json.loads((work / "plan.json").read_text())["keys"]:
        folder = results / entry["key"]
        if folder.exists():
            continue
        one["key"] = entry["key"]
        for law in one["laws"]:
            law["mae_MPa"] *= draw.uniform(0.9, 1.1)
            for parameter in law["parameters"]:
                parameter["value"] *= draw.uniform(0.99, 1.01)
        folder.mkdir()
        (folder / "study.json").write_text(json.dumps(one, indent=2) + "\n")


def scale(work):
    write_study(work, KEYS)
    copy_results(work)
    seconds, mib, _ = run(work, "report")
    page = (work / "study" / "report.html").stat().st_size / 1024
    rows = sum(1 for _ in open(work / "study" / "campaigns.csv")) - 1
    print(f"report of {KEYS:,} campaigns, {rows:,} rows: {seconds:.1f} s, {mib:.0f} MiB, page "
          f"{page:.0f} KiB")
    seconds, mib, _ = run(work, "run")
    print(f"run with nothing to do: {1000 * seconds / KEYS:.3f} s per 1,000 keys, {mib:.0f} MiB")


def speed_up(work):
    """Campaigns that take about half a second each, with the network among their laws."""
    job = JOB.replace('"shear"', '"neural_network"')
    design = "p=1725,2005;psi=1,4.47,20;v=5,500;T=20,200;points=20;validation=6"
    write_study(work, 100, design, job)
    one, _, one_cpu = run(work, "run", "-j1", "-o", "one")
    begin = time.perf_counter()
    parts = [start(work, "run", "-j1", "-o", "two", "--shard", f"{i}/2") for i in (1, 2)]
    usage = [end(part) for part in parts]
    two = time.perf_counter() - begin
    cpu = [u.ru_utime + u.ru_stime for u in usage]
    same = subprocess.run(["diff", "-r", "one", "two"], cwd=work).returncode == 0
    print(f"two shards of 50 campaigns: {two:.1f} s, one process {one:.1f} s, {one / two:.2f} "
          f"times; processor time {cpu[0]:.1f} and {cpu[1]:.1f} s, one {one_cpu:.1f} s, "
          f"{one_cpu / max(cpu):.2f} times the longer; same bytes: {same}; "
          f"load {os.getloadavg()[0]:.1f}")


FRICTAB = str(pathlib.Path(sys.argv[1]).resolve())
KEYS = int(sys.argv[2]) if len(sys.argv) > 2 else 100000
for part in (scale, speed_up):
    with tempfile.TemporaryDirectory() as folder:
        part(pathlib.Path(folder))
