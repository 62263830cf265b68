#!/usr/bin/python3
"""Holds what from_calculix.py wrote against CalculiX's own figures. Usage: check.py OUT/mu_XXX...

normal  sum of sigma_n A against the reaction force on the die along its normal: the largest
        difference over the increments after a tenth of the time
work    friction work, sum of tau v A dt; the work of the force on the quarter of the die; and what
        is left of that without the energy of the block (ELSE) and of the contact springs (CELS):
        friction work as CalculiX has it, as the small difference of large figures
cdis    the same friction work with the slip of CDIS, at the faces all of whose points touch, over
        the work of the same faces by displacements
tau/p   5, 50 and 95 % of the rows that slide faster than 1 mm/s in the late half
"""
import collections
import csv
import math
import sys

sys.path.insert(0, sys.path[0] + "/../../../templates/process")
from block_deck import ANGLE  # noqa: E402
from from_calculix import read_dat  # noqa: E402


def read(path):
    return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(open(path))]


def main(folder):
    dat = read_dat(folder + "/block.dat")
    force = dat["total force (fx,fy,fz) for set DIENODES"]
    energy = next(v for k, v in dat.items() if k.startswith("total internal energy"))
    spring = next((v for k, v in dat.items() if "spring energy" in k), {})
    cdis = next(v for k, v in dat.items() if k.startswith("relative contact"))
    tool, rows = read(folder + "/tool.csv"), read(folder + "/contact.csv")
    end = tool[-1]["time_s"]
    sine, cosine = math.sin(math.radians(ANGLE)), math.cos(math.radians(ANGLE))
    step, last = {}, 0.0
    for t in tool:
        step[t["time_s"]], last = t["time_s"] - last, t["time_s"]
    normal, power = dict.fromkeys(step, 0.0), dict.fromkeys(step, 0.0)
    for r in rows:
        normal[r["time_s"]] += r["sigma_n_MPa"] * r["area_mm2"]
        power[r["time_s"]] += r["tau_R_MPa"] * r["v_rel_mm_s"] * r["area_mm2"]
    off = [abs(normal[t] / abs(cosine * f[0][2] - sine * f[0][0]) - 1)
           for t, f in force.items() if t > 0.1 * end]
    friction = sum(power[t] * step[t] for t in step)
    work, before = 0.0, (0.0, 0.0)
    for t in tool:  # of the quarter of the die; mean of the forces at both ends
        now = (t["stroke_mm"], t["force_kN"] * 1000 / 4)
        work += (now[0] - before[0]) * (now[1] + before[1]) / 2
        before = now
    left = work - energy[end][0][0] - (spring[end][0][0] if end in spring else 0.0)
    # CDIS: mean of the points of a face, where all are there in two increments.
    by_cdis = by_u = 0.0
    full = collections.Counter((t, r[0], r[1]) for t in cdis for r in cdis[t])
    full = max(full.values())
    own = {(r["time_s"], r["facet"]): r for r in rows}
    old = {}
    for t in sorted(cdis):
        new = {}
        for e, f, _, a, b in cdis[t]:
            new.setdefault(round(e + f / 10, 1), []).append((a, b))
        for facet, points in new.items():
            r = own.get((t, facet))
            if r and len(points) == full == len(old.get(facet, [])):
                slip = [sum(p[i] - q[i] for p, q in zip(points, old[facet])) / full for i in (0, 1)]
                by_cdis += r["tau_R_MPa"] * r["area_mm2"] * math.hypot(*slip)
                by_u += r["tau_R_MPa"] * r["area_mm2"] * r["v_rel_mm_s"] * step[t]
        old = new
    ratio = sorted(r["tau_R_MPa"] / r["sigma_n_MPa"] for r in rows
                   if r["time_s"] > end / 2 and r["v_rel_mm_s"] > 1)
    quantile = [ratio[int(q * (len(ratio) - 1))] for q in (0.05, 0.5, 0.95)]
    print(f"{folder}: {len(tool)} increments, {len(rows)} rows, {tool[-1]['force_kN']:.2f} kN; "
          f"normal {100 * max(off):.2f} %; work {friction / 1000:.3f} J of {work / 1000:.3f} J, "
          f"left {left / 1000:.3f} J; cdis {by_cdis / by_u:.4f}; tau/p "
          + " ".join(f"{q:.4f}" for q in quantile))


if __name__ == "__main__":
    for name in sys.argv[1:] or sys.exit(__doc__):
        main(name.rstrip("/"))
