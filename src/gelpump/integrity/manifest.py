"""The manifest: every output of a build, with what it was made from.

Each job leaves a record of its ingredients and outputs when it ends.  The manifest takes digests
from there, not from the files as they are when it is written, and holds the files against them.
"""

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import gelpump
from gelpump.provenance import digest, packages

# no number in a dataset depends on these parts of the configuration
SHOWN_ONLY = ("figures", "tables", "published")


def numbers_digest(config: Mapping[str, Any]) -> str:
    """Digest of all of the configuration that the numbers in datasets depend on."""
    return digest({key: value for key, value in config.items() if key not in SHOWN_ONLY})


def manifest(
    found: Mapping[str, str],
    records: Mapping[str, Mapping[str, Any]],
    config: Mapping[str, Any],
) -> dict[str, Any]:
    """The manifest of the outputs ``found`` (SHA-256 by path), from the records of the jobs, oldest
    first.

    ValueError, naming all of them, if outputs have no record or are not what their job made.
    """
    made = by_output(records.values(), found)
    problems = [
        f"{path}: {'altered since its job made it' if path in made else 'no record of its job'}"
        for path, sha256 in sorted(found.items())
        if path not in made or made[path]["outputs"][path]["sha256"] != sha256
    ]
    if problems:
        raise ValueError(
            "these outputs are not as the build left them; delete them and build again:\n  "
            + "\n  ".join(problems)
        )
    jobs = {
        name: {key: value for key, value in record.items() if key not in ("outputs", "packages")}
        for name, record in sorted(records.items())
        if any(made.get(path) is record for path in record["outputs"])
    }
    names = {path: name for name in jobs for path in records[name]["outputs"]}
    return {
        "gelpump": gelpump.__version__,
        "config_digest": digest(config),
        "numbers_digest": numbers_digest(config),
        "packages": packages(),
        "outputs": {
            path: {
                **made[path]["outputs"][path],
                "rule": made[path]["rule"],
                "job": names[path],
            }
            for path in sorted(found)
        },
        "jobs": jobs,
    }


def by_output(
    records: Iterable[Mapping[str, Any]], found: Mapping[str, str | None]
) -> dict[str, Mapping[str, Any]]:
    """The record of the job that made each file found: of several, the last.

    A rule that was renamed leaves two, and a file that the older one made was put back by hand.
    """
    return {path: record for record in records for path in record["outputs"] if path in found}


def records(folder: Path) -> dict[str, Mapping[str, Any]]:
    """The records that jobs have left in ``folder``, by their name, oldest first."""
    files = sorted(folder.glob("*.json"), key=lambda path: (path.stat().st_mtime_ns, path.name))
    return {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in files}
