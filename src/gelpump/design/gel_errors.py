"""What the errors of a measured gel make of the numbers that the formulae give.

With C the covariance of the fitted parameters (`gelpump.materials.measured`), lambda_k its
eigenvalues and v_k its axes, a number r of the design has, to first order, the variance

    sum_k lambda_k (dr/dv_k)^2 ,

each slope by a central difference over a tenth of a standard error. Along the axes the steps keep
to what the points leave open: single parameters, which are correlated to many digits, do not.
"""

from collections.abc import Mapping

import numpy as np

from gelpump.design.description import DesignError, checked
from gelpump.design.device import results
from gelpump.materials.measured import Fit

STEP = 0.1  # of a standard error


def gel_errors(name: str, block: Mapping, fit: Fit) -> dict[str, float]:
    """Standard error of each number of the design ``block`` whose gel is the fitted one.

    DesignError if a gel within the errors makes the design impossible.
    """
    variances, axes = np.linalg.eigh(fit.covariance)
    total: dict[str, float] = {}
    for variance, axis in zip(variances, axes.T, strict=True):
        shift = np.sqrt(max(variance, 0.0)) * axis
        ends = []
        for sign in (1, -1):
            values = fit.parameters + sign * STEP * shift
            design = checked(name, block, {block["gel"]: fit.block(values)})
            ends.append({each.key: each.value for each in results(design)})
        for key, up in ends[0].items():
            total[key] = total.get(key, 0.0) + ((up - ends[1][key]) / (2 * STEP)) ** 2
    return {key: float(np.sqrt(variance)) for key, variance in total.items()}


def gel_note(errors: Mapping[str, float] | DesignError) -> str:
    """What is said of them on the sheet."""
    if isinstance(errors, DesignError):
        said = str(errors).partition("\n")[2].strip()
        return f"The gel's errors are not carried over: a gel within them is refused ({said})."
    return (
        "‘Gel’ is the standard error that the measured equilibria leave, to first order; what is "
        "solved (front, flow, volumes) has it too, but gives the numerical uncertainty only."
    )
