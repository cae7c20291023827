"""Rule renew_map: this build's seconds, verdict and picture, into what the repository keeps."""

from _helpers import job

with job(snakemake):
    import json
    import shutil
    from pathlib import Path

    from gelpump import build_map
    from gelpump.statements import paper, views
    from gelpump.text import write_json, write_text

    params = snakemake.params
    try:
        manifest, claims = (
            json.loads(Path(path).read_text(encoding="utf-8"))
            for path in ("results/manifest.json", "results/claims.json")
        )
        jobs = build_map.jobs_of_manifest(manifest)
        seconds = {
            name: build_map.measured(f"results/benchmarks/{name}.tsv")
            for name in sorted({*jobs, *params.ends})
        }
    except FileNotFoundError as missing:
        raise SystemExit(
            f"{missing.filename} is missing: run `snakemake --cores 2` first"
        ) from None
    rows = build_map.rows(jobs)
    shown = build_map.model_table(rows, jobs, paper.statements, params.published)
    for page, marker, content in (
        (params.readme, "map", build_map.table(rows, seconds)),
        (params.readme, "verdict", views.headline(claims)),
        (params.models, "map", shown),
    ):
        text = Path(page).read_text(encoding="utf-8")
        write_text(build_map.replaced(marker, text, content), page)
    write_json(seconds, params.seconds)
    shutil.copyfile(params.picture, params.shown)

print(
    f"{len(seconds)} jobs, {sum(seconds.values()):.0f} s: {params.seconds}, {params.readme}",
    flush=True,
)
