#!/usr/bin/python3
"""Writes sliding.inp: three pairs of blocks, pressed together at 500, 1000 and 2000 MPa and slid.

Each lower block (20 x 4 x 4 mm) stands on its base; the upper one (8 x 3.6 x 4 mm) is pressed by a
pressure on its top and then moved along x, every node of its top alike. All bricks are linear
(C3D8), units N, mm, s. Usage: deck.py > sliding.inp
"""

PRESSURES = (500, 1000, 2000)
SPEEDS = (100, 50, 20, 200, 400)  # mm/s, one step each
STEP = 1e-3  # s
E, NU = 210e3, 0.3


class Mesh:
    def __init__(self):
        self.nodes, self.bricks = [], []

    def block(self, origin, size, cells):
        """Adds a block; its nodes by grid index and its elements by cell index."""
        nx, ny, nz = cells
        node, brick = {}, {}
        for k in range(nz + 1):
            for j in range(ny + 1):
                for i in range(nx + 1):
                    at = [o + s * n / c for o, s, n, c in zip(origin, size, (i, j, k), cells)]
                    self.nodes.append(at)
                    node[i, j, k] = len(self.nodes)
        for k in range(nz):
            for j in range(ny):
                for i in range(nx):
                    self.bricks.append([node[i + a, j + b, k + c] for c in (0, 1)
                                        for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])
                    brick[i, j, k] = len(self.bricks)
        return node, brick


def lines(items, per_line=10):
    items = [str(item) for item in items]
    return "\n".join(", ".join(items[i:i + per_line]) for i in range(0, len(items), per_line))


def main():
    mesh = Mesh()
    sets, surfaces, pairs, loads = [], [], [], []
    bases, tops = [], []
    for number, pressure in enumerate(PRESSURES, 1):
        y = 10.0 * number
        node, brick = mesh.block((0, y, 0), (20, 4, 4), (10, 2, 2))
        bases += [n for (_, _, k), n in node.items() if k == 0]
        surfaces.append((f"LOWER{number}", 2, [b for (_, _, k), b in brick.items() if k == 1]))
        # A little narrower than the lower block, and off its grid.
        node, brick = mesh.block((3.3, y + 0.2, 4), (8, 3.6, 4), (5, 3, 2))
        tops += [n for (_, _, k), n in node.items() if k == 2]
        surfaces.append((f"UPPER{number}", 1, [b for (_, _, k), b in brick.items() if k == 0]))
        loads += [(b, pressure) for (_, _, k), b in brick.items() if k == 1]
        pairs.append(number)
    print("*HEADING\nTwo blocks slid over each other at three pressures\n*NODE, NSET=ALL")
    for number, at in enumerate(mesh.nodes, 1):
        print(f"{number}, " + ", ".join(f"{x:.9g}" for x in at))
    print("*ELEMENT, TYPE=C3D8, ELSET=BLOCKS")
    for number, brick in enumerate(mesh.bricks, 1):
        print(f"{number}, " + ", ".join(map(str, brick)))
    print("*NSET, NSET=BASE\n" + lines(bases) + "\n*NSET, NSET=TOP\n" + lines(tops))
    for name, face, bricks in surfaces:
        print(f"*SURFACE, NAME={name}")
        print("\n".join(f"{b}, S{face}" for b in bricks))
    print(f"*MATERIAL, NAME=STEEL\n*ELASTIC\n{E}, {NU}")
    print("*SOLID SECTION, ELSET=BLOCKS, MATERIAL=STEEL")
    # The coefficient here only says that there is friction: usrmu gives the one that is used.
    print("*SURFACE INTERACTION, NAME=DIE\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n"
          "1.e6, 1.e-3\n*FRICTION\n0.1, 1.e6")
    for number in pairs:
        print("*CONTACT PAIR, INTERACTION=DIE, TYPE=SURFACE TO SURFACE\n"
              f"UPPER{number}, LOWER{number}")
    print("*BOUNDARY\nBASE, 1, 3\nTOP, 1, 2")
    step = 0
    slid = 0.0
    for speed in (0,) + SPEEDS:
        slid += speed * STEP
        inc = 0.25 if step == 0 else 0.5
        print(f"*STEP, NLGEOM, INC=200\n*STATIC\n{inc * STEP}, {STEP}, 1e-9, {inc * STEP}")
        print(f"*BOUNDARY\nTOP, 1, 1, {slid:.9g}")
        if step == 0:
            print("*DLOAD\n" + "\n".join(f"{b}, P2, {p}" for b, p in loads))
        print("*CONTACT PRINT\nCDIS, CSTR")
        print("*END STEP")
        step += 1


if __name__ == "__main__":
    main()
