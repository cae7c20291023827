"""Disagreements about the energy-based gels (appendix A)."""

from collections.abc import Iterator, Mapping

import numpy as np

from gelpump.ledger.entry import Entry
from gelpump.uncertainty import rounding_error


def entries(data: Mapping, gels: Mapping, published: Mapping) -> Iterator[Entry]:
    """data: datasets ``materials_ANB``, ``materials_HHT``, ``bead_drying_lens``."""
    yield reference_state(data, gels["HHT"])
    yield transition_temperatures(data["materials_ANB"], published)
    yield low_temperature_fraction(data, published)


def reference_state(data: Mapping, gel) -> Entry:
    """D with (phi/phi_0)^(1/3), as eqn:lens_transport prints it, or with (phi/phi_00)^(1/3)."""
    bead = data["bead_drying_lens"]
    phi_00 = float(bead.polymer_fraction[0, 0])
    phi_0, T = float(bead.polymer_fraction[-1].mean()), float(bead.attrs["temperature"])

    def change(phi):
        derived = gel.diffusivity(phi, T)
        elastic = 4.0 / 3.0 * gel.shear_modulus(phi_00) * np.cbrt(phi / phi_00)
        return elastic * (np.cbrt(phi_00 / phi_0) - 1.0) / derived

    phi = np.linspace(phi_00, phi_0, 200)
    largest = phi[np.argmax(np.abs(change(phi)))]
    return Entry(
        "diffusivity-reference-state",
        "eqn:lens_transport, eqn:tube_evolution",
        "the elastic part of D holds (phi/phi_0)^(1/3) in one equation and (phi/phi_00)^(1/3) in "
        "another",
        "the derivation gives phi_00, and then D does not depend on the reference at all",
        float(np.abs(change(largest))),
        "largest relative change of D while the bead dries",
        float(rounding_error(change, largest)),
        reference_state,
        "data/bead_drying_lens.nc: polymer_fraction",
    )


def transition_temperatures(table, published: Mapping) -> Entry:
    """The text's transition temperatures of ANB against the folds of its equilibrium curve."""
    folds = np.sort(table.fold_temperature.values)
    printed = [published[claim]["value"] for claim in ("tc-up-anb", "tc-down-anb")]
    return Entry(
        "transition-temperatures-anb",
        "appendix A, figure 14",
        f"the text puts the jumps of ANB near {printed[0]:g} and {printed[1]:g} K",
        f"the folds lie at {folds[0]:.3f} and {folds[-1]:.3f} K, where figure 14 draws them",
        [folds[0] - printed[0], folds[-1] - printed[1]],
        "fold minus text, K",
        [published[claim]["resolution"] for claim in ("tc-up-anb", "tc-down-anb")],
        transition_temperatures,
        "data/materials_ANB.nc: fold_temperature",
    )


def low_temperature_fraction(data: Mapping, published: Mapping) -> Entry:
    """phi_0 of the swollen gels at the lowest temperature that the paper draws."""
    claim = published["phi0-low-temperature"]
    at_300 = [
        float(table.equilibrium_polymer_fraction.values[table.equilibrium_temperature == 300].min())
        for table in (data["materials_ANB"], data["materials_HHT"])
    ]
    return Entry(
        "low-temperature-fraction",
        "appendix A",
        f"phi_0 is about {claim['value']:g} in both gels when it is cold enough",
        f"at 300 K it is {at_300[0]:.3f} (ANB) and {at_300[1]:.3f} (HHT)",
        [phi - claim["value"] for phi in at_300],
        "phi_0 at 300 K minus the printed one (ANB, HHT)",
        claim["resolution"],
        low_temperature_fraction,
        "data/materials_{ANB,HHT}.nc: equilibrium_polymer_fraction",
    )
