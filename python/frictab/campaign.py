"""A campaign of tribometer tests in a DataFrame, and its fit by the installed program."""
from __future__ import annotations

import json
import os
import re
import shutil
import sys
import tempfile
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping, Optional, Sequence, Union

from . import program
from .faults import CautionWarning, FrictabError
from .frames import as_arguments, in_rows, is_frame, near, plain_frame, spelled, write_frame
from .job import JobFile, merged, without_none
from .program import PathLike

if TYPE_CHECKING:
    import pandas

    from .result import Result

_HEADING = "Written by frictab.Campaign of Python."
_STAGES = ("calibrate", "trace", "tabulate", "export", "run")
ColumnSpec = Union[str, "tuple[str, str]", Mapping[str, Any]]


class Campaign:
    """Tests of a tribometer, one row of `data` per time step, and what their columns mean.

    columns: canonical name -> the frame's own: "Druck", ("Druck", "MPa") with its unit, or a
        dictionary as [data.columns] of a job has it: {"column": ..., "unit": ..., "times": ...}.
        Canonical names in the frame need no entry. Named levels of its index are columns.
    experiment: the column that names the test; absent: `experiment`. The test is the unit that
        is held out and resampled, never the row.
    tests: one row per test (humidity, batch, tool), as a frame or a file.
    validation: a frame, or names of tests in `data`, that no law is fitted to.
    constants: canonical name -> value in its canonical unit, the same for every row.
    directory: the folder where data, job and results stay; absent: a temporary one, which goes
        with the result. Results of an earlier fit in it are replaced.
    Further keys are those of [data] in a job: roles={...}, drop={...}, missing="drop".
    """

    def __init__(self, data: pandas.DataFrame, *,
                 columns: Optional[Mapping[str, ColumnSpec]] = None,
                 experiment: Optional[str] = None,
                 tests: Union[pandas.DataFrame, PathLike, None] = None,
                 validation: Union[pandas.DataFrame, Sequence[Any], None] = None,
                 constants: Optional[Mapping[str, float]] = None,
                 directory: Optional[PathLike] = None, **data_keys: Any) -> None:
        self._columns = {str(n): _specification(str(n), s) for n, s in (columns or {}).items()}
        self._frames: dict[str, Any] = {"data": plain_frame(data, "data")}
        self._experiment = self._column_of_tests(experiment)
        if validation is not None:
            self._add_validation(validation)
        for name, frame in self._frames.items():
            self._check_columns(frame, name)
        self.directory = None if directory is None else Path(directory).resolve()
        keys: dict[str, Any] = {"training": "data.csv"}
        if "validation" in self._frames:
            keys["validation"] = "validation.csv"
        if isinstance(tests, (str, os.PathLike)):
            keys["tests"] = _absolute(tests)
        elif tests is not None:
            self._frames["tests"] = self._of_tests(tests)
            keys["tests"] = "tests.csv"
        keys.update(delimiter=",", header=True, experiment=experiment, columns=self._columns,
                    constants=dict(constants or {}))
        self._keys = without_none(merged(keys, data_keys))
        for section, name in ((self._keys, "oracle"), (self._keys.get("join", {}), "files")):
            if name in section:
                section[name] = _absolute(section[name])

    def __repr__(self) -> str:
        frame = self._frames["data"]
        tests = ("one test per row" if self._experiment is None else
                 f"{frame[self._experiment].nunique()} tests")
        return f"<frictab campaign: {len(frame)} rows, {tests}>"

    def read(self) -> dict[str, Any]:
        """How the program reads these data, as `frictab data --json`: per test, converted,
        left out, roles of the other columns. Raises FrictabError where they are wrong, and warns
        of units that nobody gave."""
        with tempfile.TemporaryDirectory() as work:
            job = self._write(Path(work), {})
            return self._read(Path(work), job, 3)

    def fit(self, laws: Union[str, Sequence[str], None] = None, *, threads: int = 0,
            until: str = "run", progress: bool = False, **job: Any) -> Result:
        """Calibrates, traces, tabulates, exports, verifies and reports, as `frictab run`.

        laws: names of `frictab list models`; absent: all that the columns allow.
        until: the stage to end with: calibrate, trace, tabulate, export; run: all of them.
        progress: whether lines on work of more than a second are written to sys.stderr.
        job: keys of a job, as sections, table={"tolerance_MPa": 0.5}, or with dots,
            **{"table.tolerance_MPa": 0.5}; the program checks them. threads: 0 for all cores.
        """
        if until not in _STAGES:
            raise FrictabError(f"until is '{until}'; it is one of {', '.join(_STAGES)}")
        keys = merged({"models": {"use": [laws] if isinstance(laws, str) else laws}}, job)
        if "directory" in keys.get("output", {}):
            raise FrictabError("output.directory: Campaign(..., directory=...) names the folder")
        scratch = None if self.directory else program.Scratch()
        try:
            return self._fitted(scratch, until, keys, threads, progress)
        except BaseException:
            if scratch:
                scratch.remove()
            raise

    def _fitted(self, scratch: Optional[program.Scratch], until: str, keys: Mapping[str, Any],
                threads: int, progress: bool) -> Result:
        from .result import Result

        folder = scratch.path if scratch else self.directory
        assert folder
        job = self._write(folder, keys)
        self._read(folder, job)
        outcome = program.run([until, "job.toml", "--json", "--progress" if progress else "-q",
                               "-j", str(threads)], folder, echo=sys.stderr if progress else None)
        if outcome.code not in (0, 1): # 1: drift over the tolerance, which is a result
            raise FrictabError(self._in_words_of_python(program.fault_text(outcome), folder, job))
        for caution in _parsed(outcome).get("cautions", []):
            warnings.warn(self._in_words_of_python(str(caution), folder, job), CautionWarning, 3)
        if outcome.code == 1:
            warnings.warn("a target was missed: see result.verification", CautionWarning, 3)
        return Result(folder / "out", folder / "job.toml", campaign=folder, keep=scratch,
                      threads=threads)

    # ---- what was given ----

    def _column_of_tests(self, experiment: Optional[str]) -> Optional[str]:
        """None where each row is a test."""
        frame = self._frames["data"]
        mapped = self._columns.get("experiment", {}).get("column")
        name = experiment or mapped or "experiment"
        if name in frame.columns:
            return name
        if name == "row":
            return None
        raise FrictabError(
            f"there is no column '{name}' that names the tests" + near(name, frame.columns)
            + "; experiment=\"...\" names it. Each test is held out as a whole")

    def _add_validation(self, validation: Any) -> None:
        if is_frame(validation):
            self._frames["validation"] = plain_frame(validation, "validation")
            return
        if isinstance(validation, str) or self._experiment is None:
            raise FrictabError("validation is a DataFrame, or a list of names of tests in `data`")
        frame = self._frames["data"]
        tests = frame[self._experiment].map(spelled)
        held = {spelled(name) for name in validation}
        unknown = sorted(held - set(tests))
        if unknown:
            raise FrictabError(f"validation: there is no test '{unknown[0]}' in column "
                               f"'{self._experiment}'" + near(unknown[0], tests.unique()))
        self._frames["data"] = frame[~tests.isin(held)]
        self._frames["validation"] = frame[tests.isin(held)]

    def _of_tests(self, tests: Any) -> Any:
        frame = plain_frame(tests, "tests")
        own = self._experiment or "experiment"
        if "experiment" not in frame.columns and own in frame.columns:
            frame = frame.rename(columns={own: "experiment"})
        if "experiment" not in frame.columns:
            raise FrictabError(f"tests has no column '{own}' that names the test of each row"
                               + near(own, frame.columns))
        return frame

    def _check_columns(self, frame: Any, argument: str) -> None:
        for name, one in self._columns.items():
            wanted = one.get("column")
            if isinstance(wanted, str) and wanted not in frame.columns:
                raise FrictabError(f"columns['{name}'] is '{wanted}', which is not a column of "
                                   f"{argument}" + near(wanted, frame.columns))

    # ---- what the program gets and says ----

    def _write(self, folder: Path, keys: Mapping[str, Any]) -> JobFile:
        job = JobFile(merged(merged({"data": self._keys}, keys), {"output.directory": "out"}),
                      _HEADING)
        _claim(folder)
        for name, frame in self._frames.items():
            write_frame(frame, folder / f"{name}.csv")
        (folder / "job.toml").write_text(job.text, encoding="utf-8")
        return job

    def _read(self, folder: Path, job: JobFile, level: int = 4) -> dict[str, Any]:
        scratch = folder / "read"
        outcome = program.run(["data", "job.toml", "--json", "-q", "-o", scratch], folder)
        shutil.rmtree(scratch, ignore_errors=True)
        if outcome.code != 0:
            raise FrictabError(self._in_words_of_python(program.fault_text(outcome), folder, job))
        found = _parsed(outcome)
        for text in found.get("units_not_given", []):
            warnings.warn(as_arguments(str(text)), CautionWarning, level)
        return found

    def _in_words_of_python(self, text: str, folder: Path, job: JobFile) -> str:
        """A message of the program with arguments and rows instead of lines of its files."""
        text = re.sub(r"job\.toml:(\d+)(?::\d+)?",
                      lambda m: _argument(job.key_at(int(m[1])), m[0]), text)
        return in_rows(as_arguments(text), folder, self._frames)


def _specification(name: str, given: ColumnSpec) -> dict[str, Any]:
    if isinstance(given, str):
        return {"column": given}
    if isinstance(given, tuple) and len(given) == 2 and all(isinstance(g, str) for g in given):
        return {"column": given[0], "unit": given[1]}
    if isinstance(given, Mapping):
        return dict(given)
    raise FrictabError(f"columns['{name}'] is {given!r}; it is the name of a column, a pair of "
                       "name and unit, or a dictionary as [data.columns] of a job")


def _absolute(files: Any) -> Any:
    """Files of the caller, whose folder is another than that of the job."""
    if isinstance(files, (str, os.PathLike)):
        return os.path.abspath(files)
    return [os.path.abspath(f) for f in files]


def _argument(key: Optional[str], place: str) -> str:
    """The argument of Campaign or fit that a key of the job was written for."""
    if key is None:
        return place
    return {"models.use": "laws", "data.training": "data"}.get(
        key, key[len("data."):] if key.startswith("data.") else key)


def _parsed(outcome: program.Outcome) -> dict[str, Any]:
    try:
        found = json.loads(outcome.out)
    except ValueError:
        found = None
    if not isinstance(found, dict):
        raise FrictabError("the program gave no JSON; is it of the version of this package? It "
                           "begins: " + outcome.out[:200])
    return found


def _claim(folder: Path) -> None:
    """Makes the folder; refuses one with a job or data that are not of this package."""
    folder.mkdir(parents=True, exist_ok=True)
    job = folder / "job.toml"
    if job.exists():
        if not job.read_text(encoding="utf-8", errors="replace").startswith("# " + _HEADING):
            raise FrictabError(f"{job} was not written by this package; give another directory")
    elif any(folder.iterdir()):
        raise FrictabError(f"{folder} is not empty; give another directory")
