"""contact.csv and tool.csv for `frictab process` from an Abaqus ODB. RECALLED, NEVER RUN IN ABAQUS:
written from memory of the scripting interface. Check the first rows by hand. Python 2.7 and 3.

    abaqus python from_abaqus.py JOB.odb STEP OUT_FOLDER --tool NODE_REGION AXIS [PAIR ...]
NODE_REGION: the history region of the tool's reference point, "Node TOOL-1.1"; AXIS: 1, 2 or 3.
PAIR: SECONDARY/MAIN, as it stands behind CPRESS in the names of the fields; without, all pairs of
the last frame (the field that is named CPRESS alone is the largest of all: left out).
Units N, mm, s. The step must request, at every frame that is to count:
    *Contact Output: CSTRESS (CPRESS, CSHEAR1, CSHEAR2), CDISP (CSLIP1, CSLIP2), CNAREA
    *Node Output: U, and NT if it is heated;   *Element Output: PEEQ
    *Output, History: RF and U of the reference point; *Energy Output: ALLFD
at the same times (*Output, ..., time interval=...). A facet is a node of the secondary surface. psi
comes from the faces around it, if the ODB has that surface; CNAREA over the first CNAREA would not
do, because a node at the edge of the contact has a part of its area only.
Not for Explicit's general contact, whose fields are named otherwise (FSLIPR gives its slip speed).
"""
from __future__ import division, print_function

import csv
import os
import sys

FACES = {8: ("1234", "5876", "1562", "2673", "3784", "4851"), 4: ("123", "142", "243", "341")}
CORNERS = {"C3D8": 8, "C3D20": 8, "C3D4": 4, "C3D10": 4}


def fail(text):
    sys.stderr.write("from_abaqus.py: " + text + "\n")
    sys.exit(2)


def field(frame, name, pair=""):
    """{(instance, node): value}. Names are padded by blanks up to the pair: 'CPRESS   A/B'."""
    for key in frame.fieldOutputs.keys():
        if key.split() == [name] + ([pair] if pair else []):
            return dict(((v.instance.name if v.instance else "", v.nodeLabel), v.data)
                        for v in frame.fieldOutputs[key].values if v.nodeLabel)
    return {}


def peeq(frame):
    """{(instance, node): mean over the elements around}"""
    if "PEEQ" not in frame.fieldOutputs.keys():
        return {}
    from abaqusConstants import ELEMENT_NODAL
    found = {}
    for v in frame.fieldOutputs["PEEQ"].getSubset(position=ELEMENT_NODAL).values:
        found.setdefault((v.instance.name, v.nodeLabel), []).append(v.data)
    return dict((n, sum(x) / len(x)) for n, x in found.items())


def faces_around(odb, surface):
    """{(instance, node): [corners of a face, ...]}, each an (instance, node); empty: not known."""
    around, assembly = {}, odb.rootAssembly
    for key in assembly.surfaces.keys():
        if key.upper() in (surface.upper(), surface.upper().replace("ASSEMBLY_", "")):
            found = assembly.surfaces[key]
            for elements, faces in zip(found.elements, found.faces):
                for element, face in zip(elements, faces):
                    count = CORNERS.get(str(element.type).rstrip("RHTIMS"), 0)
                    number = str(face)[-1]
                    if not count or not number.isdigit():
                        return {}
                    own = [(element.instanceName, element.connectivity[int(c) - 1])
                           for c in FACES[count][int(number) - 1]]
                    for node in own:
                        around.setdefault(node, []).append(own)
    return around


def area(p):
    a = [x - y for x, y in zip(p[2], p[0])]
    b = [x - y for x, y in zip(p[-1], p[1] if len(p) == 4 else p[0])]
    v = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return sum(x * x for x in v) ** 0.5 / 2


def write(out, name, header, rows):
    with open(os.path.join(out, name), "wb" if sys.version_info[0] == 2 else "w") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(header)
        table.writerows(["%.8g" % x if isinstance(x, float) else x for x in row] for row in rows)


def main(path, step_name, out, region, axis, pairs):
    from odbAccess import openOdb
    odb = openOdb(path, readOnly=True)
    step = odb.steps[step_name] if step_name in odb.steps.keys() else fail("no step " + step_name)
    keys = [key.split() for key in step.frames[-1].fieldOutputs.keys()]
    pairs = pairs or [k[1] for k in keys if len(k) == 2 and k[0] == "CPRESS"]
    for pair in pairs or fail("no CPRESS of a pair: *Contact Output with CSTRESS, CDISP, CNAREA"):
        for name in ("CPRESS", "CSHEAR1", "CSLIP1", "CNAREA"):
            if [name, pair] not in keys:
                fail("no %s of %s: *Contact Output with CSTRESS, CDISP, CNAREA" % (name, pair))
    start = dict(((i.name, n.label), [float(x) for x in n.coordinates])
                 for i in odb.rootAssembly.instances.values() for n in i.nodes)
    rows = []
    for pair in pairs:
        around, before, path_of, last = faces_around(odb, pair.split("/")[0]), {}, {}, 0.0
        for frame in step.frames:
            time = float(frame.frameValue)
            if time <= last:
                continue
            p, size, t1, t2, s1, s2 = [field(frame, name, pair) for name in (
                "CPRESS", "CNAREA", "CSHEAR1", "CSHEAR2", "CSLIP1", "CSLIP2")]
            u, heat, strain, touching = field(frame, "U"), field(frame, "NT11"), peeq(frame), {}
            now = dict((n, [x + float(d) for x, d in zip(start[n], u[n])]) for n in u if n in start)
            for n in sorted(p):
                slip = (s1.get(n, 0.0), s2.get(n, 0.0))
                old = before.get(n, (0.0, 0.0))
                before[n] = slip
                if p[n] <= 0 or size.get(n, 0.0) <= 0:
                    continue
                moved = ((slip[0] - old[0]) ** 2 + (slip[1] - old[1]) ** 2) ** 0.5
                touching[n] = path_of[n] + moved if n in path_of else 0.0
                psi = ""
                if n in around and all(m in now for f in around[n] for m in f):
                    psi = sum(area([now[m] for m in f]) for f in around[n]) / \
                        sum(area([start[m] for m in f]) for f in around[n])
                tau = (t1.get(n, 0.0) ** 2 + t2.get(n, 0.0) ** 2) ** 0.5
                rows.append([time, "%s.%d" % n, size[n], p[n], moved / (time - last), psi,
                             heat.get(n, ""), touching[n], strain.get(n, ""), tau]
                            + (now.get(n) or ["", "", ""]))
            path_of, last = touching, time
    if region not in step.historyRegions.keys():
        fail("no history region %s, but %s" % (region, ", ".join(step.historyRegions.keys())))
    history = step.historyRegions[region].historyOutputs
    for name in ("RF%d" % axis, "U%d" % axis):
        if name not in history.keys():
            fail("no %s of %s: *Output, History and *Node Output, RF, U" % (name, region))
    stroke, energy = dict(history["U%d" % axis].data), {}
    for key in step.historyRegions.keys():
        if "ALLFD" in step.historyRegions[key].historyOutputs.keys():
            energy = dict(step.historyRegions[key].historyOutputs["ALLFD"].data)
    tool, last, moved = [], 0.0, stroke.get(0.0, 0.0)
    for time, force in history["RF%d" % axis].data:
        if time > last and time in stroke:
            tool.append([float(time), abs(stroke[time]), abs(force) / 1e3,
                         abs(stroke[time] - moved) / (time - last),
                         energy[time] / 1e3 if time in energy else ""])  # N mm to J
            last, moved = time, stroke[time]
    if not os.path.isdir(out):
        os.makedirs(out)
    rows.sort(key=lambda row: row[0])
    names = ("time_s facet area_mm2 sigma_n_MPa v_rel_mm_s psi T_contact_C s_mm plastic_strain "
             "tau_R_MPa x_mm y_mm z_mm").split()
    # A column that is empty everywhere is left out.
    kept = [i for i in range(len(names)) if any(row[i] != "" for row in rows)]
    write(out, "contact.csv", [names[i] for i in kept], [[row[i] for i in kept] for row in rows])
    kept = 5 if tool and all(row[4] != "" for row in tool) else 4
    names = ["time_s", "stroke_mm", "force_kN", "speed_mm_s", "friction_J"]
    write(out, "tool.csv", names[:kept], [row[:kept] for row in tool])


if __name__ == "__main__":
    if len(sys.argv) < 7 or sys.argv[4] != "--tool" or sys.argv[6] not in ("1", "2", "3"):
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], sys.argv[3], sys.argv[5], int(sys.argv[6]), sys.argv[7:])
