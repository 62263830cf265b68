"""Reads what frictab writes: friction tables, calibrated laws, calibrations.

    import frictab
    frictab.open("out/tables/wzl.h5").tau_R(sigma_n_MPa=800, v_rel_mm_s=[5, 50], ...)
    frictab.read_model("out/models/wzl.json").tau_R(...)
    frictab.read_calibration("out/calibration.json").errors()
    import frictab.accessor # then: xarray.open_dataset(...).frictab.tau_R(...)
"""
from .calibration import Calibration, Model, read_calibration, read_model
from .faults import FrictabError, OutsideWarning
from .formula import Formula
from .table import Axis, Table
from .table import open_table as open

__version__ = "0.2.0"
__all__ = ["Axis", "Calibration", "Formula", "FrictabError", "Model", "OutsideWarning", "Table",
           "open", "read_calibration", "read_model"]
