"""Other methods on the same campaigns. Each corrects a calibrated law by regression of
ln(measured/law) on all recorded columns, and predicts the friction stress of tests it has not seen."""
import subprocess
import tempfile
import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
import statsmodels.api as sm
from sklearn.ensemble import HistGradientBoostingRegressor
from sklearn.kernel_ridge import KernelRidge
from sklearn.model_selection import GridSearchCV, GroupKFold, cross_val_predict
from threadpoolctl import threadpool_limits

BLOCKS = 12          # of a test's rows
FALSE_ALARMS = 0.02  # over all columns of a campaign, for methods that name columns


@dataclass
class Prediction:
    stress_MPa: np.ndarray
    named: set = None       # columns; None: the method names none
    stated_MPa: float = None  # error on unseen tests by the method's own account


def adjusted(left, y, constants):
    return 1 - (left ** 2).sum() / max(len(y) - constants, 1) / max(y.var(), 1e-12)


class Problem:
    """Frames with experiment, law_MPa, tau_R_MPa (training) and columns; factors are text."""

    def __init__(self, training, heldout, columns):
        self.heldout, self.columns = heldout, [c for c in columns if training[c].nunique() > 1]
        self.factors = [c for c in self.columns if training[c].dtype == object]
        place = training.groupby("experiment").cumcount()
        size = training.groupby("experiment").experiment.transform("size")
        block = (place * np.minimum(size, BLOCKS) // size).rename("block")
        ratio = training.assign(y=np.log(np.maximum(training.tau_R_MPa / training.law_MPa, 0.02)))
        how = {c: "first" if c in self.factors else "mean" for c in self.columns}
        grouped = ratio.groupby(["experiment", block], sort=False)
        self.blocks = grouped.agg({**how, "y": "mean", "law_MPa": "mean", "tau_R_MPa": "mean"}).reset_index()
        self.y, self.tests = self.blocks.y.to_numpy(), self.blocks.experiment.to_numpy()
        self.columns.sort(key=self.association, reverse=True)

    def association(self, column):
        """Share of the scatter that goes with a column alone (of numbers: a parabola in its ranks), adjusted for
        its constants; over means of tests or over blocks, whichever is more."""
        if column in self.factors:
            means = self.blocks.groupby("experiment").agg({column: "first", "y": "mean"})
            left = means.y - means.y.groupby(means[column]).transform("mean")
            return adjusted(left, means.y, means[column].nunique())
        shares = []
        for f in (self.blocks.groupby("experiment")[[column, "y"]].mean(), self.blocks):
            rank = f[column].rank() / len(f)
            curve = np.polynomial.Polynomial.fit(rank, f.y, min(2, f[column].nunique() - 1))
            shares.append(adjusted(f.y - curve(rank), f.y, 3))
        return max(shares)

    def numbers(self):
        """Training and held-out columns of numbers on a common scale; logarithms where they span a lot."""
        train, unseen = {}, {}
        for c in self.columns:
            a, b = self.blocks[c], self.heldout[c]
            if c in self.factors:
                train[c], unseen[c] = a, b
                continue
            if a.min() > 0 and a.max() > 4 * a.min():
                a, b = np.log(a), np.log(np.maximum(b, 1e-9))
            train[c], unseen[c] = (a - a.mean()) / a.std(), (b - a.mean()) / a.std()
        return pd.DataFrame(train), pd.DataFrame(unseen)

    def coded(self):
        train, unseen = self.numbers()
        both = pd.get_dummies(pd.concat([train, unseen]), columns=self.factors, drop_first=False).astype(float)
        return both[:len(train)], both[len(train):]

    def predicted(self, y, **more):
        return Prediction(self.heldout.law_MPa.to_numpy() * np.exp(np.clip(y, -3, 3)), **more)

    def folds(self):
        return list(GroupKFold(min(10, len(set(self.tests)))).split(self.y, groups=self.tests))

    def stated(self, y):
        law, measured = self.blocks.law_MPa, self.blocks.tau_R_MPa
        return float(np.abs(law * np.exp(np.clip(y, -3, 3)) - measured).mean())


def law_alone(problem):
    return Prediction(problem.heldout.law_MPa.to_numpy())


def additive_model(problem):
    train, unseen = problem.numbers()
    names = {c: f"c{i}" for i, c in enumerate(problem.columns)}
    with tempfile.TemporaryDirectory() as folder:
        files = [str(Path(folder) / f) for f in ("training.csv", "heldout.csv", "predicted.csv", "p.csv")]
        train.rename(columns=names).assign(y=problem.y, test=problem.tests).to_csv(files[0], index=False)
        unseen.rename(columns=names).to_csv(files[1], index=False)
        script = str(Path(__file__).with_name("rivals.R"))
        done = subprocess.run(["Rscript", script, *files], capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError("mgcv: " + done.stderr.strip()[-300:])
        y, p = pd.read_csv(files[2]).y.to_numpy(), pd.read_csv(files[3])
    back = {short: c for c, short in names.items()}
    named = {back[c] for c in p.column[p.p < FALSE_ALARMS / len(names)]}
    return problem.predicted(y, named=named)


def mixed_model(problem):
    train, unseen = problem.coded()
    tests = len(set(problem.tests))
    drop, kept = {f"{c}_{problem.blocks[c].iloc[0]}" for c in problem.factors}, []
    for c in problem.columns:  # the strongest first, as many as the tests carry
        new = [k for k in train if (k == c or k.startswith(c + "_") and c in problem.factors) and k not in drop]
        if len(kept) + len(new) <= tests // 2 - 1:
            kept += [k for k in new if train[k].std() > 0]
    x, x_unseen = sm.add_constant(train[kept]), sm.add_constant(unseen[kept], has_constant="add")
    if len(problem.y) > tests:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            fit = sm.MixedLM(problem.y, x, groups=problem.tests).fit(reml=True)
        slopes, p = fit.fe_params, fit.pvalues[kept]
    else:
        fit = sm.OLS(problem.y, x).fit()
        slopes, p = fit.params, fit.pvalues[kept]
    sure = list(p.index[p < FALSE_ALARMS / max(len(p), 1)])
    named = {c for c in problem.columns for k in sure if k == c or c in problem.factors and k.startswith(c + "_")}
    return problem.predicted(x_unseen.to_numpy() @ slopes.to_numpy(), named=named)


def chosen_by_folds(problem, model, grid):
    train, unseen = problem.coded()
    mean, folds = problem.y.mean(), problem.folds()
    search = GridSearchCV(model, grid, cv=folds, scoring="neg_mean_squared_error")
    with threadpool_limits(1):  # more cost these small problems time
        search.fit(train.to_numpy(), problem.y - mean)
        inside = cross_val_predict(search.best_estimator_, train.to_numpy(), problem.y - mean, cv=folds)
    return problem.predicted(mean + search.predict(unseen.to_numpy()), stated_MPa=problem.stated(mean + inside))


def kernel_ridge(problem):
    width = problem.coded()[0].shape[1]
    return chosen_by_folds(problem, KernelRidge(kernel="rbf"),
                           {"alpha": [0.01, 0.1, 1, 10, 100], "gamma": [g / width for g in (0.01, 0.03, 0.1, 0.3, 1)]})


def boosting(problem):
    model = HistGradientBoostingRegressor(learning_rate=0.06, early_stopping=False, random_state=0,
                                          min_samples_leaf=max(2, len(problem.y) // 20))
    return chosen_by_folds(problem, model, {"max_leaf_nodes": [3, 8], "max_iter": [20, 60, 180]})


RIVALS = {"law": law_alone, "mgcv": additive_model, "mixed": mixed_model, "kernel": kernel_ridge,
          "boosting": boosting}
