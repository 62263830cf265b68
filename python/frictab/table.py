"""Tables of friction laws: tables/NAME.h5."""
from __future__ import annotations

import hashlib
import os
from dataclasses import dataclass, field, replace
from typing import Any, Mapping, Optional, Sequence

import numpy as np
from numpy.typing import NDArray

from .faults import FrictabError, file_faults
from .formula import Formula
from .kernel import MANY_ROWS, Kernel, KernelFault, build_kernel, wanted
from .spline import Cubic, Grid, Linear
from .program import PathLike
from .states import Columns, Input, States, sides, warn_outside

Numbers = NDArray[np.float64]
Flags = NDArray[np.bool_]

_SCHEMAS = ("frictab/table/2", "frictab/table/1") # of /1: logarithms where transform is log
_END_ROUNDING = 1e-6 # what misses an end by no more is not refused
_WORDS = {"clamp": "the table at that end", "law": "the law's own formula", "error": "NaN",
          "held": "held at that end by the law", "free": "the formula goes on"}


@dataclass
class Axis:
    """One axis of a table: `nodes` in its unit, interpolated in `coordinates`."""
    name: str
    nodes: Numbers
    log: bool
    below: str = "clamp" # or law, error: what holds beyond this end
    above: str = "clamp"
    kinks: Numbers = field(default_factory=lambda: np.zeros(0))
    unit: str = ""
    meaning: str = ""

    def fault(self, size: int) -> str:
        """What is wrong with it as one of `size` nodes, in words; nothing where it is right."""
        x = self.nodes
        if x.shape != (size,) or size < 2 or not np.all(np.isfinite(x)) or np.any(np.diff(x) <= 0):
            return f"has no {size} ascending nodes"
        if self.log and x[0] <= 0:
            return f"is logarithmic and starts at {x[0]:g}"
        if not np.all(np.isin(self.kinks, x)):
            return "has a kink without a node"
        wrong = {self.below, self.above} - {"clamp", "law", "error"}
        return f"says {min(wrong)} of what lies outside; clamp, error or law" if wrong else ""

    def coordinate(self, x: Numbers) -> Numbers:
        if not self.log:
            return x
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(x > 0, np.log(np.where(x > 0, x, 1.0)), np.where(x == x, -np.inf, x))

    def asked_at(self, x: Numbers) -> Numbers:
        """Where the law's formula is asked: at the end instead of beyond it unless it goes on."""
        x = np.where((x < self.nodes[0]) & (self.below != "law"), self.nodes[0], x)
        return np.where((x > self.nodes[-1]) & (self.above != "law"), self.nodes[-1], x)

    def extends(self, x: Numbers) -> Flags:
        return np.asarray((x < self.nodes[0]) & (self.below == "law")
                          | (x > self.nodes[-1]) & (self.above == "law"))

    def refuses(self, x: Numbers) -> Flags:
        low, high = self.nodes[0], self.nodes[-1]
        return np.asarray((x < low - _END_ROUNDING * abs(low)) & (self.below == "error")
                          | (x > high + _END_ROUNDING * abs(high)) & (self.above == "error"))


class Table:
    """A friction table. `axes`, `inputs`, `value` (as its units say), `attributes` of the root;
    `distance` of every node from half a test (1: what the data span of one axis), or None."""

    distance: Optional[Numbers] = None

    def __init__(self, source: str, axes: Sequence[Axis], value: Numbers,
                 attributes: Mapping[str, Any], root: Mapping[str, Any],
                 digest: Optional[str] = None) -> None:
        self.source, self.axes, self.value = source, list(axes), value
        self.attributes, self.root = attributes, root
        self.model = str(root.get("model", ""))
        self.interpolation = self._one_of("interpolation", "linear", "cubic")
        self.log_value = self._one_of("transform", "linear", "log") == "log"
        self._check()
        self.combine = Formula(self._text("combine"))
        self.extension = self._extension()
        self._grid = self._make_grid()
        self.inputs = self._inputs()
        self._digest = digest # of the file; None: not of a file
        self._kernel: Optional[Kernel] = None
        self._no_kernel = "" # the reason

    def tau_R(self, states: Any = None, /, **named: Any) -> Any:
        """Friction shear stress in MPa: sigma_n_MPa=..., one keyword per input, numbers or arrays
        that broadcast; or a mapping, pandas.DataFrame or xarray.Dataset that has them by name.
        What lies outside is answered as the table says (Table.axes) and counted in an
        OutsideWarning."""
        found = States(self, self.inputs, states, named)
        warn_outside(self, self.inputs, found.columns)
        return found.back(self._tau(found.columns, found.rows))

    def mu(self, states: Any = None, /, **named: Any) -> Any:
        """tau_R / sigma_n_MPa."""
        found = States(self, self.inputs, states, named)
        if "sigma_n_MPa" not in found.columns:
            raise FrictabError(f"{self} does not depend on sigma_n_MPa")
        warn_outside(self, self.inputs, found.columns)
        with np.errstate(divide="ignore", invalid="ignore"): # no pressure: NaN
            return found.back(self._tau(found.columns, found.rows) / found.columns["sigma_n_MPa"])

    def interp(self, states: Any = None, /, **named: Any) -> Any:
        """The tabulated piece itself, held at the ends of the axes: `value` between its nodes."""
        names = {axis.name for axis in self.axes}
        held = [replace(i, below="held at that end", above="held at that end")
                for i in self.inputs if i.name in names]
        found = States(self, held, states, named)
        warn_outside(self, held, found.columns)
        return found.back(self._piece(found.columns, found.rows))

    def outside(self, states: Any = None, /, **named: Any) -> dict[str, Any]:
        """Per input -1, 0 or 1: the state is below, inside, above its range. No warning."""
        found = States(self, self.inputs, states, named)
        return {n: found.back(s) for n, s in sides(self.inputs, found.columns).items()}

    def __str__(self) -> str:
        return f"table of {self.model or 'a law'}"

    def __repr__(self) -> str:
        return f"<frictab {self}: tau_R of {', '.join(map(str, self.inputs))}>"

    @property
    def kernel(self) -> str:
        """Computes calls of many rows: "C", or "numpy: " with the reason. It is compiled here,
        unless it was before."""
        if wanted(MANY_ROWS) == "numpy":
            return "numpy: FRICTAB_PYTHON_KERNEL says so"
        try:
            self._compiled()
        except KernelFault as fault:
            return f"numpy: {fault}"
        return "C"

    def _compiled(self) -> Kernel:
        if self._kernel is None and not self._no_kernel:
            try:
                self._kernel = build_kernel(self.source, self._digest,
                                            [i.name for i in self.inputs], self.value.size)
            except KernelFault as fault:
                self._no_kernel = str(fault)
        if self._kernel is None:
            raise KernelFault(self._no_kernel)
        return self._kernel

    def _tau(self, columns: Columns, rows: int) -> Numbers:
        choice = wanted(rows)
        if choice != "numpy":
            try:
                return self._compiled()(columns, rows)
            except KernelFault as fault:
                if choice == "c":
                    raise FrictabError(f"{self.source}: no C kernel: {fault}") from None
        return self._tau_in_numpy(columns, rows)

    def _tau_in_numpy(self, columns: Columns, rows: int) -> Numbers:
        value = self._piece(columns, rows)
        refused, law = np.zeros(rows, bool), np.zeros(rows, bool)
        for axis in self.axes:
            refused |= axis.refuses(columns[axis.name])
            law |= axis.extends(columns[axis.name])
        if law.any() and self.extension:
            held = {a.name: a.asked_at(columns[a.name])[law] for a in self.axes}
            used = {n: held[n] if n in held else self._constant(n) for n in self.extension.names}
            value[law] = self.extension(**used)
        used = {n: value if n == "value" else columns[n] if n in columns else self._constant(n)
                for n in self.combine.names}
        tau: Numbers = np.broadcast_to(self.combine(**used), rows).copy()
        missing = np.any([np.isnan(c) for c in columns.values()], axis=0) if columns else False
        tau[refused | missing] = np.nan
        return tau

    def _piece(self, columns: Columns, rows: int) -> Numbers:
        points = [axis.coordinate(columns[axis.name]) for axis in self.axes]
        raw = self._grid(points, rows)
        return np.asarray(np.exp(raw)) if self.log_value else raw

    def _constant(self, name: str) -> float:
        if not isinstance(self.attributes.get(name), (int, float)):
            raise FrictabError(f"{self.source}: the formula uses '{name}', which is not a state "
                               "and no number attribute of 'value'")
        return float(self.attributes[name])

    def _make_grid(self) -> Grid:
        axes: list[Linear] = []
        for axis in self.axes:
            u = axis.coordinate(axis.nodes)
            at = np.flatnonzero(np.isin(axis.nodes, axis.kinks))
            axes.append(Cubic(u, at.tolist()) if self.interpolation == "cubic" else Linear(u))
        return Grid(axes, np.log(self.value) if self.log_value else self.value)

    def _extension(self) -> Optional[Formula]:
        text, part = "", 1
        while (name := "extension" if part == 1 else f"extension_{part}") in self.attributes:
            text, part = text + str(self.attributes[name]), part + 1
        if not text and any("law" in (axis.below, axis.above) for axis in self.axes):
            raise FrictabError(f"{self.source}: an axis goes on by the law, and 'value' has no "
                               "attribute 'extension'")
        return Formula(text) if text else None

    def _inputs(self) -> list[Input]:
        by_axis = {axis.name: axis for axis in self.axes}
        used = self.combine.names - {"value"} - set(map(str, self.attributes))
        held = self.combine.held_ranges()
        return [self._input(name, by_axis.get(name), held.get(name))
                for name in [*by_axis, *sorted(used - set(by_axis))]]

    def _input(self, name: str, axis: Optional[Axis],
               held: Optional[tuple[float, float]]) -> Input:
        if axis:
            return Input(name, axis.unit, axis.nodes[0], axis.nodes[-1], _WORDS[axis.below],
                         _WORDS[axis.above], axis.meaning)
        levels = str(self.root.get(f"levels_{name}", ""))
        low, high = held or (self.root.get(f"range_low_{name}", -np.inf),
                             self.root.get(f"range_high_{name}", np.inf))
        word = _WORDS["held" if held else "free"]
        return Input(name, str(self.root.get(f"units_{name}", "")), low, high, word, word,
                     str(self.root.get(f"long_name_{name}", "")), _levels(levels))

    def _text(self, name: str) -> str:
        if name not in self.attributes:
            raise FrictabError(f"{self.source}: 'value' has no attribute '{name}'")
        return str(self.attributes[name])

    def _one_of(self, name: str, *allowed: str) -> str:
        found = self._text(name)
        if found not in allowed:
            raise FrictabError(f"{self.source}: attribute '{name}' of 'value' is '{found}'; "
                               f"it is one of {', '.join(allowed)}")
        return found

    def _check(self) -> None:
        schema = str(self.root.get("schema", ""))
        if schema.startswith("frictab/") and schema not in _SCHEMAS:
            raise FrictabError(f"{self.source}: the layout is {schema}; this version reads "
                               + " and ".join(_SCHEMAS))
        if self.log_value and not schema:
            raise FrictabError(f"{self.source}: the root has no attribute 'schema', which says "
                               "what 'value' holds where its transform is log")
        if self.log_value and schema == _SCHEMAS[1]:
            self.value = np.exp(self.value)
        self._check_numbers()
        if self.interpolation == "cubic" and self._text("spline") != "not-a-knot":
            raise FrictabError(f"{self.source}: its spline is '{self._text('spline')}'; "
                               "this version reads not-a-knot")

    def _check_numbers(self) -> None:
        for axis, size in zip(self.axes, self.value.shape):
            if fault := axis.fault(size):
                raise FrictabError(f"{self.source}: axis '{axis.name}' {fault}")
        if not np.all(np.isfinite(self.value)) or self.log_value and np.any(self.value <= 0):
            raise FrictabError(f"{self.source}: 'value' has numbers that are not finite"
                               + (" and above 0" if self.log_value else ""))


def _levels(text: str) -> tuple[str, ...]: # "0 = A, 1 = B"
    levels: list[str] = []
    number = 0
    while text:
        begin = f"{number} = "
        text = text[len(begin):] if text.startswith(begin) else text
        number += 1
        level, _, text = text.partition(f", {number} = ")
        levels.append(level)
    return tuple(levels)


def plain(attributes: Mapping[Any, Any]) -> dict[str, Any]:
    """Attributes as str and float, whichever way HDF5 keeps them."""
    return {str(n): _plain(a) for n, a in attributes.items()}


def _plain(attribute: Any) -> Any:
    if isinstance(attribute, bytes):
        return attribute.decode()
    if isinstance(attribute, (np.ndarray, np.number)) and np.size(attribute) == 1:
        return np.ravel(attribute)[0].item()
    return attribute


def axis_of(name: str, nodes: Any, attributes: Mapping[str, Any]) -> Axis:
    """One axis from its dimension scale's nodes and attributes."""
    transform = attributes.get("transform")
    if transform not in ("linear", "log"):
        raise FrictabError(f"axis '{name}' says transform = {transform}; it is linear or log")
    return Axis(name, np.asarray(nodes, float), transform == "log",
                attributes.get("outside_low", "clamp"), attributes.get("outside_high", "clamp"),
                np.array(str(attributes.get("kinks", "")).split(), float),
                str(attributes.get("units", "")), str(attributes.get("long_name", "")))


def open_table(path: PathLike) -> Table:
    """Reads a table file. Raises FrictabError where it is none."""
    import h5py
    path = os.fspath(path)
    with file_faults(path, "a friction table"):
        try:
            file = h5py.File(path, "r")
        except OSError:
            raise FrictabError("is not an HDF5 file; a table is tables/NAME.h5 of a run") from None
        with file:
            _check_in_itself(file, "", set())
            return _read(file, path, _digest_of(path))


def _digest_of(path: str) -> str:
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        while block := file.read(1 << 20):
            digest.update(block)
    return digest.hexdigest()


def _check_in_itself(group: Any, prefix: str, seen: set[int]) -> None:
    """Refuses values that lie in other files, before any is read."""
    import h5py
    seen.add(h5py.h5o.get_info(group.id).addr) # groups may hold each other
    for name in group:
        named, link = f"'{prefix}{name}'", group.get(name, getlink=True)
        if isinstance(link, h5py.SoftLink): # ends in this file, or passes a link found below
            continue
        if not isinstance(link, h5py.HardLink):
            raise FrictabError(f"{named} is a link into another file, which is not read")
        item = group[name]
        if isinstance(item, h5py.Group):
            if h5py.h5o.get_info(item.id).addr not in seen:
                _check_in_itself(item, f"{prefix}{name}/", seen)
        elif isinstance(item, h5py.Dataset):
            if item.external:
                raise FrictabError(f"the values of {named} lie in another file, "
                                   f"{item.external[0][0]}, which is not read")
            if item.is_virtual:
                raise FrictabError(f"{named} is a virtual dataset: its values lie in other files, "
                                   "which are not read")


def _read(file: Any, path: str, digest: str) -> Table:
    value = file.get("value")
    if value is None or not hasattr(value, "dims"):
        raise FrictabError(f"{path}: there is no dataset 'value': this is not a friction table")
    axes = []
    for d in range(value.ndim):
        if len(value.dims[d]) == 0:
            raise FrictabError(f"{path}: axis {d} of 'value' has no dimension scale")
        scale = value.dims[d][0]
        axes.append(axis_of(scale.name.lstrip("/"), scale[()], plain(scale.attrs)))
    table = Table(path, axes, np.asarray(value[()], float), plain(value.attrs), plain(file.attrs),
                  digest)
    if "distance" in file:
        table.distance = np.asarray(file["distance"][()], float)
    return table
