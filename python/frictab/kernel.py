"""Tables in C: the routine that the program generates of a table, compiled once and loaded.

FRICTAB_PYTHON_KERNEL: "auto" (absent) takes it for calls of many rows, where program and compiler
are there; "c" for every call, and fails without; "numpy" never.
"""
from __future__ import annotations

import ctypes
import hashlib
import json
import os
import platform
import shlex
import shutil
import stat
import subprocess
import tempfile
from pathlib import Path
from typing import Any, Mapping, Optional, Sequence

import numpy as np
from numpy.typing import NDArray

from . import program
from .faults import FrictabError
from .states import Columns

MANY_ROWS = 50_000 # fewer take numpy less time than a compiler, once
MOST_VALUES = 200_000 # of a table: more take a compiler long
_COMPILE_SECONDS = 120
_BLOCK_ROWS = 1 << 18 # between two blocks an interruption is heard
_CHOICES = ("auto", "c", "numpy")
_FLAGS = ["-O2", "-std=c99", "-ffp-contract=off", "-fPIC", "-shared"]


class KernelFault(Exception):
    """There is no kernel, for the reason given."""


class Kernel:
    """A loaded routine. Called with one column per input it gives tau_R."""

    def __init__(self, library: ctypes.CDLL, arguments: Sequence[Optional[str]]) -> None:
        self._library, self._arguments = library, arguments # None: not used by this table
        self._batch = library.frictab_tau_R_batch
        self._batch.restype = None
        self._batch.argtypes = [ctypes.c_size_t, *[ctypes.c_void_p] * (len(arguments) + 1)]

    def __call__(self, columns: Columns, rows: int) -> NDArray[np.float64]:
        tau = np.empty(rows)
        used = [None if n is None else np.ascontiguousarray(columns[n], float)
                for n in self._arguments]
        for begin in range(0, rows, _BLOCK_ROWS):
            end = min(begin + _BLOCK_ROWS, rows)
            self._batch(end - begin, *(None if c is None else c[begin:end].ctypes.data
                                       for c in used), tau[begin:end].ctypes.data)
        return tau


def wanted(rows: int) -> str:
    """auto (try C), c (C or a fault) or numpy. By the rows of the call alone, so that the same
    call gives the same bits after any other call."""
    choice = os.environ.get("FRICTAB_PYTHON_KERNEL", "auto")
    if choice not in _CHOICES:
        raise FrictabError(f"FRICTAB_PYTHON_KERNEL is '{choice}'; it is one of "
                           + ", ".join(_CHOICES))
    return "numpy" if choice == "auto" and rows < MANY_ROWS else choice


def build_kernel(table: str, digest: Optional[str], inputs: Sequence[str],
                 values: int) -> Kernel:
    """The kernel of a file's table of so many values, from the cache or made now. Raises
    KernelFault."""
    if digest is None:
        raise KernelFault("the table is not of a file")
    if values > MOST_VALUES:
        raise KernelFault(f"the table has {values} values; up to {MOST_VALUES} are compiled")
    compiler, maker, cache = _compiler(), _program(), _cache()
    try:
        made_by = [digest, _identity(maker), _identity(compiler[0]), *compiler[1:], *_FLAGS,
                   platform.machine()]
        folder = cache / hashlib.sha256("\0".join(made_by).encode()).hexdigest()[:40]
        if not folder.is_dir():
            _make(folder, table, digest, maker, compiler)
        recipe = json.loads((folder / "recipe.json").read_text(encoding="utf-8"))
        return Kernel(ctypes.CDLL(str(folder / "kernel.so")), _arguments(recipe, inputs))
    except (OSError, ValueError, KeyError, AttributeError, subprocess.TimeoutExpired) as fault:
        raise KernelFault(f"what lies in {cache} cannot be used: {fault}") from None


def _program() -> str:
    try:
        return program.find_program()
    except FrictabError as fault:
        raise KernelFault(str(fault)) from None


def _compiler() -> list[str]:
    named = shlex.split(os.environ.get("CC", ""))
    for candidate in ([named] if named else [["cc"], ["gcc"], ["clang"]]):
        found = shutil.which(candidate[0])
        if found and os.path.isabs(found): # never one of the working folder
            return [found, *candidate[1:]]
    raise KernelFault("there is no C compiler: " + (f"CC is '{named[0]}'" if named else
                                                    "neither cc nor gcc nor clang"))


def _identity(file: str) -> str:
    """A file that was replaced is another one."""
    path = os.path.realpath(file)
    found = os.stat(path)
    return f"{path} {found.st_size} {found.st_mtime_ns}"


def _cache() -> Path:
    """A folder of this user alone: what lies in it is loaded and run."""
    base = os.environ.get("XDG_CACHE_HOME", "")
    root = Path(base) if os.path.isabs(base) else Path.home() / ".cache"
    folder = root / "frictab"
    try:
        root.mkdir(parents=True, exist_ok=True)
        folder.mkdir(mode=0o700, exist_ok=True)
        found = folder.lstat()
    except (OSError, RuntimeError) as fault: # RuntimeError: no home
        raise KernelFault(f"there is no folder to keep it in: {fault}") from None
    if not stat.S_ISDIR(found.st_mode) or found.st_uid != os.geteuid() or found.st_mode & 0o022:
        raise KernelFault(f"{folder} is not a folder that only you can write to")
    return folder


def _make(folder: Path, table: str, digest: str, maker: str, compiler: Sequence[str]) -> None:
    """Makes a folder of the cache, which appears complete by a rename."""
    with tempfile.TemporaryDirectory(dir=folder.parent) as work:
        copy = Path(work) / "table.h5" # the one that was read, or none
        shutil.copyfile(table, copy)
        if hashlib.sha256(copy.read_bytes()).hexdigest() != digest:
            raise KernelFault(f"{table} has changed since it was read")
        _expect(program.run(["export", "--table", copy, "--targets", "c", "-o", work], work,
                            maker))
        sources, made = Path(work) / "c", Path(work) / "made"
        made.mkdir()
        done = subprocess.run([*compiler, *_FLAGS, "-o", str(made / "kernel.so"),
                               str(sources / "frictab_tau_R.c"), "-lm"], capture_output=True,
                              encoding="utf-8", errors="replace", stdin=subprocess.DEVNULL,
                              timeout=_COMPILE_SECONDS)
        _expect(program.Outcome(done.returncode, done.stdout, done.stderr))
        shutil.copyfile(sources / "recipe.json", made / "recipe.json")
        try:
            made.rename(folder)
        except OSError:
            if not folder.is_dir(): # else another process was first
                raise


def _expect(outcome: program.Outcome) -> None:
    if outcome.code != 0:
        raise KernelFault(program.fault_text(outcome)[:500])


def _arguments(recipe: Mapping[str, Any], inputs: Sequence[str]) -> list[Optional[str]]:
    """The input of each argument; None where the table does not use it."""
    found = [str(a["quantity"]) if a["used"] else None for a in recipe["arguments"]]
    if {n for n in found if n} - set(inputs) or recipe.get("state_variables"):
        raise KernelFault("the generated routine takes other states than the table")
    return found
