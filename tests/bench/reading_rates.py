"""What reading calls in campaigns in which nothing is at rest, apart or in another unit: synthetic
campaigns of the twin with every kind of noise, profile, design and parameter set.

Usage: reading_rates.py FRICTAB [CAMPAIGNS]
Prints rows by phase, columns by role with their count, and every row, test or column that is called something."""
import collections
import json
import random
import re
import subprocess
import sys
import tempfile

frictab = sys.argv[1]
campaigns = int(sys.argv[2]) if len(sys.argv) > 2 else 100
PHASES, ROLES, CALLED = collections.Counter(), collections.defaultdict(collections.Counter), []
REMARKS = ("left out", "implausible", "unit not given", "read: intervals")
CALLS = ("belongs to the measured friction", "both signs", "is negative in")


def options(seed):
    draw = random.Random(seed)
    design = f"points={draw.choice([20, 60, 120])};validation={draw.choice([1, 6, 30])}"
    if draw.random() < 0.4:
        design = "p=1725,2005;psi=1,20;v=5,500;T=20,200;" + design
    out = ["--seed", str(seed), "--design", design, "--set-name", draw.choice("DWB"),
           "--profile", draw.choice(["constant", "varied"]),
           "--noise", draw.choice(["normal", "t4", "heteroscedastic"])]
    if draw.random() < 0.5:
        out.append("--more-bystanders")
    if draw.random() < 0.3:
        out += ["--law", draw.choice(["wzl", "log_coulomb", "wanheim_bay", "coulomb"])]
    return out


def run(*arguments):
    return subprocess.run([frictab, *arguments], check=True, capture_output=True, text=True).stdout


for seed in range(1, campaigns + 1):
    with tempfile.TemporaryDirectory() as directory:
        run("twin", directory + "/c", *options(seed))
        job = directory + "/c/job.toml"
        text, columns = run("data", job), json.loads(run("data", job, "--json"))["columns"]
    for line in text.splitlines():
        if line.startswith("rows read:"):
            for rows, phase in re.findall(r"(\d[\d,]*) (\w+)", line):
                PHASES[phase] += int(rows.replace(",", ""))
        elif line.startswith(REMARKS) or any(words in line for words in CALLS):
            CALLED.append(f"{' '.join(options(seed))}: {line}")
    for column in columns:
        ROLES[column["role"]][column["column"]] += 1

print(f"SYNTHETIC data, {campaigns} campaigns. Rows:", dict(PHASES))
for role, names in ROLES.items():
    print(f"  {role}:", ", ".join(f"{name} {count}" for name, count in sorted(names.items())))
print(f"Called, {len(CALLED)}:", *CALLED, sep="\n  ")
