"""Does the public validator of RO-Crates accept the one of a build?  Without a network.

    python tests/crate/run.py results

in an environment of its own (requirements.txt beside this file).  The validator wants the JSON-LD
context that the crate names from the network; it is put into its cache from the `rocrate` package,
which ships it.  A crate of two of the files must then be accepted too, and refused when it is
broken, in three ways.  Exit status 1 if one of the five verdicts is wrong.
"""

import json
import shutil
import sys
import tempfile
from importlib.resources import files
from io import BytesIO
from pathlib import Path
from typing import Any

from requests.adapters import HTTPAdapter
from requests_cache import CachedSession
from rocrate_validator import models, services
from urllib3 import HTTPResponse

METADATA = "ro-crate-metadata.json"
PROFILE = "ro-crate-1.3"


class Shipped(HTTPAdapter):
    """Answers with what a package ships."""

    def __init__(self, content: bytes):
        super().__init__()
        self.content = content

    def send(self, request, **_):
        headers = {"Content-Type": "application/ld+json"}
        body = BytesIO(self.content)
        return self.build_response(
            request, HTTPResponse(body, headers, status=200, preload_content=False)
        )


def fill(cache: Path, context: str) -> None:
    """Put the shipped context into the validator's cache, as if it had been fetched."""
    content = files("rocrate").joinpath("data/ro-crate.jsonld").read_bytes()
    shipped = json.loads(content)["@id"]
    if shipped != context:
        raise SystemExit(f"the crate names {context}, rocrate ships {shipped}")
    session = CachedSession(str(cache), backend="sqlite", expire_after=-1)
    session.mount(context, Shipped(content))
    session.get(context, headers={"Accept": "application/ld+json, application/json"})
    session.get(context)


def refusals(crate: Path, cache: Path) -> list[str]:
    """What the validator requires and does not find."""
    result = services.validate(
        services.ValidationSettings(
            rocrate_uri=str(crate),
            profile_identifier=PROFILE,
            requirement_severity=models.Severity.REQUIRED,
            offline=True,
            cache_path=cache,
        )
    )
    return [f"{issue.check.identifier}: {issue.message}" for issue in result.get_issues()]


def root(document: dict[str, Any]) -> dict[str, Any]:
    return next(entity for entity in document["@graph"] if entity["@id"] == "./")


def small(document: dict[str, Any], results: Path, crate: Path) -> dict[str, Any]:
    """A crate of the first two files only, and of what is said about all: soon validated."""
    kept = root(document)["hasPart"][:2]
    gone = {"CreateAction", "File"}
    graph = [
        entity
        for entity in json.loads(json.dumps(document))["@graph"]
        if entity["@type"] not in gone or {"@id": entity["@id"]} in kept
    ]
    part = {"@context": document["@context"], "@graph": graph}
    root(part)["hasPart"] = kept
    del root(part)["mentions"]
    for file in kept:
        (crate / file["@id"]).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(results / file["@id"], crate / file["@id"])
    return part


def unbroken(document: dict[str, Any], crate: Path) -> None:
    """Nothing."""


def without_license(document: dict[str, Any], crate: Path) -> None:
    del root(document)["license"]


def without_a_file(document: dict[str, Any], crate: Path) -> None:
    (crate / root(document)["hasPart"][0]["@id"]).unlink()


def without_a_type(document: dict[str, Any], crate: Path) -> None:
    file = root(document)["hasPart"][0]["@id"]
    del next(entity for entity in document["@graph"] if entity["@id"] == file)["@type"]


def main(results: Path) -> int:
    document = json.loads((results / METADATA).read_text(encoding="utf-8"))
    wrong = 0
    with tempfile.TemporaryDirectory(prefix="crate-") as folder:
        cache = Path(folder) / "cache"
        fill(cache, document["@context"])
        found = refusals(results, cache)
        print(f"{'REFUSED' if found else 'accepted'}: {results / METADATA}")
        print("".join(f"  {refusal}\n" for refusal in found), end="")
        wrong += bool(found)
        for spoil in (unbroken, without_license, without_a_file, without_a_type):
            crate = Path(folder) / spoil.__name__
            crate.mkdir()
            part = small(document, results, crate)
            spoil(part, crate)
            (crate / METADATA).write_text(json.dumps(part), encoding="utf-8")
            found = refusals(crate, cache)
            print(f"{f'refused: {found[0]}' if found else 'accepted'} ({spoil.__name__})")
            wrong += bool(found) == (spoil is unbroken)
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
