"""FrictionRegressor by the conventions of scikit-learn. Usage: estimator.py"""
import pickle
import sys
import unittest
import warnings

import numpy as np
import pandas

import frictab
from sample import twin

try:
    from sklearn.base import clone
    from sklearn.exceptions import NotFittedError
    from sklearn.model_selection import GroupKFold, cross_val_score
    from sklearn.utils.estimator_checks import check_estimator
    from sklearn.utils.validation import check_array, check_is_fitted, check_X_y
except ImportError:
    print("skipped: Debian's python3-sklearn is not installed")
    sys.exit()

STATES = ["sigma_n_MPa", "T_contact_C", "sigma_f_MPa"]
# Each with the reason why it does not apply.
SKIPPED = {
    "check_fit_non_negative": "the adapter below maps negative numbers to states, as others",
    "check_regressor_data_not_an_array": "states come in a DataFrame, by name",
}


class OnArrays(frictab.FrictionRegressor):
    """Takes what scikit-learn's checks fit: numbers become states of a tribometer and friction,
    rows in turn eight tests."""

    def __init__(self, law="coulomb", laws=("coulomb",), columns=None, constants=None, job=None,
                 trace=False, threads=0, random_state=None):
        super().__init__(law, laws, columns, constants, job, trace, threads, random_state)

    def fit(self, X, y):
        X, y = check_X_y(X, y, y_numeric=True, multi_output=False)
        tests = np.arange(len(X)) * 8 // max(len(X), 16)
        super().fit(self._states(X), 40 + 60 * self._share(y), tests)
        self.n_features_in_ = X.shape[1]
        return self

    def predict(self, X, groups=None):
        if not self.__sklearn_is_fitted__():
            return super().predict(X)
        X = check_array(X)
        if X.shape[1] != self.n_features_in_:
            raise ValueError(f"X has {X.shape[1]} features, but OnArrays is expecting "
                             f"{self.n_features_in_} features as input")
        return super().predict(self._states(X), groups)

    def _states(self, X):
        return pandas.DataFrame({"sigma_n_MPa": 500 + 1000 * self._share(X[:, 0]),
                                 "sigma_f_MPa": 400.0})

    @staticmethod
    def _share(x):
        return 1 / (1 + np.exp(-np.clip(np.asarray(x, float), -30, 30)))


class Estimator(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        frame = twin()
        cls.X, cls.y, cls.groups = frame[STATES], frame["tau_R_MPa"], frame["experiment"]
        cls.one = frictab.FrictionRegressor("exp_coulomb", ["coulomb", "exp_coulomb"],
                                            random_state=1)
        cls.one.fit(cls.X, cls.y, cls.groups)

    def test_the_checks_of_scikit_learn_that_apply_hold(self):
        passed = 0
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for estimator, check in check_estimator(OnArrays(), generate_only=True):
                name = check.func.__name__
                if name not in SKIPPED:
                    with self.subTest(name):
                        check(estimator)
                        passed += 1
        print(f"{passed} checks of scikit-learn hold, {len(SKIPPED)} do not apply")
        self.assertGreater(passed, 35)

    def test_tests_are_the_unit(self):
        with self.assertRaisesRegex(frictab.FrictabError, "Rows of one test are not independent"):
            frictab.FrictionRegressor().fit(self.X, self.y)
        held = set(self.one.result_.calibration.record["validation_experiments"])
        self.assertTrue(held and held <= set(self.groups))

    def test_predicts_and_scores_what_the_law_gives(self):
        tau = self.one.predict(self.X)
        np.testing.assert_allclose(tau, self.one.result_.law("exp_coulomb").tau_R(self.X), 1e-12)
        r2 = 1 - np.sum((self.y - tau) ** 2) / np.sum((self.y - self.y.mean()) ** 2)
        self.assertAlmostEqual(self.one.score(self.X, self.y), r2, 12)
        self.assertEqual(list(self.one.feature_names_in_), STATES)

    def test_is_cloned_pickled_and_cross_validated_over_groups(self):
        copy = clone(self.one)
        self.assertEqual(copy.get_params(), self.one.get_params())
        with self.assertRaises(NotFittedError):
            copy.predict(self.X)
        check_is_fitted(self.one)
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(self.one)).predict(self.X),
                                      self.one.predict(self.X))
        scores = cross_val_score(copy, self.X, self.y, groups=self.groups, cv=GroupKFold(3),
                                 fit_params={"groups": self.groups})
        self.assertTrue((scores > 0.2).all(), scores)

    def test_faults_name_the_argument(self):
        for X, y, groups, text in (
                (self.X.to_numpy(), self.y, self.groups, "X is a ndarray"),
                (self.X, self.y[:5], self.groups, "y has 5 values for"),
                (self.X, self.y, self.groups[:5], r"groups has the shape \(5,\)"),
                (self.X.assign(tau_R_MPa=1), self.y, self.groups, "'tau_R_MPa', which y or")):
            with self.assertRaisesRegex(frictab.FrictabError, text):
                frictab.FrictionRegressor().fit(X, y, groups)
        with self.assertRaisesRegex(frictab.FrictabError, "X lacks sigma_n_MPa"):
            self.one.predict(self.X.drop(columns="sigma_n_MPa"))


unittest.main()
