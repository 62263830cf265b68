#!/usr/bin/python3
"""The ring of this example for stock CalculiX, and what it printed.

ring_deck.py deck MU > ring.inp      the deck: upper half of the ring 18:9:6 mm, reduced by 50 %
ring_deck.py read ring.dat           "FORCE_kN INNER_RADIUS_mm" at the end

Axisymmetric elements with eight nodes and reduced integration (CAX8R), a die that is stiff (E 100
times that of steel) instead of rigid, contact from surface to surface with the penalty of
process_benchmark. Units N, mm, s.
"""
import re
import sys

INNER, OUTER, HEIGHT, STROKE = 4.5, 9.0, 3.0, 1.5  # mm, of the half
COLUMNS, ROWS = 8, 4
DIE_OUTER, DIE_HEIGHT = 16.0, 2.0
YOUNG, POISSON = 210e3, 0.3
PENALTY, STICK = 1e6, 1e5  # MPa/mm
INCREMENT = 0.0125  # of the stroke, at most


def flow_stress(strain):
    return 700 * (0.01 + strain) ** 0.2


def block(first, corner, size, cells):
    """Nodes {number: (r, z)} on a half-spaced grid without cell centres, elements of 8 nodes."""
    number, at = {}, {}
    for j in range(2 * cells[1] + 1):
        for i in range(2 * cells[0] + 1):
            if i % 2 and j % 2:
                continue
            number[i, j] = first + len(at)
            at[number[i, j]] = (corner[0] + size[0] * i / (2 * cells[0]),
                                corner[1] + size[1] * j / (2 * cells[1]))
    around = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))
    elements = [[number[2 * i + a, 2 * j + b] for a, b in around]
                for j in range(cells[1]) for i in range(cells[0])]
    return number, at, elements


def numbers(items):
    items = [str(item) for item in items]
    return ",\n".join(", ".join(items[i:i + 12]) for i in range(0, len(items), 12))


def write_deck(mu):
    ring, ring_at, ring_elements = block(1, (INNER, 0), (OUTER - INNER, HEIGHT), (COLUMNS, ROWS))
    die, die_at, die_elements = block(10001, (0.5, HEIGHT), (DIE_OUTER - 0.5, DIE_HEIGHT), (1, 1))
    print(f"*HEADING\nRing compression, Coulomb friction {mu:g}\n*NODE, NSET=ALL")
    for number, (r, z) in {**ring_at, **die_at}.items():
        print(f"{number}, {r:.9g}, {z:.9g}, 0.")
    for name, first, elements in (("RING", 1, ring_elements), ("DIE", 10001, die_elements)):
        print(f"*ELEMENT, TYPE=CAX8R, ELSET={name}")
        for number, nodes in enumerate(elements, first):
            print(f"{number}, " + ", ".join(map(str, nodes)))
    print("*NSET, NSET=MIDDLE\n" + numbers(n for (_, j), n in ring.items() if j == 0))
    print(f"*NSET, NSET=INNER\n{ring[0, 0]}")
    print("*NSET, NSET=PUSHED\n" + numbers(n for (_, j), n in die.items() if j == 2))
    print("*NSET, NSET=DIENODES\n" + numbers(die_at))
    print("*SURFACE, NAME=RINGTOP")
    for i in range(COLUMNS):
        print(f"{(ROWS - 1) * COLUMNS + i + 1}, S3")
    print("*SURFACE, NAME=DIEFACE\n10001, S1")
    print(f"*MATERIAL, NAME=STEEL\n*ELASTIC\n{YOUNG}, {POISSON}\n*PLASTIC")
    for k in range(120):
        strain = 2.5 * (k / 119) ** 3
        print(f"{flow_stress(strain):.9g}, {strain:.9g}")
    print(f"*MATERIAL, NAME=STIFF\n*ELASTIC\n{100 * YOUNG}, {POISSON}")
    print("*SOLID SECTION, ELSET=RING, MATERIAL=STEEL\n*SOLID SECTION, ELSET=DIE, MATERIAL=STIFF")
    print("*SURFACE INTERACTION, NAME=CONTACT\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n"
          f"{PENALTY}, 1.e-2\n*FRICTION\n{mu}, {STICK}")
    print("*CONTACT PAIR, INTERACTION=CONTACT, TYPE=SURFACE TO SURFACE\nRINGTOP, DIEFACE")
    print("*BOUNDARY\nMIDDLE, 2, 2\nDIENODES, 1, 1")
    print(f"*STEP, NLGEOM, INC=4000\n*STATIC\n0.0025, 1., 1e-6, {INCREMENT}")
    print(f"*BOUNDARY\nPUSHED, 2, 2, {-STROKE}")
    print("*NODE PRINT, NSET=MIDDLE, TOTALS=ONLY\nRF\n*NODE PRINT, NSET=INNER\nU\n*END STEP")


def read_result(path):
    text = open(path).read()
    forces = re.findall(r"total force .*?MIDDLE.*?\n\s*\n?\s*(\S+)\s+(\S+)\s+(\S+)", text)
    moves = re.findall(r"displacements .*?INNER.*?\n\s*\n?\s*1\s+(\S+)\s+(\S+)", text)
    times = [float(t) for t in re.findall(r"displacements .*?INNER and time\s+(\S+)", text)]
    if not forces or not moves or abs(times[-1] - 1) > 1e-6:
        sys.exit("ring_deck.py: CalculiX has not reached the end")
    # The axisymmetric model stands for a sector of two degrees.
    print(abs(float(forces[-1][1])) * 180 / 1e3, INNER + float(moves[-1][0]))


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "deck":
        write_deck(float(sys.argv[2]))
    elif len(sys.argv) == 3 and sys.argv[1] == "read":
        read_result(sys.argv[2])
    else:
        sys.exit(__doc__)
