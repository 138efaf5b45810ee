"""Screenshots of pages: `shots.py DIRECTORY NAME@PART[:dark] ...`; PART of the run, 0 to 1."""

import sys
from pathlib import Path

from browser import Browser, Page

directory = Path(sys.argv[1])
with Browser() as browser:
    for wish in sys.argv[2:]:
        name, part = wish.removesuffix(":dark").split("@")
        scheme = "dark" if wish.endswith(":dark") else "light"
        page = Page(browser, directory / f"{name}.html", 1280, 800, scheme, 1.5)
        page.run(f"lgvi.go({part} * lgvi.end)")
        page.frames(3)
        (directory / f"{name}.png").write_bytes(page.picture())
        page.close()
