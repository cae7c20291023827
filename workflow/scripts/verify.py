"""Rule verify: is this build whole, unaltered, of this code, and are its numbers the reference's?

What it finds goes to the terminal and to results/tables/verify.md.
"""

from _helpers import job

with job(snakemake):
    from pathlib import Path

    from gelpump.integrity.examination import examine
    from gelpump.text import write_text

    params = snakemake.params
    try:
        found = examine(params.blocks, Path(params.quantities), Path(params.values))
    except FileNotFoundError as refusal:
        raise SystemExit(str(refusal)) from None
    text = found.markdown()
    write_text(text, "results/tables/verify.md")

print(text, flush=True)
if not found.passed:
    raise SystemExit(1)
