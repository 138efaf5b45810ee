"""Pages of all scenes in headless Chromium, and arrays against the table: `check.py COMMAND DIRECTORY`."""

import json
import subprocess
import sys
import time
from pathlib import Path

import numpy

from browser import Browser, Page

ROOT = Path(__file__).resolve().parents[2]
COMMAND, MADE = sys.argv[1], Path(sys.argv[2])
SECONDS = "4"
EVERY = "0.02"
# Scenes on which the default way takes long: what is looked at here is the picture.
QUICK = ["--method", "gauss-4", "--step", "0.02"]

# Nothing moves, or only within a larger body.
STILL = ["hard-at-rest", "hard-rotors"]

# Of the picture: how many colours it has, and a number that tells it from others.
LOOK = """(() => {
  lgvi.draw();
  const canvas = document.getElementById("picture"), small = new OffscreenCanvas(320, 200), pen = small.getContext("2d");
  pen.drawImage(canvas, 0, 0, 320, 200);
  const { data } = pen.getImageData(0, 0, 320, 200), colours = new Set();
  let sum = 0;
  for (let k = 0; k < data.length; k += 4) {
    colours.add((data[k] >> 4) << 8 | (data[k + 1] >> 4) << 4 | data[k + 2] >> 4);
    sum = (sum * 31 + data[k] + 256 * data[k + 1] + 65536 * data[k + 2]) % 4294967291;
  }
  return [colours.size, sum];
})()"""


def require(holds, what):
    if not holds:
        raise SystemExit(f"not so: {what}")


def runs():
    """Every scene that is shipped, as page, glTF, arrays and table; those that are to be refused say so."""
    made = []
    for scene in sorted(ROOT.glob("scenes/**/*.toml")):
        if scene.parent.name == "wrong":
            continue
        name = f"{scene.parent.name}-{scene.stem}"
        files = [str(MADE / f"{name}.{ending}") for ending in ("html", "glb", "npz", "csv")]
        outs = [word for file in files for word in ("--out", file)]
        line = [COMMAND, "run", str(scene), "--until", SECONDS, "--every-seconds", EVERY, *outs, "--all-columns"]
        done = subprocess.run([*line, *QUICK], capture_output=True, text=True)
        if done.returncode == 1:
            done = subprocess.run([*line, "--method", "gauss-6"], capture_output=True, text=True)
        require(done.returncode == 0, f"{scene} runs: {done.stderr}")
        made.append(name)
    return made


def check_page(browser, name):
    path = MADE / f"{name}.html"
    page = Page(browser, path, 1100, 700)
    colours, _ = page.run(LOOK)
    require(colours > 12, f"{name}: the picture is not blank ({colours} colours)")
    inside = page.run("Array.from({ length: 101 }, (_, k) => lgvi.places(lgvi.end * k / 100).flat()).flat().every((x) => Math.abs(x) < 1)")
    require(inside, f"{name}: all bodies are in view at all times")
    # The ways change with time whatever the bodies do.
    page.run("Picture.prototype.drawWays = () => undefined")
    before = page.run(LOOK)[1]
    page.run("lgvi.go(0.6 * lgvi.end)")
    require(name in STILL or page.run(LOOK)[1] != before, f"{name}: another time is another picture")
    require(page.requests == [path.resolve().as_uri()], f"{name}: no request leaves the page: {page.requests}")
    require(not page.complaints, f"{name}: nothing is complained of: {page.complaints}")
    page.close()


def press(page, key, code):
    for kind in ("keyDown", "keyUp"):
        page.call("Input.dispatchKeyEvent", type=kind, key=key, code=code, text=key if kind == "keyDown" and len(key) == 1 else "")


def check_controls(browser, name):
    """Keys, scrubber, views and the two looks; of a page with two motions."""
    page = Page(browser, MADE / f"{name}.html", 1100, 700)
    press(page, " ", "Space")
    until = time.time() + 20
    while page.run("lgvi.time()") == 0 and time.time() < until:
        page.frames(1)
    press(page, " ", "Space")
    stopped = page.run("lgvi.time()")
    page.frames(3)
    require(0 < stopped == page.run("lgvi.time()"), "space plays and pauses")
    press(page, "ArrowRight", "ArrowRight")
    require(page.run("lgvi.time()") > stopped, "an arrow steps")
    press(page, "End", "End")
    require(page.run("lgvi.time() === lgvi.end"), "End jumps")
    page.run("(() => { const bar = document.getElementById('scrubber'); bar.value = 0.25 * lgvi.end; bar.dispatchEvent(new Event('input')); })()")
    require(abs(page.run("lgvi.time() / lgvi.end") - 0.25) < 1e-6, "the scrubber scrubs")
    box = page.run("(({ x, y, width, height }) => [x, y, width, height])(document.querySelector('.plot').getBoundingClientRect())")
    where = {"x": box[0] + 0.7 * box[2], "y": box[1] + box[3] / 2, "button": "left", "clickCount": 1}
    page.call("Input.dispatchMouseEvent", type="mousePressed", **where)
    page.call("Input.dispatchMouseEvent", type="mouseReleased", **where)
    require(page.run("lgvi.time() / lgvi.end") > 0.5, "a chart is a scrubber, too")
    both = page.run(LOOK)[1]
    page.run("document.querySelectorAll('#motions input')[1].click()")
    require(page.run(LOOK)[1] != both, "a motion can be hidden")
    light = page.run("getComputedStyle(document.body).backgroundColor")
    press(page, "t", "KeyT")
    require(page.run("getComputedStyle(document.body).backgroundColor") != light, "there is a dark look")
    dark = Page(browser, MADE / f"{name}.html", 1100, 700, "dark")
    require(dark.run("getComputedStyle(document.body).backgroundColor") != light, "which is the system's")
    require(not page.complaints + dark.complaints, f"{page.complaints} {dark.complaints}")


def check_arrays(name):
    with open(MADE / f"{name}.csv") as file:
        header = file.readline().strip().split(",")
        rows = numpy.loadtxt(file, delimiter=",", ndmin=2)
    column = lambda label: rows[:, header.index(label)]
    arrays = numpy.load(MADE / f"{name}.npz")
    bodies = [str(body) for body in arrays["bodies"]]
    count = len(rows)
    require(arrays["attitude"].shape == (count, len(bodies), 3, 3), f"{name}: shape of attitude")
    require(numpy.array_equal(arrays["t"], column("t")), f"{name}: t")
    require(numpy.array_equal(arrays["energy"], column("energy")), f"{name}: energy")
    for k, axis in enumerate("xyz"):
        require(numpy.array_equal(arrays["position"][:, k], column(axis)), f"{name}: position")
        require(numpy.array_equal(arrays["momentum"][:, k], column("p" + axis)), f"{name}: momentum")
    for i, body in enumerate(bodies):
        w, x, y, z = (column(f"{body}.q{axis}") for axis in "wxyz")
        require(numpy.allclose(arrays["attitude"][:, i, 1, 0], 2 * (x * y + w * z), atol=1e-12), f"{name}: attitude")
        require(numpy.array_equal(arrays["angular_velocity"][:, i, 2], column(f"{body}.wz")), f"{name}: angular velocity")
    require(arrays["work"].shape == (count, len(arrays["drives"])), f"{name}: work")
    require(arrays["hinge"].shape == (count, len(arrays["hinges"]), 2), f"{name}: hinges")


def main():
    begin = time.time()
    names = runs()
    ran = time.time()
    two = [COMMAND, "run", "--until", SECONDS, "--beside", "dp54", "--out", str(MADE / "two.html"), "--json"]
    done = subprocess.run(two, capture_output=True, text=True, check=True)
    require(json.loads(done.stdout)["written"] == [str(MADE / "two.html")], "a summary tells what was written")
    for name in names:
        check_arrays(name)
    with Browser() as browser:
        for name in names:
            check_page(browser, name)
        check_controls(browser, "two")
    print(f"{len(names)} scenes run in {ran - begin:.0f} s, looked at in {time.time() - ran:.0f} s")


if __name__ == "__main__":
    main()
