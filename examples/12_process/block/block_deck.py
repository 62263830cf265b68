#!/usr/bin/python3
"""Writes a deck for CalculiX: a steel block pressed between two wedge dies, with Coulomb friction.

block_deck.py MU > block.inp                the dies close with 50 mm/s
block_deck.py MU --force KN > block.inp     a force pushes them, which grows to KN linearly

The block is 12 x 10 x 8 mm. The dies are roofs, highest at x = 0 and 5 degrees steep, so that they
touch along a line first. Three planes of symmetry: an eighth of the block, 6 x 5 x 4 mm, is meshed,
and a quarter of the upper die, as one rigid brick. Seen from the middle plane a die moves with half
the speed. Units N, mm, s. KN is the whole force of a die; the deck has a quarter of it.
"""
import math
import sys

SIZE, CELLS = (6.0, 5.0, 4.0), (10, 8, 6)
ANGLE = 5.0  # degrees
STROKE, SPEED = 1.5, 25.0  # mm and mm/s of one die
YOUNG, POISSON = 210e3, 0.3
PENALTY, STICK = 1e5, 2e4  # MPa/mm
INCREMENT = 0.02  # of the time, at most
FIRST = 0.002  # of the time: until the first step ends
AROUND = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))


def flow_stress(strain):
    return 700 * (0.01 + strain) ** 0.2


def numbers(items):
    items = [str(item) for item in items]
    return ",\n".join(", ".join(items[i:i + 12]) for i in range(0, len(items), 12))


def main(mu, force_kN):
    nx, ny, nz = CELLS
    node, at = {}, {}
    for k in range(nz + 1):
        for j in range(ny + 1):
            for i in range(nx + 1):
                node[i, j, k] = len(node) + 1
                at[len(node)] = [s * n / c for s, n, c in zip(SIZE, (i, j, k), CELLS)]
    bricks, top = [], []
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                bricks.append([node[i + a, j + b, k + c] for a, b, c in AROUND])
                if k == nz - 1:
                    top.append(len(bricks))
    # The die: one brick of 8 nodes, its lower face on the slope.
    slope = math.tan(math.radians(ANGLE))
    die = {}
    for z in (0, 3):
        for x, y in ((-1, -1), (12, -1), (12, 9), (-1, 9)):
            die[90001 + len(die)] = (x, y, SIZE[2] + slope * x + z)
    master = 90005

    print(f"*HEADING\nBlock between wedge dies, Coulomb friction {mu:g}\n*NODE, NSET=ALL")
    for n, place in {**at, **die}.items():
        print(f"{n}, " + ", ".join(f"{x:.9g}" for x in place))
    print("*ELEMENT, TYPE=C3D8I, ELSET=BLOCK")
    for n, nodes in enumerate(bricks, 1):
        print(f"{n}, " + numbers(nodes))
    print("*ELEMENT, TYPE=C3D8, ELSET=DIE\n90001, " + numbers(die))
    for name, axis in (("MIDX", 0), ("MIDY", 1), ("MIDZ", 2)):
        print(f"*NSET, NSET={name}\n" + numbers(n for g, n in node.items() if g[axis] == 0))
    print("*NSET, NSET=DIENODES\n" + numbers(die) + f"\n*NSET, NSET=MASTER\n{master}")
    print("*ELSET, ELSET=TOPBRICKS\n" + numbers(top))
    print("*SURFACE, NAME=BLOCKTOP\n" + "\n".join(f"{e}, S2" for e in top))
    print("*SURFACE, NAME=DIEFACE\n90001, S1")
    print(f"*MATERIAL, NAME=STEEL\n*ELASTIC\n{YOUNG}, {POISSON}\n*PLASTIC")
    for k in range(120):
        strain = 3 * (k / 119) ** 3
        print(f"{flow_stress(strain):.9g}, {strain:.9g}")
    print(f"*MATERIAL, NAME=STIFF\n*ELASTIC\n{100 * YOUNG}, {POISSON}")
    print("*SOLID SECTION, ELSET=BLOCK, MATERIAL=STEEL\n*SOLID SECTION, ELSET=DIE, MATERIAL=STIFF")
    print("*SURFACE INTERACTION, NAME=CONTACT\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n"
          f"{PENALTY}, 1.e-2\n*FRICTION\n{mu:g}, {STICK}")
    print("*CONTACT PAIR, INTERACTION=CONTACT, TYPE=SURFACE TO SURFACE\nBLOCKTOP, DIEFACE")
    print("*BOUNDARY\nMIDX, 1, 1\nMIDY, 2, 2\nMIDZ, 3, 3\nDIENODES, 1, 2")
    time = STROKE / SPEED
    if force_kN:
        # All nodes of the die move like one. A weak spring holds it before it touches.
        print("*EQUATION")
        for n in die:
            if n != master:
                print(f"2\n{n}, 3, 1., {master}, 3, -1.")
        print("*ELEMENT, TYPE=SPRING1, ELSET=HOLD\n90002, 90005\n*SPRING, ELSET=HOLD\n3\n10.")
    # The process is the second step. In a first one CalculiX forgives any overlap at the start of
    # each increment and takes it back until the step ends: the die would lag behind.
    for part in (FIRST, 1.0):
        span = time * (part if part < 1 else 1 - FIRST)
        inc = min(INCREMENT * time, span)
        print(f"*STEP, NLGEOM, INC=2000\n*STATIC\n{inc / 4:.9g}, {span:.9g}, 1e-9, {inc:.9g}")
        if force_kN:
            print(f"*CLOAD\nMASTER, 3, {-part * force_kN * 1000 / 4:.9g}")
        else:
            print(f"*BOUNDARY\nDIENODES, 3, 3, {-part * STROKE:.9g}")
        print("*NODE PRINT, NSET=ALL\nU\n*NODE PRINT, NSET=DIENODES, TOTALS=ONLY\nRF\n"
              "*EL PRINT, ELSET=TOPBRICKS\nPEEQ\n*CONTACT PRINT\nCDIS, CSTR\n"
              # For check.py: energy of the contact springs and of the block.
              "*CONTACT PRINT, TOTALS=ONLY\nCELS\n*EL PRINT, ELSET=BLOCK, TOTALS=ONLY\nELSE\n"
              "*END STEP")


if __name__ == "__main__":
    if len(sys.argv) == 2:
        main(float(sys.argv[1]), 0)
    elif len(sys.argv) == 4 and sys.argv[2] == "--force":
        main(float(sys.argv[1]), float(sys.argv[3]))
    else:
        sys.exit(__doc__)
