"""Interpolation on a rectangular grid, piecewise linear or by cubic splines, in numpy.

Each axis gives its cells' polynomials in t, the share of the cell that lies below a state (0 .. 1),
and the first of the coefficients they multiply. A state then needs a small window of coefficients.
"""
from __future__ import annotations

from typing import Sequence

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]

_WINDOW_NUMBERS = 1 << 21 # of coefficients that are gathered at once


class Linear:
    """Weights 1 - t and t."""

    def __init__(self, u: Numbers) -> None:
        self.u = u
        self.support = 2
        self.first: NDArray[np.int_] = np.arange(len(u) - 1)
        self.basis = np.tile([[1.0, 0.0], [-1.0, 1.0]], (len(u) - 1, 1, 1)) # cell, power, spline

    def coefficients(self, values: Numbers) -> Numbers:
        return values

    def weights(self, u: Numbers) -> tuple[NDArray[np.int_], Numbers]:
        """Per state the first coefficient and the weights of `support` ones; held at the ends."""
        cell = np.clip(np.searchsorted(self.u, u, side="right") - 1, 0, len(self.u) - 2)
        t = np.clip((u - self.u[cell]) / (self.u[cell + 1] - self.u[cell]), 0.0, 1.0)
        powers = t[:, None] ** np.arange(self.basis.shape[1])
        return self.first[cell], np.einsum("rp,rps->rs", powers, self.basis[cell])


class Cubic(Linear):
    """C2 spline through the nodes, not-a-knot at its ends, split at the nodes `kinks`."""

    def __init__(self, u: Numbers, kinks: Sequence[int] = ()) -> None:
        self.u = u
        self.support = min(4, len(u))
        self.first = np.zeros(len(u) - 1, int)
        self.basis = np.zeros((len(u) - 1, 4, self.support))
        ends = [0, *kinks, len(u) - 1]
        for begin, end in zip(ends, ends[1:]):
            self._add_piece(begin, end)

    def _add_piece(self, begin: int, end: int) -> None:
        nodes = self.u[begin:end + 1]
        n, degree = len(nodes), min(3, end - begin)
        knots = np.concatenate([[nodes[0]] * (degree + 1), nodes[2:-2] if n > 4 else [],
                                [nodes[-1]] * (degree + 1)])
        for cell in range(n - 1):
            span = min(max(cell - 1, 0), n - degree - 1) if n > 4 else 0
            self.first[begin + cell] = min(begin + span, len(self.u) - self.support)
            shift = begin + span - self.first[begin + cell]
            polynomials = _cell_polynomials(knots, span, degree, nodes[cell], nodes[cell + 1])
            self.basis[begin + cell, :, shift:shift + degree + 1] = polynomials.T

    def coefficients(self, values: Numbers) -> Numbers:
        """Of the splines, from the values at the nodes, along the first axis of `values`."""
        first, weights = self.weights(self.u)
        matrix = np.zeros((len(self.u), len(self.u)))
        for j in range(self.support):
            matrix[np.arange(len(self.u)), first + j] = weights[:, j]
        flat = np.linalg.solve(matrix, values.reshape(len(self.u), -1))
        return np.asarray(flat).reshape(values.shape)


def _cell_polynomials(knots: Numbers, span: int, degree: int, low: float,
                      high: float) -> Numbers:
    """The degree + 1 B-splines of a cell, each by powers of t (Cox - de Boor)."""
    def times(p: Numbers, a: float, b: float) -> Numbers: # p (a + b t)
        return np.asarray(p * a + np.append(0.0, p[:3] * b))

    width = high - low
    basis = np.zeros((degree + 1, 4))
    basis[0, 0] = 1.0
    for q in range(1, degree + 1):
        for j in range(q, -1, -1): # from the last: each is made of itself and the one before
            k = span + degree - q + j # knot where spline j of degree q begins
            total = np.zeros(4)
            if j > 0:
                length = knots[k + q] - knots[k]
                total = total + times(basis[j - 1], (low - knots[k]) / length, width / length)
            if j < q:
                length = knots[k + q + 1] - knots[k + 1]
                total = total + times(basis[j], (knots[k + q + 1] - low) / length, -width / length)
            basis[j] = total
    return basis


class Grid:
    """Tensor product of axes over values, row-major."""

    def __init__(self, axes: Sequence[Linear], values: Numbers) -> None:
        self.axes = axes
        c: Numbers = np.array(values, float)
        for d, axis in enumerate(axes):
            c = np.moveaxis(axis.coefficients(np.moveaxis(c, d, 0)), 0, d)
        self.strides = [int(np.prod(c.shape[d + 1:])) for d in range(c.ndim)]
        self.flat = np.ascontiguousarray(c).ravel()

    def __call__(self, points: Sequence[Numbers], rows: int) -> Numbers:
        """The interpolant at one array of coordinates per axis."""
        if not self.axes:
            return np.full(rows, self.flat[0])
        window = int(np.prod([axis.support for axis in self.axes]))
        step = max(1, _WINDOW_NUMBERS // window)
        parts = [self._block([p[i:i + step] for p in points]) for i in range(0, rows, step)]
        return np.concatenate(parts) if parts else np.zeros(0)

    def _block(self, points: Sequence[Numbers]) -> Numbers:
        at: NDArray[np.int_] = np.zeros((len(points[0]), 1), int)
        all_weights = []
        for axis, u, stride in zip(self.axes, points, self.strides):
            first, weights = axis.weights(u)
            all_weights.append(weights)
            offset = (first[:, None] + np.arange(axis.support)) * stride
            at = (at[:, :, None] + offset[:, None, :]).reshape(len(u), -1)
        window = self.flat[at]
        for weights in reversed(all_weights): # the last axis runs fastest
            window = window.reshape(len(weights), -1, weights.shape[1])
            window = np.einsum("rws,rs->rw", window, weights)
        return np.asarray(window[:, 0])
