"""Spherical beads, in the LENS and in the fully nonlinear model (section 2.1).

lens.solve, nonlinear.solve   a bead after a jump of temperature, by FiPy and by CVODE
run(model, gel, case, numerics)   a case of the configuration, with its refinement
output_times, initial_polymer_fraction   of a case
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
    },
)
