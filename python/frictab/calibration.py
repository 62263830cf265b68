"""Calibrated laws: models/NAME.json and calibration.json."""
import json
import os

import numpy as np

from .faults import FrictabError, file_faults
from .formula import Formula
from .states import Input, States, sides, warn_outside

_UNLIKE = "the law's own formula"


class Model:
    """One calibrated law; `parameters` {name: value}, `fit` its whole record in the file."""

    def __init__(self, fit, source):
        self.fit, self.source, self.name = fit, source, fit["name"]
        self.parameters = {p["name"]: float(p["value"]) for p in fit["parameters"]}
        try:
            texts = {**fit.get("law", {}), **fit["expressions"]}
            self.value, self.combine = Formula(texts["value"]), Formula(texts["combine"])
        except KeyError:
            raise FrictabError(f"{source}: has no formula that can be computed; calibrate again "
                               "with this version") from None
        levels = fit.get("law", {}).get("levels", {})
        ranges = fit.get("data_range", {})
        self.inputs = [Input(n, "", *ranges.get(n, (-np.inf, np.inf)), _UNLIKE, _UNLIKE, "",
                             tuple(levels.get(n, ()))) for n in fit["inputs"]]

    def tau_R(self, states=None, /, **named):
        """Friction shear stress in MPa by the law's formula, as Table.tau_R takes its states.
        Rows outside the data of the calibration are counted in an OutsideWarning."""
        found = States(self, self.inputs, states, named)
        warn_outside(self, self.inputs, found.columns)
        parts = [self._tau({n: c[i:i + 4096] for n, c in found.columns.items()})
                 for i in range(0, found.rows, 4096)] # a network's formula has thousands of parts
        return found.back(np.concatenate(parts) if parts else np.zeros(0))

    def outside(self, states=None, /, **named):
        """Per input -1, 0 or 1: the state is below, inside, above the data of the calibration."""
        found = States(self, self.inputs, states, named)
        return {n: found.back(s) for n, s in sides(self.inputs, found.columns).items()}

    def __str__(self):
        return f"law {self.name}"

    def __repr__(self):
        return f"<frictab {self}: tau_R of {', '.join(map(str, self.inputs))}>"

    def _tau(self, columns):
        known = {**columns, **self.parameters}
        known["value"] = self.value(**{n: known[n] for n in self.value.names})
        rows = len(next(iter(columns.values()))) if columns else 1
        tau = np.broadcast_to(self.combine(**{n: known[n] for n in self.combine.names}), rows)
        missing = np.any([np.isnan(c) for c in columns.values()], axis=0) if columns else False
        return np.where(missing, np.nan, tau)


class Calibration:
    """calibration.json: `models` {name: Model}, as they are delivered; `record` the file."""

    def __init__(self, record, source):
        self.record, self.source = record, source
        self.models = {f["name"]: Model(f.get("delivered", f), source) for f in record["models"]}

    @property
    def synthetic(self):
        """Whether the data came from the twin."""
        return bool(self.record["synthetic_data"])

    @property
    def best(self):
        """Name of the law with the smallest error on unseen tests, of those that compete."""
        return self.record.get("best") # None: of a version that did not write it

    @property
    def recommended(self):
        """Name of the simplest law that is not worse than it by more than a standard error."""
        return self.record.get("recommended")

    def errors(self):
        """{law: mean absolute error in MPa on experiments it was not trained on}, best first."""
        found = {f["name"]: f["validation"]["mae_MPa"] for f in self.record["models"]}
        judged = {name: mae for name, mae in found.items() if mae is not None}
        return dict(sorted(judged.items(), key=lambda one: one[1]))

    def __repr__(self):
        return f"<frictab calibration {self.source}: {', '.join(self.models)}>"


def _read(path, kind, make):
    path = os.fspath(path)
    with file_faults(path, f"a {kind}"):
        with open(path, encoding="utf-8") as file:
            try:
                record = json.load(file)
            except ValueError:
                raise FrictabError("is no JSON file") from None
        schema = record.get("schema", "") if isinstance(record, dict) else ""
        if schema != f"frictab/{kind}/1":
            raise FrictabError(f"its schema is \"{schema}\", not \"frictab/{kind}/1\"")
        return make(record, path)


def read_model(path):
    """Reads models/NAME.json. Raises FrictabError where it is none."""
    return _read(path, "model", Model)


def read_calibration(path):
    """Reads calibration.json. Raises FrictabError where it is none."""
    return _read(path, "calibration", Calibration)
