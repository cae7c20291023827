"""What Snakemake leaves out, misreads or cannot bear of how it was started, mended at the start."""

import os
import re
import shlex
import sys
from argparse import ArgumentParser
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from gelpump.config import ConfigError, require_plain, require_plain_text

NUMBER = re.compile(r"[-+]?\.?\d")  # how a number begins, such as 1e-4, a string to YAML 1.1


def settle() -> None:
    """Make this process one whose jobs can run, whatever its folder and environment.

    Snakemake writes the interpreter's path into lines of a shell without quotes: where it has
    spaces or the like, Python is called by its name, from the front of PATH.  Jobs need
    docstrings (FiPy adds to some), and of FiPy's own switches none.  Params are plain here, so
    Snakemake need not import pandas to ask each of them whether it is a data frame.
    """
    if shlex.quote(sys.executable) != sys.executable:
        folder, sys.executable = os.path.split(sys.executable)
        path = os.environ.get("PATH", os.defpath).split(os.pathsep)
        os.environ["PATH"] = os.pathsep.join([folder, *(each for each in path if each != folder)])
    for name in list(os.environ):
        if name == "PYTHONOPTIMIZE" or name.startswith("FIPY_"):
            del os.environ[name]
    os.environ["FIPY_SOLVERS"] = "scipy"
    from snakemake import persistence

    if kept := getattr(persistence, "PersistenceBase", None):
        kept._serialize_param = property(lambda self: self._serialize_param_builtin)


def complete(workflow: Any, config: dict[str, Any], arguments: Sequence[str] | None = None) -> None:
    """Give ``config`` all that the command line says of it, in place.

    Of several ``--configfile`` (or ``--config``) Snakemake keeps the last alone; here they add up
    as if their values stood behind one, a later one overriding an earlier one.  Numbers inside a
    value of ``--config``, such as ``tube={eps: 0.02}``, are strings to Snakemake, here numbers.
    Raises ConfigError.
    """
    from snakemake.cli import parse_config
    from snakemake.common.configfile import load_configfile
    from snakemake.utils import update_config

    settings = workflow.config_settings
    parser = ArgumentParser(add_help=False)
    parser.add_argument("--configfile", "--configfiles", nargs="*", action="extend", default=[])
    parser.add_argument("--config", "-C", nargs="*", action="extend", default=[])
    named = parser.parse_known_args(arguments)[0]
    files = [Path(file).absolute() for file in named.configfile]
    if settings.configfiles and files[-len(settings.configfiles) :] == settings.configfiles:
        for file in reversed(files[: -len(settings.configfiles)]):
            require_plain(file)
            workflow.configfiles.insert(0, file)
        settings.configfiles = files
    entries = list(settings.config_args or [])
    if entries and named.config[-len(entries) :] == entries:
        entries = settings.config_args = named.config
    whole: dict[str, Any] = {}
    for file in settings.configfiles:
        update_config(whole, load_configfile(file))
    for entry in entries:
        try:
            value = parse_config([entry])
        except ValueError as refusal:
            raise ConfigError(f"--config {entry}: {refusal}") from None
        key, _, text = entry.partition("=")
        if isinstance(value[key], dict | list):
            value[key] = _numbers(require_plain_text(text, f"--config {key}"))
        update_config(whole, value)
    settings.overwrite_config = whole
    update_config(config, whole)


def _numbers(value):
    if isinstance(value, dict):
        return {key: _numbers(each) for key, each in value.items()}
    if isinstance(value, list):
        return [_numbers(each) for each in value]
    if isinstance(value, str) and NUMBER.match(value):
        try:
            return float(value)
        except ValueError:
            return value
    return value
