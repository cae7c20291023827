"""What an output was made from: code, configuration, packages and inputs, each by its digest.

Neither dates nor commits nor absolute paths: equal ingredients give an equal record, whichever
the checkout, and an edit elsewhere in the repository changes nothing here.
"""

import hashlib
import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

import gelpump

PACKAGES = ("fipy", "matplotlib", "netCDF4", "numpy", "scikit-sundae", "scipy", "xarray")


def file_digest(path: str | Path) -> str:
    """SHA-256 of a file's bytes; OSError if it cannot be read."""
    with open(path, "rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def file_digests(paths: Iterable[str | Path]) -> dict[str, str]:
    """SHA-256 of each file, by its path as given, in the order of the paths."""
    return {str(path): file_digest(path) for path in sorted(paths, key=str)}


def digest(value: Any) -> str:
    """SHA-256 of a value made of what JSON knows, whatever the order of its keys."""
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).hexdigest()


@cache
def packages() -> dict[str, str]:
    """Versions of the packages that numbers and figures depend on."""
    return {name: version(name) for name in PACKAGES}


@dataclass(frozen=True)
class Provenance:
    """The ingredients of one job: digests of files by path, and of its block of the config."""

    rule: str
    wildcards: Mapping[str, str]
    code: Mapping[str, str]
    inputs: Mapping[str, str]
    config: str

    def attributes(self) -> dict[str, str]:
        """As attributes of a dataset."""
        return {
            "code_version": f"gelpump {gelpump.__version__}, sha256:{digest(self.code)}",
            "config_digest": f"sha256:{self.config}",
            "package_versions": ", ".join(f"{name} {v}" for name, v in packages().items()),
            "input_digests": json.dumps(self.inputs, sort_keys=True),
        }

    def text(self) -> str:
        """As one line of ASCII, for the metadata of figures."""
        return json.dumps(self.attributes(), sort_keys=True)

    def record(self, outputs: Iterable[str | Path]) -> dict[str, Any]:
        """Everything, with digests and sizes of the finished outputs."""
        return {
            "rule": self.rule,
            "wildcards": dict(self.wildcards),
            "code_digest": digest(self.code),
            "config_digest": self.config,
            "code": dict(self.code),
            "inputs": dict(self.inputs),
            "packages": packages(),
            "outputs": {
                path: {"sha256": sha256, "size": Path(path).stat().st_size}
                for path, sha256 in file_digests(outputs).items()
            },
        }


def age_restored(records: Path = Path("results/provenance")) -> None:
    """Make what failed jobs gave back as old as it was, by the records of the jobs that made it.

    Snakemake restores copies, which would pass for results of what has changed since.
    """
    for record in records.rglob("*.json"):
        made = record.stat().st_mtime
        for output in json.loads(record.read_text("utf-8"))["outputs"]:
            if os.path.exists(output) and os.path.getmtime(output) > made + 1:
                os.utime(output, (made, made))
