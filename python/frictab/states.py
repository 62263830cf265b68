"""States by name: what a call gives becomes one column of numbers per input."""
from __future__ import annotations

import difflib
import sys
import warnings
from dataclasses import dataclass
from typing import Any, Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from .faults import FrictabError, OutsideWarning

Numbers = NDArray[np.float64]
Columns = Mapping[str, Numbers]


@dataclass
class Input:
    """A state that a table or law takes: its name, canonical unit, range and meaning."""
    name: str
    unit: str = ""
    low: float = -np.inf # of what the table was made for, or the law calibrated on
    high: float = np.inf
    below: str = "" # what holds beyond the ends, in words
    above: str = ""
    meaning: str = ""
    levels: tuple[str, ...] = () # of a text column, by number

    def __str__(self) -> str:
        if self.levels:
            return f"{self.name} (one of {', '.join(self.levels)})"
        span = f"{self.low:g} .. {self.high:g}" if np.isfinite(self.high - self.low) else "any"
        return f"{self.name} ({span}{' ' + self.unit if self.unit not in ('', '1') else ''})"


class States:
    """One flat array per input, and how a result gets back the shape that was given."""

    def __init__(self, owner: object, inputs: Sequence[Input], given: Any,
                 named: Mapping[str, Any]) -> None:
        self._wrap: Callable[[Any], Any] = lambda values: values
        columns = self._columns(owner, inputs, given, named)
        if given is not None and hasattr(given, "index") and hasattr(given, "columns"):
            self._wrap = lambda values: sys.modules["pandas"].Series(values, index=given.index)
        xarray = sys.modules.get("xarray")
        if xarray and any(isinstance(c, xarray.DataArray) for c in columns.values()):
            columns = self._from_xarray(xarray, columns)
        arrays = [_numbers(i, columns[i.name]) for i in inputs]
        try:
            arrays = list(np.broadcast_arrays(*arrays)) if arrays else [np.zeros(())]
        except ValueError:
            shapes = ", ".join(f"{i.name} {a.shape}" for i, a in zip(inputs, arrays))
            raise FrictabError(f"the shapes of the states do not fit together: {shapes}") from None
        self.shape = arrays[0].shape
        self.rows = int(np.prod(self.shape))
        self.columns: Columns = {i.name: a.ravel() for i, a in zip(inputs, arrays)}

    def _from_xarray(self, xarray: Any, columns: Mapping[str, Any]) -> dict[str, Any]:
        one = xarray.broadcast(*[c if isinstance(c, xarray.DataArray) else xarray.DataArray(c)
                                 for c in columns.values()])
        first = one[0]
        self._wrap = lambda values: xarray.DataArray(values, coords=first.coords, dims=first.dims)
        return dict(zip(columns, (c.data for c in one)))

    @staticmethod
    def _columns(owner: object, inputs: Sequence[Input], given: Any,
                 named: Mapping[str, Any]) -> dict[str, Any]:
        names = [i.name for i in inputs]
        for name in named:
            if name not in names:
                near = difflib.get_close_matches(name, names, 1)
                raise FrictabError(f"'{name}' is not an input of {owner}; "
                                   + (f"did you mean '{near[0]}'?" if near else
                                      f"it takes {', '.join(map(str, inputs))}"))
        columns = {n: given[n] for n in names if given is not None and n in given}
        columns.update(named)
        missing = [str(i) for i in inputs if i.name not in columns]
        if missing:
            raise FrictabError(f"{owner} needs {', '.join(missing)}")
        return {n: columns[n] for n in names}

    def back(self, values: Any) -> Any:
        """Flat results in the shape of the call; a number where numbers were given."""
        values = np.asarray(values).reshape(self.shape)
        return self._wrap(values if self.shape else values[()])


def _numbers(one: Input, column: Any) -> Numbers:
    if isinstance(column, np.ma.MaskedArray): # beneath a mask anything may stand
        there = ~np.broadcast_to(column.mask, column.shape)
        numbers = np.full(column.shape, np.nan)
        numbers[there] = _numbers(one, column.data[there])
        return numbers
    column = np.asarray(column)
    if one.levels and column.dtype.kind in "OUS":
        number = {level: float(n) for n, level in enumerate(one.levels)}
        unknown = sorted({str(c) for c in column.ravel()} - set(number))
        if unknown:
            raise FrictabError(f"{one.name} is '{unknown[0]}'; it is one of "
                               + ", ".join(one.levels))
        return np.array([number[str(c)] for c in column.ravel()]).reshape(column.shape)
    try:
        return np.asarray(column.astype(float, copy=False))
    except (TypeError, ValueError):
        raise FrictabError(f"{one.name} is not a number") from None


def sides(inputs: Sequence[Input], columns: Columns) -> dict[str, NDArray[np.int8]]:
    """Per input -1, 0 or 1: below its range, inside, above."""
    return {i.name: (columns[i.name] > i.high).astype(np.int8)
                    - (columns[i.name] < i.low).astype(np.int8) for i in inputs}


def warn_outside(owner: object, inputs: Sequence[Input], columns: Columns,
                 level: int = 3) -> None:
    """One OutsideWarning that counts the rows of each side, at the line that called."""
    found = []
    for i in inputs:
        x = columns[i.name]
        if not x.size or i.low <= x.min() and x.max() <= i.high: # false of NaN
            continue
        for there, word, end, farthest, rule in ((x < i.low, "below", i.low, np.min, i.below),
                                                 (x > i.high, "above", i.high, np.max, i.above)):
            if there.any():
                found.append(f"{i.name} {word} {end:g} in {there.sum()} (as far as "
                             f"{farthest(x[there]):g}; {rule})")
    if found:
        rows = len(next(iter(columns.values())))
        warnings.warn(f"{owner}: of {rows} states, " + ", ".join(found), OutsideWarning, level)
