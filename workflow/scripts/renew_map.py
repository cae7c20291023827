"""Rule renew_map: this build's seconds, verdict and picture, into what the repository keeps."""

from _helpers import job

with job(snakemake):
    import json
    import shutil
    from pathlib import Path

    from gelpump import build_map
    from gelpump.statements import views
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
    readme = Path(params.readme)
    text = readme.read_text(encoding="utf-8")
    for marker, content in (
        ("map", build_map.table(build_map.rows(jobs), seconds)),
        ("verdict", views.headline(claims)),
    ):
        text = build_map.replaced(marker, text, content)
    write_json(seconds, params.seconds)
    write_text(text, readme)
    shutil.copyfile(params.picture, params.shown)

print(f"{len(seconds)} jobs, {sum(seconds.values()):.0f} s: {params.seconds}, {readme}", flush=True)
