#!/usr/bin/env python3
"""contact.csv and tool.csv for `frictab process` from what a GetFEM program writes.

from_getfem.py NAME SPEED_MM_S OUT_FOLDER
NAME_contact.csv: a row per increment and integration point (or node) of the surface that touches,
    stroke_mm,area_mm2,sigma_n_MPa,tau_MPa,v_rel_mm_s,psi,T_contact_C,s_mm,sigma_f_MPa,r_mm,z_mm
NAME_force.csv: a row per increment, stroke_mm,force_kN,friction_J. So does
`process_benchmark --output NAME` of examples/09_process_benchmark. SPEED: of the tool, constant.
Further columns stay away. psi, T_contact_C, s_mm, sigma_f_MPa, r_mm and z_mm may be missing.

In a program of your own all of this is there when an increment has converged: at each integration
point of the contact, area = weight times Jacobian of the surface now (axisymmetric: times 2 pi r),
psi = that over the same at the start, sigma_n and tau from the multiplier or penalty, v_rel from
the slip of the increment over its time, s_mm the sum of the slips so far, sigma_f from the plastic
strain there.
"""
import csv
import os
import sys

COPIED = ("area_mm2", "sigma_n_MPa", "v_rel_mm_s", "psi", "T_contact_C", "s_mm", "sigma_f_MPa",
          "r_mm", "z_mm")


def read(path, needed):
    try:
        with open(path) as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    except OSError as error:
        sys.stderr.write("from_getfem.py: %s\n" % error)
        sys.exit(2)
    for name in needed:
        if not rows or name not in rows[0]:
            sys.stderr.write("from_getfem.py: %s has no column %s (or no row)\n" % (path, name))
            sys.exit(2)
    return rows


def main(name, speed, out):
    contact = read(name + "_contact.csv", ("stroke_mm", "tau_MPa") + COPIED[:3])
    force = read(name + "_force.csv", ("stroke_mm", "force_kN"))
    os.makedirs(out, exist_ok=True)
    copied = [c for c in COPIED if c in contact[0]]
    with open(os.path.join(out, "contact.csv"), "w", newline="") as file:
        write = csv.writer(file, lineterminator="\n")
        write.writerow(["time_s", "facet"] + copied + ["tau_R_MPa"])
        last, facet = None, 0
        for row in contact:  # facet only counts the rows of an increment: speed and path are there
            facet = facet + 1 if row["stroke_mm"] == last else 1
            last = row["stroke_mm"]
            write.writerow(["%.9g" % (float(last) / speed), facet] + [row[c] for c in copied]
                           + ["%.7g" % abs(float(row["tau_MPa"]))])
    with open(os.path.join(out, "tool.csv"), "w", newline="") as file:
        write = csv.writer(file, lineterminator="\n")
        friction = ["friction_J"] if "friction_J" in force[0] else []
        write.writerow(["time_s", "stroke_mm", "force_kN", "speed_mm_s"] + friction)
        for row in force:
            write.writerow(["%.9g" % (float(row["stroke_mm"]) / speed), row["stroke_mm"],
                            row["force_kN"], "%g" % speed] + [row[f] for f in friction])


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(sys.argv[1], float(sys.argv[2]), sys.argv[3])
