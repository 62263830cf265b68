#!/usr/bin/python3
"""How each calibrated law errs in ring and rod, beside its rank on tau_R. SYNTHETIC data.

Usage: compare.py FOLDER TRUTH; FOLDER holds what `run` has written for one truth. The measured
process is the one with the truth's own routine. Errors at the end of the stroke; `worst` is the
largest error of the force over the last half of the stroke.
"""
import csv
import json
import sys
from pathlib import Path

# The ranges that all laws were tested in: those of the campaign (frictab_tau_R.h of a law with all
# states). s_mm and sigma_f_MPa are left out: hardly a law uses them as an axis.
RANGES = {"sigma_n_MPa": (500, 2750), "psi": (1, 20), "v_rel_mm_s": (5, 500),
          "T_contact_C": (20, 249.95)}
CONSTANTS = ("coulomb_0.04", "coulomb_0.08", "shear_0.12")


def read(path):
    rows = list(csv.DictReader(path.open()))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def at(curve, stroke, column):
    """Linear between the steps: runs may have taken different ones."""
    x, y = curve["stroke_mm"], curve[column]
    for i in range(1, len(x)):
        if x[i] >= stroke:
            return y[i - 1] + (y[i] - y[i - 1]) * (stroke - x[i - 1]) / (x[i] - x[i - 1])
    return y[-1]


def errors(curve, truth):
    end = truth["stroke_mm"][-1]
    late = [x for x in truth["stroke_mm"] if x >= 0.5 * end]
    force = [100 * (at(curve, x, "force_kN") / at(truth, x, "force_kN") - 1) for x in late]
    return {"force": force[-1], "worst": max(force, key=abs),
            "diameter": 2 * (curve["inner_mid_mm"][-1] - truth["inner_mid_mm"][-1]),
            "heat": curve["T_contact_C"][-1] - truth["T_contact_C"][-1]}


def outside(path):
    """Shares of contact area and stroke beyond the campaign: any state, and each of them."""
    points = read(path)
    total, beyond, each = 0.0, 0.0, dict.fromkeys(RANGES, 0.0)
    strokes = sorted(set(points["stroke_mm"]))
    travel = {b: b - a for a, b in zip([0.0] + strokes, strokes)}
    for i, area in enumerate(points["area_mm2"]):
        area *= travel[points["stroke_mm"][i]]
        out = [name for name, (low, high) in RANGES.items()
               if not low <= points[name][i] <= high]
        total += area
        beyond += area if out else 0
        for name in out:
            each[name] += area
    return beyond / total, {name: share / total for name, share in each.items()}


def ranks(values):
    """1 for the smallest; the mean rank for equal ones."""
    return [1 + sum(v < value for v in values) + 0.5 * (sum(v == value for v in values) - 1)
            for value in values]


def spearman(first, second):
    a, b = ranks(first), ranks(second)
    mean = (len(a) + 1) / 2
    above = sum((x - mean) * (y - mean) for x, y in zip(a, b))
    below = (sum((x - mean) ** 2 for x in a) * sum((y - mean) ** 2 for y in b)) ** 0.5
    return above / below


def check_truth(folder, name):
    """The truth's routine has the twin's constants: the largest difference of one."""
    planted = json.loads((folder / "exact/twin.json").read_text())["law"]["parameters"]
    models = json.loads((folder / "truth/calibration.json").read_text())["models"]
    found = next(m for m in models if m["name"] == name)["parameters"]
    return max((abs(p["value"] / planted[p["name"]] - 1) for p in found
                if planted.get(p["name"])), default=float("nan"))


def table(folder, name):
    models = json.loads((folder / "results/calibration.json").read_text())["models"]
    mae = {m["name"]: m["validation"]["mae_MPa"] for m in models}
    laws = sorted(mae, key=mae.get)
    found = {}
    for process in ("ring", "rod"):
        truth = read(folder / process / "routine_force.csv")
        found[process] = {law: errors(read(folder / process / f"{law}_force.csv"), truth)
                          for law in laws}
        found[process]["truth"] = truth
    ring, rod = found["ring"]["truth"], found["rod"]["truth"]
    print(f"### SYNTHETIC truth: {name}\n")
    print(f"Ring with the truth: {ring['force_kN'][-1]:.1f} kN, inner diameter "
          f"{2 * ring['inner_mid_mm'][-1]:.3f} mm, contact {ring['T_contact_C'][-1]:.1f} degC; "
          f"rod {rod['force_kN'][-1]:.2f} kN, {rod['T_contact_C'][-1]:.1f} degC. The constants of "
          f"its routine are within {check_truth(folder, name):.1e} of the planted ones.\n")
    print("| law | tau_R, MPa (rank) | ring: force, % (rank) | inner diameter, mm (rank) "
          "| contact, K | rod: force, % (rank) | contact, K |")
    print("|---|--:|--:|--:|--:|--:|--:|")
    measures = {"ring: force": [abs(found["ring"][law]["force"]) for law in laws],
                "ring: inner diameter": [abs(found["ring"][law]["diameter"]) for law in laws],
                "rod: force": [abs(found["rod"][law]["force"]) for law in laws]}
    place = {key: ranks(values) for key, values in measures.items()}
    for i, law in enumerate(laws):
        a, b = found["ring"][law], found["rod"][law]
        print(f"| {law} | {mae[law]:.2f} ({i + 1}) | {a['force']:+.2f} "
              f"({place['ring: force'][i]:g}) | {a['diameter']:+.3f} "
              f"({place['ring: inner diameter'][i]:g}) | {a['heat']:+.1f} | {b['force']:+.2f} "
              f"({place['rod: force'][i]:g}) | {b['heat']:+.1f} |")
    print("\nRank correlation (Spearman) of the error of tau_R with that of the process, "
          "SYNTHETIC:\n")
    print("| | all laws | without the constants of the literature |\n|---|--:|--:|")
    fitted = [i for i, law in enumerate(laws) if law not in CONSTANTS]
    order = [mae[law] for law in laws]
    for key, values in measures.items():
        print(f"| {key} | {spearman(order, values):.2f} | "
              f"{spearman([order[i] for i in fitted], [values[i] for i in fitted]):.2f} |")
    print("\nShare of the contact (area, over the stroke) beyond the campaign's range, with the "
          "truth, SYNTHETIC:\n")
    print("| | any state | sigma_n | psi | v | T |\n|---|--:|--:|--:|--:|--:|")
    for process in ("ring", "rod"):
        beyond, each = outside(folder / process / "routine_contact.csv")
        print(f"| {process} | {100 * beyond:.0f} % | " +
              " | ".join(f"{100 * share:.0f} %" for share in each.values()) + " |")
    print()
    say(laws, mae, found, place)


def say(laws, mae, found, place):
    """The table in words, so that no sentence outlives its figures."""
    def process(law):
        ring, rod = found["ring"][law], found["rod"][law]
        return (f"{ring['force']:+.1f} % of the ring's force, {ring['diameter']:+.2f} mm of its "
                f"diameter, {rod['force']:+.1f} % of the rod's force")

    best = laws[0]
    print(f"* Best on tau_R: `{best}`, {mae[best]:.2f} MPa. It errs by {process(best)}.")
    winners = {key: laws[values.index(min(values))] for key, values in place.items()}
    print("* Least error: " + ", ".join(f"{key} `{law}` ({laws.index(law) + 1} on tau_R)"
                                        for key, law in winners.items()) + ".")
    fitted = [law for law in laws if law not in CONSTANTS]
    near = [(abs(found["rod"][a]["force"] - found["rod"][b]["force"]), a, b)
            for i, a in enumerate(fitted) for b in fitted[i + 1:] if abs(mae[a] - mae[b]) < 0.5]
    if near:
        _, a, b = max(near)
        print(f"* A small step on tau_R can be a large one in the process: `{a}` and `{b}` are "
              f"{abs(mae[a] - mae[b]):.2f} MPa apart, and err by {process(a)}; and by "
              f"{process(b)}.")
    print()


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    table(Path(sys.argv[1]), sys.argv[2])
