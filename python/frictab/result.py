"""A folder of results: the ranking, laws, trace, verification and routines of a run."""
from __future__ import annotations

import html
import io
import json
import os
import shutil
import tempfile
import warnings
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping, Optional, Sequence

from . import program
from .calibration import Calibration, Model, read_calibration, read_record
from .faults import FrictabError, OutsideWarning, file_faults
from .frames import (as_arguments, in_rows, near, order_by_test, pandas_module, plain_frame,
                     read_frame, write_frame)
from .parts import Trace, Verification
from .program import PathLike
from .routine import Export, export_routine, files_in

if TYPE_CHECKING:
    import pandas

    from .plots import Plots

_BAND = ["tau_R_q05_MPa", "tau_R_q95_MPa"]


class Law(Model):
    """A calibrated law of a result: a Model, which also predicts rows of data as they were
    measured."""

    def __init__(self, result: Result, model: Model) -> None:
        self.__dict__.update(vars(model)) # a formula of many weights is not parsed again
        self._result = result

    def predict(self, data: pandas.DataFrame, band: bool = False) -> Any:
        """tau_R in MPa, one value per row, as a Series; with band=True a DataFrame that also has
        the 5 % and 95 % quantiles of new experiments.

        `data` has the columns of the campaign, in its units; no friction is needed. Tests are
        named as in the campaign: histories, such as sliding distance, run along each.
        """
        pandas = pandas_module()
        rows = self._result.predicted(self.name, data)
        if band and _BAND[0] not in rows:
            raise FrictabError(f"{self.name} has no band: the {len(self.fit['experiment_gains'])} "
                               "experiments of its calibration do not give 5 % and 95 %")
        self._warn_outside(rows)
        columns = ["tau_R_MPa", *(_BAND if band else [])]
        found = pandas.DataFrame(rows[columns].to_numpy(), index=data.index, columns=columns)
        return found if band else found["tau_R_MPa"]

    @property
    def parameter_table(self) -> pandas.DataFrame:
        """Its parameters: value, standard error, unit, meaning."""
        return pandas_module().DataFrame(
            [[p["value"], p.get("std_error"), p.get("unit", ""), p.get("meaning", "")]
             for p in self.fit["parameters"]], index=list(self.parameters),
            columns=["value", "std_error", "unit", "meaning"])

    @property
    def correlations(self) -> Optional[pandas.DataFrame]:
        """Of the parameters; None for laws of many weights."""
        found, names = self.correlation, list(self.parameters)
        return None if found is None else pandas_module().DataFrame(found, names, names)

    def _warn_outside(self, rows: Any) -> None:
        beyond = rows["outside"].notna().sum()
        if beyond:
            names = sorted({n for cell in rows["outside"].dropna() for n in str(cell).split()})
            warnings.warn(f"{self}: {beyond} of {len(rows)} rows lie outside the data that it was "
                          f"calibrated on: {', '.join(names)}", OutsideWarning, 3)


class Result:
    """The results of a run. `directory` holds the files, `job` the job file where one is known;
    `calibration`, `trace` and `verification` what they say (None: that stage was not run)."""

    def __init__(self, directory: PathLike, job: Optional[PathLike] = None, *,
                 campaign: Optional[Path] = None, keep: Any = None, threads: int = 0) -> None:
        self.directory = Path(directory)
        self.job = None if job is None else Path(job).resolve()
        self._campaign = campaign # the folder of data, job and results that Campaign made
        self.threads = threads
        self._keep = keep # a temporary folder, which goes with this object
        self._data: Any = None # read at first use
        self._predicted: dict[str, Any] = {}
        self.calibration: Calibration = read_calibration(self.directory / "calibration.json")
        self.trace: Optional[Trace] = self._part("trace", Trace)
        self.verification: Optional[Verification] = self._part("verify", Verification)
        with file_faults(self.calibration.source, "a calibration"):
            self._repr_html_() # everything that is shown can be read

    @classmethod
    def open(cls, directory: PathLike, job: Optional[PathLike] = None) -> Result:
        """Results of the command line or of `save`: the folder of a job, a job file, or the
        folder of its results. Without a job, and none in the folder, prediction takes canonical
        columns, and routines are not verified."""
        found = Path(directory)
        if not found.exists():
            raise FrictabError(f"{found}: there is no such folder")
        if found.is_file():
            job = found
        elif job is None and not (found / "calibration.json").exists():
            job = found / "job.toml"
            if not job.exists():
                raise FrictabError(f"{found} has no results of frictab: neither calibration.json "
                                   "nor job.toml")
        elif job is not None:
            return cls(found, job)
        if job is None:
            return cls(found)
        job = Path(job).resolve()
        status = json.loads(program.answer(["status", job.name, "--json"], job.parent))
        return cls(job.parent / str(status["directory"]), job)

    def __reduce__(self) -> Any:
        """Of a campaign the files go along; of other results, where they are."""
        if self._campaign is None:
            return type(self), (self.directory.resolve(), self.job)
        packed = io.BytesIO()
        with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
            for name in sorted(files_in(self._campaign)):
                archive.write(self._campaign / name, name)
        return _unpacked, (type(self), packed.getvalue())

    # ---- what it says ----

    @property
    def synthetic(self) -> bool:
        """Whether the data came from the twin: nothing was measured."""
        return self.calibration.synthetic

    @property
    def best(self) -> Optional[str]:
        """The law with the smallest error on unseen tests, of those that compete."""
        return self.calibration.best

    @property
    def recommended(self) -> Optional[str]:
        """The simplest law that is not worse than it by more than a standard error."""
        return self.calibration.recommended

    @property
    def ranking(self) -> pandas.DataFrame:
        """Laws by their mean absolute error on unseen tests, in MPa: interval of 95 % from
        resampled tests, RMSE, bias, error on the tests of the fit, number of parameters; whether
        a law competes (constants of the literature do not) and may be the best of all."""
        may = {c["name"]: c.get("may_be_best") for c in
               (self.calibration.record.get("comparisons") or {}).get("best_of_all", [])}
        rows = []
        for fit in self.calibration.record["models"]:
            unseen, seen = fit["validation"], fit["training"]
            low, high = unseen.get("mae_95") or (None, None)
            rows.append([fit["name"], unseen["mae_MPa"], low, high, unseen["rmse_MPa"],
                         unseen["bias_MPa"], seen["mae_MPa"], len(fit["parameters"]),
                         fit.get("candidate", True), may.get(fit["name"])])
        return pandas_module().DataFrame(rows, columns=[
            "law", "mae_MPa", "mae_low_95", "mae_high_95", "rmse_MPa", "bias_MPa",
            "training_mae_MPa", "parameters", "competes", "may_be_best"]).set_index("law")

    @property
    def laws(self) -> list[str]:
        """Names of the calibrated laws, by rank."""
        return list(self.calibration.models)

    def law(self, name: str = "best") -> Law:
        """A law by its name, or "best", or "recommended"."""
        chosen = {"best": self.best, "recommended": self.recommended}.get(name, name)
        if chosen not in self.calibration.models:
            raise FrictabError(f"there is no law '{name}'" + near(str(chosen), self.laws))
        return Law(self, self.calibration.models[str(chosen)])

    @property
    def parameters(self) -> pandas.DataFrame:
        """Of all laws: value, standard error over experiments, unit, meaning. Correlations:
        law(...).correlations."""
        return pandas_module().concat({n: self.law(n).parameter_table for n in self.laws},
                                names=["law", "parameter"])

    @property
    def errors_by_experiment(self) -> pandas.DataFrame:
        """Every law on every test: rows, MAE, RMSE, bias in MPa, held out or not."""
        file = self.directory / "errors_by_experiment.csv"
        with file_faults(os.fspath(file), "a table of errors"):
            return read_frame(file)
        raise AssertionError # file_faults lets no fault pass

    @property
    def data(self) -> pandas.DataFrame:
        """What the program read: canonical names and units, and whether a test is of the
        training or the validation (`use`: train, validate)."""
        if self._data is None:
            if self.job is None:
                raise FrictabError(f"{self.directory}: the data are not known without the job: "
                                   "Result.open(directory, job=\"job.toml\")")
            with tempfile.TemporaryDirectory(prefix="frictab_") as work:
                program.answer(["data", self.job.name, "-q", "--write", "csv", "-j",
                                str(self.threads), "-o", work], self.job.parent)
                self._data = read_frame(Path(work) / "data.csv")
        return self._data.copy()

    def predicted_data(self, law: str) -> pandas.DataFrame:
        """`predicted` of `data`, row by row."""
        name = self.law(law).name
        if name not in self._predicted:
            self._predicted[name] = self._predict([self._model_file(name)], None, self.data)
        return self._predicted[name].copy()

    @property
    def plot(self) -> Plots:
        """Pictures on matplotlib: result.plot.measured_vs_predicted(), ..."""
        from .plots import Plots
        return Plots(self)

    def summary(self) -> str:
        """The findings in short."""
        return "\n".join(self._findings())

    def __repr__(self) -> str:
        return f"<frictab result: {'; '.join(self._findings()[:2])}>"

    def __str__(self) -> str:
        return self.summary()

    def _repr_html_(self) -> str:
        shown = self.ranking.head(8).to_html(float_format="%.2f", na_rep="")
        more = len(self.laws) - 8
        return ("".join(f"<p>{html.escape(line)}</p>" for line in self._findings()) + str(shown)
                + (f"<p>... and {more} more laws</p>" if more > 0 else ""))

    # ---- what it gives ----

    def predicted(self, law: str, data: Any) -> pandas.DataFrame:
        """Rows of a frame as `frictab predict` prints them: states, tau_R_MPa with its band, what
        was measured; one row for each of its own, in its order."""
        name, frame = self.law(law).name, plain_frame(data, "data")
        if self.job is None:
            return self._predict([self._model_file(name)], None, frame)
        return self._predict([self.job.name, "--model", name], self.job.parent, frame)

    def export(self, target: str, directory: PathLike, law: Optional[str] = None) -> Export:
        """Writes the routine of a target (`frictab list targets`) into a folder of its own, and
        verifies it. Without `law`, the law of the job's table. The results stay as they are."""
        return export_routine(self, target, Path(directory), law)

    def save(self, directory: PathLike) -> Path:
        """Copies results, job and data into a new folder, from which Result.open and the command
        line go on. Refuses a folder that has files."""
        place = Path(directory)
        if place.exists() and (not place.is_dir() or any(place.iterdir())):
            raise FrictabError(f"{place} is there and not empty; give a new folder")
        place.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=place.parent, prefix=".frictab_") as work:
            shutil.copytree(self._campaign or self.directory, Path(work) / "saved")
            (Path(work) / "saved").rename(place) # it appears complete
        return place

    # ---- how ----

    def _model_file(self, name: str) -> Path:
        return (self.directory / "models" / f"{name}.json").resolve()

    def _predict(self, law: Sequence[PathLike], directory: Optional[Path], frame: Any) -> Any:
        with tempfile.TemporaryDirectory(prefix="frictab_") as work:
            file, out = Path(work) / "data.csv", Path(work) / "predicted.csv"
            write_frame(frame, file)
            outcome = program.run(["predict", law[0], file, *law[1:], "-j", str(self.threads), "-o",
                                   out], directory)
            if outcome.code != 0:
                raise FrictabError(in_rows(as_arguments(program.fault_text(outcome)), Path(work),
                                           {"data": frame}))
            rows = read_frame(out)
        if len(rows) != len(frame):
            left = [line.strip() for line in (outcome.out + outcome.err).splitlines()
                    if "left out" in line]
            raise FrictabError(f"{len(frame) - len(rows)} of {len(frame)} rows cannot be predicted "
                               f"({'; '.join(left) or 'the job leaves them out'}); drop them first")
        rows.index = order_by_test(frame, rows["experiment"])
        return rows.sort_index()

    def _part(self, name: str, make: Any) -> Any:
        file = self.directory / f"{name}.json"
        if not file.exists():
            return None
        with file_faults(os.fspath(file), f"a {name}"):
            return make(read_record(file, name))

    def _in_short(self) -> list[str]:
        """The first box of the report; nothing where it is of other results than these."""
        path = self.directory / "summary.json"
        if not path.exists():
            return []
        with file_faults(str(path), "a summary"):
            record = read_record(path, "summary")
            own = self.calibration
            if (record["data_hash"], record.get("best"), record.get("recommended")) != (
                    own.record.get("data_hash"), own.best, own.recommended):
                return []
            return [str(line) for line in record["in_short"]]

    def _findings(self) -> list[str]:
        record, found = self.calibration.record, []
        if self.synthetic:
            found.append("SYNTHETIC data: nothing here was measured")
        if in_short := self._in_short():
            return found + in_short
        fits = {f["name"]: f for f in record["models"]}
        if self.best in fits:
            unseen = fits[self.best]["validation"]
            found.append(f"best law: {self.best} misses tau_R by {_mae(unseen)} on "
                         f"{_count(unseen['n_experiments'], 'test')} it has not seen")
        if self.recommended and self.recommended != self.best:
            found.append(f"recommended: {self.recommended}, which is simpler and not worse by "
                         "more than a standard error")
        expected = (record.get("choice") or {}).get("expected_mae_MPa")
        if expected is not None:
            found.append(f"expected error of a law chosen like this on new tests: {expected:.2f} "
                         "MPa")
        if self.trace:
            effects = [str(e["derived"] or " x ".join(e["columns"])) for e in
                       self.trace.record["effects"]]
            found.append(self.trace.headline + (f": {', '.join(effects)}" if effects else ""))
        if self.verification:
            drift = max((r["worst_case_MPa"] for r in self.verification.record["records"]
                         if r.get("worst_case_MPa") is not None), default=None)
            found.append(self.verification.headline + ("" if drift is None else
                         f", {f'{drift:.2g}' if drift > 1e-3 else 'less than 0.001'} MPa off"))
        return found or [f"{len(self.laws)} laws"]


def _unpacked(kind: type[Result], packed: bytes) -> Result:
    scratch = program.Scratch()
    with zipfile.ZipFile(io.BytesIO(packed)) as archive:
        archive.extractall(scratch.path)
    return kind(scratch.path / "out", scratch.path / "job.toml", campaign=scratch.path,
                keep=scratch)


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"


def _mae(errors: Mapping[str, Any]) -> str:
    if errors["mae_MPa"] is None:
        return "an unknown amount"
    low, high = errors.get("mae_95") or (None, None)
    interval = "" if low is None or high is None else f" ({low:.2f} to {high:.2f})"
    return f"{errors['mae_MPa']:.2f} MPa{interval}"
