"""Rule renew_reference: take this build's numbers as the reference, and say what that changes."""

from _helpers import job

with job(snakemake):
    import json
    from pathlib import Path

    import yaml

    from gelpump.text import write_json
    from gelpump.verify import reference
    from gelpump.verify.build import Build

    params = snakemake.params
    try:
        build = Build()
    except FileNotFoundError as refusal:
        raise SystemExit(str(refusal)) from None
    problems = [each for found in build.problems(params.blocks).values() for each in found]
    data, unreadable = build.datasets()
    listed = yaml.safe_load(Path(params.quantities).read_text(encoding="utf-8"))
    new, absent = reference.evaluated(listed, data)
    problems += unreadable + absent
    if problems:
        raise SystemExit("the reference is kept:\n  " + "\n  ".join(map(str, problems)))
    values = Path(params.values)
    old = json.loads(values.read_text(encoding="utf-8")) if values.exists() else {"values": {}}
    lines = reference.changes(old["values"], new)
    write_json({"numbers_digest": build.manifest["numbers_digest"], "values": new}, values)

print(*lines, f"{len(new)} numbers, {len(lines)} of them changed: {values}", sep="\n", flush=True)
