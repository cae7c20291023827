# The paper's tables, as CSV, Markdown and LaTeX.

TABLES = expand(
    "results/tables/{table}.{suffix}",
    table=["table1_tube_parameters", "table2_gel_parameters"],
    suffix=["csv", "md", "tex"],
)


rule table1_tube_parameters:
    input:
        src=modules("table1_tube_parameters"),
    output:
        csv="results/tables/table1_tube_parameters.csv",
        md=report(
            "results/tables/table1_tube_parameters.md",
            caption="../report/table1_tube_parameters.rst",
            category="Tables",
            labels={"table": "1", "shows": "parameters of the tubes"},
        ),
        tex="results/tables/table1_tube_parameters.tex",
    log:
        "results/logs/table1_tube_parameters.log",
    benchmark:
        "results/benchmarks/table1_tube_parameters.tsv"
    params:
        gel=config["gels"][config["tube"]["gel"]],
        tube=config["tube"],
    script:
        "../scripts/table1_tube_parameters.py"


rule table2_gel_parameters:
    input:
        src=modules("table2_gel_parameters"),
    output:
        csv="results/tables/table2_gel_parameters.csv",
        md=report(
            "results/tables/table2_gel_parameters.md",
            caption="../report/table2_gel_parameters.rst",
            category="Tables",
            labels={"table": "2", "shows": "parameters of the gels"},
        ),
        tex="results/tables/table2_gel_parameters.tex",
    log:
        "results/logs/table2_gel_parameters.log",
    benchmark:
        "results/benchmarks/table2_gel_parameters.tsv"
    params:
        gels={
            name: config["gels"][name]
            for name in config["tables"]["table2_gel_parameters"]["gels"]
        },
    script:
        "../scripts/table2_gel_parameters.py"
