#!/usr/bin/python3
"""Draws sliding.svg from what `slide` has written. Usage: plot.py FOLDER LAW..."""
import csv
import sys
from pathlib import Path

COLOURS = ["#777777", "#c0392b", "#1f618d", "#1e8449"]
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 470, 300, 70, 20, 40, 50


def read(path):
    rows = list(csv.DictReader(path.open()))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def nice_step(span, most=6):
    """The smallest of 1, 2, 5 times a power of ten that leaves at most `most` steps."""
    step = 10.0 ** -9
    while True:
        for factor in (1, 2, 5):
            if span / (factor * step) <= most:
                return factor * step
        step *= 10


def panel(x0, y0, title, x_label, y_label, curves, dots=False, y_from=None):
    """curves: [(colour, xs, ys)]; the vertical axis starts at y_from, or at the data."""
    xs = [x for _, x, _ in curves for x in x]
    ys = [y for _, _, y in curves for y in y]
    x_low, x_high = min(xs), max(xs)
    y_low, y_high = (min(ys) if y_from is None else y_from), max(ys)
    y_step = nice_step(y_high - y_low)
    y_low, y_high = (y_low // y_step) * y_step, -((-y_high) // y_step) * y_step
    x_step = nice_step(x_high - x_low)
    w, h = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM

    def at(x, y):
        return (x0 + LEFT + w * (x - x_low) / (x_high - x_low),
                y0 + TOP + h * (1 - (y - y_low) / (y_high - y_low)))

    out = [f'<text x="{x0 + LEFT}" y="{y0 + 24}" font-weight="bold">{title}</text>']
    y = y_low
    while y <= y_high + y_step / 2:
        a, b = at(x_low, y), at(x_high, y)
        out.append(f'<path d="M{a[0]:.1f} {a[1]:.1f}H{b[0]:.1f}" stroke="#ddd"/>'
                   f'<text x="{a[0] - 6:.1f}" y="{a[1] + 4:.1f}" text-anchor="end">{y:g}</text>'
                   .replace(f"{y:g}<", f"{round(y, 9):g}<"))
        y += y_step
    x = -((-x_low) // x_step) * x_step
    while x <= x_high + x_step / 1e6:
        a = at(x, y_low)
        out.append(f'<path d="M{a[0]:.1f} {a[1]:.1f}v5" stroke="#444"/><text x="{a[0]:.1f}" '
                   f'y="{a[1] + 18:.1f}" text-anchor="middle">{round(x, 9):g}</text>')
        x += x_step
    bottom = at(x_low, y_low)
    out.append(f'<path d="M{bottom[0]:.1f} {bottom[1]:.1f}h{w}" stroke="#444"/>'
               f'<text x="{x0 + LEFT + w / 2}" y="{y0 + HEIGHT - 10}" text-anchor="middle">{x_label}'
               f'</text><text transform="translate({x0 + 16},{y0 + TOP + h / 2}) rotate(-90)" '
               f'text-anchor="middle">{y_label}</text>')
    for colour, xs, ys in curves:
        points = [at(x, y) for x, y in zip(xs, ys)]
        path = "L".join(f"{px:.1f} {py:.1f}" for px, py in points)
        out.append(f'<path d="M{path}" fill="none" stroke="{colour}" stroke-width="1.6"/>')
        if dots:
            out += [f'<circle cx="{px:.1f}" cy="{py:.1f}" r="3" fill="{colour}"/>'
                    for px, py in points]
    return out


def main():
    folder, laws = Path(sys.argv[1]), sys.argv[2:]
    force = {law: read(folder / f"{law}_force.csv") for law in laws}
    contact = {law: read(folder / f"{law}_contact.csv") for law in laws}
    for rows in contact.values():  # GetFEM lists the points of a face in its own order
        order = sorted(range(len(rows["x_mm"])), key=rows["x_mm"].__getitem__)
        for name, values in rows.items():
            rows[name] = [values[i] for i in order]
    colour = dict(zip(laws, COLOURS))

    def along(column):
        return [(colour[law], contact[law]["x_mm"], contact[law][column]) for law in laws]

    end = {name: values[-1] for name, values in force[laws[0]].items()}
    state = f'at {end["speed_mm_s"]:g} mm/s, {end["T_contact_C"]:g} °C'
    out = panel(0, 30, "Force that slides the block (per mm of thickness)", "slid, mm", "N/mm",
                [(colour[law], force[law]["slid_mm"], force[law]["tangential_N_mm"])
                 for law in laws], dots=True)
    out += panel(WIDTH, 30, f"Contact normal stress {state}", "x, mm", "MPa",
                 along("sigma_n_MPa"), y_from=0)
    out += panel(0, 30 + HEIGHT, f"Frictional shear stress {state}", "x, mm", "MPa",
                 along("tau_MPa"), y_from=0)
    out += panel(WIDTH, 30 + HEIGHT, f"Shear stress / normal stress {state}", "x, mm", "tau_R / p",
                 along("mu"), y_from=0)
    legend = 20
    for law in laws:
        out.append(f'<path d="M{legend} 18h24" stroke="{colour[law]}" stroke-width="3"/>'
                   f'<text x="{legend + 30}" y="22">{law}</text>')
        legend += 50 + 8 * len(law)
    out.append(f'<text x="{legend + 20}" y="22" fill="#666">synthetic data</text>')
    size = f'width="{2 * WIDTH}" height="{30 + 2 * HEIGHT}"'
    (folder / "sliding.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="sans-serif" font-size="12">'
        f'<rect {size} fill="white"/>' + "\n".join(out) + "</svg>\n")


if __name__ == "__main__":
    main()
