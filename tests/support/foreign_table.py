"""Writes a friction table in the documented layout with h5py alone, as someone without frictab does.

Usage: foreign_table.py small OUT.h5             mu over psi (log) and v_rel_mm_s, three by two nodes
       foreign_table.py MODEL.json OUT.h5 [F]    mu of a calibrated exp_coulomb, times F; in ln
"""
import json
import sys

import h5py
import numpy as np


def write(path, axes, value, transform, combine, **constants):
    with h5py.File(path, "w") as f:
        f["value"] = value
        for d, (name, units, coordinate, nodes) in enumerate(axes):
            f[name] = np.array(nodes, float)
            f[name].make_scale(name)
            f["value"].dims[d].attach_scale(f[name])
            f[name].attrs["units"] = units
            f[name].attrs["transform"] = coordinate
        f.attrs["schema"] = "frictab/table/2"
        attributes = dict(quantity="mu", transform=transform, interpolation="linear",
                          combine=combine, **constants)
        for name, attribute in attributes.items():
            f["value"].attrs[name] = attribute


def small(path):
    write(path, [("psi", "1", "log", [1, 2, 4]), ("v_rel_mm_s", "mm/s", "linear", [10, 20])],
          np.array([[0.10, 0.08], [0.12, 0.10], [0.14, 0.12]]), "linear",
          "minimum(value*sigma_n_MPa, m*0.5*sigma_f_MPa)", m=0.8)


def exp_coulomb(model, path, factor):
    law = {p["name"]: p["value"] for p in json.load(open(model))["parameters"]}
    pressure, temperature = np.array([500.0, 2750.0]), np.array([20.0, 200.0])
    mu = (law["mu0"] * factor * (pressure[:, None] / 1000) ** law["a"]
          * np.exp(law["b"] * (temperature[None, :] - 20)))
    write(path, [("sigma_n_MPa", "MPa", "log", pressure),
                 ("T_contact_C", "degC", "linear", temperature)], mu, "log",
          "minimum(maximum(value*sigma_n_MPa, 0), 0.5773502691896258*sigma_f_MPa)")
    with h5py.File(path, "a") as f: # a state that is no axis: optional, where verify has no data
        f.attrs["range_low_sigma_f_MPa"], f.attrs["range_high_sigma_f_MPa"] = 300.0, 900.0


if sys.argv[1] == "small":
    small(sys.argv[2])
else:
    exp_coulomb(sys.argv[1], sys.argv[2], float(sys.argv[3]) if len(sys.argv) > 3 else 1.0)
