#!/usr/bin/python3
"""Draws process.svg from what `run` has written for one truth. SYNTHETIC data.

Usage: plot.py FOLDER CURVES; CURVES holds the rings with constant friction factors m.
"""
import sys
from pathlib import Path

from compare import RANGES, read

LAWS = {"routine": ("truth", "#000000"), "coulomb": ("coulomb", "#c0392b"),
        "shear": ("shear", "#d68910"), "wanheim_bay": ("wanheim_bay", "#1e8449"),
        "log_coulomb": ("log_coulomb", "#1f618d"), "neural_network": ("neural_network", "#7d3c98"),
        "coulomb_0.04": ("coulomb_0.04", "#17a589")}
PROCESSES = {"ring": "#1f618d", "rod": "#c0392b"}
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 520, 340, 64, 24, 38, 48


def ticks(low, high):
    """At most seven round numbers from low to high."""
    step = 1e-6
    while True:
        for factor in (1, 2, 5):
            if (high - low) / (factor * step) <= 6:
                first = -(-low // (factor * step))
                return [round((first + i) * factor * step, 9)
                        for i in range(int((high - low) // (factor * step)) + 1)
                        if (first + i) * factor * step <= high * (1 + 1e-12) + 1e-12]
        step *= 10


class Panel:
    """One diagram at (x0, y0); x and y are (label, low, high)."""

    def __init__(self, x0, y0, title, x, y):
        self.left, self.top = x0 + LEFT, y0 + TOP
        self.width, self.height = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM
        self.x, self.y = x, y
        self.out = [f'<text x="{x0 + LEFT}" y="{y0 + 24}" font-weight="bold">{title}</text>']
        bottom = self.top + self.height
        for value in ticks(*x[1:]):
            px = self.at(value, y[1])[0]
            self.out.append(f'<path d="M{px:.1f} {self.top}V{bottom}" stroke="#eee"/>'
                            f'<text x="{px:.1f}" y="{bottom + 17}" text-anchor="middle">'
                            f'{value:g}</text>')
        for value in ticks(*y[1:]):
            py = self.at(x[1], value)[1]
            self.out.append(f'<path d="M{self.left} {py:.1f}h{self.width}" stroke="#eee"/>'
                            f'<text x="{self.left - 6}" y="{py + 4:.1f}" text-anchor="end">'
                            f'{value:g}</text>')
        self.out.append(f'<rect x="{self.left}" y="{self.top}" width="{self.width}" '
                        f'height="{self.height}" fill="none" stroke="#444"/>'
                        f'<text x="{self.left + self.width / 2}" y="{bottom + 38}" '
                        f'text-anchor="middle">{x[0]}</text>'
                        f'<text transform="translate({x0 + 16},{self.top + self.height / 2}) '
                        f'rotate(-90)" text-anchor="middle">{y[0]}</text>')

    def at(self, x, y):
        return (self.left + self.width * (x - self.x[1]) / (self.x[2] - self.x[1]),
                self.top + self.height * (1 - (y - self.y[1]) / (self.y[2] - self.y[1])))

    def inside(self, x, y):
        return self.x[1] <= x <= self.x[2] and self.y[1] <= y <= self.y[2]

    def line(self, xs, ys, colour, style=""):
        points = [self.at(x, y) for x, y in zip(xs, ys) if self.inside(x, y)]
        path = "L".join(f"{px:.1f} {py:.1f}" for px, py in points)
        self.out.append(f'<path d="M{path}" fill="none" stroke="{colour}" {style}/>')

    def dots(self, xs, ys, colour):
        for x, y in zip(xs, ys):
            if self.inside(x, y):
                px, py = self.at(x, y)
                self.out.append(f'<circle cx="{px:.1f}" cy="{py:.1f}" r="1.6" fill="{colour}" '
                                'fill-opacity="0.45"/>')

    def range(self, x, y):
        a, b = self.at(max(x[0], self.x[1]), min(y[1], self.y[2])), \
            self.at(min(x[1], self.x[2]), max(y[0], self.y[1]))
        self.out.append(f'<rect x="{a[0]:.1f}" y="{a[1]:.1f}" width="{b[0] - a[0]:.1f}" '
                        f'height="{b[1] - a[1]:.1f}" fill="#2ecc71" fill-opacity="0.15" '
                        'stroke="#27ae60" stroke-dasharray="5 3"/>')

    def note(self, x, y, text):
        px, py = self.at(x, y)
        self.out.append(f'<text x="{px - 4:.1f}" y="{py + 4:.1f}" fill="#888" font-size="11" '
                        f'text-anchor="end">{text}</text>')


def force_panel(folder, process, x0, y0):
    curves = {law: read(folder / process / f"{law}_force.csv") for law in LAWS}
    stroke = max(curves["routine"]["stroke_mm"])
    most = max(max(c["force_kN"]) for c in curves.values())
    panel = Panel(x0, y0, f"{process}: force (synthetic)", ("stroke, mm", 0, stroke),
                  ("kN", 0, 1.05 * most))
    for law, curve in curves.items():
        dash = 'stroke-width="1.5"' + (' stroke-dasharray="6 3"' if law == "routine" else "")
        panel.line(curve["stroke_mm"], curve["force_kN"], LAWS[law][1], dash)
    return panel.out


def shrinkage(curve):
    start = curve["inner_mid_mm"][0]
    return ([100 * x for x in curve["reduction"]],
            [100 * (1 - r / start) for r in curve["inner_mid_mm"]])


def ring_panel(folder, curves, x0, y0):
    panel = Panel(x0, y0, "ring: inner diameter at mid height (synthetic)",
                  ("reduction of height, %", 0, 50), ("decrease of inner diameter, %", -45, 55))
    for path in sorted(curves.glob("*_force.csv")):
        x, y = shrinkage(read(path))
        panel.line(x, y, "#bbbbbb", 'stroke-width="1"')
        panel.note(x[-1], y[-1], "m = " + path.name.split("_")[0])
    for law, (_, colour) in LAWS.items():
        x, y = shrinkage(read(folder / "ring" / f"{law}_force.csv"))
        panel.line(x, y, colour, 'stroke-width="1.6"' +
                   (' stroke-dasharray="6 3"' if law == "routine" else ""))
    return panel.out


def map_panel(folder, x0, y0, title, x, y, columns):
    panel = Panel(x0, y0, title, x, y)
    panel.range(RANGES[columns[0]], RANGES[columns[1]])
    for process, colour in PROCESSES.items():
        points = read(folder / process / "routine_contact.csv")
        panel.dots(points[columns[0]], points[columns[1]], colour)
    return panel.out


def legend():
    out, x = [], 20
    for name, colour in [*LAWS.values(), *((f"contact: {p}", c) for p, c in PROCESSES.items()),
                         ("range of the campaign", "#27ae60")]:
        out.append(f'<path d="M{x} 18h20" stroke="{colour}" stroke-width="3"/>'
                   f'<text x="{x + 25}" y="22">{name}</text>')
        x += 44 + 7 * len(name)
    return out


def main():
    folder, curves = Path(sys.argv[1]), Path(sys.argv[2])
    out = legend()
    out += force_panel(folder, "ring", 0, 30)
    out += ring_panel(folder, curves, WIDTH, 30)
    out += force_panel(folder, "rod", 0, 30 + HEIGHT)
    out += map_panel(folder, WIDTH, 30 + HEIGHT,
                     "contact with the truth: pressure, speed (synthetic)",
                     ("sigma_n, MPa", 0, 3000), ("v_rel, mm/s", 0, 80),
                     ("sigma_n_MPa", "v_rel_mm_s"))
    out += map_panel(folder, 0, 30 + 2 * HEIGHT,
                     "contact with the truth: expansion, temperature (synthetic)",
                     ("psi", 0, 4), ("T_contact, degC", 0, 260), ("psi", "T_contact_C"))
    out += map_panel(folder, WIDTH, 30 + 2 * HEIGHT,
                     "contact with the truth: pressure, expansion (synthetic)",
                     ("sigma_n, MPa", 0, 3000), ("psi", 0, 4), ("sigma_n_MPa", "psi"))
    size = f'width="{2 * WIDTH}" height="{30 + 3 * HEIGHT}"'
    (folder / "process.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="sans-serif" font-size="12">'
        f'<rect {size} fill="white"/>' + "\n".join(out) + "</svg>\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main()
