"""Rule article: the content of this build, typeset."""

from _helpers import job

with job(snakemake):
    import json
    from pathlib import Path

    from gelpump.article.telling import telling
    from gelpump.article.typeset import typeset
    from gelpump.report.content import gather

    params = snakemake.params
    content = gather(params.config, params.figures, params.tables, digests={})
    seconds = json.loads(Path(snakemake.input.seconds).read_text(encoding="utf-8"))
    drawings = {Path(file).stem: Path(file) for file in snakemake.input.drawings}
    typeset(telling(content, params.config, seconds), drawings, snakemake.output[0])
