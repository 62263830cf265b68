#!/usr/bin/python3
"""Table and direct form of every law of a job, as Markdown: nodes, size, drift, time per state.

    /usr/bin/python3 tests/bench/law_figures.py build/release/frictab JOB [--set KEY=VALUE ...]

Runs the job with table.model = "all" and no targets; what a state costs is what `frictab run` times of
both forms as generated C. Of a law whose table has no axes both are the same source, which is timed
here: its batch entry on 4,096 states of Table 1, processor time, the fastest of 300 passes.
"""
import ctypes
import json
import pathlib
import shlex
import subprocess
import sys
import time

import numpy as np

RANGES = {"sigma_n_MPa": (500, 2750), "psi": (1, 20), "v_rel_mm_s": (5, 500), "T_contact_C": (20, 200),
          "s_mm": (0, 20), "sigma_f_MPa": (300, 600)}
STATES, PASSES = 4096, 300


def size(count):
    return f"{count} B" if count < 1024 else f"{count / 1024:.1f} KiB"


def drift(value):
    return "–" if value is None else "< 1e-9" if value < 1e-9 else f"{value:.3f}"


def direct_ns(binary, job, law):
    """Of the source of a law without axes."""
    subprocess.run([binary, "export", job, "-q", "--set", f'table.model=["{law}"]', "--set", 'export.targets=["c"]'],
                   check=True, capture_output=True)
    where = pathlib.Path(job).parent / "out" / "export" / "c"
    recipe = json.loads((where / "recipe.json").read_text())
    subprocess.run(shlex.split(recipe["compile"][1]), cwd=where, check=True)
    file = (where / "libfrictab_tau_R.so").rename(where / f"lib_{law}.so").resolve() # one name is loaded once
    library = ctypes.CDLL(str(file))
    random = np.random.default_rng(1)
    states = [random.uniform(*RANGES.get(a["quantity"], (0.5, 1)), STATES) for a in recipe["arguments"]]
    arrays = [x.ctypes.data_as(ctypes.c_void_p) for x in [*states, np.empty(STATES)]]
    best = float("inf")
    for _ in range(PASSES):
        before = time.thread_time_ns()
        library.frictab_tau_R_batch(ctypes.c_size_t(STATES), *arrays)
        best = min(best, time.thread_time_ns() - before)
    file.unlink()
    return best / STATES


def main():
    binary, job, more = str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2], sys.argv[3:]
    done = subprocess.run([binary, "run", job, "--json", "-q", "--set", 'table.model="all"', "--set",
                           "export.targets=[]", *more], check=True, capture_output=True, text=True)
    found = json.loads(done.stdout)
    forms = {form["model"]: form for form in found["forms"]}
    drifts = {r["model"]: r for r in found["verification"]["records"] if r["subject"] == "table"}
    print("| law | nodes | table | found | proven | direct form | ns, table | ns, direct |")
    print("|---|--:|--:|--:|--:|--:|--:|--:|")
    for table in found["tables"]:
        form, r = forms[table["model"]], drifts[table["model"]]
        if "ns_per_query" in form["direct"]:
            times = [f"{form[kind]['ns_per_query']:.1f}" for kind in ("table", "direct")]
        else:
            times = ["–", f"{direct_ns(binary, job, table['model']):.1f}"]
        print(f"| {table['model']} | {table['nodes']:,} | {size(table['bytes'])} | {drift(r['worst_case_MPa'])} | "
              f"{drift(r.get('proven_MPa'))} | {size(form['direct']['bytes'])} | {' | '.join(times)} |")


if __name__ == "__main__":
    main()
