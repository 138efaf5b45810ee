#!/usr/bin/env python3
"""Runs the commands of the pages, as a reader would: each block of `sh` in the README, in docs and beside the crates.

    python3 tools/commands.py COMMAND      the built command, as target/debug/lgvi

The blocks of a page run one after the other in an empty directory with a link to the scenes. `cargo run --release -- ARGS` and `lgvi ARGS` are COMMAND there,
and nothing opens a browser. A block of `toml` whose first line is `# NAME.toml` is that file. A block that does not run here says why in the line before it:

    <!-- not in CI: REASON -->
"""

import os
import re
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGES = ["*.md", "docs/*.md", "python/*.md", "crates/*/README.md"]
BLOCK = re.compile(r"(?:^<!--(?P<note>[^\n]*)-->\n)?^```(?P<language>sh|toml)\n(?P<code>.*?)^```", re.M | re.S)
LEFT_OUT = re.compile(r" not in CI: \S.*")
SECONDS = 60
CARGO = """#!/bin/sh
if [ "$1 $2 $3" = "run --release --" ]; then shift 3; exec lgvi "$@"; fi
echo "cargo $*: run it elsewhere in CI, and mark the block" >&2
exit 1
"""


def shims(folder, command):
    """The commands that a block finds before others."""
    folder.mkdir()
    (folder / "lgvi").symlink_to(command)
    for name, text in (("cargo", CARGO), ("xdg-open", "#!/bin/sh\n"), ("open", "#!/bin/sh\n")):
        (folder / name).write_text(text)
        (folder / name).chmod(0o755)
    return f"{folder}{os.pathsep}{os.environ['PATH']}"


def blocks(text):
    """The blocks of a page, each with its line, language, code, and the note before it."""
    for match in BLOCK.finditer(text):
        line = text.count("\n", 0, match.start("code"))
        yield line, match["language"], match["code"], match["note"]


def run(code, folder, path):
    """What is wrong with a block; None where it runs."""
    environment = {**os.environ, "PATH": path}
    arguments = ["bash", "-euo", "pipefail", "-c", code]
    try:
        done = subprocess.run(arguments, cwd=folder, env=environment, capture_output=True, text=True, timeout=SECONDS, stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        return f"took more than {SECONDS} s"
    return None if done.returncode == 0 else done.stderr.strip()[-2000:] or f"exit code {done.returncode}"


def check(page, scratch, path):
    """What the blocks of a page come to: how many ran, how many did not, and the failures."""
    name = page.relative_to(ROOT)
    folder = scratch / str(name).replace("/", "-")
    folder.mkdir()
    (folder / "scenes").symlink_to(ROOT / "scenes")
    ran, left_out, failures = 0, 0, []
    for line, language, code, note in blocks(page.read_text(encoding="utf-8")):
        if language == "toml":
            file = re.match(r"# ([\w-]+\.toml)\n", code)
            if file:
                (folder / file[1]).write_text(code, encoding="utf-8")
            continue
        if note and LEFT_OUT.match(note):
            left_out += 1
            continue
        begin = time.monotonic()
        failure = run(code, folder, path)
        ran += 1
        print(f"{name}:{line}: {time.monotonic() - begin:.1f} s{' FAILED' if failure else ''}", flush=True)
        if failure:
            failures.append(f"{name}:{line}: {failure}")
    return ran, left_out, failures


def main(command):
    pages = sorted(page for pattern in PAGES for page in ROOT.glob(pattern))
    with tempfile.TemporaryDirectory() as temporary:
        scratch = Path(temporary)
        path = shims(scratch / "bin", Path(command).resolve(strict=True))
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            results = list(pool.map(lambda page: check(page, scratch, path), pages))
    ran, left_out = (sum(result[i] for result in results) for i in (0, 1))
    failures = [failure for result in results for failure in result[2]]
    print(f"{ran} blocks of {len(pages)} pages ran, {left_out} are not for CI")
    if not ran:
        failures.append("no block ran")
    return "\n".join(failures)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]) or 0)
