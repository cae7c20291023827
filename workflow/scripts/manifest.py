"""Rule manifest: every output, with what it was made from."""

from _helpers import job

with job(snakemake) as provenance:
    import json
    from pathlib import Path

    from gelpump.text import write_json
    from gelpump.verify.manifest import manifest

    records = {
        path.stem: json.loads(path.read_text(encoding="utf-8"))
        for path in sorted(Path("results/provenance").glob("*.json"))
    }
    write_json(manifest(provenance.inputs, records, snakemake.params.config), snakemake.output[0])
