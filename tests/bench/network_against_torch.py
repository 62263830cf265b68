#!/usr/bin/python3
"""The neural network of frictab against one PyTorch net: time and error on unseen experiments.

Optional: needs Debian's python3-torch, python3-numpy and python3-h5py, which nothing else here
needs. Data are SYNTHETIC: `frictab twin`, written to a temporary directory.

    /usr/bin/python3 tests/bench/network_against_torch.py build/release/frictab [SEED ...]

frictab: the process `frictab calibrate` with neural_network alone (125 nets: decay by
cross-validation, ensemble of 20), reading of the data included. PyTorch: one 5-16-1 tanh net on all
rows, Adam, batches of 512, weight decay, stopped early on a fifth of the experiments; training
alone, import and reading not counted. Both in seconds of processor time, which a busy machine
stretches less than wall time.
"""
import json
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np
import torch

INPUTS = ["sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C", "s_mm"]


def read(path):
    with h5py.File(path) as file:
        return {name: file[name][()] for name in file}


def inputs(data):
    columns = [np.log(data["sigma_n_MPa"]), np.log(data["psi"]), np.log(data["v_rel_mm_s"] + 1e-3),
               data["T_contact_C"], np.log(data["s_mm"] + 0.5)]
    return np.column_stack(columns)


def torch_net(training, seed):
    """Trains one net; returns mu as a function of rows, and the seconds of training."""
    torch.manual_seed(seed)
    x = inputs(training)
    centre, scale = x.mean(0), x.std(0)
    experiment = np.unique(training["experiment"], return_inverse=True)[1]
    held = np.random.default_rng(seed).permutation(experiment.max() + 1)[: (experiment.max() + 1) // 5]
    out = np.isin(experiment, held)
    as_tensor = lambda a: torch.tensor(a, dtype=torch.float32)
    z = as_tensor((x - centre) / scale)
    stress, tau = as_tensor(training["sigma_n_MPa"]), as_tensor(training["tau_R_MPa"])
    mu0 = float((stress @ tau) / (stress @ stress))
    net = torch.nn.Sequential(torch.nn.Linear(5, 16), torch.nn.Tanh(), torch.nn.Linear(16, 1))
    predict = lambda rows, sigma: mu0 * (1 + 0.25 * net(rows)[:, 0]) * sigma
    optimiser = torch.optim.Adam(net.parameters(), lr=5e-3)
    decay, rows = 1e4, int((~out).sum())
    zi, si, ti = z[~out], stress[~out], tau[~out]
    zo, so, to = z[out], stress[out], tau[out]
    begin = time.process_time()
    best, best_state, since = np.inf, None, 0
    for _ in range(300):
        order = torch.randperm(rows)
        for at in range(0, rows, 512):
            pick = order[at:at + 512]
            loss = ((predict(zi[pick], si[pick]) - ti[pick]) ** 2).mean()
            loss = loss + decay / rows * sum((p ** 2).sum() for p in net.parameters())
            optimiser.zero_grad()
            loss.backward()
            optimiser.step()
        with torch.no_grad():
            error = float(((predict(zo, so) - to) ** 2).mean())
        since += 1
        if error < best:
            best, since = error, 0
            best_state = {k: v.clone() for k, v in net.state_dict().items()}
        if since == 30:
            break
    seconds = time.process_time() - begin
    net.load_state_dict(best_state)

    def stress_of(data):
        with torch.no_grad():
            return predict(as_tensor((inputs(data) - centre) / scale),
                           as_tensor(data["sigma_n_MPa"])).numpy()

    return stress_of, seconds


def children_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main():
    binary = str(pathlib.Path(sys.argv[1]).resolve())
    seeds = [int(s) for s in sys.argv[2:]] or list(range(1, 7))
    torch.set_num_threads(1)
    print(f"SYNTHETIC data; validation MAE in MPa, PyTorch {torch.__version__}")
    print("seed  oracle  frictab   s      PyTorch   s      over the oracle")
    ratios = []
    for seed in seeds:
        with tempfile.TemporaryDirectory() as where:
            run = lambda *a: subprocess.run([binary, *a], check=True, capture_output=True, text=True)
            run("twin", where, "--seed", str(seed), "--oracle", "--format", "hdf5", "-q")
            training, validation = (read(f"{where}/{n}.h5") for n in ("training", "validation"))
            oracle = np.abs(validation["tau_R_MPa"] -
                            read(f"{where}/validation_oracle.h5")["tau_oracle_MPa"]).mean()
            begin = children_seconds()
            run("calibrate", f"{where}/job.toml", "-q", "--set", 'models.use="neural_network"')
            ours_s = children_seconds() - begin
            result = json.loads(pathlib.Path(where, "out/calibration.json").read_text())
            ours = result["models"][0]["validation"]["mae_MPa"]
            stress_of, torch_s = torch_net(training, seed)
            theirs = np.abs(validation["tau_R_MPa"] - stress_of(validation)).mean()
        ratios.append((ours / oracle - 1, theirs / oracle - 1, ours_s / torch_s))
        print(f"{seed:4}  {oracle:6.3f}  {ours:7.3f} {ours_s:6.2f}  {theirs:7.3f} {torch_s:6.2f}"
              f"      {100 * ratios[-1][0]:+.1f} % and {100 * ratios[-1][1]:+.1f} %")
    mean = np.mean(ratios, axis=0)
    print(f"mean over the oracle: frictab {100 * mean[0]:+.2f} %, PyTorch {100 * mean[1]:+.2f} %; "
          f"frictab takes {mean[2]:.2f} of the time of one PyTorch net")


if __name__ == "__main__":
    main()
