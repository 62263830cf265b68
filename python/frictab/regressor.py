"""A friction law as an estimator of scikit-learn, which it does not need."""
from __future__ import annotations

import inspect
import sys
from typing import Any, Mapping, Optional, Sequence, Union

import numpy as np

from .campaign import Campaign
from .faults import FrictabError
from .frames import is_frame
from .result import Result

_STRESS, _TEST = "tau_R_MPa", "experiment"


class FrictionRegressor:
    """fit(X, y, groups), predict(X, groups), score, get_params, set_params; clone and the
    searches and cross-validations over groups work.

    X: a DataFrame of states, by canonical names or as `columns` maps them; y: the friction shear
    stress in MPa; groups: the test of each row. Tests are the unit of the fit: without groups it
    is refused. law: the one that predicts: "best", "recommended" or a name. laws: those that are
    calibrated. trace: whether effects that they lack are searched for, which takes longer. job:
    further keys of a job, as Campaign.fit takes them.
    After the fit: result_, law_, n_features_in_, feature_names_in_.
    """

    _estimator_type = "regressor"

    def __init__(self, law: str = "best", laws: Union[str, Sequence[str], None] = None,
                 columns: Optional[Mapping[str, Any]] = None,
                 constants: Optional[Mapping[str, float]] = None,
                 job: Optional[Mapping[str, Any]] = None, trace: bool = False,
                 threads: int = 0, random_state: Optional[int] = None) -> None:
        self.law = law
        self.laws = laws
        self.columns = columns
        self.constants = constants
        self.job = job
        self.trace = trace
        self.threads = threads
        self.random_state = random_state

    def fit(self, X: Any, y: Any, groups: Any = None) -> FrictionRegressor:
        """Calibrates the laws and ranks them on tests that they have not seen."""
        if groups is None:
            raise FrictabError("fit needs groups: the name of the test of each row. Rows of one "
                               "test are not independent")
        frame = self._frame(X, groups)
        stress = np.asarray(y, float).ravel()
        if len(stress) != len(frame):
            raise FrictabError(f"y has {len(stress)} values for {len(frame)} rows of X")
        frame[_STRESS] = stress
        job = dict(self.job or {})
        if self.random_state is not None:
            job["calibration.seed"] = int(self.random_state)
        campaign = Campaign(frame, columns=self.columns, constants=self.constants)
        self.result_: Result = campaign.fit(
            self.laws, threads=self.threads, until="trace" if self.trace else "calibrate", **job)
        self.law_: str = self.result_.law(self.law).name
        self.feature_names_in_ = np.array(list(X.columns), dtype=object)
        self.n_features_in_ = len(X.columns)
        return self

    def predict(self, X: Any, groups: Any = None) -> Any:
        """tau_R in MPa, an array. groups matter to laws with histories; absent: one test."""
        self._check_fitted()
        missing = sorted(set(self.feature_names_in_) - set(self._columns_of(X)))
        if missing:
            raise FrictabError(f"X lacks {', '.join(missing)}, which the fit had")
        frame = self._frame(X, ["1"] * len(X) if groups is None else groups)
        return self.result_.law(self.law_).predict(frame).to_numpy()

    def score(self, X: Any, y: Any, sample_weight: Any = None, groups: Any = None) -> float:
        """R2, as in scikit-learn."""
        stress = np.asarray(y, float).ravel()
        weight = np.ones(len(stress)) if sample_weight is None else np.asarray(sample_weight)
        off = np.sum(weight * (stress - self.predict(X, groups)) ** 2)
        spread = np.sum(weight * (stress - np.average(stress, weights=weight)) ** 2)
        return float(1.0 - off / spread) if spread > 0 else 0.0

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """The arguments of the constructor."""
        return {name: getattr(self, name) for name in self._names()}

    def set_params(self, **params: Any) -> FrictionRegressor:
        """Changes arguments of the constructor."""
        for name, value in params.items():
            if name not in self._names():
                raise ValueError(f"'{name}' is not a parameter of {type(self).__name__}; it has "
                                 + ", ".join(self._names()))
            setattr(self, name, value)
        return self

    def __repr__(self) -> str:
        default = {n: p.default for n, p in inspect.signature(type(self)).parameters.items()}
        given = ", ".join(f"{n}={v!r}" for n, v in self.get_params().items()
                          if repr(v) != repr(default[n]))
        return f"{type(self).__name__}({given})"

    def __sklearn_is_fitted__(self) -> bool:
        return hasattr(self, "result_")

    def _more_tags(self) -> dict[str, Any]:
        """For scikit-learn's checks: only states that a tribometer can have are fitted."""
        return {"poor_score": True, "requires_positive_X": True, "requires_positive_y": True}

    @classmethod
    def _names(cls) -> list[str]:
        return list(inspect.signature(cls).parameters)

    @staticmethod
    def _columns_of(X: Any) -> list[str]:
        if not is_frame(X):
            raise FrictabError(f"X is a {type(X).__name__}; it is a pandas.DataFrame, whose "
                               "columns are states by name")
        return list(X.columns)

    def _frame(self, X: Any, groups: Any) -> Any:
        for name in (_STRESS, _TEST):
            if name in self._columns_of(X):
                raise FrictabError(f"X has a column '{name}', which y or groups give")
        groups = np.asarray(groups)
        if groups.shape != (len(X),):
            raise FrictabError(f"groups has the shape {groups.shape} for {len(X)} rows of X")
        return X.reset_index(drop=True).assign(**{_TEST: groups})

    def _check_fitted(self) -> None:
        if not self.__sklearn_is_fitted__():
            text = f"this {type(self).__name__} is not fitted yet: call fit(X, y, groups)"
            sklearn = sys.modules.get("sklearn.exceptions")
            raise FrictabError(text) if sklearn is None else sklearn.NotFittedError(text)
