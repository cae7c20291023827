"""Rule manifest: every output, with what it was made from."""

from _helpers import job

with job(snakemake) as provenance:
    from pathlib import Path

    from gelpump.integrity.manifest import manifest, records
    from gelpump.text import write_json

    made = records(Path("results/provenance"))
    write_json(manifest(provenance.inputs, made, snakemake.params.config), snakemake.output[0])
