#!/usr/bin/env bash
# Pictures of runs, to be looked at: screenshots in out/shots, and the moving pictures of the README and of docs/urdf.md.
#   bash docs/shots.sh COMMAND      the built command, as target/release/lgvi; Chromium, and Python with Pillow
set -euo pipefail
command=$(realpath "$1")
cd "$(dirname "$0")/.."
shots=out/shots
mkdir -p "$shots"
page() { # NAME SCENE SECONDS [OPTION...]
  "$command" run "$2" --until "$3" --out "$shots/$1.html" "${@:4}" > "$shots/$1.txt"
}
python3 tools/page/star.py > "$shots/star.toml"
page fish scenes/fish-chain.toml 20
page eel scenes/eel.toml 12
page robot scenes/branching-robot.toml 10
page arm scenes/loads/arm.toml 20
page foil scenes/swim/foil.toml 6
page star "$shots/star.toml" 20
page beside scenes/fish-chain.toml 60 --beside dp54
page swimming scenes/swim/fish.toml 30
page swimming-eel scenes/swim/eel.toml 10
"$command" import scenes/urdf/turtle.urdf --fluid 1000 > "$shots/turtle.toml"
cat scenes/urdf/turtle.stroke >> "$shots/turtle.toml"
page best-fish scenes/swim/fish-best.toml 15
page best-eel scenes/swim/eel-best.toml 8
page turtle "$shots/turtle.toml" 20 --every-seconds 0.05
python3 tools/page/shots.py "$shots" fish@0.3 eel@0.45 robot@0.4 arm@0.6 foil@0.55 star@0.63 beside@0.35 swimming-eel@0.5:dark turtle@0.5
python3 tools/page/film.py "$shots/swimming.html" docs/swimming-fish.webp 15 20
python3 tools/page/film.py "$shots/turtle.html" docs/turtle.webp 10 14
python3 tools/page/film.py "$shots/best-fish.html" docs/best-fish.webp 0 5
python3 tools/page/film.py "$shots/best-eel.html" docs/best-eel.webp 0 4
