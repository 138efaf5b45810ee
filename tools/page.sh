#!/usr/bin/env bash
# Whether what a run is looked at by works: the page in headless Chromium, glTF by the Khronos validator, NumPy's arrays by NumPy.
#   bash tools/page.sh COMMAND      the built command, as target/debug/lgvi
set -euo pipefail
command=$(realpath "$1")
cd "$(dirname "$0")/.."
made=${CARGO_TARGET_DIR:-target}/page
mkdir -p "$made"

if ! command -v chromium > /dev/null; then
  root=$([ "$(id -u)" = 0 ] || echo sudo)
  $root apt-get update -qq
  $root apt-get install -y -qq --no-install-recommends chromium > /dev/null
fi
if [ ! -d "$made/node_modules/gltf-validator" ]; then
  npm install --silent --no-audit --no-fund --prefix "$made" gltf-validator@2.0.0-dev.3.10
fi
python=python3
if ! python3 -c 'import numpy' 2> /dev/null; then
  python=$made/python/bin/python
  [ -x "$python" ] || python3 -m venv "$made/python"
  "$python" -m pip install --quiet 'numpy==2.*'
fi
"$python" tools/page/check.py "$command" "$made"
NODE_PATH="$made/node_modules" node tools/page/validate.js "$made"/*.glb
