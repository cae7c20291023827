# The replication article: what was found, as a PDF whose numbers all come from the results.


rule article:
    input:
        drawings=[figure for figure in FIGURES if figure.endswith(".svg")]
        + ["results/figures/verification.svg"],
        tables=[table for table in TABLES if table.endswith(".csv")],
        told=[
            *rules.statements.output,
            "results/verification.json",
            "results/cross_check.json",
            "CITATION.cff",
        ],
        seconds="workflow/reference/seconds.json",
        captions=[f"workflow/report/{name}.rst" for name in [*TOLD_FIGURES, *TOLD_TABLES]],
        frame=["src/gelpump/article/article.typ", "src/gelpump/article/references.yml"],
        src=modules("article"),
    output:
        report(
            "results/replication.pdf",
            caption="../report/article.rst",
            category="Article",
            labels={"shows": "the replication article"},
        ),
    log:
        "results/logs/article.log",
    benchmark:
        "results/benchmarks/article.tsv"
    resources:
        own_interpreter=1,  # typesetting takes much memory, and nothing that others import
    params:
        config=config,
        figures=TOLD_FIGURES,
        tables=TOLD_TABLES,
    script:
        "../scripts/article.py"
