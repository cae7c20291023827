"""Rule cycle_beads: beads along temperature programmes, loops of a(T)."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump import netcdf
    from gelpump.cycles import production
    from gelpump.materials import from_config

    given = snakemake.params
    gels = {name: from_config(name, block) for name, block in given.gels.items()}
    netcdf.write(
        production.loops(gels, given.beads["cases"], given.beads["outputs"]),
        snakemake.output[0],
        "beads that are heated and cooled",
        {"gels": given.gels, "beads": given.beads},
        provenance,
    )
