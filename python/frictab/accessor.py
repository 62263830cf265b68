"""`import frictab.accessor` gives a table that xarray has opened the right interpolation:

    ds = xarray.open_dataset("out/tables/wzl.h5")
    ds.frictab.tau_R(sigma_n_MPa=800, v_rel_mm_s=20, ...)

`ds.value.interp(...)` is linear in the axes' own values; a table is linear, or a cubic spline, in
the logarithm of each axis with transform = "log".
"""
from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from .faults import FrictabError
from .table import Table, axis_of, plain


class TableAccessor:
    """A Dataset as a frictab.Table; its methods are those of the Table."""

    def __init__(self, dataset: Any) -> None:
        if "value" not in dataset:
            raise FrictabError("there is no variable 'value': this is not a friction table")
        value = dataset["value"]
        axes = [axis_of(d, dataset[d].data, plain(dataset[d].attrs)) for d in value.dims]
        self.table = Table("the dataset", axes, np.asarray(value.data, float), plain(value.attrs),
                           plain(dataset.attrs))
        # Not methods of its own: warnings name the line that called.
        self.tau_R, self.mu = self.table.tau_R, self.table.mu
        self.interp, self.outside = self.table.interp, self.table.outside


xr.register_dataset_accessor("frictab")(TableAccessor)
