# The report: everything that was found, on one page that needs no network.


def told(name):
    """What page and article tell of the rule of a figure or a table."""
    made_by = getattr(rules, name)
    return {
        "caption": f"workflow/report/{name}.rst",
        "params": dict(made_by.params.items()),
        "data": sorted(str(file) for file in made_by.input if str(file).endswith(".nc")),
        "files": {suffix: str(file) for suffix, file in made_by.output.items()},
    }


TOLD_FIGURES = {Path(file).stem: told(Path(file).stem) for file in FIGURES if file.endswith(".png")}
TOLD_FIGURES["verification"] = told("verification")
TOLD_TABLES = {Path(file).stem: told(Path(file).stem) for file in TABLES if file.endswith(".csv")}
