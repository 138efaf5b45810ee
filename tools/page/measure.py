"""What pages and glTF files take: `measure.py COMMAND DIRECTORY`. Chains of 3, 30 and 300 bodies, 2500 frames; sizes, times, frames a second."""

import os
import subprocess
import sys
import time
from pathlib import Path

from browser import Browser, Page

COMMAND, MADE = sys.argv[1], Path(sys.argv[2])
MADE.mkdir(parents=True, exist_ok=True)
PLAYED = 5  # s


def written(scene, *names):
    """Seconds of a run of 2500 frames, with these files."""
    outs = [word for name in names for word in ("--out", str(MADE / name))]
    line = [COMMAND, "run", scene, "--until", "25", "--method", "gauss-6", "--step", "0.005", "--every-seconds", "0.01", *outs]
    begin = time.time()
    subprocess.run(line, check=True, capture_output=True)
    return time.time() - begin


def frames_a_second(browser, name):
    page = Page(browser, MADE / name, 1280, 800)
    page.run("lgvi.play(true)")
    first, begin = page.run("lgvi.drawn"), time.time()
    page.run(f"new Promise((done) => setTimeout(done, {1000 * PLAYED}))")
    rate = (page.run("lgvi.drawn") - first) / (time.time() - begin)
    page.close()
    return rate


print("bodies  page kB  glTF kB  run s  with both files s  frames a second")
with Browser() as browser:
    for count in (3, 30, 300):
        scene = str(MADE / f"chain-{count}.toml")
        chain = subprocess.run([sys.executable, Path(__file__).parent / "chain.py", str(count)], capture_output=True, check=True)
        Path(scene).write_bytes(chain.stdout)
        page, gltf = f"chain-{count}.html", f"chain-{count}.glb"
        alone, both = written(scene), written(scene, page, gltf)
        kilobytes = [os.path.getsize(MADE / name) / 1000 for name in (page, gltf)]
        rate = frames_a_second(browser, page)
        print(f"{count:6}  {kilobytes[0]:7.0f}  {kilobytes[1]:7.0f}  {alone:5.1f}  {both:17.1f}  {rate:15.1f}")
