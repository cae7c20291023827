"""Spherical beads, in the LENS and in the fully nonlinear model (section 2.1).

    lens.solve, nonlinear.solve   a bead after a jump of temperature, by FiPy and by CVODE

and the paper's production cases, from blocks of the configuration:

    run(model, gel, case, numerics)   one with its refinement; model: `lens` or `nonlinear`
    sensitivity.of_case               what printed digits leave open of it
    output_times, initial_polymer_fraction
"""

from gelpump.lazy import face

__getattr__, __dir__, __all__ = face(
    __name__,
    {
        "lens": "bead.lens",
        "nonlinear": "bead.nonlinear",
        "initial_polymer_fraction": "bead.production:initial_polymer_fraction",
        "output_times": "bead.production:output_times",
        "run": "bead.production:run",
        "sensitivity": "bead.sensitivity",
    },
)
