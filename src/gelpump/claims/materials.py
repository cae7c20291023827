"""What the paper states about the energy-based gels (appendix A and section 2.1)."""

from collections.abc import Iterator, Mapping

import numpy as np

from gelpump.claims.finding import Finding, holds

ROUNDING = 4 * np.finfo(float).eps  # relative, of a closed formula or a root found to the last bit
COLD = 300.0  # K, the lowest temperature that the paper draws
STRAIN = 1e-6  # of the shear that measures a modulus, to an error of this order
NUDGE = 1e-6  # relative shift of a polymer fraction, to see how well an extremum is located


def findings(data: Mapping, gels: Mapping) -> Iterator[Finding]:
    """data: datasets ``materials_ANB``, ``materials_HHT`` and LENS beads; gels: by name."""
    tables = {name: data[f"materials_{name}"] for name in ("ANB", "HHT")}
    yield from _equilibria(data, gels["HHT"])
    yield from _transitions(tables, gels)
    yield from _low_temperatures(tables, gels)
    yield from _moduli(tables, gels)


def _equilibria(data, gel) -> Iterator[Finding]:
    for claim, case in (("phi0-308-hht", "swelling"), ("phi0-304-hht", "drying")):
        bead = data[f"bead_{case}_lens"]
        phi, T = float(bead.polymer_fraction[0, 0]), float(claim[5:8])
        yield Finding(
            claim,
            "section 2.1",
            f"the HHT gel in equilibrium at {T:.0f} K has this polymer fraction",
            phi,
            root_uncertainty(gel, phi, T),
            f"data/bead_{case}_lens.nc: polymer_fraction at t = 0",
        )


def root_uncertainty(gel, phi: float, T: float) -> float:
    """How far phi is from T_eq(phi) = T, to first order, and what rounding adds."""
    at, beside = gel.equilibrium_temperature(np.array([phi, phi * (1 + NUDGE)]))
    return float(abs((at - T) * phi * NUDGE / (beside - at))) + ROUNDING


def fold_uncertainty(gel, phi: float) -> float:
    """How far T_eq moves when the fold's polymer fraction is nudged: T is flat there."""
    T = gel.equilibrium_temperature(np.array([phi * (1 - NUDGE), phi, phi * (1 + NUDGE)]))
    return float(np.ptp(T)) + ROUNDING * float(T[1])


def _transitions(tables, gels) -> Iterator[Finding]:
    folds = {
        name: (
            np.sort(table.fold_temperature.values),
            [fold_uncertainty(gels[name], phi) for phi in table.fold_polymer_fraction.values],
        )
        for name, table in tables.items()
    }
    for claim, index, what in (("tc-up-anb", 0, "swelling"), ("tc-down-anb", -1, "drying")):
        yield Finding(
            claim,
            "appendix A, figure 14",
            f"temperature at which the ANB gel jumps on {what}",
            float(folds["ANB"][0][index]),
            max(folds["ANB"][1]),
            "data/materials_ANB.nc: fold_temperature",
        )
    yield Finding(
        "tc-hht",
        "appendix A, figure 14",
        "temperature at which the HHT gel jumps (on swelling, on drying)",
        folds["HHT"][0].tolist(),
        max(folds["HHT"][1]),
        "data/materials_HHT.nc: fold_temperature",
    )
    width = min(float(np.ptp(T)) for T, _ in folds.values())
    doubt = max(sum(uncertainties) for _, uncertainties in folds.values())
    yield Finding(
        "hysteresis-both",
        "appendix A, figure 14",
        "both gels have several equilibria in a narrow band of temperatures",
        holds(width, doubt),
        doubt,
        "data/materials_{ANB,HHT}.nc: fold_temperature",
        measure=width,
        measured="narrower band, K:",
    )


def _exponent(phi, asymptote, step: int) -> float:
    """Power of (1/2 - a + b) that phi_0 follows at the lowest temperatures (asymptote: -3/5)."""
    slope = np.diff(np.log(phi[: step + 1 : step])) / np.diff(np.log(asymptote[: step + 1 : step]))
    return -0.6 * float(slope[0])


def _low_temperatures(tables, gels) -> Iterator[Finding]:
    exponents, exponent_doubts, errors, at_300, root_doubts = [], [], [], [], []
    for name, table in tables.items():
        phi, asymptote = table.swollen_polymer_fraction, table.asymptotic_polymer_fraction
        exponent, wider = (_exponent(phi.values, asymptote.values, step) for step in (1, 2))
        exponents.append(exponent)
        exponent_doubts.append(abs(exponent - wider))
        errors.append(float(asymptote[0] / phi[0]) - 1.0)
        cold = table.equilibrium_temperature.values == COLD
        at_300.append(float(table.equilibrium_polymer_fraction.values[cold].min()))
        root_doubts.append(root_uncertainty(gels[name], at_300[-1], COLD))
    yield Finding(
        "phi0-asymptote",
        "appendix A",
        "power of 1/2 - (A0-A1) - (B0-B1) T that phi_0 of the swollen gels (ANB, HHT) follows at "
        "the lowest temperature of their range",
        exponents,
        exponent_doubts,
        "data/materials_{ANB,HHT}.nc: swollen_polymer_fraction, asymptotic_polymer_fraction",
        measure=errors,
        measured="relative error of the asymptote at the lowest temperature:",
    )
    yield Finding(
        "phi0-low-temperature",
        "appendix A",
        "phi_0 of the swollen gels (ANB, HHT) at 300 K, which is sufficiently low",
        at_300,
        root_doubts,
        "data/materials_{ANB,HHT}.nc: equilibrium_polymer_fraction",
    )
    for name, table in tables.items():
        yield Finding(
            f"singular-t-{name.lower()}",
            "appendix A",
            f"temperature at which the low-temperature asymptote of {name} breaks down",
            float(table.singular_temperature),
            ROUNDING * float(table.singular_temperature),
            f"data/materials_{name}.nc: singular_temperature",
        )


def _moduli(tables, gels) -> Iterator[Finding]:
    phi = np.geomspace(1e-3, 0.9, 40)
    spread = max(
        float(np.ptp(_sheared(gel, phi)) / gel.shear_modulus(0.05)) for gel in gels.values()
    )
    yield Finding(
        "mu-independent-of-phi",
        "appendix A",
        "the shear modulus does not depend on the polymer fraction, and grows with temperature",
        holds(STRAIN - spread, 0.0),
        STRAIN,
        "gelpump.claims.materials: neo-Hookean chains under a small shear",
        measure=spread,
        measured="relative spread of mu_s at fixed k_B T over phi from 0.001 to 0.9:",
    )
    negative = max(float(table.osmotic_pressure[:, 0].max()) for table in tables.values())
    growth = min(
        float((table.osmotic_pressure[:, -1] - table.osmotic_pressure[:, -2]).min())
        for table in tables.values()
    )
    yield Finding(
        "pi-negative-small-phi",
        "appendix A, figure 13",
        "the osmotic pressure is slightly negative as phi -> 0 and diverges as phi -> 1",
        holds(min(-negative, growth), 0.0),
        0.0,
        "data/materials_{ANB,HHT}.nc: osmotic_pressure",
        measure=negative,
        measured="largest Pi at the smallest phi, in k_B T/Omega_f:",
    )


def _sheared(gel, phi, phi_00: float = 0.05):
    """sigma_xy / (2 epsilon_xy) of the chains' stress phi F F^T / (Omega phi_00^(2/3)).

    The deformation gradient is that of a displacement with Cauchy strain c I - epsilon, where
    c = (phi/phi_00)^(1/3): F = (c I - epsilon)^-1, in the plane of the shear.
    """
    c = np.cbrt(phi / phi_00)
    inverse = c[:, None, None] * np.eye(2) - STRAIN * np.array([[0.0, 1.0], [1.0, 0.0]])
    F = np.linalg.inv(inverse)
    stress = phi * (F @ F.transpose(0, 2, 1))[:, 0, 1] / (gel.Omega * phi_00 ** (2 / 3))
    return stress / (2.0 * STRAIN)
