"""From paper to bench: a device in millimetres and seconds, and whether the model holds for it.

    checked(name, block, gels)    a design from a block of quantities such as ``"1 mm"``
    read(path)                    the block of a file, as in config/designs
    results(design)               what the formulae say of it, at once
    before_solving(design)        lights: does the model hold for it?
    assemble(design, numerics)    the solved device with all of this, as one dataset

Its packages come with ``pip install gelpump[design]``.
"""

from gelpump.lazy import face

__getattr__, __dir__, __all__ = face(
    __name__,
    {
        "Design": "design.description:Design",
        "DesignError": "design.description:DesignError",
        "assemble": "design.dataset:assemble",
        "before_solving": "design.validity:before_solving",
        "checked": "design.description:checked",
        "read": "design.description:read",
        "results": "design.device:results",
    },
)
