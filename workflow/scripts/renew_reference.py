"""Rule renew_reference: take this build's numbers as the reference, and say what that changes."""

from _helpers import job

with job(snakemake):
    import json
    from pathlib import Path

    import yaml

    from gelpump.integrity import reference
    from gelpump.integrity.build import Build
    from gelpump.text import write_text

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
    old = {"values": {}, "figures": {}}
    if values.exists():
        old |= json.loads(values.read_text(encoding="utf-8"))
    shown = reference.of_figures(build.figure_numbers())
    lines = reference.changes(old["values"], new) + reference.changes(old["figures"], shown)
    digests = {
        "numbers_digest": build.manifest["numbers_digest"],
        "shown_digest": build.shown_digest,
    }
    write_text(reference.as_text({**digests, "values": new, "figures": shown}), values)
    count = len(new) + len(shown)

print(*lines, f"{count} numbers, {len(lines)} of them changed: {values}", sep="\n", flush=True)
