"""An RO-Crate 1.3 of the results, made from the manifest alone."""

from collections.abc import Iterable, Mapping
from pathlib import PurePosixPath
from typing import Any

from gelpump.netcdf import PAPER

RELEASED = "2026-11-22"  # of gelpump.__version__; a crate must have a date, a build must not
FORMATS = {
    ".nc": "application/netcdf",
    ".json": "application/json",
    ".md": "text/markdown",
    ".csv": "text/csv",
    ".tex": "application/x-tex",
    ".pdf": "application/pdf",
    ".png": "image/png",
    ".svg": "image/svg+xml",
    ".html": "text/html",
}
LICENSE = "https://spdx.org/licenses/MIT"


def crate(manifest: Mapping[str, Any], sha256: str, size: int) -> dict[str, Any]:
    """The metadata document for results/; ``sha256`` and ``size`` are those of the manifest."""
    listed = {**manifest["outputs"], "results/manifest.json": {"sha256": sha256, "size": size}}
    files = [_file(path, output) for path, output in sorted(listed.items())]
    actions = [_action(name, job, manifest) for name, job in sorted(manifest["jobs"].items())]
    root = {
        "@id": "./",
        "@type": "Dataset",
        "name": "gelpump: a replication of Poromechanical modelling of responsive hydrogel pumps",
        "description": f"Datasets, figures, tables and verdicts of a replication of {PAPER}",
        "datePublished": RELEASED,
        "license": _link(LICENSE),
        "author": _link("#developers"),
        "publisher": _link("#developers"),
        "hasPart": [_link(file["@id"]) for file in files],
        "mentions": [_link(action["@id"]) for action in actions],
    }
    about = [
        {
            "@id": "ro-crate-metadata.json",
            "@type": "CreativeWork",
            "conformsTo": _link("https://w3id.org/ro/crate/1.3"),
            "about": _link("./"),
        },
        root,
        {
            "@id": LICENSE,
            "@type": "CreativeWork",
            "name": "MIT License",
            "description": "Free to use, change and distribute with the copyright notice.",
        },
        {"@id": "#developers", "@type": "Organization", "name": "The gelpump developers"},
        {
            "@id": "#gelpump",
            "@type": "CreativeWork",  # an application must have a url
            "name": "gelpump",
            "version": manifest["gelpump"],
            "softwareRequirements": [f"{n} {v}" for n, v in manifest["packages"].items()],
        },
    ]
    return {
        "@context": "https://w3id.org/ro/crate/1.3/context",
        "@graph": [*about, *files, *actions],
    }


def _link(identifier: str) -> dict[str, str]:
    return {"@id": identifier}


def _links(paths: Iterable[str]) -> dict[str, str] | list[dict[str, str]]:
    links = [_link(_below_results(path)) for path in paths]
    return links[0] if len(links) == 1 else links


def _below_results(path: str) -> str:
    return str(PurePosixPath(path).relative_to("results"))


def _file(path: str, output: Mapping[str, Any]) -> dict[str, Any]:
    return {
        "@id": _below_results(path),
        "@type": "File",
        "name": PurePosixPath(path).name,
        "encodingFormat": FORMATS[PurePosixPath(path).suffix],
        "contentSize": str(output["size"]),
        "sha256": output["sha256"],
    }


def _action(name: str, job: Mapping[str, Any], manifest: Mapping[str, Any]) -> dict[str, Any]:
    outputs = (path for path, output in manifest["outputs"].items() if output["job"] == name)
    inputs = [path for path in job["inputs"] if path in manifest["outputs"]]
    return {
        "@id": f"#{name}",
        "@type": "CreateAction",
        "name": f"rule {job['rule']}",
        "description": f"code sha256:{job['code_digest']}, config sha256:{job['config_digest']}",
        "instrument": _link("#gelpump"),
        "result": _links(outputs),
        **({"object": _links(inputs)} if inputs else {}),
    }
