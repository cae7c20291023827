"""Rule cycle_tube: a tube whose end is heated and cooled, by two solvers, for several periods."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.cycles import production
    from gelpump.materials import from_config

    given = snakemake.params
    gel = from_config(given.tube["gel"], given.gel)
    netcdf.write(
        production.tubes(gel, given.tube, given.settings, given.numerics),
        snakemake.output[0],
        "a tube whose end is heated and cooled",
        {key: given[key] for key in ("gel", "tube", "settings", "numerics")},
        provenance,
    )
