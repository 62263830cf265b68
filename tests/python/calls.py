"""How the package frictab is called. Usage: calls.py DIRECTORY of sides.h5, spline.h5, tool.json"""
import builtins
import pathlib
import random
import shutil
import subprocess
import sys
import unittest
import warnings

import h5py
import numpy as np
import pandas
import xarray

import frictab
import frictab.accessor

HERE = pathlib.Path(sys.argv.pop(1))


def middle(law, **others):
    """A state in the middle of every range."""
    return {**{i.name: (i.low + i.high) / 2 if np.isfinite(i.high - i.low) else 400.0
               for i in law.inputs}, **others}


class Calls(unittest.TestCase):
    def setUp(self):
        self.table = frictab.open(HERE / "spline.h5")
        self.state = middle(self.table)
        self.axis = self.table.axes[0].name

    def fails(self, text, function, *arguments, **named):
        with self.assertRaises(frictab.FrictabError) as fault:
            function(*arguments, **named)
        self.assertIn(text, str(fault.exception))

    def test_numbers_give_a_number_and_arrays_broadcast(self):
        one = self.table.tau_R(**self.state)
        self.assertIsInstance(one, float)
        many = dict(self.state, **{self.axis: np.full((3, 1), self.state[self.axis])})
        many[self.table.axes[1].name] = np.full(2, self.state[self.table.axes[1].name])
        np.testing.assert_array_equal(self.table.tau_R(**many), np.full((3, 2), one))
        empty = {**self.state, self.axis: []}
        self.assertEqual(self.table.tau_R(empty).shape, (0,))

    def test_frames_and_datasets_give_their_own_kind(self):
        one = self.table.tau_R(**self.state)
        frame = pandas.DataFrame([self.state] * 2, index=["a", "b"]).assign(note="not asked for")
        series = self.table.tau_R(frame)
        self.assertEqual(series.index.tolist(), ["a", "b"])
        self.assertEqual(series["b"], one)
        data = xarray.Dataset({n: ("node", [x, x]) for n, x in self.state.items()})
        self.assertEqual(self.table.tau_R(data).dims, ("node",))

    def test_names_that_are_wrong_or_missing_are_told(self):
        self.fails("did you mean 'sigma_n_MPa'?", self.table.tau_R, sigma_n=1)
        self.fails(f"needs {self.table.inputs[0]}", self.table.tau_R)
        self.fails("is not a number", self.table.tau_R, {**self.state, self.axis: "much"})
        self.fails("do not fit together", self.table.tau_R, {
            **self.state, self.axis: [1, 2], self.table.axes[1].name: [1, 2, 3]})

    def test_states_outside_are_counted_by_side(self):
        axis = self.table.axes[0]
        state = {**self.state, self.axis: [axis.nodes[0] / 2, self.state[self.axis],
                                           axis.nodes[-1] * 2, axis.nodes[-1] * 3]}
        with self.assertWarns(frictab.OutsideWarning) as heard:
            self.table.tau_R(state)
        self.assertIn(f"of 4 states, {self.axis} below {axis.nodes[0]:g} in 1", str(heard.warning))
        self.assertIn(f"{self.axis} above {axis.nodes[-1]:g} in 2", str(heard.warning))
        self.assertEqual(heard.filename, __file__)
        self.assertEqual(self.table.outside(state)[self.axis].tolist(), [-1, 0, 1, 1])

    def test_a_state_that_is_not_known_gives_nan(self):
        self.assertTrue(np.isnan(self.table.tau_R(self.state, **{self.axis: np.nan})))
        x = self.state[self.axis]
        masked = np.ma.masked_array([[x, x], [x, -1e9]], [[False, True], [False, True]])
        one = self.table.tau_R(self.state) # and says nothing of the range of what is masked
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            np.testing.assert_array_equal(self.table.tau_R(self.state, **{self.axis: masked}),
                                          [[one, np.nan], [one, np.nan]])

    def test_a_side_that_refuses_gives_nan(self):
        table = frictab.open(HERE / "sides.h5")
        ends = [(a, sign) for a in table.axes for sign in (-1, 1)
                if (a.below if sign < 0 else a.above) == "error"]
        self.assertTrue(ends)
        for axis, sign in ends:
            end = axis.nodes[0] if sign < 0 else axis.nodes[-1]
            for part, refused in ((1e-7, False), (1e-5, True)):
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    tau = table.tau_R(middle(table), **{axis.name: end * (1 + sign * part)})
                self.assertEqual(np.isnan(tau), refused, axis.name)

    def test_the_accessor_interpolates_as_the_table_where_interp_of_xarray_does_not(self):
        with xarray.open_dataset(HERE / "spline.h5") as data:
            self.assertEqual(data.frictab.tau_R(self.state), self.table.tau_R(self.state))
            piece = data.frictab.interp(self.state)
            at = {axis.name: self.state[axis.name] for axis in self.table.axes}
            self.assertGreater(abs(data["value"].interp(at).item() / piece - 1), 1e-3)
            self.assertIn("is WRONG between the nodes", data["value"].attrs["comment"])
            log = [a for a in self.table.axes if a.log]
            self.assertTrue(log)
            for axis in log:
                np.testing.assert_array_equal(data.coords["ln_" + axis.name], np.log(axis.nodes))
                self.assertEqual(data.coords["ln_" + axis.name].dims, (axis.name,))
            self.assertEqual(data.attrs["Conventions"], "CF-1.8, ACDD-1.3")

    def test_text_columns_are_taken_by_their_levels(self):
        law = frictab.read_model(HERE / "tool.json")
        named, = [i for i in law.inputs if i.levels]
        state = middle(law)
        for number, level in enumerate(named.levels):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                self.assertEqual(law.tau_R(state, **{named.name: level}),
                                 law.tau_R(state, **{named.name: number}))
        self.fails("it is one of A, B", law.tau_R, state, **{named.name: "Z"})

    def test_files_of_another_kind_are_told_apart(self):
        self.fails("is not an HDF5 file", frictab.open, HERE / "tool.json")
        self.fails("no such file", frictab.open, HERE / "none.h5")
        self.fails("is not a JSON file", frictab.read_model, HERE / "spline.h5")
        self.fails('its schema is "frictab/model/1"', frictab.read_calibration, HERE / "tool.json")
        self.fails("no variable 'value'", lambda: xarray.Dataset().frictab)

    def changed(self, change):
        """A copy of the table after change(file)."""
        copy = HERE / "changed.h5"
        shutil.copy(HERE / "spline.h5", copy)
        with h5py.File(copy, "r+") as file:
            change(file)
        return copy

    def test_tables_of_the_first_layout_hold_logarithms(self):
        def as_it_was(file):
            file["value"][...] = np.log(file["value"][...])
            file.attrs["schema"] = "frictab/table/1"
        old = frictab.open(self.changed(as_it_was))
        self.assertAlmostEqual(old.tau_R(self.state) / self.table.tau_R(self.state), 1, 12)

    def test_damaged_tables_are_refused(self):
        def node(file):
            file[self.axis][1] = file[self.axis][0]
        def number(file):
            file["value"][(0,) * file["value"].ndim] = np.nan
        def side(file):
            file[self.axis].attrs["outside_low"] = "law"
        def constant(file):
            file["value"].attrs["combine"] = "value*nobody"
        def scale(file):
            file["value"].dims[0].detach_scale(file[self.axis])
        for change, text in ((node, "ascending nodes"), (number, "not finite and above 0"),
                             (side, "no attribute 'extension'"), (scale, "no dimension scale")):
            self.fails(text, frictab.open, self.changed(change))
        self.fails("needs nobody", frictab.open(self.changed(constant)).tau_R, self.state)
        (HERE / "cut.h5").write_bytes((HERE / "spline.h5").read_bytes()[:3000])
        self.fails("cut.h5: ", frictab.open, HERE / "cut.h5")

    def test_values_in_other_files_are_refused_before_they_are_read(self):
        def moved(make):
            def change(file):
                old = file["value"]
                shape, attributes = old.shape, dict(old.attrs)
                del file["value"]
                make(file, shape)
                if "value" in file:
                    file["value"].attrs.update({n: a for n, a in attributes.items()
                                                if n != "DIMENSION_LIST"})
            return self.changed(change)
        def external(file, shape):
            file.create_dataset("value", shape, "f8", external=[("/etc/passwd", 0, 10000000)])
        def virtual(file, shape):
            layout = h5py.VirtualLayout(shape, "f8")
            layout[...] = h5py.VirtualSource("gone.h5", "value", shape)
            file.create_virtual_dataset("value", layout, fillvalue=88.8)
        def deep(file, shape):
            file.create_group("a/b")["out"] = h5py.ExternalLink("spline.h5", "/value")
            file["value"] = h5py.SoftLink("/a/b/out")
        for make, text in ((external, "lie in another file, /etc/passwd"),
                           (virtual, "is a virtual dataset"),
                           (deep, "'a/b/out' is a link into another file")):
            self.fails(text, frictab.open, moved(make))

    def test_every_damaged_file_is_a_fault_of_its_own_kind(self):
        draw = random.Random(5)
        for name, read in (("spline.h5", frictab.open), ("tool.json", frictab.read_model)):
            whole = (HERE / name).read_bytes()
            for _ in range(400):
                data = bytearray(whole)
                for _ in range(draw.randint(1, 4)):
                    data[draw.randrange(len(data))] = draw.randrange(256)
                if draw.random() < 0.1:
                    del data[draw.randrange(len(data)):]
                (HERE / "other").write_bytes(data)
                try:
                    read(HERE / "other")
                except frictab.FrictabError as fault:
                    self.assertIn("other: ", str(fault))
        for place, text in ((HERE, "is not a file"), ("/dev/null", "is not a file"),
                            (HERE / "none", "no such file")):
            for read in (frictab.open, frictab.read_model, frictab.read_calibration):
                self.fails(text, read, place)


class Names(unittest.TestCase):
    def test_an_import_of_everything_leaves_the_names_of_python_alone(self):
        names = {}
        exec("from frictab import *", names)
        self.assertEqual([n for n in names if n in dir(builtins) and n[0] != "_"], [])
        self.assertLessEqual(set(frictab.__all__), set(names))
        self.assertIs(frictab.open, frictab.open_table)

    def test_reading_needs_neither_pandas_nor_the_program(self):
        gone = dict.fromkeys(["pandas", "matplotlib", "sklearn", "xarray"])
        text = (f"import sys; sys.modules.update({gone}); import frictab\n"
                f"frictab.open_table({str(HERE / 'spline.h5')!r})\n"
                "try: frictab.frames.pandas_module()\n"
                "except frictab.FrictabError as fault: print(fault)")
        done = subprocess.run([sys.executable, "-c", text], capture_output=True, encoding="utf-8")
        self.assertIn("needs pandas: pip install pandas", done.stdout, done.stderr)


class Formulas(unittest.TestCase):
    def test_binds_as_python_does(self):
        for text in ("-x**2", "2**-x", "x/2*3", "1 - x - 2", "2**x**2", "-(x + 1)*.5e1",
                     "where(x <= 3, minimum(x, 1), exp(x))"):
            scope = {n: getattr(np, n) for n in ("minimum", "exp", "where")}
            self.assertEqual(frictab.Formula(text)(x=3.0), eval(text, scope, {"x": 3.0}), text)

    def test_runs_nothing_but_arithmetic(self):
        for text in ("__import__('os')", "x.real", "open(x)", "x[0]", "lambda: 1", "1 if x else 2",
                     "x; x", "", "(" * 500 + "x", "1 +", "minimum(x)", "where(x, 1, 2)"):
            with self.assertRaises(frictab.FrictabError, msg=text):
                frictab.Formula(text)

    def test_any_text_is_a_formula_or_a_fault(self):
        pieces = "x 1.5 2e3 + - * / ** ( ) , <= where log .".split() + [" "]
        draw, read = random.Random(1), 0
        for _ in range(5000):
            try:
                frictab.Formula("".join(draw.choices(pieces, k=draw.randint(1, 8))))
                read += 1
            except frictab.FrictabError:
                pass
        self.assertGreater(read, 100)

    def test_nan_goes_through_every_choice(self):
        for text in ("minimum(x, 1)", "maximum(1, x)", "where(x <= 1, 1, 2)",
                     "where(1 <= x, 1, 2)"):
            self.assertTrue(np.isnan(frictab.Formula(text)(x=np.nan)), text)


unittest.main(argv=["calls.py"])
