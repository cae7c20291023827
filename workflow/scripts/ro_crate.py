"""Rule ro_crate: the results as a research object that others' tools can read."""

from _helpers import job

with job(snakemake) as provenance:
    import json
    from pathlib import Path

    from gelpump.integrity.crate import crate
    from gelpump.text import write_json

    manifest = Path(snakemake.input.manifest)
    write_json(
        crate(
            json.loads(manifest.read_text(encoding="utf-8")),
            provenance.inputs[str(manifest)],
            manifest.stat().st_size,
        ),
        snakemake.output[0],
    )
