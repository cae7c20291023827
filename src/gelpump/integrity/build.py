"""A finished build as it lies on the disk."""

import json
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gelpump import netcdf
from gelpump.integrity import alterations
from gelpump.integrity.crate import crate
from gelpump.integrity.manifest import records
from gelpump.integrity.problem import Problem
from gelpump.provenance import file_digest

if TYPE_CHECKING:
    import xarray as xr

RESULTS = Path("results")
MANIFEST = RESULTS / "manifest.json"
NUMBERS = "tables/figure_numbers.json", "claims.json", "beyond.json"  # below RESULTS
CRATE = RESULTS / "ro-crate-metadata.json"
NO_BUILD = f"there is no build here ({MANIFEST} is missing): run `snakemake --cores 2` first"


class Build:
    """The build below the working directory; FileNotFoundError if there is none."""

    def __init__(self):
        try:
            self.manifest = _read(MANIFEST)
        except FileNotFoundError as missing:
            raise FileNotFoundError(NO_BUILD) from missing
        self.records = list(records(RESULTS / "provenance").values())
        self.digest = cache(_digest)

    def problems(self, blocks: Mapping[str, str | None]) -> dict[str, list[Problem]]:
        """Files that are altered, missing, stale or left over; the name of the check before."""
        files = [path.as_posix() for path in RESULTS.rglob("*") if path.is_file()]
        return {
            "outputs are as they were made": [
                *alterations.changed(self.manifest, self.records, self.digest),
                *self._crate_problems(),
            ],
            "outputs are of this code and configuration": alterations.stale(
                self.manifest, blocks, self.digest
            ),
            "nothing is left over": alterations.leftovers(files, self.manifest),
        }

    def _crate_problems(self) -> list[Problem]:
        sha256 = self.digest(MANIFEST.as_posix())
        expected = crate(self.manifest, sha256, MANIFEST.stat().st_size)
        try:
            same = _read(CRATE) == expected
        except FileNotFoundError:
            return [Problem(CRATE.as_posix(), "missing", "every build writes it")]
        except ValueError as failure:
            return [Problem(CRATE.as_posix(), "altered", str(failure))]
        why = "does not follow from the manifest"
        return [] if same else [Problem(CRATE.as_posix(), "altered", why)]

    def dataset_files(self) -> list[str]:
        """Datasets of the manifest that are there."""
        return [p for p in self.manifest["outputs"] if p.endswith(".nc") and Path(p).exists()]

    def datasets(self) -> tuple[dict[str, "xr.Dataset"], list[Problem]]:
        """Datasets by their name below results/data, and those that cannot be read."""
        data, problems = {}, []
        for path in self.dataset_files():
            try:
                data |= netcdf.read_all([path], RESULTS / "data")
            except (OSError, ValueError) as failure:
                problems.append(Problem(path, "unreadable", str(failure)))
        return data, problems

    def figure_numbers(self) -> list[dict[str, Any]]:
        """The numbers of the figures and of the statements; none of a file that is not there."""
        shown, claims, beyond = (
            _read(path) if path.exists() else [] for path in (RESULTS / name for name in NUMBERS)
        )
        return shown + [
            {"figure": "statement", "quantity": each["id"], "value": each["computed"]}
            | {"uncertainty": each["uncertainty"]}
            for each in claims + beyond
            if isinstance(each["computed"], float | list)
        ]

    @property
    def shown_digest(self) -> str:
        """Digest of what of the configuration decides which key numbers there are."""
        return self.manifest["jobs"]["statements"]["config_digest"]


def _read(path: Path) -> Any:
    return json.loads(path.read_text(encoding="utf-8"))


def _digest(path: str) -> str | None:
    try:
        return file_digest(path)
    except FileNotFoundError:
        return None
