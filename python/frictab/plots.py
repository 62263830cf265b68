"""Pictures of a result, on matplotlib. Each takes axes to draw on, or makes its own, and gives
them back. Synthetic data are called so in every title."""
from __future__ import annotations

import textwrap
import warnings
from typing import TYPE_CHECKING, Any, Mapping, Optional, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from .faults import FrictabError, OutsideWarning
from .frames import near

if TYPE_CHECKING:
    from .result import Law, Result

_LABELS = {"sigma_n_MPa": r"contact normal stress $\sigma_N$ / MPa", "psi": r"$\psi$",
           "v_rel_mm_s": "sliding speed / (mm/s)", "T_contact_C": "contact temperature / °C",
           "s_mm": "sliding distance / mm", "sigma_f_MPa": r"flow stress $\sigma_f$ / MPa",
           "time_s": "time / s"}
_TAU = r"friction shear stress $\tau_R$ / MPa"


class Plots:
    """result.plot"""

    def __init__(self, result: Result) -> None:
        self._result = result

    def measured_vs_predicted(self, law: str = "best", ax: Any = None) -> Any:
        """Every row of data; filled where the law has not seen the test."""
        one = self._result.law(law)
        rows = self._rows(one)
        ax = self._axes(ax, f"{one.name}: measured against predicted")
        end = max(rows["measured_tau_R_MPa"].max(), rows["tau_R_MPa"].max()) * 1.03
        ax.plot([0, end], [0, end], color="grey", lw=1)
        for unseen, label, style in ((False, "tests of the fit", {"facecolors": "none"}),
                                     (True, "unseen tests", {})):
            some = rows[rows["unseen"] == unseen]
            if len(some):
                mae = some["residual_MPa"].abs().mean()
                ax.scatter(some["tau_R_MPa"], some["measured_tau_R_MPa"], s=9, lw=0.6,
                           edgecolors="C1" if unseen else "C0", color="C1" if unseen else "C0",
                           label=f"{label} ({some['experiment'].nunique()}), MAE {mae:.1f} MPa",
                           **style)
        ax.set(xlabel="predicted " + _TAU, ylabel="measured " + _TAU, xlim=(0, end), ylim=(0, end))
        ax.legend()
        return ax

    def laws(self, over: str = "sigma_n_MPa", laws: Union[str, Sequence[str], None] = None,
             at: Optional[Mapping[str, Any]] = None, ax: Any = None) -> Any:
        """Laws over one state with the data; the other states at their medians, or as `at` has
        them. Dotted beyond the data. Absent: the first five laws that compete."""
        data = self._result.data
        chosen = self._chosen(laws)
        if over not in data or not any(i.name == over for law in chosen for i in law.inputs):
            raise FrictabError(f"no law here depends on '{over}'" + near(over, sorted(
                {i.name for law in chosen for i in law.inputs})))
        ax = self._axes(ax, "laws over the data")
        ax.scatter(data[over], data["tau_R_MPa"], s=7, color="0.75", label="data", zorder=0)
        low, high = data[over].min(), data[over].max()
        x = np.linspace(max(low - 0.1 * (high - low), 0), high + 0.1 * (high - low), 200)
        held: dict[str, Any] = {}
        for number, law in enumerate(chosen):
            states = {i.name: x if i.name == over else self._held(law, i.name, at, held)
                      for i in law.inputs}
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", OutsideWarning) # dotted instead
                tau = np.broadcast_to(law.tau_R(states), x.shape)
            inside = (x >= low) & (x <= high)
            ax.plot(x, tau, ":", color=f"C{number}")
            ax.plot(x[inside], tau[inside], color=f"C{number}", label=law.name)
        note = ", ".join(f"{n} {v if isinstance(v, str) else format(v, '.4g')}"
                         for n, v in held.items())
        ax.set(ylabel=_TAU, ylim=(0, None))
        ax.set_xlabel(_LABELS.get(over, over) + ("\n" + textwrap.fill("at " + note, 70) if note
                                                 else ""), fontsize="small")
        ax.legend(fontsize="small")
        return ax

    def residuals(self, laws: Union[str, Sequence[str], None] = "best", ax: Any = None) -> Any:
        """Density of measured - predicted, each test with the same weight: of unseen tests where
        a law has them, else of those it was fitted to."""
        ax = self._axes(ax, "residuals")
        for number, law in enumerate(self._chosen(laws)):
            rows = self._rows(law)
            seen = not rows["unseen"].any()
            rows = rows if seen else rows[rows["unseen"]]
            residual = rows["residual_MPa"].to_numpy()
            weights = 1.0 / rows.groupby("experiment")["experiment"].transform("size").to_numpy()
            if number == 0:
                ax.hist(residual, bins=40, weights=weights, density=True, color="0.85")
            beyond = 0.15 * np.ptp(residual) # so that the curve comes down
            x = np.linspace(residual.min() - beyond, residual.max() + beyond, 300)
            ax.plot(x, _density(residual, weights, x), color=f"C{number}",
                    label=f"{law.name}, {'tests of the fit' if seen else 'unseen tests'}")
        ax.axvline(0, color="grey", lw=1)
        ax.set(xlabel="measured - predicted / MPa", ylabel="density / (1/MPa)")
        ax.legend(fontsize="small")
        return ax

    def ranking(self, ax: Any = None) -> Any:
        """Mean absolute error on unseen tests with its interval of 95 %; constants of the
        literature, which do not compete, in grey; the noise floor."""
        table = self._result.ranking.dropna(subset=["mae_MPa"])
        ax = self._axes(ax, "error on unseen tests", height=1.2 + 0.28 * len(table))
        mae = table["mae_MPa"].to_numpy()
        low = np.nan_to_num(mae - table["mae_low_95"].astype(float).to_numpy())
        high = np.nan_to_num(table["mae_high_95"].astype(float).to_numpy() - mae)
        ax.barh(table.index, mae, xerr=[np.maximum(low, 0), np.maximum(high, 0)], ecolor="0.4",
                color=["C0" if c else "0.7" for c in table["competes"]], error_kw={"lw": 1})
        ax.invert_yaxis()
        ax.set_xlim(0, mae.max() * 1.25) # an interval may go far beyond
        floor = (self._result.calibration.record.get("noise_floor") or {}).get("mae_MPa")
        if floor is not None:
            ax.axvline(floor, color="C3", lw=1, ls="--", label=f"noise floor {floor:.1f} MPa")
            ax.legend()
        ax.set_xlabel("mean absolute error / MPa, 95 % by resampled tests")
        return ax

    def stroke(self, experiment: Any, laws: Union[str, Sequence[str], None] = "best",
               ax: Any = None) -> Any:
        """One test: measured and predicted along its path, or its time, with the band where a
        single law has one."""
        data = self._result.data
        there = data["experiment"] == str(experiment)
        if not there.any():
            raise FrictabError(f"there is no test '{experiment}'"
                               + near(str(experiment), data["experiment"].unique()))
        along = next((n for n in ("s_mm", "time_s") if n in data), None)
        x = data.loc[there, along] if along else np.arange(1, there.sum() + 1)
        ax = self._axes(ax, f"test {experiment}")
        ax.plot(x, data.loc[there, "tau_R_MPa"], ".", color="0.4", label="measured")
        chosen = self._chosen(laws)
        for number, law in enumerate(chosen):
            rows = self._rows(law)[there.to_numpy()]
            ax.plot(x, rows["tau_R_MPa"], color=f"C{number}", label=law.name)
            if len(chosen) == 1 and "tau_R_q05_MPa" in rows:
                ax.fill_between(x, rows["tau_R_q05_MPa"], rows["tau_R_q95_MPa"], alpha=0.2, lw=0,
                                label="90 % of new experiments")
        ax.set(xlabel=_LABELS.get(along or "", "row"), ylabel=_TAU, ylim=(0, None))
        ax.legend()
        return ax

    def _axes(self, ax: Any, title: str, height: float = 4.0) -> Any:
        if ax is None:
            try:
                import matplotlib.pyplot as plt
            except ImportError:
                raise FrictabError("pictures need matplotlib: pip install matplotlib (Debian: "
                                   "python3-matplotlib)") from None
            _, ax = plt.subplots(figsize=(6.0, height), layout="constrained")
        ax.set_title(title + (" (SYNTHETIC data)" if self._result.synthetic else ""),
                     fontsize="medium")
        return ax

    def _chosen(self, laws: Union[str, Sequence[str], None]) -> list[Law]:
        if laws is None:
            ranking = self._result.ranking
            laws = list(ranking.index[ranking["competes"].astype(bool)][:5])
        return [self._result.law(n) for n in ([laws] if isinstance(laws, str) else laws)]

    def _rows(self, law: Law) -> Any:
        """The rows of the campaign with what the law gives. A law that effects were searched for
        with the validation tests is fitted to these as well: it has then seen them."""
        data = self._result.data
        rows = self._result.predicted_data(law.name)
        fitted = data.loc[data["use"] == "train", "experiment"].nunique()
        own = law.fit["training"]["n_experiments"] <= fitted and not law.fit.get("fitted_to")
        rows["unseen"] = (data["use"] == "validate").to_numpy() & own
        return rows

    def _held(self, law: Law, name: str, at: Optional[Mapping[str, Any]],
              held: dict[str, Any]) -> Any:
        if at and name in at:
            held[name] = at[name]
        elif name not in held:
            rows = self._result.predicted_data(law.name)[name] # has histories too
            held[name] = (rows.median() if rows.dtype.kind in "if" else rows.mode().iloc[0])
        return held[name]


def _density(values: NDArray[np.float64], weights: NDArray[np.float64],
             x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Gaussian kernels with Silverman's width."""
    share = weights / weights.sum()
    mean = np.sum(share * values)
    width = np.sqrt(np.sum(share * (values - mean) ** 2)) or 1.0
    width *= 0.9 * (1.0 / np.sum(share ** 2)) ** -0.2
    total = np.zeros_like(x)
    for i in range(0, len(values), 1 << 14): # a block of rows at a time
        z = (x[:, None] - values[None, i:i + (1 << 14)]) / width
        total += np.exp(-0.5 * z ** 2) @ share[i:i + (1 << 14)]
    return np.asarray(total / (width * np.sqrt(2 * np.pi)))
