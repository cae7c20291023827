"""gelpump: a replication of Webber & Montenegro-Johnson (2025) on responsive hydrogel pumps.

    gels      materials by their free energy or their moduli: `gelpump.materials`  (section 2)
    bead      beads that swell and dry                                           (section 2.1)
    tube      tubes that collapse, everywhere or behind a front                    (section 3)
    design    devices in SI units; needs ``pip install gelpump[design]``
    open_dataset(path)   the whole of a dataset that gelpump wrote, as xarray has it

docs/tutorial.py is a walk through these in four steps.
"""

from gelpump.lazy import face

__version__ = "0.1.0"

__getattr__, __dir__, __all__ = face(
    __name__,
    {
        "gels": "materials",
        "bead": "bead",
        "tube": "tube",
        "design": "design",
        "open_dataset": "netcdf:read",
    },
)
