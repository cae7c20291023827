"""Rule pump_balance: all water of the tubes by each closure, and what geometry says of it."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.coordinates import merged
    from gelpump.materials import from_config
    from gelpump.tube import production, pump
    from gelpump.tube.heat import StepHeating
    from gelpump.tube.tubes import Tubes, one_by_one

    params, output = snakemake.params, snakemake.output
    gel = from_config(params.tube["gel"], params.gel)
    heat = StepHeating(params.tube["Le"])
    tubes = Tubes(params.pulse["ell"], params.tube["eps"], gel.M, gel.Pi_ratio, gel.Phi_inf)
    others, varied = one_by_one(gel, params.tube, params.response)
    tau = merged(params.response["tau"], production.family_tau(params.pulse))
    pulses = pump.closures(tubes, heat, tau, params.numerics, others)
    coarse = pump.closures(tubes, heat, tau, pump.coarser(params.numerics))
    given = {
        "tube": params.tube,
        "gel": params.gel,
        "tube_pulse": params.pulse,
        "pump_response": params.response,
        "numerics": params.numerics,
    }
    for dataset, path, title in (
        (
            pump.balance(pulses, heat, coarse),
            output.balance,
            "the water of collapsing tubes, by closure",
        ),
        (pump.joined(pulses), output.pulse, "tubes that collapse behind a pulse, water conserved"),
        (
            pump.response(pulses["others"], varied, params.response["tau"]),
            output.response,
            "what tubes pump, by their shape and their gel",
        ),
    ):
        netcdf.write(dataset, path, title=title, parameters=given, provenance=provenance)
