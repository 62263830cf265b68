"""Calibrated laws: models/NAME.json and calibration.json."""
from __future__ import annotations

import json
import os
from typing import Any, Callable, Mapping, Optional, TypeVar

import numpy as np
from numpy.typing import NDArray

from .faults import FrictabError, file_faults
from .formula import Formula
from .program import PathLike
from .states import Columns, Input, States, sides, warn_outside

Read = TypeVar("Read")
_UNLIKE = "the law's own formula"


class Model:
    """One calibrated law; `parameters` {name: value}, `fit` its whole record in the file."""

    def __init__(self, fit: Mapping[str, Any], source: str) -> None:
        self.fit, self.source, self.name = fit, source, str(fit["name"])
        self.parameters = {str(p["name"]): float(p["value"]) for p in fit["parameters"]}
        try:
            texts = {**fit.get("law", {}), **fit["expressions"]}
            self.value, self.combine = Formula(texts["value"]), Formula(texts["combine"])
        except KeyError:
            raise FrictabError(f"{source}: has no formula that can be computed; calibrate again "
                               "with this version") from None
        levels = fit.get("law", {}).get("levels", {})
        ranges = fit.get("data_range", {})
        self.inputs = []
        for name in fit["inputs"]:
            low, high = ranges.get(name, (-np.inf, np.inf))
            self.inputs.append(Input(name, "", low, high, _UNLIKE, _UNLIKE, "",
                                     tuple(levels.get(name, ()))))

    def tau_R(self, states: Any = None, /, **named: Any) -> Any:
        """Friction shear stress in MPa by the law's formula, as Table.tau_R takes its states.
        Rows outside the data of the calibration are counted in an OutsideWarning."""
        found = States(self, self.inputs, states, named)
        warn_outside(self, self.inputs, found.columns)
        parts = [self._tau({n: c[i:i + 4096] for n, c in found.columns.items()})
                 for i in range(0, found.rows, 4096)] # a network's formula has thousands of parts
        return found.back(np.concatenate(parts) if parts else np.zeros(0))

    def outside(self, states: Any = None, /, **named: Any) -> dict[str, Any]:
        """Per input -1, 0 or 1: the state is below, inside, above the data of the calibration."""
        found = States(self, self.inputs, states, named)
        return {n: found.back(s) for n, s in sides(self.inputs, found.columns).items()}

    @property
    def formula(self) -> str:
        """The law as people write it."""
        return str(self.fit.get("formula", ""))

    @property
    def errors(self) -> dict[str, Optional[float]]:
        """{parameter: standard error}, over experiments; None where the tests do not give it."""
        return {str(p["name"]): p.get("std_error") for p in self.fit["parameters"]}

    @property
    def covariance(self) -> Optional[NDArray[np.float64]]:
        """Of the parameters, in their order; NaN where the tests do not determine one. None for
        laws of many weights, which have none."""
        flat, n = self.fit.get("covariance"), len(self.parameters)
        if flat is None or len(flat) != n * n:
            return None
        return np.array([np.nan if x is None else float(x) for x in flat]).reshape(n, n)

    @property
    def correlation(self) -> Optional[NDArray[np.float64]]:
        """Covariance over the standard errors; NaN where one of these is 0 or not known."""
        covariance = self.covariance
        if covariance is None:
            return None
        error = np.sqrt(np.diag(covariance))
        error[~(error > 0)] = np.nan
        return np.asarray(covariance / np.outer(error, error))

    def __str__(self) -> str:
        return f"law {self.name}"

    def __repr__(self) -> str:
        return f"<frictab {self}: tau_R of {', '.join(map(str, self.inputs))}>"

    def _tau(self, columns: Columns) -> NDArray[np.float64]:
        known: dict[str, Any] = {**columns, **self.parameters}
        known["value"] = self.value(**{n: known[n] for n in self.value.names})
        rows = len(next(iter(columns.values()))) if columns else 1
        tau = np.broadcast_to(self.combine(**{n: known[n] for n in self.combine.names}), rows)
        if not columns:
            return tau
        return np.where(np.any([np.isnan(c) for c in columns.values()], axis=0), np.nan, tau)


class Calibration:
    """calibration.json: `models` {name: Model}, as they are delivered; `record` the file."""

    def __init__(self, record: Mapping[str, Any], source: str) -> None:
        self.record, self.source = record, source
        self.models = {str(f["name"]): Model(f.get("delivered", f), source)
                       for f in record["models"]}

    @property
    def synthetic(self) -> bool:
        """Whether the data came from the twin."""
        return bool(self.record["synthetic_data"])

    @property
    def best(self) -> Optional[str]:
        """Name of the law with the smallest error on unseen tests, of those that compete."""
        return self.record.get("best") # None: of a version that did not write it

    @property
    def recommended(self) -> Optional[str]:
        """Name of the simplest law that is not worse than it by more than a standard error."""
        return self.record.get("recommended")

    def errors(self) -> dict[str, float]:
        """{law: mean absolute error in MPa on experiments it was not trained on}, best first."""
        found = {f["name"]: f["validation"]["mae_MPa"] for f in self.record["models"]}
        judged = {str(name): float(mae) for name, mae in found.items() if mae is not None}
        return dict(sorted(judged.items(), key=lambda one: one[1]))

    def __repr__(self) -> str:
        data = "synthetic data, " if self.synthetic else ""
        return f"<frictab calibration {self.source}: {data}{', '.join(self.models)}>"


def read_record(path: PathLike, kind: str) -> dict[str, Any]:
    """A JSON file of a run by its schema frictab/KIND/1. Raises FrictabError where it is none."""
    return _read(path, kind, lambda record, _: record)


def _read(path: PathLike, kind: str, make: Callable[[dict[str, Any], str], Read]) -> Read:
    path = os.fspath(path)
    with file_faults(path, f"a {kind}"):
        with open(path, encoding="utf-8") as file:
            try:
                record = json.load(file)
            except (ValueError, RecursionError):
                raise FrictabError("is not a JSON file") from None
        schema = record.get("schema", "") if isinstance(record, dict) else ""
        if schema != f"frictab/{kind}/1":
            raise FrictabError(f"its schema is \"{schema}\", not \"frictab/{kind}/1\"")
        return make(record, path)
    raise AssertionError # file_faults lets no fault pass


def read_model(path: PathLike) -> Model:
    """Reads models/NAME.json. Raises FrictabError where it is none."""
    return _read(path, "model", Model)


def read_calibration(path: PathLike) -> Calibration:
    """Reads calibration.json. Raises FrictabError where it is none."""
    return _read(path, "calibration", Calibration)
