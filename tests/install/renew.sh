#!/usr/bin/env bash
# Pins anew what pyproject.toml asks for, with uv: ./tests/install/renew.sh [--upgrade].
# Without --upgrade what is pinned stays, as far as it can.  Then: python tests/install/wheels.py
set -euo pipefail
cd "$(dirname "$0")/../.."
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT
cat requirements.txt requirements-test.txt 2> /dev/null | grep -E "^[a-z].*==" | grep -vE "^(netcdf4|cf-units)" > "$scratch/kept.txt" || true
[ "${1:-}" != --upgrade ] || : > "$scratch/kept.txt"

from=pyproject.toml
pins() { # extras...
  uv pip compile -q "$from" "${@/#/--extra=}" --universal --python-version 3.11 \
    --strip-extras --no-annotate --no-header --override tests/install/overrides.txt \
    -c "$scratch/kept.txt" "${hashes[@]}" | grep -v "sys_platform == 'win32'$"
}
hashes=()
pins workflow design sweep report > "$scratch/rebuild.txt"
pins dev > "$scratch/all.txt"
{
  echo "# What a rebuild needs, pinned, transitive packages too (Python 3.11 to 3.14)."
  echo "# Renew: tests/install/renew.sh.  requirements.lock holds the same with hashes."
  cat "$scratch/rebuild.txt"
  echo "-e ."
} > requirements.txt
{
  echo "# What the tests need besides."
  echo "-r requirements.txt"
  grep -vxFf "$scratch/rebuild.txt" "$scratch/all.txt"
} > requirements-test.txt
python3 -c "
import tomllib
extras = tomllib.load(open('pyproject.toml', 'rb'))['project']['optional-dependencies']
print(*extras['docs'], sep='\n')" > "$scratch/docs.in"
[ "${1:-}" = --upgrade ] || cp requirements-docs.txt "$scratch/kept.txt"
{
  echo "# What the site of docs/ needs, in an environment of its own: .ci/run builds it."
  echo "# Renew: tests/install/renew.sh."
  from="$scratch/docs.in" pins # alone: nothing is imported for the site
} > requirements-docs.txt
hashes=(--generate-hashes)
cp "$scratch/rebuild.txt" "$scratch/kept.txt"
{
  echo "# pip install --require-hashes -r requirements.lock && pip install --no-deps -e ."
  pins workflow design sweep report
} > requirements.lock
