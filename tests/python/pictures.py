"""Pictures of the package frictab. Usage: pictures.py"""
import sys
import unittest
from unittest import mock

import numpy as np

import frictab
from sample import twin

try:
    import matplotlib
    matplotlib.use("Agg")
except ImportError:
    print("skipped: Debian's python3-matplotlib is not installed")
    sys.exit()
import matplotlib.pyplot as plt


def labels(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.frame = twin()
        held = sorted(t for t in cls.frame["experiment"].unique() if t.startswith("V"))
        cls.result = frictab.Campaign(cls.frame, validation=held).fit(
            ["coulomb", "exp_coulomb", "wzl", "coulomb_0.04"], until="calibrate")

    def tearDown(self):
        plt.close("all")

    def test_every_title_says_that_data_are_synthetic(self):
        plot = self.result.plot
        for ax in (plot.measured_vs_predicted(), plot.laws(), plot.residuals(), plot.ranking(),
                   plot.stroke("V001")):
            self.assertIn("SYNTHETIC", ax.get_title())
            self.assertIn("MPa", ax.get_xlabel() + ax.get_ylabel())
            ax.figure.canvas.draw()

    def test_measured_against_predicted_has_every_row_and_the_error_of_unseen_tests(self):
        ax = self.result.plot.measured_vs_predicted("exp_coulomb")
        points = np.concatenate([c.get_offsets() for c in ax.collections])
        self.assertEqual(len(points), len(self.frame))
        np.testing.assert_allclose(np.sort(points[:, 1]), np.sort(self.frame["tau_R_MPa"]))
        unseen = self.result.ranking.loc["exp_coulomb", "mae_MPa"]
        self.assertIn(f"unseen tests (6), MAE {unseen:.1f} MPa", labels(ax))

    def test_laws_are_drawn_over_the_data_and_dotted_beyond(self):
        ax = self.result.plot.laws("T_contact_C", ["exp_coulomb", "wzl"], at={"sigma_n_MPa": 900})
        self.assertEqual(labels(ax), ["data", "exp_coulomb", "wzl"])
        dotted, solid = ax.lines[:2]
        self.assertLess(dotted.get_xdata().min(), solid.get_xdata().min())
        self.assertEqual(solid.get_xdata().min() >= self.frame["T_contact_C"].min(), True)
        law = self.result.law("exp_coulomb")
        x = float(solid.get_xdata()[3])
        self.assertAlmostEqual(solid.get_ydata()[3], law.tau_R(
            sigma_n_MPa=900, T_contact_C=x, sigma_f_MPa=self.frame["sigma_f_MPa"].median()), 9)
        self.assertIn("sigma_n_MPa 900", ax.get_xlabel())
        with self.assertRaisesRegex(frictab.FrictabError, "no law here depends on 'psi'"):
            self.result.plot.laws("psi", ["exp_coulomb"])

    def test_the_density_of_residuals_has_the_area_1(self):
        ax = self.result.plot.residuals(["exp_coulomb", "coulomb"])
        for line in ax.lines[:2]:
            area = np.trapz(line.get_ydata(), line.get_xdata())
            self.assertTrue(0.9 < area < 1.01, area)
        self.assertEqual(labels(ax)[0], "exp_coulomb, unseen tests")

    def test_the_ranking_has_every_law_and_its_interval(self):
        ax = self.result.plot.ranking()
        bars = [bar.get_width() for bar in ax.patches]
        np.testing.assert_array_equal(bars, self.result.ranking["mae_MPa"])
        self.assertEqual([t.get_text() for t in ax.get_yticklabels()],
                         list(self.result.ranking.index))

    def test_a_stroke_has_measurement_law_and_band(self):
        ax = self.result.plot.stroke("V002", "exp_coulomb")
        there = self.frame["experiment"] == "V002"
        np.testing.assert_allclose(ax.lines[0].get_ydata(), self.frame.loc[there, "tau_R_MPa"])
        np.testing.assert_allclose(ax.lines[1].get_ydata(), self.result.law("exp_coulomb").predict(
            self.frame[there]))
        self.assertIn("90 % of new experiments", labels(ax))
        with self.assertRaisesRegex(frictab.FrictabError, "did you mean 'V002'"):
            self.result.plot.stroke("V02")

    def test_axes_of_the_caller_are_drawn_on(self):
        ax = plt.figure().subplots()
        self.assertIs(self.result.plot.ranking(ax=ax), ax)

    def test_without_matplotlib_it_is_named(self):
        with mock.patch.dict(sys.modules, {"matplotlib.pyplot": None}):
            with self.assertRaisesRegex(frictab.FrictabError, "pip install matplotlib"):
                self.result.plot.ranking()


unittest.main()
