"""Rebuilds tau_R from a friction table by its attributes alone and compares it with given values;
a linear table also by scipy's RegularGridInterpolator and xarray's interp.

Usage: rebuild_tau.py TABLE.h5 STATES.csv ...   (pairs; columns: states, then tau_R_MPa)
Prints for each the largest relative difference by h5py and the axes that xarray sees.
"""
import sys

import h5py
import numpy as np
import pandas as pd
import xarray as xr
from scipy.interpolate import RegularGridInterpolator, make_interp_spline


def multilinear(nodes, values, points):
    """Multilinear interpolation, clamped at the edges."""
    weights, cells = [], []
    for u, x in zip(nodes, points):
        i = np.clip(np.searchsorted(u, x, side="right") - 1, 0, len(u) - 2)
        cells.append(i)
        weights.append(np.clip((x - u[i]) / (u[i + 1] - u[i]), 0.0, 1.0))
    total = np.zeros(len(points[0]) if points else 1)
    for corner in range(1 << len(nodes)):
        share = np.ones_like(total)
        index = []
        for d in range(len(nodes)):
            up = (corner >> d) & 1
            share = share * (weights[d] if up else 1.0 - weights[d])
            index.append(cells[d] + up)
        total = total + share * values[tuple(index)]
    return total


def spline(nodes, kinks, values, points):
    """Tensor product of interpolating splines, not-a-knot (scipy's default), split at the kinks;
    clamped at the edges."""
    total = None
    for u, bends, x in zip(nodes, kinks, points):
        x = np.clip(x, u[0], u[-1])
        weights = np.zeros((len(x), len(u)))
        ends = [0, *bends, len(u) - 1]
        for a, b in zip(ends, ends[1:]):
            here = (x >= u[a]) & (x <= u[b])
            unit = make_interp_spline(u[a : b + 1], np.eye(b - a + 1), k=min(3, b - a))
            weights[here] = 0
            weights[here, a : b + 1] = unit(x[here])
        total = (np.tensordot(weights, values, 1) if total is None
                 else np.einsum("pi,pi...->p...", weights, total))
    return total if total is not None else values


def text(attribute):
    return attribute.decode() if isinstance(attribute, bytes) else attribute


def extension(attributes):
    """The law's own formula of "value"; long ones go on in extension_2, ..."""
    formula, part = "", 1
    while (name := "extension" if part == 1 else f"extension_{part}") in attributes:
        formula += text(attributes[name])
        part += 1
    return formula


def beyond(scale, x):
    """States beyond a side by what holds there, and where the law's formula takes the axis."""
    low, high = scale[0], scale[-1]
    below, above = (text(scale.attrs.get(f"outside_{side}", "clamp")) for side in ("low", "high"))
    under, over = x < low, x > high
    law = (under & (below == "law")) | (over & (above == "law"))
    refused = ((x < low - 1e-6 * abs(low)) & (below == "error")
               | (x > high + 1e-6 * abs(high)) & (above == "error"))
    return law, refused, np.where(law, x, np.clip(x, low, high))


def by_scipy_and_xarray(path, points, tabulated):
    """The same by the interpolators of others, where the table is linear: largest relative error."""
    data = xr.open_dataset(path)
    log = [data[d].attrs["transform"] == "log" for d in data["value"].dims]
    coordinates = {d: np.log(data[d]) if l else data[d] for d, l in zip(data["value"].dims, log)}
    value = data["value"].assign_coords({d: c.data for d, c in coordinates.items()})
    edges = [np.clip(x, c.data[0], c.data[-1]) for x, c in zip(points, coordinates.values())]
    at = {d: xr.DataArray(x, dims="row") for d, x in zip(value.dims, edges)}
    if data["value"].attrs["transform"] == "log":
        value = np.log(value)
    grid = RegularGridInterpolator([c.data for c in coordinates.values()], value.data)
    answers = value.interp(at, method="linear").data, grid(np.transpose(edges))
    scale = np.maximum(np.abs(tabulated), 1e-300)
    return max(np.max(np.abs(answer - tabulated) / scale) for answer in answers)


def rebuild(path, states):
    """tau_R, and how far other interpolators are from ours."""
    with h5py.File(path) as f:
        value = f["value"]
        attributes = value.attrs
        nodes, points, kinks, held, others = [], [], [], {}, 0.0
        law, refused = np.zeros(len(states), bool), np.zeros(len(states), bool)
        for d in range(value.ndim):
            scale = value.dims[d][0]
            name = scale.name.lstrip("/")
            log = text(scale.attrs["transform"]) == "log"
            nodes.append(np.log(scale[:]) if log else scale[:])
            x = states[name].to_numpy()
            points.append(np.log(x) if log else x)
            goes_on, ends, held[name] = beyond(scale, x)
            law, refused = law | goes_on, refused | ends
            bends = np.array(text(scale.attrs.get("kinks", "")).split(), float)
            kinks.append(np.flatnonzero(np.isin(scale[:], bends)))
        in_ln = text(attributes["transform"]) == "log"
        values = np.log(value[()]) if in_ln else value[()]
        if text(attributes["interpolation"]) == "cubic":
            assert text(attributes["spline"]) == "not-a-knot"
            tabulated = spline(nodes, kinks, values, points)
        else:
            tabulated = multilinear(nodes, values, points)
            if value.ndim > 0:
                others = by_scipy_and_xarray(path, points, tabulated)
        if in_ln:
            tabulated = np.exp(tabulated)
        names = {c: states[c].to_numpy() for c in states.columns}
        for constant in text(attributes["constants"]).split():
            names[constant] = float(np.ravel(attributes[constant])[0])
        names["value"] = tabulated
        functions = {n: getattr(np, n) for n in ("minimum", "maximum", "exp", "log", "sqrt", "sin",
                                                 "tanh", "arccos", "where")}
        scope = {"__builtins__": {}}
        if law.any():
            formula = eval(extension(attributes), scope, {**functions, **names, **held})
            names["value"] = np.where(law, formula, tabulated)
        tau = eval(text(attributes["combine"]), scope, {**functions, **names})
        return np.where(refused, np.nan, tau), others


def compare(path, states):
    wanted = states.pop("tau_R_MPa").to_numpy()
    rebuilt, others = rebuild(path, states)
    tau = np.broadcast_to(rebuilt, wanted.shape)
    both = np.isnan(tau) & np.isnan(wanted)
    relative = np.abs(tau - wanted) / np.maximum(np.abs(wanted), 1e-300)
    difference = max(np.max(np.where(both, 0, relative)), others)
    data = xr.open_dataset(path)
    axes = [f"{d}[{data.sizes[d]}] {data[d].attrs['units']}" for d in data["value"].dims]
    assert all(d in data.coords for d in data["value"].dims)
    print("ok" if difference < 1e-12 else "differs", f"{difference:.1e}", "; ".join(axes))


for table, states in zip(sys.argv[1::2], sys.argv[2::2]):
    compare(table, pd.read_csv(states, float_precision="round_trip"))
