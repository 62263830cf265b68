"""Judges frictab's search for what a law lacks beside other methods, on synthetic campaigns or on stored cases.

    judge.py --binary build/frictab --seeds 0-1 --only '^(?!null)' --out plants
    judge.py --binary build/frictab --cases DIR --out cases
    judge.py --table plants.csv more.csv --out both     tables of earlier runs; later lines replace earlier ones
Writes OUT.csv (a line per campaign and method, as they come) and OUT.md."""
import argparse
import csv
import re
import resource
import shutil
import tempfile
import time
import tomllib
from pathlib import Path

import numpy as np
import pandas as pd

import campaigns
from rivals import RIVALS, Prediction, Problem
from tool import Frictab, in_words, named_columns, stated_error

METHODS = ("law", "frictab", *[name for name in RIVALS if name != "law"], "ceiling")


def is_worse(error, law_error, mean):
    return int(error > 1.05 * law_error and error > law_error + 0.005 * mean)


def mean_error(predicted, measured):
    return float(np.abs(np.asarray(predicted) - np.asarray(measured)).mean())


def processor_seconds():
    own, children = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return own.ru_utime + own.ru_stime + children.ru_utime + children.ru_stime


def predictions(binary, folder, job, law, files, columns, methods, ceiling=None):
    """(method, prediction, seconds, words) of every method; files: name -> frame with canonical columns."""
    tool = Frictab(binary, folder, job)
    tool.calibrate()
    known = pd.concat([f.assign(law_MPa=tool.predict(f, law, name)) for name, f in files.items() if name != "heldout.csv"],
                      ignore_index=True)
    unseen = files["heldout.csv"].assign(law_MPa=tool.predict(files["heldout.csv"], law, "heldout.csv"))
    for method in methods:
        start, words = processor_seconds(), ""
        try:
            if method == "frictab":
                trace = tool.trace()
                delivered = trace["extended_model"] if trace["effects"] else law
                result = Prediction(tool.predict(unseen, delivered, "heldout.csv"), named_columns(trace), stated_error(trace))
                words = trace["verdict"] + (": " + in_words(trace) if trace["effects"] else "")
            elif method == "ceiling":
                result = Prediction(ceiling())
            else:
                result = RIVALS[method](Problem(known, unseen, columns))
        except RuntimeError as fault:
            print(f"FAULT {method}: {fault}", flush=True)
            continue
        yield method, result, processor_seconds() - start, words


def judge_campaign(binary, kind, seed, last, methods):
    c = campaigns.make(kind, seed, last)
    plan, causes = c.plan, c.causes
    with tempfile.TemporaryDirectory() as folder:
        c.write(folder)
        files = {f"{name}.csv": getattr(c, name) for name in ("training", "validation", "heldout") if len(getattr(c, name))}
        base = None
        for method, result, seconds, words in predictions(binary, folder, "job.toml", plan.law, files, c.columns,
                                                          methods, c.known_form):
            error = mean_error(result.stress_MPa, c.heldout.true_MPa)
            base = error if method == "law" else base
            named = result.named
            yield dict(kind=kind, seed=seed, size=plan.size, size_reached=round(c.size, 4), rig=plan.rig, law=plan.law,
                       true_law=plan.true_law, tests=plan.tests, rows=plan.rows, design=plan.design, noise=plan.noise,
                       order=plan.order or "none", validation=plan.validation_tests, method=method, planted=len(causes),
                       right="" if named is None else len(named & causes),
                       false="" if named is None else len(named - causes), mean_MPa=round(float(c.heldout.true_MPa.mean()), 5),
                       law_error=round(base, 6), error=round(error, 6), removed=round(1 - error / base, 4),
                       worse=is_worse(error, base, c.heldout.true_MPa.mean()), stated="" if result.stated_MPa is None else round(result.stated_MPa, 6),
                       measured_error=round(mean_error(result.stress_MPa, c.heldout.tau_R_MPa), 6), seconds=round(seconds, 2),
                       planted_columns=" ".join(sorted(causes)), named_columns=" ".join(sorted(named or [])), words=words)


def summary(lines, label):
    named = pd.to_numeric(lines.right).notna().all()
    stated = pd.to_numeric(lines.stated) / lines.measured_error
    null = (lines["size"] == 0).all()
    false = pd.to_numeric(lines.false)
    return [*label, lines.method.iloc[0], len(lines),
            f"{int(pd.to_numeric(lines.right).sum())} / {lines.planted.sum()}" if named and not null else "-",
            int(false.sum()) if named else "-", "-" if null else f"{100 * lines.removed.median():.0f} %", lines.worse.sum(),
            f"{int((false > 0).sum())}" if named and null else "-",
            f"{100 * (lines.error / lines.mean_MPa).median():.1f} %", "-" if stated.isna().all() else f"{stated.median():.2f}",
            f"{lines.seconds.mean():.1f}"]


HEADER = ("kind", "size", "method", "campaigns", "right / planted columns", "false columns", "removed (median)", "worse",
          "nulls with a false column", "error / mean stress (median)", "stated / true error", "s")


def table(data):
    data = data.assign(method=pd.Categorical(data.method, METHODS, ordered=True),
                       kind=pd.Categorical(data.kind, campaigns.KINDS, ordered=True))
    rows, plants, nulls = [], data[data["size"] > 0], data[data["size"] == 0]
    for label, group in (("all plants", plants), ("all nulls", nulls)):
        for size, part in group.groupby("size"):
            rows += [summary(lines, (label, f"{size:g}")) for _, lines in part.groupby("method", observed=True)]
    for (kind, size), part in data.groupby(["kind", "size"], observed=True):
        rows += [summary(lines, (kind, f"{size:g}")) for _, lines in part.groupby("method", observed=True)]
    return markdown(HEADER, rows)


def markdown(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows]) + "\n"


def judge_cases(binary, folder, methods):
    """Held-out error of each method in MPa, of stored jobs with a file heldout.csv beside them."""
    rows = []
    for job in sorted(Path(folder).glob("*/job*.toml")):
        settings = tomllib.loads(job.read_text())
        with tempfile.TemporaryDirectory() as copy:
            shutil.copytree(job.parent, copy, dirs_exist_ok=True)
            names = [settings["data"].get(key) for key in ("training", "validation")]
            names = [n for value in names if value for n in ([value] if isinstance(value, str) else value)]
            files = {n: pd.read_csv(job.parent / n, dtype={"experiment": str}) for n in [*names, "heldout.csv"]}
            heldout = files["heldout.csv"]
            columns = [c for c in heldout if c not in ("experiment", "time_s", "tau_R_MPa", "origin", *campaigns.ORDER_COLUMNS)]
            law = settings["models"]["use"][0]
            errors, said = {}, ""
            for method, result, _, words in predictions(binary, copy, job.name, law, files, columns, methods):
                errors[method] = mean_error(result.stress_MPa, heldout.tau_R_MPa)
                said = words or said
            rows.append([job.parent.name + ("" if job.name == "job.toml" else f" ({job.name})"),
                         *[f"{errors[m]:.2f}" if m in errors else "fault" for m in methods], said])
            print(rows[-1], flush=True)
    return markdown(("case, MPa held out", *methods, "frictab says"), rows)


def seed_range(text):
    first, _, end = text.partition("-")
    return range(int(first), int(end or first) + 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary")
    parser.add_argument("--seeds", type=seed_range, default=seed_range("0"), help="3 or 0-4")
    parser.add_argument("--only", default="", help="regular expression on the kind")
    parser.add_argument("--methods", default=",".join(METHODS), help="law comes first in any case")
    parser.add_argument("--last", action="store_true", help="allow the seeds that are kept for the last run")
    parser.add_argument("--cases", help="a folder of stored cases instead of synthetic campaigns")
    parser.add_argument("--table", nargs="+", help="CSV files of earlier runs: no campaign is judged")
    parser.add_argument("--out", required=True, help="name of the files to write, without .csv and .md")
    arguments = parser.parse_args()
    if arguments.table:
        lines = pd.concat([pd.read_csv(f, keep_default_na=False) for f in arguments.table], ignore_index=True)
        return report(arguments.out, table(lines.drop_duplicates(["kind", "seed", "method"], keep="last")))
    if not arguments.binary or not Path(arguments.binary).is_file():
        parser.error("--binary: the frictab program that is judged")
    methods = ["law"] + [m for m in arguments.methods.split(",") if m != "law"]
    unknown = set(methods) - set(METHODS)
    if unknown:
        parser.error(f"no method {', '.join(sorted(unknown))}; there are {', '.join(METHODS)}")
    if not arguments.last and max(arguments.seeds) >= campaigns.FIRST_LAST_SEED:
        parser.error(f"seeds from {campaigns.FIRST_LAST_SEED} on are kept for the last run: --last")
    if arguments.cases:
        text = judge_cases(arguments.binary, arguments.cases, [m for m in methods if m != "ceiling"])
    else:
        lines, began = [], time.time()
        with open(arguments.out + ".csv", "w", newline="") as file:
            for seed in arguments.seeds:
                for kind in [k for k in campaigns.KINDS if re.search(arguments.only, k)]:
                    for line in judge_campaign(arguments.binary, kind, seed, arguments.last, methods):
                        if not lines:
                            writer = csv.DictWriter(file, list(line))
                            writer.writeheader()
                        lines.append(line)
                        writer.writerow(line)
                        file.flush()
                    print(f"{time.time() - began:6.0f} s  {kind} {seed}", flush=True)
        text = table(pd.DataFrame(lines))
    report(arguments.out, text)


def report(out, text):
    Path(out + ".md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
