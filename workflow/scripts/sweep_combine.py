"""Rule sweep_combine: one dataset of all chunks."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump.sweep import combine

    failed = combine.combine(
        snakemake.input.chunks,
        snakemake.output[0],
        snakemake.params.designs,
        "a sweep: response of tubes behind a pulse of heat",
        snakemake.params.sweep,
        {"config_digest": f"sha256:{provenance.config}"},
    )
    print(f"{failed} of {snakemake.params.designs} designs failed")
