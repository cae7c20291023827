"""Rule verify: is this build whole, unaltered, of this code, and are its numbers the reference's?

What it finds goes to the terminal and to results/tables/verify.md.
"""

from _helpers import job

with job(snakemake):
    import json
    from pathlib import Path

    import yaml

    from gelpump.text import write_text
    from gelpump.verify import conventions, reference, table
    from gelpump.verify.build import Build

    params = snakemake.params
    try:
        build = Build()
    except FileNotFoundError as refusal:
        raise SystemExit(str(refusal)) from None
    checks = build.problems(params.blocks)
    checks["datasets follow CF-1.11"] = conventions.problems(build.dataset_files())
    data, unreadable = build.datasets()
    checks["datasets can be read"] = unreadable
    known = json.loads(Path(params.values).read_text(encoding="utf-8"))
    rows, notes = [], []
    if known["numbers_digest"] == build.manifest["numbers_digest"]:
        listed = yaml.safe_load(Path(params.quantities).read_text(encoding="utf-8"))
        here, absent = reference.evaluated(listed, data)
        rows, differing = reference.compared(known["values"], here)
        checks["numbers agree with the reference"] = absent + differing
    else:
        notes.append(
            "the numbers were NOT compared: the reference is for the paper's configuration "
            f"(digest {known['numbers_digest'][:12]}), this build has another one "
            f"(digest {build.manifest['numbers_digest'][:12]})."
        )
    text = table.markdown(checks, rows, notes)
    write_text(text, "results/tables/verify.md")

print(text, flush=True)
if any(checks.values()):
    raise SystemExit(1)
