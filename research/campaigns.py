"""Synthetic friction campaigns with a known truth, for judging searches of what a law lacks.

    campaigns.py DIR --kind bump --seed 3      writes one campaign; --list names the kinds
Seeds below 1000 are for development, those from 1000 on for one last run (--last)."""
import argparse
import itertools
import json
import zlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from scipy.optimize import least_squares
from scipy.stats import norm

FIRST_LAST_SEED = 1000
SIZES = (0.05, 0.15, 0.5)  # mean error by what the law lacks, as a share of the mean stress
HELD_OUT_TESTS = 60
LAW_INPUTS = ("sigma_n_MPa", "v_rel_mm_s", "T_contact_C", "sigma_f_MPa", "psi")
ORDER_COLUMNS = ("start_time", "run_order")


# --- laws, as `frictab explain LAW` has them ---------------------------------------------------------

def coefficient(law, p, f):
    s, v, t = f["sigma_n_MPa"], f["v_rel_mm_s"], f["T_contact_C"]
    if law == "coulomb":
        return p[0] + 0 * s
    if law == "filzek_ludwig":
        return p[0] * (s / 100) ** (p[1] - 1) - p[2] * np.log(v)
    if law == "log_coulomb":
        return p[0] + p[1] * np.log(s / 1000) + p[2] * np.log(v / 100) + p[3] * np.log(t / 100)
    if law == "exp_coulomb":
        return p[0] * (s / 1000) ** p[1] * np.exp(p[2] * (t - 20))
    return p[0] * (s / 1000) ** p[1] * (v / 100) ** p[2] * (t / 100) ** p[3]  # wzl


def law_stress(law, p, f, on_mu=1.0, on_limit=1.0):
    s = f["sigma_n_MPa"]
    if law not in ("orowan", "levanov"):
        return on_mu * coefficient(law, p, f) * s
    k = f["sigma_f_MPa"] / np.sqrt(3)
    if law == "orowan":
        return np.minimum(np.minimum(p[0] * on_mu * s, p[1] * on_limit * k), k)
    return np.minimum(p[0] * on_mu * k * (1 - np.exp(-1.25 * s / f["sigma_f_MPa"])), k)


def draw_parameters(law, rng):
    u = rng.uniform
    return {"coulomb": lambda: [u(0.08, 0.25)],
            "filzek_ludwig": lambda: [u(0.15, 0.25), u(0.85, 0.95), u(0.004, 0.012)],
            "log_coulomb": lambda: [u(0.12, 0.17), u(-0.003, 0.003), u(-0.008, 0.004), u(-0.015, 0.015)],
            "exp_coulomb": lambda: [u(0.05, 0.08), u(-0.15, -0.05), u(-0.001, 0.0005)],
            "wzl": lambda: [u(0.06, 0.09), u(-0.15, 0), u(-0.15, -0.03), u(-0.1, 0.2)],
            "orowan": lambda: [u(0.1, 0.2), u(0.25, 0.5)],
            "levanov": lambda: [u(0.15, 0.4)]}[law]()


# --- rigs: states with (low, high, logarithmic) and how the rig records them ---------------------

RIGS = {
    "strip": dict(laws=("coulomb", "filzek_ludwig"), stroke_mm=300,
                  states={"sigma_n_MPa": (2, 40, 1), "v_rel_mm_s": (10, 500, 1), "T_contact_C": (20, 120, 0)},
                  recorded={"sigma_n_MPa": ("jaw_bar", "bar", 10, 0), "v_rel_mm_s": ("draw_m_min", "m/min", 0.06, 0),
                            "T_contact_C": ("strip_K", "K", 1, 273.15), "s_mm": ("drawn_m", "m", 1e-3, 0),
                            "tau_R_MPa": ("drag_kPa", "kPa", 1000, 0)}),
    "brake": dict(laws=("log_coulomb", "exp_coulomb"), stroke_mm=200000,
                  states={"sigma_n_MPa": (0.3, 4, 1), "v_rel_mm_s": (500, 15000, 1), "T_contact_C": (40, 350, 0)},
                  recorded={"sigma_n_MPa": ("pad_N_cm2", "N/cm^2", 100, 0), "v_rel_mm_s": ("rim_km_h", "km/h", 0.0036, 0),
                            "T_contact_C": ("disc_degC", "degC", 1, 0), "s_mm": ("braking_m", "m", 1e-3, 0)}),
    "bush": dict(laws=("wzl",), stroke_mm=2000,
                 states={"sigma_n_MPa": (5, 60, 1), "v_rel_mm_s": (12, 300, 1), "T_contact_C": (22, 90, 0)},
                 recorded={"sigma_n_MPa": ("projected_MPa", "MPa", 1, 0), "v_rel_mm_s": ("journal_cm_s", "cm/s", 0.1, 0),
                           "T_contact_C": ("shell_degC", "degC", 1, 0), "s_mm": ("path_cm", "cm", 0.1, 0)}),
    "upset": dict(laws=("orowan", "levanov"), stroke_mm=12,
                  states={"sigma_n_MPa": (80, 900, 1), "v_rel_mm_s": (1, 60, 1), "T_contact_C": (20, 300, 0),
                          "sigma_f_MPa": (120, 320, 0)},
                  recorded={"sigma_n_MPa": ("die_GPa", "GPa", 1e-3, 0), "v_rel_mm_s": ("ram_mm_s", "mm/s", 1, 0),
                            "T_contact_C": ("billet_degC", "degC", 1, 0), "sigma_f_MPa": ("flow_MPa", "MPa", 1, 0),
                            "s_mm": ("slip_um", "um", 1000, 0), "tau_R_MPa": ("shear_MPa", "MPa", 1, 0)}),
}  # without tau_R_MPa in it a rig records a coefficient
NUMBERS = {"lube_g_m2": (0.3, 3, 0), "tool_HRC": (52, 64, 0), "Sa_nm": (80, 900, 1), "bath_alkalinity": (6.5, 9.5, 0),
           "visc_cSt": (20, 400, 1), "water_ppm": (50, 2000, 1), "anneal_h": (0.5, 12, 1), "clamp_kN": (2, 9, 0),
           "storage_d": (1, 90, 1), "tilt_mrad": (-2, 2, 0), "grain_um": (8, 60, 1), "zinc_g_m2": (3, 12, 0),
           "supply_V": (225, 235, 0), "dewpoint_degC": (-5, 15, 0), "tank_l": (20, 80, 0)}
ANGLE = {"grain_angle_deg": (0, 180, 0)}
FACTORS = {"coating": ("plain", "CrN", "DLC", "TiAlN"), "lube_lot": ("L07", "L11", "L12", "L20", "L23"),
           "punch": ("P1", "P2", "P3"), "supplier": ("north", "south")}
DRIFTING = {"hall_degC": (17, 27, 0), "hall_rh": (25, 65, 0), "baro_hPa": (990, 1030, 0)}
RANGES = {**NUMBERS, **ANGLE, **DRIFTING}
GEARS = (0.0, 0.5, 1.0)  # of the speed, where the rig has three


def on_range(value_range, u):
    low, high, logarithmic = value_range
    return low * (high / low) ** u if logarithmic else low + (high - low) * u


def place(value_range, x):
    low, high, logarithmic = value_range
    return np.log(x / low) / np.log(high / low) if logarithmic else (x - low) / (high - low)


# --- planted effects -----------------------------------------------------------------------------

@dataclass
class Term:
    form: str
    columns: tuple
    site: str = "mu"      # mu, limit or added
    weight: float = 1.0   # its part of the common amplitude, with its sign
    centre: float = 0.5
    width: float = 0.15
    contrast: dict = None  # of a factor's levels

    def shape(self, f, ranges):
        level = [np.array([self.contrast[x] for x in f[c]]) for c in self.columns if c in FACTORS]
        u = [place(ranges[c], f[c].to_numpy(float)) for c in self.columns if c in ranges]
        c, w = self.centre, self.width
        return {"line": lambda: u[0],
                "power": lambda: u[0] - 0.5,  # of a logarithmic column, behind an exponential
                "exponential": lambda: np.expm1(3 * u[0]) / np.expm1(3),
                "saturation": lambda: 1 - np.exp(-5 * np.clip(u[0], 0, None)),
                "threshold": lambda: np.clip((u[0] - c) / w, 0, 1),
                "step": lambda: (u[0] > c) * 1.0,
                "parabola": lambda: 4 * (u[0] - c) ** 2,
                "bump": lambda: np.exp(-((u[0] - c) / w) ** 2 / 2),
                "lay_angle": lambda: np.cos(2 * np.radians(f[self.columns[0]].to_numpy(float) - 180 * c)),
                "levels": lambda: level[0],
                "factor_slope": lambda: level[0] * (2 * u[0] - 1),
                "product": lambda: (u[0] - c) * (u[1] - c) * (1 if c == 0 else 4),
                "running_in": lambda: np.exp(-f["s_mm"].to_numpy(float) / (w * ranges["s_mm"][1])),
                "speed_dip": lambda: -np.exp(-((u[0] - 0.5) / 0.15) ** 2 / 2),
                "speed_reversal": lambda: (2 * u[0] - 1) * (1 - 2 * u[1])}[self.form]()

    def factor(self, amplitude, shape):
        change = amplitude * self.weight * shape
        return np.exp(change) if self.form in ("power", "levels") else np.maximum(1 + change, 0.1)


ONE_COLUMN = ("line", "power", "exponential", "saturation", "threshold", "step", "parabola", "bump", "lay_angle")
PLANTS = ONE_COLUMN + ("levels", "factor_slope", "product", "running_in", "speed_dip", "speed_reversal", "masked",
                       "several", "added", "on_limit", "law_wrong")
NOISES = ("plain", "day_blocks", "tool_jumps", "heavy_tails", "pressure_scatter", "quantised", "zero_offset", "wander")
KINDS = PLANTS + tuple("null_" + noise for noise in NOISES)


def draw_terms(kind, size, rng):
    numbers = list(rng.permutation(list(NUMBERS)))
    def term(form, **more):
        if form == "lay_angle":
            columns = ("grain_angle_deg",)
        elif form in ("levels", "factor_slope"):
            name = str(rng.choice(list(FACTORS)))
            steps = np.linspace(-1, 1, len(FACTORS[name])) + rng.normal(0, 0.15, len(FACTORS[name]))
            more["contrast"] = dict(zip(FACTORS[name], rng.permutation(steps)))
            columns = (name,) if form == "levels" else (name, str(rng.choice(["v_rel_mm_s", "T_contact_C"])))
        elif form == "power":
            columns = (next(n for n in numbers if NUMBERS[n][2]),)
            numbers.remove(columns[0])
        elif form in ("running_in", "speed_dip", "speed_reversal"):
            columns = {"running_in": ("s_mm",), "speed_dip": ("v_rel_mm_s",),
                       "speed_reversal": ("v_rel_mm_s", "T_contact_C")}[form]
        else:
            columns = tuple(numbers.pop() for _ in range(2 if form == "product" else 1))
        centre = rng.choice([0, 0.5]) if form == "product" else rng.uniform(0.35, 0.6)
        sign = 1 if size == SIZES[-1] or form in ("lay_angle", "factor_slope") else rng.choice([-1, 1])
        more = {"weight": float(sign), "centre": float(centre), "width": float(rng.uniform(0.1, 0.2)), **more}
        return Term(form, columns, **more)
    if kind.startswith("null"):
        return []
    if kind == "masked":
        return [term("line", weight=1.0), term("line", weight=-0.6)]
    if kind == "several":
        forms = rng.permutation(["line", "saturation", "threshold", "levels", "parabola", "power"])
        return [term(str(form)) for form in forms[:rng.integers(2, 5)]]
    if kind == "added":
        return [term(str(rng.choice(["line", "saturation", "parabola"])), site="added")]
    if kind == "on_limit":
        return [term(str(rng.choice(["line", "step", "levels"])), site="limit")]
    return [term("line" if kind == "law_wrong" else kind)]


# --- tests ---------------------------------------------------------------------------------------

DESIGNS = ("latin", "composite", "one_factor", "factorial", "repeated_factorial", "random")


def design(kind, n, levels, rng):
    """Settings of n tests in 0 .. 1, one column per entry of levels (how many a factorial has)."""
    d = len(levels)
    if kind == "latin":
        return np.stack([(rng.permutation(n) + rng.uniform(0, 1, n)) / n for _ in range(d)], axis=1)
    if kind == "random":
        return rng.uniform(0, 1, (n, d))
    if kind == "one_factor":
        points = [np.full(d, 0.5)]
        for step in itertools.count():
            if len(points) >= n:
                return np.array(points[:n])
            point = np.full(d, 0.5)
            point[step % d] = rng.choice([0, 0.25, 0.75, 1])
            points.append(point)
    if kind == "composite":
        corners = rng.permutation(list(itertools.product([0.15, 0.85], repeat=d)))
        axial = [np.where(np.arange(d) == i, x, 0.5) for i in range(d) for x in (0, 1)]
        points = np.vstack([corners[:max(n - len(axial) - 1, n // 2)], axial])[:n - 1]
        return np.vstack([points, np.full((n - len(points), d), 0.5)])
    grid = rng.permutation(list(itertools.product(*[np.linspace(0, 1, k) for k in levels])))
    distinct = n // 2 if kind == "repeated_factorial" else n
    return np.array([grid[i % min(distinct, len(grid))] for i in range(n)])


def correlated(u, rho, rng):
    return norm.cdf(rho * norm.ppf(0.02 + 0.96 * u) + np.sqrt(1 - rho ** 2) * rng.normal(size=len(u)))


class Plan:
    """What one campaign is: rig, columns, how each is set or comes about."""

    def __init__(self, kind, seed, rng):
        self.size = 0.0 if kind.startswith("null") else SIZES[(seed + KINDS.index(kind)) % 3]
        rig = {"speed_dip": "strip", "speed_reversal": "strip", "on_limit": "upset"}.get(kind)
        self.rig = rig or str(rng.choice(["strip", "brake", "bush"] if kind == "law_wrong" else list(RIGS)))
        self.states = RIGS[self.rig]["states"]
        self.ranges = {**RANGES, **self.states, "s_mm": (0, RIGS[self.rig]["stroke_mm"], 0)}
        laws = {"speed_dip": ["coulomb"], "speed_reversal": ["coulomb"], "on_limit": ["orowan"]}
        choice = [x for x in RIGS[self.rig]["laws"] if kind != "law_wrong" or x != "coulomb"]
        self.true_law = str(rng.choice(laws.get(kind, choice)))
        self.law = "coulomb" if kind == "law_wrong" else self.true_law
        self.tests = int(rng.choice([12, 15, 20, 27, 40, 60]))
        self.rows = int(rng.choice([20, 150] if kind == "running_in" else [1, 1, 20, 20, 150]))
        self.design = str(rng.choice(DESIGNS))
        self.noise = kind[5:] if kind.startswith("null") else str(rng.choice(NOISES))
        self.order = str(rng.choice(["", "start_time", "run_order"]))
        self.validation_tests = int(rng.choice([0, 0, 0, 8, 10]))
        self.gears = kind == "speed_dip"
        self.terms = draw_terms(kind, self.size, rng)
        self.columns(kind, rng)

    def columns(self, kind, rng):
        causes = [c for t in self.terms for c in t.columns if c not in LAW_INPUTS + ("s_mm",)]
        pool = [c for c in rng.permutation([*NUMBERS, *FACTORS]) if c not in causes]
        self.drifting = list(rng.permutation(list(DRIFTING))[:rng.integers(1, 3)])
        room = int(rng.integers(6, 15)) - len(self.states) - len(causes) - len(self.drifting)
        self.bystanders = [str(c) for c in pool[:max(room, 1)]]
        self.set_columns = [*self.states] + [c for c in causes if kind != "masked" and
                                             (rng.uniform() < 0.6 or c in ANGLE)]
        if len(self.set_columns) == len(self.states):
            self.set_columns.append(self.bystanders[0])
        self.drawn = [c for c in causes + self.bystanders if c not in self.set_columns]
        followed = next((c for t in self.terms for c in t.columns if c != "s_mm"), "sigma_n_MPa")
        self.follows = {c: (followed, float(rng.uniform(0.5, 0.9)))
                        for c in [b for b in self.bystanders if b in NUMBERS and b in self.drawn][:rng.integers(0, 3)]}
        if kind == "masked":
            self.follows[causes[1]] = (causes[0], float(rng.uniform(0.75, 0.9)))
        self.drawn.sort(key=lambda c: c in self.follows and 1 + (self.follows[c][0] in self.follows))
        curved = {"v_rel_mm_s": 3} if self.gears else {c: 5 for c in causes}
        self.levels = [len(FACTORS[c]) if c in FACTORS else 6 if c in ANGLE else curved.get(c, int(rng.choice([2, 3])))
                       for c in self.set_columns]
        self.phases = {c: rng.uniform(0, 1, 2) for c in self.drifting}
        self.loops = rng.uniform(0, 1, 2)

    def part(self, settings, position, rng, rows, name):
        n = len(settings)
        u = {c: settings[:, i] for i, c in enumerate(self.set_columns)}
        if self.gears:
            u["v_rel_mm_s"] = np.array(GEARS)[np.minimum((3 * u["v_rel_mm_s"]).astype(int), 2)]
        for c in self.drawn:
            u[c] = correlated(u[self.follows[c][0]], self.follows[c][1], rng) if c in self.follows else rng.uniform(0, 1, n)
        table = {"experiment": [f"{name}{i + 1}" for i in range(n)]}
        for c in u:
            if c in FACTORS:
                table[c] = [FACTORS[c][min(int(x * len(FACTORS[c])), len(FACTORS[c]) - 1)] for x in u[c]]
            else:
                x = on_range(self.ranges[c], u[c])
                table[c] = 5 * np.round(x / 5) if c in ANGLE else np.array([float(f"{v:.3g}") for v in x])
        for c in self.drifting:
            waves, start = self.phases[c]
            wave = 0.5 + 0.42 * np.sin(2 * np.pi * ((0.4 + waves) * position + start)) + rng.normal(0, 0.03, n)
            table[c] = np.round(on_range(DRIFTING[c], wave), 1)
        table["position"] = position
        return self.with_rows(pd.DataFrame(table), rows, rng)

    def with_rows(self, tests, rows, rng):
        if rows == 1:
            return tests
        f = tests.loc[tests.index.repeat(rows)].reset_index(drop=True)
        part = np.tile((np.arange(rows) + 1) / rows, len(tests))
        stroke = np.repeat(RIGS[self.rig]["stroke_mm"] * rng.uniform(0.6, 1, len(tests)), rows)
        turn = np.repeat(rng.uniform(0, 1, len(tests)), rows)
        heat = place(self.states["v_rel_mm_s"], f.v_rel_mm_s) * (0.3 + place(self.states["sigma_n_MPa"], f.sigma_n_MPa))
        low, high, _ = self.states["T_contact_C"]
        f["s_mm"] = part * stroke
        f["sigma_n_MPa"] *= 1 + 0.04 * np.sin(2 * np.pi * (self.loops[0] * 2 * part + turn))
        f["v_rel_mm_s"] *= 1 + 0.02 * np.sin(2 * np.pi * (self.loops[1] * 3 * part + turn))
        f["T_contact_C"] += 0.12 * (high - low) * heat * (1 - np.exp(-part / 0.4))
        f["time_s"] = (stroke / rows / f.v_rel_mm_s).groupby(f.experiment, sort=False).cumsum()
        return f


# --- the campaign --------------------------------------------------------------------------------

@dataclass
class Campaign:
    kind: str
    seed: int
    plan: Plan
    parameters: list
    amplitude: float
    size: float           # reached; a law's parameters may take a part of an effect up
    training: pd.DataFrame  # in canonical names and units, tau_R_MPa as measured, true_MPa
    validation: pd.DataFrame
    heldout: pd.DataFrame
    scale_MPa: float

    @property
    def columns(self):
        """What may be a cause: all recorded but the time and the order of tests."""
        return [c for c in recorded(self.training) if c not in ("experiment", "tau_R_MPa", "time_s", *ORDER_COLUMNS)]

    @property
    def causes(self):
        """The planted columns, and where the job has Coulomb's law instead of the true one its states."""
        states = {"filzek_ludwig": {"sigma_n_MPa", "v_rel_mm_s"}, "exp_coulomb": {"sigma_n_MPa", "T_contact_C"}}.get(
            self.plan.true_law, {"sigma_n_MPa", "v_rel_mm_s", "T_contact_C"})
        planted = {c for t in self.plan.terms for c in t.columns}
        return planted if self.plan.law == self.plan.true_law else planted | states

    def stress(self, f, parameters, amplitudes):
        return stress(self.plan, f, parameters, amplitudes, self.scale_MPa)

    def known_form(self):
        """Held-out stress by the true law and the true forms with their constants fitted: what can be reached."""
        step = max(self.plan.rows // 8, 1)
        known = pd.concat([self.training, self.validation], ignore_index=True)
        known = known[known.groupby("experiment").cumcount() % step == 0]
        split = len(self.parameters)
        def misfit(x):
            return np.log(self.stress(known, list(x[:split]), x[split:]) / known.tau_R_MPa)
        start = [*self.parameters, *[self.amplitude] * len(self.plan.terms)]
        x = least_squares(misfit, start, x_scale=np.abs(start) + 0.01, loss="soft_l1", f_scale=0.1).x
        return self.stress(self.heldout, list(x[:split]), x[split:])

    def write(self, folder):
        folder = Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        rig = RIGS[self.plan.rig]["recorded"]
        here = {c: v for c, v in rig.items() if c in self.training}
        lines = ["[data]", 'training = "training.csv"', "[data.columns]"]
        lines += [f'{c} = {{ column = "{name}", unit = "{unit}" }}' for c, (name, unit, _, _) in here.items()]
        if "tau_R_MPa" not in rig:
            lines.append('tau_R_MPa = { column = "cof", times = "sigma_n_MPa" }')
        lines += ["[data.constants]", "psi = 1.0", "[models]", f'use = ["{self.plan.law}"]', "[trace]", "alpha = 0.02",
                  "[output]", 'directory = "out"']
        if self.plan.validation_tests:
            lines.insert(2, 'validation = "validation.csv"')
        (folder / "job.toml").write_text("# Synthetic data\n" + "\n".join(lines) + "\n")
        for name in ("training", "validation", "heldout"):
            f = getattr(self, name)
            if not len(f):
                continue
            out = f[recorded(f)].copy()
            if "tau_R_MPa" not in rig:
                out["cof"] = out.pop("tau_R_MPa") / out.sigma_n_MPa
            for c, (file_name, _, factor, offset) in here.items():
                out[c] = out[c] * factor + offset
            if name == "heldout":
                out["true_MPa"] = f.true_MPa
            out.rename(columns={c: v[0] for c, v in here.items()}).to_csv(folder / f"{name}.csv", index=False, float_format="%.7g")
        p = self.plan
        truth = dict(kind=self.kind, seed=self.seed, synthetic=True, rig=p.rig, tests=p.tests, rows=p.rows, design=p.design,
                     noise=p.noise, order=p.order, law=p.law, true_law=p.true_law, law_right=p.law == p.true_law,
                     size=p.size, size_reached=self.size, parameters=list(map(float, self.parameters)),
                     amplitude=self.amplitude, terms=[{**vars(t), "columns": list(t.columns)} for t in p.terms])
        (folder / "truth.json").write_text(json.dumps(truth, indent=1) + "\n")


def recorded(f):
    return [c for c in f.columns if c not in ("true_MPa", "position")]


def stress(plan, f, parameters, amplitudes, scale):
    on_mu, on_limit, added = 1.0, 1.0, 0.0
    for term, amplitude in zip(plan.terms, amplitudes):
        shape = term.shape(f, plan.ranges)
        if term.site == "added":
            added = added + amplitude * term.weight * shape * scale
        elif term.site == "limit":
            on_limit = on_limit * term.factor(amplitude, shape)
        else:
            on_mu = on_mu * term.factor(amplitude, shape)
    law = law_stress(plan.true_law, parameters, f, on_mu, on_limit)
    return np.asarray(np.maximum(law + added, 0.05 * law), float)


def removable(plan, parameters, amplitude, training, heldout, scale):
    """Mean error on held-out tests of the true law with its parameters refitted, over the mean stress."""
    def logs(f):
        law = np.log(stress(plan, f, parameters, [0] * len(plan.terms), scale))
        slopes = [np.ones(len(f))]
        for i, p in enumerate(parameters):
            moved = [*parameters[:i], p + 1e-4 * (abs(p) + 0.01), *parameters[i + 1:]]
            slopes.append((np.log(law_stress(plan.true_law, moved, f)) - law) / (1e-4 * (abs(p) + 0.01)))
        true = stress(plan, f, parameters, [amplitude] * len(plan.terms), scale)
        return law, np.stack(slopes, axis=1), true
    law, slopes, true = logs(training)
    shift = np.linalg.lstsq(slopes, np.log(true) - law, rcond=1e-6)[0]
    law, slopes, true = logs(heldout)
    return np.abs(np.exp(law + slopes @ shift) - true).mean() / true.mean()


def find_amplitude(plan, *rest):
    if not plan.terms:
        return 0.0
    low, high = 0.0, 1.5 if plan.terms[0].site == "added" else 6.0
    for _ in range(30):
        middle = (low + high) / 2
        low, high = (middle, high) if removable(plan, rest[0], middle, *rest[1:]) < plan.size else (low, middle)
    return low


def test_gains(plan, position, pressure, rng, world):
    """Logarithms of what each test has of its own; `world` is what both parts of a campaign share."""
    n, kind = len(position), plan.noise
    sd = world["sd"]
    if kind == "heavy_tails":
        return sd * rng.standard_t(3, n) / np.sqrt(3)
    if kind == "pressure_scatter":
        return rng.normal(0, 0.01 + 2 * sd * np.clip(pressure, 0, 1))
    gains = rng.normal(0, sd if kind in ("plain", "quantised", "zero_offset") else sd / 2, n)
    if kind == "day_blocks":
        gains += world["days"][np.minimum((position * len(world["days"])).astype(int), len(world["days"]) - 1)]
    if kind == "tool_jumps":
        gains += (position[:, None] > world["changes"]) @ world["jumps"]
    if kind == "wander":
        gains += np.interp(position, np.linspace(0, 1, len(world["walk"])), world["walk"])
    return gains


def measure(plan, f, rng, world):
    tests = f.groupby("experiment", sort=False)
    pressure = place(plan.states["sigma_n_MPa"], tests.sigma_n_MPa.mean().to_numpy())
    gains = test_gains(plan, tests.position.first().to_numpy(), pressure, rng, world)
    sizes = tests.size().to_numpy()
    if plan.rows > 1:
        rho = 0.7 if plan.rows == 20 else 0.95
        noise = []
        for rows in sizes:
            x = [rng.normal()]
            for _ in range(rows - 1):
                x.append(rho * x[-1] + np.sqrt(1 - rho ** 2) * rng.normal())
            noise.append(0.02 * np.array(x) + 0.005 * rng.normal(size=rows))
        within = np.concatenate(noise)
    else:
        within = 0.0
    measured = f.true_MPa * np.exp(np.repeat(gains, sizes) + within)
    mean = world["mean_MPa"]
    if plan.noise == "zero_offset":
        measured = measured + 0.04 * mean * world["offset"]
    if plan.noise == "quantised":
        measured = np.maximum(np.round(measured / (0.04 * mean)), 1) * 0.04 * mean
    return np.maximum(measured, 0.02 * f.true_MPa)


def make(kind, seed, last=False):
    if kind not in KINDS:
        raise SystemExit(f"no kind '{kind}'; there are: {', '.join(KINDS)}")
    if seed >= FIRST_LAST_SEED and not last:
        raise SystemExit(f"seeds from {FIRST_LAST_SEED} on are kept for the last run: --last")
    rng = np.random.default_rng([zlib.crc32(kind.encode()), seed])
    plan = Plan(kind, seed, rng)
    parameters = draw_parameters(plan.true_law, rng)
    n = plan.tests
    settings = design(plan.design, n, plan.levels, rng)
    training = plan.part(settings, (rng.permutation(n) + 0.5) / n, rng, plan.rows, "run-")
    def others(count, rows, name):
        return plan.part(rng.uniform(0, 1, (count, len(plan.levels))), rng.uniform(0, 1, count), rng, rows, name)
    validation = others(plan.validation_tests, plan.rows, "check-")
    heldout = others(HELD_OUT_TESTS, min(plan.rows, 20), "unseen-")
    for c in [c for c in FACTORS if c in heldout]:  # no level that training lacks
        for f in (validation, heldout):
            known = list(training[c].unique())
            f[c] = [x if x in known else known[i % len(known)] for i, x in enumerate(f[c])]
    scale = float(law_stress(plan.true_law, parameters, training).mean())
    amplitude = find_amplitude(plan, parameters, training, heldout, scale)
    reached = removable(plan, parameters, amplitude, training, heldout, scale)
    world = dict(sd=rng.uniform(0.02, 0.06), days=rng.normal(0, 0.04, max(3, n // 6)), changes=rng.uniform(0.15, 0.9, 2),
                 jumps=rng.normal(0, 0.06, 2), walk=0.05 * np.cumsum(rng.normal(0, 0.5, 12)), offset=rng.choice([-1, 1]))
    numbered = 0
    for f in (training, validation, heldout):
        f["true_MPa"] = stress(plan, f, parameters, [amplitude] * len(plan.terms), scale)
        world.setdefault("mean_MPa", float(f.true_MPa.mean()))
        f["tau_R_MPa"] = measure(plan, f, rng, world) if len(f) else []
        if plan.order == "start_time":
            minutes = np.round(f.position * n * 95) + 8 * 60
            f["start_time"] = (pd.Timestamp("2031-03-03") + pd.to_timedelta(minutes, unit="min")).dt.strftime("%Y-%m-%d %H:%M")
        elif plan.order == "run_order":
            f["run_order"] = f.position.rank(method="dense").astype(int) + numbered
            numbered += f.experiment.nunique()
    return Campaign(kind, seed, plan, parameters, amplitude, float(reached), training, validation, heldout, scale)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?")
    parser.add_argument("--kind")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--last", action="store_true")
    parser.add_argument("--list", action="store_true")
    arguments = parser.parse_args()
    if arguments.list or not arguments.folder or not arguments.kind:
        print("\n".join(KINDS))
    else:
        make(arguments.kind, arguments.seed, arguments.last).write(arguments.folder)
