"""Rule verification: the FiPy solvers on problems whose solutions are known."""

from _helpers import job

with job(snakemake) as provenance:
    from gelpump.figures import style, verification
    from gelpump.known_solutions import bead, study, tube
    from gelpump.text import write_json, write_text

    studies = [*bead.studies(), *tube.studies()]
    print(study.markdown(studies))
    study.require_all(studies)
    records = [each.record() for each in studies]
    write_json(records, snakemake.output.json)
    write_text(study.markdown(studies), snakemake.output.md)
    with style.styled():
        style.save(
            verification.draw(records),
            [snakemake.output.pdf, snakemake.output.png, snakemake.output.svg],
            provenance,
        )
