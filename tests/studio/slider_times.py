"""From a slider to the picture: how long a hand waits in the studio, from the local server and in WebAssembly.

``python tests/studio/slider_times.py [--pyodide DIR]``, with ``tests`` on the path, moves the offset of the coursework
task a hundred times in each of three views.  It tells the median and the 95th percentile from the event to the painted
picture, and what the engine took of it, and how many pictures a hand sees that moves every 16 ms; with a folder of
Pyodide also for the one file, its size, and the processor time from its opening to its first answer.  On an idle
machine.
"""

from __future__ import annotations

import os
import re
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from chromium import chromium
from playwright.sync_api import Page

import graphcam as gc
from graphcam.studio.worker_page import write_one_file

VIEWS = "combined", "profile", "acceleration"
MOVES = 100
MOVED = """async ([from, by, moves]) => {
  const found = [], slider = document.querySelector("[data-key='follower.offset/range']"), { stats } = studio;
  const wait = (time) => new Promise((done) => setTimeout(done, time));
  const painted = () => new Promise((done) => requestAnimationFrame(() => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = done;
    port2.postMessage(0);
  }));
  dispatchEvent(new PointerEvent("pointerdown"));
  for (let k = 0; k < moves; k += 1) {
    await wait(30);
    const before = stats.at(-1).seq, start = performance.now();
    slider.value = from + by * (k % 40);
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    while (stats.at(-1).seq === before) await wait(1);
    await painted();
    const { construct, exact, svg, told } = studio.shown.ms;
    found.push([performance.now() - start, construct + exact + svg + (told || 0)]);
  }
  dispatchEvent(new PointerEvent("pointerup"));
  return found;
}"""

STREAM = """async ([from, by, moves, apart]) => {
  const slider = document.querySelector("[data-key='follower.offset/range']");
  const wait = (time) => new Promise((done) => setTimeout(done, time)), begin = performance.now();
  const steps = document.getElementById("steps");
  let pictures = 0, isChanged = false, isOver = false;
  const watched = { childList: true, subtree: true, attributes: true };
  new MutationObserver(() => { isChanged = true; }).observe(steps, watched);
  const frame = () => {
    pictures += isChanged;
    isChanged = false;
    if (!isOver) requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
  dispatchEvent(new PointerEvent("pointerdown"));
  for (let k = 0; k < moves; k += 1) {
    slider.value = from + by * (k + 1);
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    await wait(Math.max(0, begin + apart * (k + 1) - performance.now()));
  }
  while (!studio.quiet()) await wait(1);
  dispatchEvent(new PointerEvent("pointerup"));
  isOver = true;
  return pictures;
}"""
"""A hand that moves without waiting: in how many frames it sees another picture, drawn anew or gone along."""
STREAMED, APART = 48, 16
"""So many moves, so many milliseconds apart."""


@contextmanager
def served() -> Iterator[str]:
    """The address of the local page."""
    command = [sys.executable, "-m", "graphcam", "studio", "--no-browser"]
    with tempfile.TemporaryDirectory() as folder:
        running = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=folder)
        assert running.stdout
        address = re.search(r"http://\S+", running.stdout.readline())
        assert address
        yield address[0]
        running.terminate()
        running.wait()


def processor_time() -> float:
    """Of all Chromiums that this process has started [s]."""
    ticks, children = dict[int, int](), dict[int, list[int]]()
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            name, _, rest = stat.read_text(encoding="utf-8").rpartition(") ")
        except OSError:  # it has ended
            continue
        process = int(stat.parent.name)
        children.setdefault(int(rest.split()[1]), []).append(process)
        ticks[process] = sum(map(int, rest.split()[11:13])) if "(chrom" in name else 0
    own = [os.getpid()]
    for process in own:
        own += children.get(process, [])
    return sum(ticks.get(process, 0) for process in own) / os.sysconf("SC_CLK_TCK")


def told(page: Page, where: str) -> None:
    """Print the times of each view."""
    for view in VIEWS:
        page.locator(f"#view-{view}").click()
        page.wait_for_timeout(2500)
        pictures, engines = (sorted(times) for times in zip(*page.evaluate(MOVED, [-15, 0.5, MOVES]), strict=True))
        middle, late = statistics.median(pictures), pictures[int(0.95 * MOVES)]
        engine = statistics.median(engines)
        # What was let go is told first.
        page.wait_for_timeout(1500)
        seen = page.evaluate(STREAM, [-15, 0.5, STREAMED, APART])
        sys.stdout.write(f"{where}, {view}: {seen} pictures of {STREAMED} moves every {APART} ms\n")
        sys.stdout.write(f"{where}, {view}: median {middle:.0f} ms, 95 % {late:.0f} ms, engine {engine:.0f} ms\n")


def main() -> None:
    with chromium() as browser:
        window = {"width": 1440, "height": 900}
        with served() as address:
            page = browser.new_page(viewport=window)
            page.goto(address)
            page.wait_for_function("() => window.studio && studio.stats.length")
            told(page, "server")
            page.close()
        if "--pyodide" in sys.argv:
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder, "studio.html")
                write_one_file(path, Path(sys.argv[-1]), gc.builtin_task())
                page = browser.new_page(viewport=window)
                before = processor_time()
                page.goto(path.as_uri())
                page.wait_for_function("() => window.studio && studio.stats.length", timeout=120_000)
                size, took = path.stat().st_size / 1e6, processor_time() - before
                sys.stdout.write(f"one file: {size:.1f} MB, first answer after {took:.1f} s of the processor\n")
                told(page, "one file")
        browser.close()


if __name__ == "__main__":
    main()
