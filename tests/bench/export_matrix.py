#!/usr/bin/python3
"""Which law goes to which target, and with which of its states, as Markdown.

    /usr/bin/python3 tests/bench/export_matrix.py build/release/frictab JOB [--set KEY=VALUE ...]

JOB: a job whose tables are there (`frictab tabulate JOB` with table.model = "all"). Every table is
exported to all targets. all: every state is the solver's own, an argument or a state variable;
2 set: two are properties of the input deck; 1 held: one is held at a number. Where a target refuses,
the number of its message, which stands below the table.
"""
import json
import pathlib
import re
import subprocess
import sys

FAULT = re.compile(r"^(?:\S+: )?error: (\w+): (.*)$")


def run(binary, *arguments):
    return subprocess.run([binary, *arguments], capture_output=True, text=True)


def refusals(binary, job, law, targets, more):
    """By target, what it says; the sources of the others are written."""
    done = run(binary, "export", job, "-q", "--set", f'table.model=["{law}"]',
               "--set", f"export.targets={json.dumps(targets)}", *more)
    found = {m[1]: m[2] for line in done.stderr.splitlines() if (m := FAULT.match(line)) and m[1] in targets}
    if done.returncode != 0 and not found:
        sys.exit(f"{law}: {done.stderr}")
    if found and (others := [t for t in targets if t not in found]):
        refusals(binary, job, law, others, more)
    return found


def states(recipe):
    """How a target comes to the law's states, by its recipe.json."""
    held = len(recipe.get("held") or {}) + sum("constant" in a for a in recipe["arguments"])
    words = [f"{len(recipe['properties'])} set"] * bool(recipe.get("properties")) + [f"{held} held"] * bool(held)
    return ", ".join(words) or "all"


def main():
    binary, job, more = str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2], sys.argv[3:]
    targets = [line.split()[0] for line in run(binary, "list", "targets").stdout.splitlines() if line.strip()]
    tables = pathlib.Path(job).parent / "out" / "tables"
    reasons = []
    print("| law | " + " | ".join(targets) + " |\n|---|" + ":-:|" * len(targets))
    for law in sorted(file.stem for file in tables.glob("*.h5")):
        refused = refusals(binary, job, law, targets, more)
        cells = []
        for target in targets:
            if target in refused and refused[target] not in reasons:
                reasons.append(refused[target])
            recipe = tables.parent / "export" / target / "recipe.json"
            cells.append(str(1 + reasons.index(refused[target])) if target in refused
                         else states(json.loads(recipe.read_text())))
        print(f"| {law} | " + " | ".join(cells) + " |")
    for number, reason in enumerate(reasons, 1):
        print(f"\n{number}: {reason}")


if __name__ == "__main__":
    main()
