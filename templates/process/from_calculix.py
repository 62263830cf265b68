#!/usr/bin/env python3
"""contact.csv and tool.csv for `frictab process` from a job of CalculiX (2.20; 3D, static).

from_calculix.py JOB OUT_FOLDER --tool NSET AXIS [--times N]
JOB without its ending: JOB.inp for nodes, elements and contact pairs; JOB.dat and, for what is not
there, JOB.frd (ASCII) for the results. NSET: the tool's nodes that the force acts on, AXIS: 1, 2
or 3. N: the force written is N times that of the model (then frictab needs --symmetry N).
Units N, mm, s; time is the real one and starts at 0. The step must request, at every increment:
    *NODE PRINT, NSET=ALL                      or *NODE FILE
    U
    *NODE PRINT, NSET=NSET, TOTALS=ONLY
    RF
    *CONTACT PRINT                             or *CONTACT FILE (while the contact grows, its nodal
    CDIS, CSTR                                 values give too much force at the edge)
    *EL PRINT, ELSET=SKIN                      or *EL FILE; it may be left out
    PEEQ
Let a short first step touch and the second be the process: in a static first step CalculiX takes
any overlap at the start of an increment for an initial one, so that the tool lags behind.
A facet is a face of a slave surface. Its slip is that of its corners against the nearest node of
the tool, which must be stiff; CDIS would be that of points which come and go as the contact grows.
"""
import collections
import csv
import os
import re
import sys

# Corners of every face, by number of corners of the element. Nodes in the middle are left out.
FACES = {8: ("1234", "5876", "1562", "2673", "3784", "4851"), 4: ("123", "142", "243", "341"),
         6: ("123", "456", "1254", "2365", "3146")}
CORNERS = {8: 8, 20: 8, 4: 4, 10: 4, 6: 6, 15: 6}


def fail(text):
    sys.stderr.write("from_calculix.py: " + text + "\n")
    sys.exit(2)


def lines_of(path):
    if not os.path.exists(path):
        fail("no file " + path)
    return open(path, errors="replace")


def read_deck(path):
    """Nodes {number: place}, elements {number: corners}, sets, surfaces {name: faces}, pairs."""
    at, corners, pairs, held, steps = {}, {}, [], [], 0
    sets, surfaces = collections.defaultdict(list), collections.defaultdict(list)
    for line in lines_of(path):
        words = [w.strip().upper() for w in line.strip().rstrip(",").split(",")]
        if line.startswith("**") or not line.strip():
            continue
        if line.startswith("*"):
            key = words[0].replace(" ", "")
            steps += key == "*STEP"
            option = dict((w.replace(" ", "") + "=").split("=")[:2] for w in words[1:])
        elif key == "*NODE":
            at[int(words[0])] = [float(w) for w in (words[1:] + ["0"] * 3)[:3]]
            sets["N", option.get("NSET")].append(int(words[0]))
        elif key == "*ELEMENT":
            count = int((re.findall(r"C3D(\d+)", option["TYPE"]) or ["0"])[0])
            held += [int(w) for w in words]
            if len(held) > count:  # the nodes of an element may go on in the next line
                corners[held[0]] = held[1:CORNERS.get(count, 0) + 1]
                sets["E", option.get("ELSET")].append(held[0])
                held = []
        elif key in ("*NSET", "*ELSET"):
            found = sets[key[1], option[key[1:]]]
            if "GENERATE" in option:
                first, last, step = ([int(w) for w in words] + [1])[:3]
                found += range(first, last + 1, step)
            else:
                for w in words:
                    found += [int(w)] if w.isdigit() else sets[key[1], w]
        elif key == "*SURFACE" and len(words) == 2 and re.match(r"S\d", words[1]):
            number = int(words[1][1])
            for e in [int(words[0])] if words[0].isdigit() else sets["E", words[0]]:
                if not corners.get(e):
                    fail("surface %s: only faces of 3D elements (C3D...) are read" % option["NAME"])
                nodes = [corners[e][int(c) - 1] for c in FACES[len(corners[e])][number - 1]]
                surfaces[option["NAME"]].append(((e, number), nodes))
        elif key == "*CONTACTPAIR":
            pairs.append(words[:2])
    if steps == 1:
        sys.stderr.write("from_calculix.py: warning: one step only: the tool may lag behind\n")
    return at, sets, surfaces, pairs


def read_dat(path):
    """{title: {time: rows of numbers}}"""
    found, rows = collections.defaultdict(dict), []
    for line in lines_of(path):
        title = re.match(r" (\S.*?) (?:and|for) time +(\S+)\s*$", line)
        words = line.split()
        if title:
            rows = found[title.group(1)].setdefault(float(title.group(2)), [])
        elif words:
            try:
                rows.append([float(w) for w in words])
            except ValueError:
                rows = []  # a title without a time: not ours
    return found


def read_frd(path):
    """{name: {time: rows}}, rows like those of the dat: node, numbers (12 characters each)"""
    found, time, rows = collections.defaultdict(dict), 0.0, []
    for line in lines_of(path) if os.path.exists(path) else []:
        if line.startswith("  100C"):
            time = float(line[12:24])
        elif line.startswith(" -4"):
            rows = found[line.split()[1]].setdefault(time, [])
        elif line.startswith(" -1"):
            text = line[13:].rstrip()
            rows.append([int(line[3:13])] + [float(text[i:i + 12]) for i in range(0, len(text), 12)
                                             if "." in text[i:i + 12]])
        elif line.startswith(" -3"):
            rows = []
    return found


def blocks(dat, start, frd, name):
    """{time: rows} of all titles of the dat that start so; if there is none, of the frd."""
    found = collections.defaultdict(list)
    for title in dat:
        if title.startswith(start):
            for time in dat[title]:
                found[time] += dat[title][time]
    return found or frd.get(name, {})


def at_time(found, time):
    near = min(found, key=lambda t: abs(t - time)) if found else 0.0  # a frd has five digits of it
    return found[near] if found and abs(near - time) <= 2e-5 * time else []


def area_vector(p):
    """Area times normal: half the cross product of the diagonals, in a triangle of two sides."""
    a = [x - y for x, y in zip(p[2], p[0])]
    b = [x - y for x, y in zip(p[-1], p[1])]
    if len(p) == 3:
        b = [x - y for x, y in zip(p[0], p[1])]
    return [(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2]) / 2 for i in range(3)]


def size(v):
    return sum(x * x for x in v) ** 0.5


def mean(rows):
    return [sum(column) / len(rows) for column in zip(*rows)]


def main(job, out, nset, axis, times):
    at, sets, surfaces, pairs = read_deck(job + ".inp")
    dat, frd = read_dat(job + ".dat"), read_frd(job + ".frd")
    moves = blocks(dat, "displacements", frd, "DISP")
    stress = blocks(dat, "contact stress", frd, "CONTACT")
    strain = blocks(dat, "equivalent plastic", frd, "PE")
    force = dat.get("total force (fx,fy,fz) for set " + nset)
    tool = sets["N", nset] or fail("the deck has no *NSET " + nset)
    all_u = "*NODE PRINT (or *NODE FILE) with U for all nodes of workpiece and tool"
    for found, need in ((pairs, "*CONTACT PAIR"), (moves, all_u),
                        (stress, "*CONTACT PRINT (or *CONTACT FILE) with CDIS, CSTR"),
                        (force, "*NODE PRINT, NSET=%s, TOTALS=ONLY with RF" % nset)):
        if not found:
            fail("the deck needs " + need)
    for name in sum(pairs, []):
        if name not in surfaces:
            fail("surface %s must be made of faces (*SURFACE, TYPE=ELEMENT)" % name)
    faces = dict(f for slave, _ in pairs for f in surfaces[slave])
    master = sorted(set(n for _, other in pairs for _, nodes in surfaces[other] for n in nodes))
    contact_rows, tool_rows, path = [], [], {}
    most = collections.Counter()  # the points that a face had when most of it touched
    for rows in stress.values():
        for f, n in collections.Counter((r[0], r[1]) for r in rows if len(r) == 5).items():
            most[f] = max(most[f], n)
    last, before = 0.0, dict((n, [0.0] * 3) for n in at)
    for time in sorted(force):
        u = dict((int(r[0]), r[1:4]) for r in at_time(moves, time))
        if not u:
            continue  # U is written at fewer increments
        for n in master + tool + sum(faces.values(), []):
            if n not in u:
                fail("no displacement of node %d: the deck needs %s" % (n, all_u))
        now = dict((n, [x + d for x, d in zip(at[n], u[n])]) for n in u)
        points, plastic = collections.defaultdict(list), collections.defaultdict(list)
        for r in at_time(stress, time):  # element, face, p, t1, t2 or node, ..., p, t1, t2
            if r[-3] > 0:
                points[(r[0], r[1]) if len(r) == 5 else r[0]].append((r[-3], size(r[-2:])))
        for r in at_time(strain, time):  # of the element (integration points) or of nodes
            plastic[r[0]].append(r[-1])
        stroke, stroke_before = [mean([w[n] for n in tool])[axis] for w in (u, before)]
        tool_rows.append([time, abs(stroke), times * abs(force[time][0][axis]) / 1e3,
                          abs(stroke - stroke_before) / (time - last)])
        touching = {}
        for f, nodes in sorted(faces.items()):
            own = points[f] or sum((points[n] for n in nodes), [])
            if not own:
                continue
            # At the edge of the contact a part of a face touches: that part of its points or nodes.
            part = len(own) / float(most[f] if points[f] else len(nodes))
            normal = area_vector([now[n] for n in nodes])
            area, start = size(normal), size(area_vector([at[n] for n in nodes]))
            place = mean([now[n] for n in nodes])
            near = min(master, key=lambda n: size([x - y for x, y in zip(now[n], place)]))
            own_u, own_before = [mean([w[n] for n in nodes]) for w in (u, before)]
            moved = [x - y - (a - b)
                     for x, y, a, b in zip(own_u, own_before, u[near], before[near])]
            along = sum(x * y for x, y in zip(moved, normal)) / area**2
            slip = size([x - along * y for x, y in zip(moved, normal)])
            touching[f] = path[f] + slip if f in path else 0.0
            eps = plastic[f[0]] or sum((plastic[n] for n in nodes), [])
            p, tau = mean(own)
            contact_rows.append([time, "%d.%d" % f, area * part, p, slip / (time - last),
                                 area / start, touching[f], sum(eps) / len(eps) if eps else "",
                                 tau] + place)
        path, last, before = touching, time, u
    if not os.path.isdir(out):
        os.makedirs(out)
    names = ("time_s facet area_mm2 sigma_n_MPa v_rel_mm_s psi s_mm plastic_strain tau_R_MPa "
             "x_mm y_mm z_mm")
    for name, header, rows in (("contact.csv", names, contact_rows),
                               ("tool.csv", "time_s stroke_mm force_kN speed_mm_s", tool_rows)):
        with open(os.path.join(out, name), "w") as file:
            write = csv.writer(file, lineterminator="\n")
            write.writerow(header.split())
            write.writerows([x if isinstance(x, str) else "%.8g" % x for x in row] for row in rows)


if __name__ == "__main__":
    given = sys.argv[1:]
    if (len(given) not in (5, 7) or given[2] != "--tool" or given[4] not in ("1", "2", "3")
            or given[5:6] not in ([], ["--times"])):
        sys.stderr.write(__doc__)
        sys.exit(2)
    main(given[0], given[1], given[3].upper(), int(given[4]) - 1,
         float(given[6]) if given[5:] else 1.0)
