"""Tubes that collapse: uniformly, or behind a pulse of heat that pumps water (section 3).

    Tubes, StepHeating            shapes and gels of a family of tubes; the front of heat
    solve                         the tubes behind a front                    (eqn:tube_model)
    deswelling_time, _curve       of tubes that are heated everywhere         (section 3.4)
    response_time                 the same in seconds, from SI units
    sharpness, tube_flow, water_budget   of solved tubes              (sections 3.5 and 3.6)
    pump, wall                    beyond the paper: the balance of all water, walls resolved in r

and the paper's production cases, from blocks of the configuration:

    family, refinement            the tubes of figures 8 to 13, and some on other meshes
    deswelling_map, deswelling_curves                                 (figure 7)
    front_fit.front_fit, lumen_pulse.lumen_pulse     of the family    (figures 9 and 12)
"""

from gelpump.lazy import face

__getattr__, __dir__, __all__ = face(
    __name__,
    {
        "StepHeating": "tube.heat:StepHeating",
        "Tubes": "tube.tubes:Tubes",
        "deswelling_curve": "tube.deswelling:deswelling_curve",
        "deswelling_curves": "tube.uniform:deswelling_curves",
        "deswelling_map": "tube.uniform:deswelling_map",
        "deswelling_time": "tube.deswelling:deswelling_time",
        "family": "tube.production:family",
        "front_fit": "tube.front_fit",
        "lumen_pulse": "tube.lumen_pulse",
        "pump": "tube.pump",
        "refinement": "tube.production:refinement",
        "response_time": "tube.deswelling:response_time",
        "sharpness": "tube.front:sharpness",
        "solve": "tube.slender:solve",
        "tube_flow": "tube.flow_fields:tube_flow",
        "wall": "tube.wall",
        "water_budget": "tube.budget:water_budget",
    },
)
