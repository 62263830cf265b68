"""Tables by their generated C routine and by numpy: the same values. Usage: kernel.py"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import warnings
from unittest import mock

import numpy as np

import frictab
from frictab import kernel, program

DESIGN = "p=600,1200,2000;psi=1,5;v=5,500;T=20,200;points=20;validation=6"
ROWS = 4000


def states(table, rows):
    """Inside, at the ends, beyond them by 0.4 of the range, not known, and endless."""
    draw, found = np.random.default_rng(1), {}
    for one in table.inputs:
        low, high = (one.low, one.high) if np.isfinite(one.high - one.low) else (1.0, 900.0)
        x = draw.uniform(1.4 * low - 0.4 * high, 1.4 * high - 0.4 * low, rows)
        x[:6] = low, high, np.nan, 0.0, np.inf, -np.inf
        found[one.name] = draw.permutation(x)
    return found


class Kernels(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.keep = tempfile.TemporaryDirectory(prefix="ä b ")
        cls.here = pathlib.Path(cls.keep.name)
        cls.environment = mock.patch.dict(os.environ, XDG_CACHE_HOME=str(cls.here / "cache"))
        cls.environment.start()
        program.answer(["twin", "twin", "--seed", "3", "--design", DESIGN], cls.here)
        (cls.here / "job.toml").write_text(
            '[data]\ntraining = "twin/training.csv"\nvalidation = "twin/validation.csv"\n'
            '[table]\nrange = "table1"\n')
        program.answer(["calibrate", "job.toml", "-q"], cls.here)

    @classmethod
    def tearDownClass(cls):
        cls.environment.stop()
        cls.keep.cleanup()

    def setUp(self):
        warnings.simplefilter("ignore", frictab.OutsideWarning)

    def table(self, law, interpolation="linear", outside=None, axes=()):
        keys = [f"table.model={law}", f"table.interpolation={interpolation}",
                *(f"table.axes.{axis}.outside={outside}" for axis in axes if outside)]
        program.answer(["tabulate", "job.toml", "-q", *(a for k in keys for a in ("--set", k))],
                       self.here)
        copy = self.here / f"{law}_{interpolation}_{outside}.h5"
        copy.write_bytes((self.here / "out" / "tables" / f"{law}.h5").read_bytes())
        return frictab.open_table(copy)

    def by(self, choice, call, *arguments):
        with mock.patch.dict(os.environ, FRICTAB_PYTHON_KERNEL=choice):
            return call(*arguments)

    def test_gives_the_values_of_numpy_to_1e_12_whatever_holds_beyond_the_ends(self):
        wzl = "sigma_n_MPa", "v_rel_mm_s", "T_contact_C"
        kinds = [("coulomb", "linear", None, ()), *((law, i, None, ()) for i in ("linear", "cubic")
                                                    for law in ("wanheim_bay", "polynomial"))]
        kinds += [("wzl", i, o, wzl) for i in ("linear", "cubic")
                  for o in ("clamp", "error", "law")]
        for kind in kinds:
            table = self.table(*kind)
            where = states(table, ROWS)
            wanted = self.by("numpy", table.tau_R, where)
            made = self.by("c", table.tau_R, where)
            np.testing.assert_allclose(made, wanted, 1e-12, 1e-15, err_msg=str(kind))
            self.assertEqual(kind[2] == "error", np.isnan(wanted).mean() > 0.3, kind)
            np.testing.assert_allclose(self.by("c", table.mu, where),
                                       self.by("numpy", table.mu, where), 1e-12, 1e-15)

    def test_warns_as_numpy_does_and_takes_numbers_arrays_and_strides(self):
        table = self.table("wzl")
        where = states(table, ROWS)
        heard = []
        for choice in ("numpy", "c"):
            with self.assertWarns(frictab.OutsideWarning) as one:
                self.by(choice, table.tau_R, where)
            heard.append((str(one.warning), one.filename == unittest.mock.__file__))
        self.assertEqual(*heard)
        inside = {i.name: (i.low + i.high) / 2 if np.isfinite(i.high - i.low) else 400.0
                  for i in table.inputs}
        one = self.by("c", table.tau_R, inside)
        self.assertIsInstance(one, float)
        grid = np.full((6, 4), inside["sigma_n_MPa"])[::2, ::2]
        many = self.by("c", table.tau_R, {**inside, "sigma_n_MPa": grid})
        np.testing.assert_array_equal(many, np.full((3, 2), one))
        self.assertEqual(self.by("c", table.tau_R, {**inside, "sigma_n_MPa": []}).shape, (0,))

    def test_rows_of_a_call_alone_decide_unless_the_environment_does(self):
        table = self.table("wzl")
        with mock.patch.dict(os.environ), mock.patch.object(
                frictab.table, "build_kernel", side_effect=kernel.KernelFault("here")) as build:
            os.environ.pop("FRICTAB_PYTHON_KERNEL", None)
            table.tau_R(states(table, kernel.MANY_ROWS - 1))
            build.assert_not_called()
            table.tau_R(states(table, kernel.MANY_ROWS))
            build.assert_called_once()
        self.assertIn("FRICTAB_PYTHON_KERNEL", self.by("numpy", lambda: table.kernel))
        self.assertEqual(frictab.open_table(table.source).kernel, "C")
        with self.assertRaisesRegex(frictab.FrictabError, "it is one of auto, c, numpy"):
            self.by("fast", table.tau_R, states(table, 10))

    def test_is_compiled_once_and_again_for_another_table(self):
        table = self.table("wzl")
        self.by("c", table.tau_R, states(table, 10))
        cache = self.here / "cache" / "frictab"
        self.assertEqual(cache.stat().st_mode & 0o777, 0o700)
        before = {f: f.stat().st_mtime_ns for f in cache.rglob("*")}
        self.assertEqual(frictab.open_table(table.source).kernel, "C")
        self.assertEqual(before, {f: f.stat().st_mtime_ns for f in cache.rglob("*")})
        other = self.table("exp_coulomb")
        self.assertEqual(other.kernel, "C")
        self.assertEqual(len(list(cache.iterdir())), len({f.parent for f in before if
                                                          f.name == "kernel.so"}) + 1)

    def test_a_table_that_changed_since_it_was_read_is_not_compiled(self):
        table = self.table("levanov")
        pathlib.Path(table.source).write_bytes(pathlib.Path(self.table("shear").source)
                                               .read_bytes())
        self.assertIn("has changed since it was read", table.kernel)

    def test_a_table_that_a_compiler_would_take_long_for_is_left_to_numpy(self):
        table = self.table("shear")
        with mock.patch.object(kernel, "MOST_VALUES", table.value.size - 1):
            self.assertIn(f"has {table.value.size} values", table.kernel)

    def test_without_compiler_program_or_safe_folder_numpy_gives_the_values(self):
        table = self.table("orowan")
        where = states(table, kernel.MANY_ROWS)
        wanted = self.by("numpy", table.tau_R, where)
        open_folder = self.here / "open" / "frictab"
        open_folder.mkdir(parents=True)
        open_folder.chmod(0o777)
        for change, text in (({"CC": "/nowhere/cc"}, "there is no C compiler"),
                             ({"CC": "false"}, "frictab ended with 1"),
                             ({"FRICTAB": "/nowhere"}, "FRICTAB is '/nowhere'"),
                             ({"XDG_CACHE_HOME": str(open_folder.parent)}, "only you can write"),
                             ({"XDG_CACHE_HOME": "/dev/null/x"}, "there is no folder to keep")):
            with mock.patch.dict(os.environ, change):
                fresh = frictab.open_table(table.source)
                self.assertIn(text, fresh.kernel)
                np.testing.assert_array_equal(fresh.tau_R(where), wanted)
                with self.assertRaisesRegex(frictab.FrictabError, "no C kernel: "):
                    self.by("c", fresh.tau_R, where)

    def test_two_processes_at_once_make_one(self):
        table = self.table("shaw", "cubic")
        text = f"import frictab; print(frictab.open_table({table.source!r}).kernel)"
        two = [subprocess.Popen([sys.executable, "-c", text], stdout=subprocess.PIPE,
                                encoding="utf-8") for _ in range(2)]
        self.assertEqual([one.communicate()[0] for one in two], ["C\n"] * 2)
        left = [f for f in (self.here / "cache" / "frictab").iterdir() if len(f.name) != 40]
        self.assertEqual(left, [])


if __name__ == "__main__":
    unittest.main()
