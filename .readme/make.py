"""Draw the pictures of README.md anew: ``python .readme/make.py``."""

import shutil
import sys
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Thread

from matplotlib.figure import Figure
from PIL import Image
from playwright.sync_api import sync_playwright

import graphcam as gc
from graphcam.bench.bench_report import QUICK_EFFORT, bench
from graphcam.studio.local_studio import local_studio, opened_address

HERE = Path(__file__).parent
sys.path.append(str(HERE.parent / "notebooks" / "site"))
from graded_page import graded_page  # noqa: E402

WIDTHS = {"coursework": 1800, "arm": 1200, "flat": 1200}
"""The built-in tasks that are shown, and how wide [pixels]."""
COLOURS = 32
"""Lines in few colours on white: a palette keeps the pictures small."""


def player_picture(page_file: Path) -> Image.Image:
    """The step player in a browser: a part of a step, and the mechanism as it turns."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1180, "height": 760}, reduced_motion="reduce")
        page.goto(f"{page_file.as_uri()}#3.2/4")
        shots = [page.screenshot()]
        page.keyboard.press("m")
        page.locator("#phi").fill("40")
        page.locator("#phi").blur()
        shots.append(page.screenshot())
        browser.close()
    both = Image.new("RGB", (2 * 1180 + 20, 760), "#8a94a0")
    for k, shot in enumerate(shots):
        both.paste(Image.open(BytesIO(shot)).convert("RGB"), (1200 * k, 0))
    return both


def graded_picture() -> Image.Image:
    """The page that a student gets back: marks, the mistake by its name, and the drawing over the right one."""
    with TemporaryDirectory() as folder, sync_playwright() as playwright:
        page_file = Path(folder, "graded.html")
        page_file.write_text(graded_page(), encoding="utf-8")
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 900, "height": 900})
        page.goto(page_file.as_uri())
        shot = Image.open(BytesIO(page.screenshot(full_page=True))).convert("RGB")
        middle = round(page.locator("h2", has_text="The first wrong step").bounding_box()["y"])
        last = page.locator("figure svg, svg").last.bounding_box()
        browser.close()
    both = Image.new("RGB", (1560, middle), "#ffffff")
    both.paste(shot.crop((0, 0, 900, middle)), (0, 0))
    drawn = shot.crop(tuple(round(x) for x in (last["x"], last["y"], last["x"] + last["width"], shot.height)))
    both.paste(drawn, (930, (middle - drawn.height) // 2))
    return both


def studio_picture() -> Image.Image:
    """The studio in a browser: the region of the coursework task."""
    with TemporaryDirectory() as folder, local_studio(Path(folder), "en") as server, sync_playwright() as playwright:
        serving = Thread(target=server.run)
        serving.start()
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1440, "height": 900}, reduced_motion="reduce")
        page.goto(opened_address(server, gc.builtin_task()))
        page.locator("#canvas .step").first.wait_for()
        page.wait_for_timeout(3000)
        shot = page.screenshot()
        browser.close()
        # It ends with its last tab.
        serving.join()
    return Image.open(BytesIO(shot)).convert("RGB")


for name, width in WIDTHS.items():
    with TemporaryDirectory() as folder:
        files = gc.solve(gc.builtin_task(name)).write(folder)
        with Image.open(Path(folder, str(files["png"]))) as sheet:
            size = (width, round(width * sheet.height / sheet.width))
            picture = sheet.convert("RGB").resize(size, Image.Resampling.LANCZOS)
        if name == "coursework":
            player = player_picture(Path(folder, str(files["player"])))
            player.quantize(64, Image.Quantize.MAXCOVERAGE).save(HERE / "player.png", optimize=True)
    # Of all ways this one keeps grey lines grey.
    picture.quantize(COLOURS, Image.Quantize.FASTOCTREE).save(HERE / f"{name}.png", optimize=True)

graded_picture().quantize(64, Image.Quantize.MAXCOVERAGE).save(HERE / "graded.png", optimize=True)
studio_picture().quantize(64, Image.Quantize.MAXCOVERAGE).save(HERE / "studio.png", optimize=True)

cam = gc.solve(gc.builtin_task()).cam
plots, picture = Figure((12, 5.6), layout="tight"), BytesIO()
left, right = plots.subplots(1, 2)
cam.motion.plot(left)
cam.plot(right)
plots.savefig(picture, dpi=100)
plotted = Image.open(picture).convert("RGB")
plotted.quantize(COLOURS, Image.Quantize.MAXCOVERAGE).save(HERE / "plots.png", optimize=True)

with TemporaryDirectory() as folder:
    bench(QUICK_EFFORT, folder)
    with Image.open(Path(folder, "bench-time.png")) as figure:
        figure.convert("RGB").quantize(64, Image.Quantize.MAXCOVERAGE).save(HERE / "bench-time.png", optimize=True)
