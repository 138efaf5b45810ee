"""A stretch of a page's run as a moving picture: `film.py PAGE FILE.webp FROM TO`, in seconds of the run, with Pillow."""

import io
import sys

from PIL import Image

from browser import Browser, Page

PICTURES = 15  # a second
SIZE = (560, 320)

page_file, film, start, end = sys.argv[1], sys.argv[2], float(sys.argv[3]), float(sys.argv[4])
with Browser() as browser:
    page = Page(browser, page_file, SIZE[0], SIZE[1])
    page.run("document.head.appendChild(document.createElement('style')).textContent = '#controls, #charts, header { display: none !important }'")
    page.frames(3)
    pictures = []
    for k in range(round((end - start) * PICTURES)):
        page.run(f"lgvi.go({start + k / PICTURES})")
        page.frames(2)
        pictures.append(Image.open(io.BytesIO(page.picture("#stage"))).convert("RGB"))
pictures[0].save(film, save_all=True, append_images=pictures[1:], duration=1000 // PICTURES, loop=0, quality=60, method=4)
