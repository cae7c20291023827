"""The page's designer alone, as a page that needs no build."""

from pathlib import Path

import yaml

from gelpump.report import designer, page

PROJECT = Path(__file__).parents[2]


def _read(path):
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def gels():
    """The gels of the configuration and those of the literature."""
    found = _read(PROJECT / "config/config.yaml")["gels"]
    for file in sorted((PROJECT / "config/gels").glob("*.yaml")):
        found |= {k: v for k, v in _read(file)["gels"].items() if v["model"] in designer.MODELS}
    return found


def told():
    """What the designer takes from Python."""
    files = (PROJECT / f"config/designs/{name}.yaml" for name in ("microtube", "millitube"))
    return designer.designer(gels(), {file.stem: _read(file) for file in files})


def html():
    """A page with the designer only."""
    found = page.environment(PROJECT)
    section = found.get_template("design.html").render(designer=told())
    names = [name for name in page.SCRIPTS if name != "start"]
    data = page.embed({"colours": page.colours(), "design": told()})
    return f"""<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>Designer</title>
<meta name="viewport" content="width=device-width, initial-scale=1"><link rel="icon" href="data:,">
<style>{(page.TEMPLATES / "page.css").read_text("utf-8")}</style></head><body><h1>Alone</h1>
<button type="button" id="theme">Dark</button><main>{section}</main>
<script type="application/json" id="data">{data}</script><script>(() => {{ "use strict";
{page.scripts(names)}
const data = JSON.parse(document.getElementById("data").textContent);
root.classList.add("scripted"); startTheme(); new Designer(); }})();</script></body></html>"""
