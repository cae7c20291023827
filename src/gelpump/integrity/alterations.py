"""Are the files of a build those that were made, from what is there now?"""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from gelpump.integrity.manifest import by_output
from gelpump.integrity.problem import Problem

Digest = Callable[[str], str | None]

# made beside the outputs that the manifest lists, or by hand
NOT_LISTED = {
    "results/README.md",
    "results/manifest.json",
    "results/ro-crate-metadata.json",
    "results/tables/verify.md",
}
NOT_RESULTS = (
    "results/logs/",
    "results/benchmarks/",
    "results/provenance/",
    "results/designs/",  # asked for by name, as are the others: not of the paper's build
    "results/gels/",
    "results/sweeps/",
)


def changed(
    manifest: Mapping[str, Any], records: Iterable[Mapping[str, Any]], digest: Digest
) -> list[Problem]:
    """Outputs that are missing, or not as the manifest lists them."""
    found = {path: digest(path) for path in manifest["outputs"]}
    made = by_output(records, found)
    problems = []
    for path, listed in manifest["outputs"].items():
        if found[path] is None:
            problems.append(Problem(path, "missing", "the manifest lists it"))
        elif found[path] != listed["sha256"]:
            if path in made and made[path]["outputs"][path]["sha256"] == found[path]:
                why = "made again since the manifest was: finish with `snakemake --cores 2`"
                problems.append(Problem(path, "newer", why))
            else:
                why = f"sha256 is {found[path][:12]}…, was {listed['sha256'][:12]}…"
                problems.append(Problem(path, "altered", why))
    return problems


def stale(
    manifest: Mapping[str, Any], blocks: Mapping[str, str | None], digest: Digest
) -> list[Problem]:
    """Outputs made from code, inputs or configuration that have changed since.

    ``blocks``: digest of what each job takes from the configuration now, None for a rule that is
    gone; a digest of None says that a file is gone.
    """
    problems = []
    for name, job in manifest["jobs"].items():
        reasons = []
        for kind, files in (("module", job["code"]), ("input", job["inputs"])):
            for path, sha256 in files.items():
                now = digest(path)
                if now != sha256:
                    reasons.append(f"{kind} {path} {'is gone' if now is None else 'has changed'}")
        if blocks.get(name) is None:
            reasons.append(f"rule {job['rule']} does not make it any more")
        elif blocks[name] != job["config_digest"]:
            reasons.append("its part of the configuration has changed")
        problems += [
            Problem(path, "stale", "; ".join(reasons))
            for path, output in manifest["outputs"].items()
            if reasons and output["job"] == name
        ]
    return problems


def leftovers(files: Iterable[str], manifest: Mapping[str, Any]) -> list[Problem]:
    """Files below results/ that no rule of this build made."""
    return [
        Problem(path, "leftover", "no rule of this build made it")
        for path in sorted(files)
        if path not in manifest["outputs"]
        and path not in NOT_LISTED
        and not path.startswith(NOT_RESULTS)
    ]
