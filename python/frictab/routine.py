"""Routines for solvers, exported from results into folders of their own and verified."""
from __future__ import annotations

import json
import shutil
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator, Mapping, Optional

from . import program
from .calibration import read_record
from .faults import FrictabError
from .frames import as_arguments
from .parts import Verification
from .program import PathLike

if TYPE_CHECKING:
    from .result import Result


@dataclass
class Export:
    """A routine that was written: its folder, its recipe (argument list, compile commands, lines
    for the input deck), and its verification; None: the folder of results has no job."""
    directory: Path
    recipe: Mapping[str, Any]
    verification: Optional[Verification]

    @property
    def files(self) -> list[Path]:
        """With README.md, which says how the solver gets the routine."""
        return [self.directory / str(name) for name in self.recipe["files"]]

    def __repr__(self) -> str:
        state = self.verification.headline if self.verification else "not verified"
        return (f"<frictab routine {self.recipe['target']} of {self.recipe['model']} in "
                f"{self.directory}: {state}>")


def export_routine(result: Result, target: str, place: Path, law: Optional[str]) -> Export:
    """Result.export"""
    earlier = _earlier_export(place)
    with tempfile.TemporaryDirectory(prefix="frictab_") as work:
        made = Path(work) / "out"
        verification = None
        if result.job:
            verification = _by_job(result, result.job, target, made, law)
        else:
            _by_table(result, target, made, law)
        folders = sorted(f.parent for f in made.rglob("recipe.json"))
        if len(folders) != 1:
            raise FrictabError(f"{target} of {len(folders)} laws was made; name one: law=\"...\"")
        for name in earlier:
            (place / name).unlink()
        shutil.copytree(folders[0], place, dirs_exist_ok=True)
    recipe = json.loads((place / "recipe.json").read_text(encoding="utf-8"))
    return Export(place, recipe, verification)


def _by_job(result: Result, job: Path, target: str, made: Path, law: Optional[str]
            ) -> Verification:
    shutil.copytree(result.directory, made)
    shutil.rmtree(made / "export", ignore_errors=True)
    wanted: list[PathLike] = ["-o", made, "-q", "-j", str(result.threads), "--set",
                              f"export.targets=[{json.dumps(target)}]"]
    if law is not None:
        wanted += ["--set", f"table.model={json.dumps(result.law(law).name)}"]
    for command in ("tabulate", "export", "verify") if law else ("export", "verify"):
        outcome = program.run([command, job.name, *wanted], job.parent)
        if outcome.code not in (0, 1): # 1: over the tolerance, which the verification says
            raise FrictabError(as_arguments(program.fault_text(outcome)))
    return Verification(read_record(made / "verify.json", "verify"))


def _by_table(result: Result, target: str, made: Path, law: Optional[str]) -> None:
    tables = {f.stem: f for f in sorted((result.directory / "tables").glob("*.h5"))}
    name = result.law(law).name if law else next(iter(tables), "")
    if name not in tables:
        raise FrictabError(f"{result.directory} has no table of {name or 'any law'}; with the "
                           "job it is made: Result.open(directory, job=\"job.toml\")")
    program.answer(["export", "--table", tables[name].resolve(), "--targets", target, "-o",
                    made])


def _earlier_export(place: Path) -> set[str]:
    """Files that an export wrote there before. Refuses a folder that has others."""
    if not place.exists():
        return set()
    if not place.is_dir():
        raise FrictabError(f"{place} is a file; a routine has a folder of its own")
    there = set(files_in(place))
    try:
        recipe = json.loads((place / "recipe.json").read_text(encoding="utf-8"))
        own = {str(name) for name in recipe["files"]} & there
    except (OSError, ValueError, KeyError, TypeError):
        own = set()
    if there - own:
        raise FrictabError(f"{place} has {min(there - own)}, which no export wrote; give a folder "
                           "of its own")
    return own


def files_in(place: Path) -> Iterator[str]:
    """All files below a folder, as names from there."""
    return (f.relative_to(place).as_posix() for f in place.rglob("*") if not f.is_dir())
