"""The paper's configuration, as the workflow reads it."""

from functools import cache
from pathlib import Path

import yaml

from gelpump import config as checked

PROJECT = Path(__file__).resolve().parents[1]


@cache
def paper() -> dict:
    """config/config.yaml with the schema's defaults."""
    config = yaml.safe_load((PROJECT / "config/config.yaml").read_text(encoding="utf-8"))
    schema = (PROJECT / "workflow/schemas/config.schema.yaml").read_text(encoding="utf-8")
    checked.fill_defaults(config, yaml.safe_load(schema))
    return config
