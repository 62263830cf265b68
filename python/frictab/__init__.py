"""Fits friction laws to tribometer data, and reads what frictab writes.

    import frictab
    result = frictab.Campaign(frame, columns={"sigma_n_MPa": ("Normal stress", "Pa")}).fit()
    result.law("best").predict(frame, band=True)
    result.export("abaqus_vfric", "routine")

    frictab.open_table("out/tables/wzl.h5").tau_R(sigma_n_MPa=800, v_rel_mm_s=[5, 50], ...)
    frictab.read_model("out/models/wzl.json").tau_R(...)
    import frictab.accessor # then: xarray.open_dataset(...).frictab.tau_R(...)

Fitting runs the installed program `frictab` and needs pandas; reading needs numpy and h5py alone.
"""
from .calibration import Calibration, Model, read_calibration, read_model
from .campaign import Campaign
from .faults import CautionWarning, FrictabError, OutsideWarning
from .formula import Formula
from .regressor import FrictionRegressor
from .result import Law, Result
from .routine import Export
from .table import Axis, Table, open_table

open = open_table # not in __all__: an import of everything leaves Python's own open alone
__version__ = "0.2.0"
__all__ = ["Axis", "Calibration", "Campaign", "CautionWarning", "Export", "Formula",
           "FrictabError", "FrictionRegressor", "Law", "Model", "OutsideWarning", "Result",
           "Table", "open_table", "read_calibration", "read_model"]
