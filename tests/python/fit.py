"""Campaign, fit and Result of the package frictab. Usage: fit.py [names of tests]"""
import contextlib
import io
import json
import os
import pathlib
import pickle
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import warnings

import numpy as np
import pandas

import frictab
from frictab import program
from sample import COLUMNS, CONSTANTS, recorded, twin

LAWS = ["coulomb", "exp_coulomb", "neural_network"]
QUICK = {"trace.models": ["exp_coulomb"]}


def campaign(frame, **changes):
    given = {"columns": COLUMNS, "experiment": "Versuch", "constants": CONSTANTS, **changes}
    return frictab.Campaign(frame, **given)


class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.keep = tempfile.TemporaryDirectory(prefix="mit Leerzeichen ä ")
        cls.here = pathlib.Path(cls.keep.name)
        cls.twin = twin()
        cls.frame = recorded(cls.twin)
        cls.held = sorted(t for t in cls.frame["Versuch"].unique() if t.startswith("V"))

    @classmethod
    def tearDownClass(cls):
        cls.keep.cleanup()

    def fails(self, text, function, *arguments, **named):
        with self.assertRaises(frictab.FrictabError) as fault:
            function(*arguments, **named)
        self.assertIn(text, str(fault.exception))
        return str(fault.exception)


class Results(Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.result = campaign(cls.frame, validation=cls.held).fit(LAWS, **QUICK)
        cls.open = frictab.Result.open(cls.result.save(cls.here / "gespeichert"))

    def test_ranks_the_laws_on_tests_that_they_have_not_seen(self):
        ranking = self.result.ranking
        record = json.loads((self.result.directory / "calibration.json").read_text())
        self.assertEqual(record["validation_experiments"], self.held)
        coulomb = {m["name"]: m for m in record["models"]}["coulomb"]
        self.assertEqual(coulomb["training"]["n_experiments"],
                         self.frame["Versuch"].nunique() - len(self.held))
        self.assertEqual(list(ranking.index), [m["name"] for m in record["models"]])
        self.assertEqual(ranking.loc["coulomb", "mae_MPa"],
                         [m for m in record["models"] if m["name"] == "coulomb"][0]
                         ["validation"]["mae_MPa"])
        self.assertTrue((ranking["mae_low_95"] <= ranking["mae_MPa"]).all())
        self.assertEqual(set(LAWS) - set(ranking.index), set())

    def test_gives_parameters_with_errors_and_correlations(self):
        law = self.result.law("exp_coulomb")
        table = self.result.parameters.loc["exp_coulomb"]
        self.assertEqual(list(table.index), ["mu0", "a", "b"])
        self.assertEqual(table["std_error"].tolist(), list(law.errors.values()))
        np.testing.assert_allclose(np.sqrt(np.diag(law.covariance)), table["std_error"], 1e-9)
        np.testing.assert_allclose(np.diag(law.correlations), 1.0)
        self.assertLess(np.abs(law.correlations.to_numpy()).max(), 1 + 1e-12)
        self.assertIsNone(self.result.law("neural_network").correlations)

    def test_predicts_every_row_in_the_order_and_index_of_the_frame(self):
        law = self.result.law("exp_coulomb")
        tau = law.predict(self.frame)
        by_formula = law.tau_R(sigma_n_MPa=self.frame["Druck"] / 1e6, sigma_f_MPa=420.0,
                               T_contact_C=self.frame["T"])
        np.testing.assert_allclose(tau, by_formula, 1e-12)
        mixed = self.frame.sample(frac=1.0, random_state=1)
        pandas.testing.assert_series_equal(law.predict(mixed), tau[mixed.index])

    def test_gives_the_band_that_the_record_has(self):
        law = self.result.law("exp_coulomb")
        found = law.predict(self.frame, band=True)
        self.assertEqual(list(found), ["tau_R_MPa", "tau_R_q05_MPa", "tau_R_q95_MPa"])
        low = found["tau_R_q05_MPa"] / found["tau_R_MPa"]
        free = found["tau_R_q95_MPa"] < 0.99 * 420 / np.sqrt(3) # not held by the shear limit
        np.testing.assert_allclose(low[free], law.fit["band"]["factor_5"], 1e-9)
        few = campaign(self.frame[self.frame["Versuch"].isin(self.held)]).fit(
            "coulomb", until="calibrate")
        self.fails("coulomb has no band: the 6 experiments", few.law("coulomb").predict,
                   self.frame, band=True)

    def test_warns_of_rows_beyond_the_data(self):
        with self.assertWarns(frictab.OutsideWarning) as heard:
            self.result.law("exp_coulomb").predict(self.frame.assign(T=self.frame["T"] + 500))
        self.assertIn(f"{len(self.frame)} of {len(self.frame)} rows", str(heard.warning))
        self.assertEqual(heard.filename, __file__)

    def test_a_fault_in_rows_to_predict_names_row_and_column(self):
        frame = self.frame.copy()
        frame.index = frame.index + 1000
        frame.loc[1005, "T"] = np.nan
        text = self.fails("data, row 1005", self.result.law("exp_coulomb").predict, frame)
        self.assertNotIn("csv", text)

    def test_reads_trace_and_verification(self):
        self.assertEqual(self.result.trace.verdict, self.result.trace["verdict"])
        self.assertTrue(self.result.verification.passed)
        table = self.result.verification.table
        self.assertEqual(table["subject"].tolist()[:2], ["table", "c/c99"])
        self.assertTrue((table["worst_case_MPa"] <= table["allowed_MPa"]).all())

    def test_exports_a_routine_and_verifies_it_and_leaves_the_results_as_they_are(self):
        before = {f: f.stat().st_mtime_ns for f in self.result.directory.rglob("*")}
        made = self.result.export("marc_ufric", self.here / "Routine ä", law="coulomb")
        self.assertEqual(before, {f: f.stat().st_mtime_ns
                                  for f in self.result.directory.rglob("*")})
        self.assertTrue(all(f.exists() for f in made.files))
        self.assertEqual(made.recipe["model"], "coulomb")
        self.assertEqual(made.verification.table["subject"].tolist()[0], "table")
        self.assertIn("marc_ufric/double", made.verification.table["subject"].tolist())
        self.assertTrue(made.verification.passed)
        self.result.export("abaqus_vfric", made.directory) # in place of one of its own
        (made.directory / "mine.f").write_text("mine")
        self.fails("mine.f", self.result.export, "marc_ufric", made.directory)
        self.fails("did you mean", self.result.export, "abaqus_vfrick", self.here / "x")

    def test_a_drift_over_the_tolerance_is_a_result_with_a_warning(self):
        tight = {"table.interpolation": "linear", "table.axes.sigma_n_MPa.nodes": 2,
                 "table.axes.T_contact_C.nodes": 2, "verify.max_drift_MPa": 1e-9,
                 "table.model": "neural_network", "export.form": "table"}
        with self.assertWarnsRegex(frictab.CautionWarning, "a target was missed"):
            result = campaign(self.frame, validation=self.held).fit(["neural_network"], **tight)
        self.assertFalse(result.verification.passed)
        self.assertRegex(result.summary(), "OVER TOLERANCE|FAILED")

    def test_is_saved_and_opened_with_its_data(self):
        law = self.open.law("exp_coulomb")
        np.testing.assert_array_equal(law.predict(self.frame),
                                      self.result.law("exp_coulomb").predict(self.frame))
        self.fails("not empty", self.result.save, self.here / "gespeichert")
        status = program.answer(["status", "job.toml", "--json"], self.here / "gespeichert")
        self.assertEqual({s["state"] for s in json.loads(status)["stages"]}, {"done"})
        again = pickle.loads(pickle.dumps(self.result))
        np.testing.assert_array_equal(again.law().predict(self.frame),
                                      self.result.law().predict(self.frame))

    def test_opens_what_the_command_line_wrote(self):
        job = self.here / "gespeichert" / "job.toml"
        for place, given in ((job, None), (job.parent / "out", job), (job.parent / "out", None)):
            result = frictab.Result.open(place, given)
            self.assertEqual(result.laws, self.result.laws)
        self.assertIsNone(result.job)
        frame = self.twin.assign(sigma_f_MPa=420.0)
        np.testing.assert_allclose(result.law("coulomb").predict(frame),
                                   self.result.law("coulomb").predict(self.frame), 1e-12)
        made = result.export("c", self.here / "ohne")
        self.assertIsNone(made.verification)
        self.assertIn("not verified", repr(made))
        self.fails("the data are not known without the job", lambda: result.data)
        self.fails("no results of frictab", frictab.Result.open, self.here)

    def test_shows_itself(self):
        self.assertIn("take: ", self.result.summary())
        html = self.result._repr_html_()
        self.assertIn("<table", html)
        self.assertNotIn("SYNTHETIC", html) # a rig's names, no column that says so
        self.assertIn("<table", self.result.trace._repr_html_())

    def test_a_law_that_is_not_there_is_named(self):
        self.fails("did you mean 'coulomb'?", self.result.law, "coulom")

    def test_damaged_results_are_faults_of_their_own_kind(self):
        place = self.here / "damaged"
        shutil.copytree(self.open.directory, place)
        draw, opened = random.Random(5), 0
        for name in ("calibration", "verify", "trace"):
            file = place / f"{name}.json"
            whole = file.read_bytes()
            damaged = [b"{}", whole[:200], b'{"schema": "frictab/%s/1"}' % name.encode(),
                       whole.replace(b'"models"', b'"model_"').replace(b'"records"', b'"record_"')
                       .replace(b'"effects"', b'"effect_"')]
            for text in damaged:
                file.write_bytes(text)
                self.fails(f"{name}.json", frictab.Result.open, place)
            for _ in range(60):
                data = bytearray(whole)
                for _ in range(draw.randint(1, 3)):
                    data[draw.randrange(len(data))] = draw.randrange(32, 127)
                file.write_bytes(data)
                try:
                    result = frictab.Result.open(place)
                    for show in (result.summary, result._repr_html_, lambda: result.parameters):
                        show()
                    opened += 1
                except frictab.FrictabError as fault:
                    self.assertIn(f"{name}.json", str(fault))
            file.write_bytes(whole)
        self.assertGreater(opened, 10)
        frictab.Result.open(place)

    def test_a_fit_that_ends_early_still_exports(self):
        result = campaign(self.frame, validation=self.held).fit("coulomb", until="calibrate")
        self.assertIsNone(result.verification)
        self.assertTrue(result.export("c", self.here / "spät").verification.passed)


class Calls(Case):
    def test_synthetic_data_are_called_so(self):
        result = frictab.Campaign(self.twin).fit("coulomb", until="calibrate")
        self.assertTrue(result.synthetic)
        for text in (result.summary(), repr(result), result._repr_html_()):
            self.assertIn("SYNTHETIC", text)

    def test_the_job_holds_what_was_given(self):
        tests = self.twin.groupby("experiment")["humidity_pct"].first().rename("hum")
        result = campaign(self.frame.drop(columns="Feuchte"), tests=tests.reset_index(),
                          directory=self.here / "Job ü", roles={"hum": "ignore"}).fit(
            "coulomb", until="calibrate", threads=1, calibration={"loss": "L1", "seed": 7})
        self.assertEqual(result.directory, (self.here / "Job ü" / "out").resolve())
        self.assertEqual(result.calibration.record["loss"], "L1")
        self.assertEqual(result.calibration.record["seed"], 7)
        self.assertIn("hum", result.data)
        (self.here / "other").mkdir()
        (self.here / "other" / "job.toml").write_text("mine")
        self.fails("was not written by this package",
                   campaign(self.frame, directory=self.here / "other").fit)
        self.assertEqual((self.here / "other" / "job.toml").read_text(), "mine")

    def test_every_number_and_text_reaches_the_program_as_it_was(self):
        frame = self.twin[["experiment", "sigma_n_MPa", "sigma_f_MPa", "tau_R_MPa"]].copy()
        frame["sigma_n_MPa"] += np.random.default_rng(1).uniform(0, 1, len(frame))
        frame["Öl, \"A\"\n"] = "fein; \"ä\", 1"
        result = frictab.Campaign(frame).fit("coulomb", until="calibrate")
        self.assertEqual(set(result.data["use"]), {"train", "validate"}) # 30 tests: some held out
        np.testing.assert_array_equal(result.predicted_data("coulomb")["measured_tau_R_MPa"],
                                      result.data["tau_R_MPa"])
        data, frame = (f.sort_values("experiment", kind="stable") for f in (result.data, frame))
        self.assertEqual(data["sigma_n_MPa"].tolist(), frame["sigma_n_MPa"].tolist())
        self.assertEqual(set(data.iloc[:, 4]), {"fein; \"ä\", 1"})

    def test_the_same_call_gives_the_same_files(self):
        made = [campaign(self.frame, directory=self.here / f"{n}").fit(
            ["coulomb"], until="tabulate", threads=n).directory for n in (1, 2)]
        for name in ("calibration.json", "models/coulomb.json", "tables/coulomb.h5"):
            self.assertEqual(*[(d / name).read_bytes() for d in made], name)

    def test_tests_may_be_numbers_levels_of_an_index_or_rows(self):
        number = {name: n for n, name in enumerate(self.frame["Versuch"].unique())}
        frame = self.frame.assign(Versuch=self.frame["Versuch"].map(number).astype(float))
        wanted = None
        for given in (frame, frame.astype({"Versuch": int}), frame.set_index(["Versuch", "v"]),
                      frame.sort_values("Druck", kind="stable")):
            law = campaign(given).fit("coulomb", until="calibrate").law("coulomb")
            found = law.predict(given)
            self.assertTrue(found.index.equals(given.index))
            np.testing.assert_allclose(found, law.parameters["mu"] * given["Druck"] / 1e6, 1e-9)
            wanted = wanted or law.parameters
            self.assertAlmostEqual(law.parameters["mu"] / wanted["mu"], 1, 6)
        rows = campaign(self.frame.drop(columns="Versuch").iloc[::9], experiment="row").fit(
            "coulomb", until="calibrate")
        self.assertEqual(rows.calibration.record["models"][0]["training"]["n_experiments"]
                         + len(rows.calibration.record["validation_experiments"]),
                         len(self.frame.iloc[::9]))

    def test_names_that_are_wrong_are_named_before_anything_runs(self):
        typo = {**COLUMNS, "sigma_n_MPa": ("Druk", "Pa")}
        self.fails("columns['sigma_n_MPa'] is 'Druk', which is not a column of data; did you mean "
                   "'Druck'?", campaign, self.frame, columns=typo)
        self.fails("there is no column 'Versuh' that names the tests; did you mean 'Versuch'?",
                   campaign, self.frame, experiment="Versuh")
        self.fails("there is no column 'experiment'", campaign, self.frame, experiment=None)
        self.fails("there is no test 'V01'", campaign, self.frame, validation=["V01"])
        self.fails("it is a pandas.DataFrame", campaign, [1, 2])
        self.fails("has no rows", campaign, self.frame[:0])
        self.fails("directory=...) names the folder", campaign(self.frame).fit,
                   output={"directory": "x"})

    def test_faults_of_the_program_name_the_argument(self):
        text = self.fails("unknown quantity 'sigma_N'",
                          campaign(self.frame, columns={**COLUMNS, "sigma_N": "Druck"}).fit)
        self.assertIn("columns.sigma_N", text)
        text = self.fails("unknown friction law 'coulom'", campaign(self.frame).fit, "coulom")
        self.assertTrue(text.startswith("laws: error"), text)
        self.assertIn("did you mean 'coulomb'?", text)
        text = self.fails("unknown key 'tolerance'", campaign(self.frame).fit,
                          table={"tolerance": 1})
        self.assertIn("table.tolerance: error", text)
        text = self.fails("data: error: sigma_n_MPa is above", campaign(
            self.frame, columns={**COLUMNS, "sigma_n_MPa": ("Druck", "MPa")}).fit)
        self.assertIn("\"Pa\" as its unit in columns", text)
        self.assertIn("allow_implausible=[\"pressure\"]", text)
        for word in ("data.", "mapped", "[data"):
            self.assertNotIn(word, text)
        bad = self.frame.copy()
        bad.index = bad.index + 500
        bad.loc[517, "Reibung"] = np.nan
        text = self.fails("data, row 517, column 'Reibung': error", campaign(bad).fit)
        self.assertIn("hint:", text)
        held = bad.iloc[::-1]
        for text in ("", "Ä", "a,\"b"): # cells before it have signs of several bytes
            bad.insert(1, "Text" + text, text)
        self.fails("data, row 517, column 'Reibung': error", campaign(bad).fit)
        self.fails("validation, row 517", campaign(self.frame, validation=held).fit)
        for part in (".csv", "job.toml", str(tempfile.gettempdir())):
            self.assertNotIn(part, text)

    def test_one_test_to_judge_by_gives_no_interval(self):
        result = campaign(self.frame, validation=self.held[:1]).fit("coulomb", until="calibrate")
        self.assertIn("on 1 test it has not seen", result.summary())
        self.assertTrue(result.ranking["mae_low_95"].isna().all())

    def test_a_unit_that_nobody_gave_is_a_warning(self):
        bare = {**COLUMNS, "v_rel_mm_s": "v"}
        with self.assertWarns(frictab.CautionWarning) as heard:
            campaign(self.frame, columns=bare).read()
        self.assertIn('columns={"v_rel_mm_s": ("v", "mm/s")}', str(heard.warning))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            found = campaign(self.frame).read()
        self.assertEqual(len(found["tests"]), self.frame["Versuch"].nunique())

    def test_a_program_that_is_not_there_is_named(self):
        for environment, text in (({"FRICTAB": "/no/frictab"}, "FRICTAB is '/no/frictab'"),
                                  ({"FRICTAB": "", "PATH": ""}, "neither in FRICTAB, nor on")):
            copy = self.here / "copy"
            shutil.copytree(pathlib.Path(frictab.__file__).parent, copy / "frictab",
                            dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__"))
            done = subprocess.run(
                [sys.executable, "-c", "import frictab.program as p; p.find_program()"],
                env={**os.environ, "PYTHONPATH": str(copy), **environment}, capture_output=True,
                encoding="utf-8")
            self.assertIn(text, done.stderr)
            self.assertIn("FrictabError", done.stderr)

    def test_lines_on_stderr_are_passed_on_as_they_come(self):
        heard = io.StringIO()
        text = "echo one >&2; echo out; echo 'x: error: two' >&2; exit 2"
        outcome = program.run(["-c", text], program="/bin/sh", echo=heard)
        self.assertEqual((outcome.code, outcome.out, outcome.err),
                         (2, "out\n", "one\nx: error: two\n"))
        self.assertEqual(heard.getvalue(), outcome.err)
        self.assertEqual(program.fault_text(outcome), "x: error: two")
        with contextlib.redirect_stderr(heard):
            campaign(self.frame).fit("coulomb", until="calibrate", progress=True)

    def test_an_interruption_ends_the_program_and_leaves_nothing(self):
        scratch = self.here / "scratch"
        scratch.mkdir()
        text = ("import sys, signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n"
                "sys.path.insert(0, %r)\nfrom fit import *\nfrom frictab import program\n"
                "run = program.run\n"
                "def started(a, d, **n):\n    print('run' if a[0] == 'run' else '', flush=True)\n"
                "    return run(a, d, **n)\n"
                "program.run = started\n"
                "campaign(recorded(twin())).fit()\n" % str(pathlib.Path(__file__).parent))
        child = subprocess.Popen([sys.executable, "-c", text], stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, encoding="utf-8", start_new_session=True,
                                 env={**os.environ, "TMPDIR": str(scratch)})
        while child.stdout.readline().strip() != "run":
            self.assertIsNone(child.poll())
        time.sleep(0.5)
        child.send_signal(signal.SIGINT) # to Python alone, as Jupyter does
        self.assertIn("KeyboardInterrupt", child.communicate(timeout=60)[1])
        self.assertRaises(ProcessLookupError, os.killpg, child.pid, 0) # the program ended too
        self.assertEqual(list(scratch.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
