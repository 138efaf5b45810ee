#!/usr/bin/env bash
# Builds the wheel, installs it in an environment of its own, and runs the tests against it: `bash python/test.sh`.
# It takes the profile and the target directory of `cargo test`, whose dependencies are built already.
set -euo pipefail
cd "$(dirname "$0")"
target="${CARGO_TARGET_DIR:-$PWD/../target}"
environment="$target/python"
[ -x "$environment/bin/maturin" ] || python3 -m venv "$environment"
"$environment/bin/pip" install --quiet --disable-pip-version-check "maturin>=1.9,<2" numpy pytest
rm -rf "$environment/wheels"
CARGO_TARGET_DIR="$target" "$environment/bin/maturin" build --quiet --profile dev --out "$environment/wheels" --interpreter "$environment/bin/python"
"$environment/bin/pip" install --quiet --disable-pip-version-check --force-reinstall --no-deps "$environment"/wheels/lgvi-*.whl
# From another folder: the package is the installed one.
cd tests
LGVI_COMMAND="${LGVI_COMMAND:-$target/debug/lgvi}" "$environment/bin/python" -m pytest -q -p no:cacheprovider "$@"
