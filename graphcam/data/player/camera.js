// Where the reader looks: a scale and a shift of a pane's page, in its millimetres.
"use strict";

// A little detail is not blown up to fill the pane: pixels for a millimetre at most, millimetres across at least.
const NEAREST = 6, NARROWEST = 100;

function cameraOf(pane) {
  const pages = [...pane.querySelectorAll("svg.page")];
  const camera = { zoom: 1, x: 0, y: 0 };
  const thin = thinnerOf(pane);
  let shown = 0;

  const sheet = () => pages[shown].viewBox.baseVal;
  // Pixels for a millimetre of the page before the camera.
  const fit = () => Math.min(pane.clientWidth / sheet().width, pane.clientHeight / sheet().height) || 1;

  function place() {
    const { zoom, x, y } = camera, pixel = 1 / (fit() * zoom);
    pages[shown].querySelector(".camera").style.transform = `translate(${x}px, ${y}px) scale(${zoom})`;
    // How many millimetres a pixel is: nothing is drawn thinner, or lettered smaller, than can be seen.
    pages[shown].style.setProperty("--pixel", `${pixel}px`);
    thin(pages[shown], pixel);
  }

  function turnTo(number) {
    shown = number;
    pages.forEach((page, k) => page.classList.toggle("away", k !== number));
  }

  // A box of a page, or all of it; the window need not have the shape of the page.
  function look(page, box) {
    turnTo(page);
    const { width, height } = sheet(), [left, top, wide, high] = box || [0, 0, width, height];
    camera.zoom = Math.min(pane.clientWidth / Math.max(wide, NARROWEST), pane.clientHeight / high, NEAREST) / fit();
    camera.x = width / 2 - camera.zoom * (left + wide / 2);
    camera.y = height / 2 - camera.zoom * (top + high / 2);
    place();
  }

  // Client coordinates in the page's millimetres, before the camera.
  function onPage(x, y) {
    return new DOMPoint(x, y).matrixTransform(pages[shown].getScreenCTM().inverse());
  }

  function zoomAbout(factor, centre) {
    const zoom = Math.max(0.4, Math.min(40, camera.zoom * factor)), ratio = zoom / camera.zoom;
    camera.x = centre.x - ratio * (centre.x - camera.x);
    camera.y = centre.y - ratio * (centre.y - camera.y);
    camera.zoom = zoom;
    place();
  }

  function zoomFromMiddle(factor) {
    const box = pane.getBoundingClientRect();
    zoomAbout(factor, onPage(box.left + box.width / 2, box.top + box.height / 2));
  }

  gesturesOf(pane, {
    onDrawing: onPage, zoomAbout,
    shift({ x, y }) {
      camera.x += x;
      camera.y += y;
      place();
    },
  });

  return { look, turnTo, zoomFromMiddle };
}

// The letters of a step are never smaller than can be read; of those that had to grow and now stand in each other's
// way, the more important stays, and of neighbours alike the first.
function thinnerOf(pane) {
  const LEAST = 9;  // pixels
  const texts = [...pane.querySelectorAll(".step text, .titles text")].map((text) => {
    const size = Number(text.getAttribute("font-size")), turn = /rotate\((\S+)/.exec(text.getAttribute("transform"));
    text.style.setProperty("--size", `${size}px`);
    return { text, size, turn: turn ? Number(turn[1]) * Math.PI / 180 : 0, page: text.closest("svg.page") };
  });
  let due = 0;

  // The middle and the size of a text's box, in the page's millimetres, however it is turned.
  function boxOf({ text, turn }) {
    const { x, y, width, height } = text.getBBox(), c = Math.cos(turn), s = Math.sin(turn);
    const about = { x: Number(text.getAttribute("x")), y: Number(text.getAttribute("y")) };
    const across = x + width / 2 - about.x, down = y + height / 2 - about.y;
    // Capital letters and digits fill the middle of their line.
    const wide = width, high = 0.6 * height;
    return {
      x: about.x + c * across - s * down, y: about.y + s * across + c * down,
      wide: Math.abs(c) * wide + Math.abs(s) * high, high: Math.abs(s) * wide + Math.abs(c) * high,
    };
  }

  const meet = (a, b) => 2 * Math.abs(a.x - b.x) < a.wide + b.wide && 2 * Math.abs(a.y - b.y) < a.high + b.high;
  const weight = ({ text }) => ["now", "lit"].findIndex((name) => text.classList.contains(name)) + 1
    || (text.closest(".current, .titles") ? 3 : 4);

  function thin(page, pixel) {
    // On the whole sheet none has grown.
    const grow = pane.closest(".lettered");
    const shown = texts.filter((one) => one.page === page && !one.text.closest(".later, .step.away"))
      // What has its own size stands as on the sheet.
      .map((one) => ({ ...boxOf(one), text: one.text, grown: grow && one.size < LEAST * pixel, weight: weight(one) }))
      .sort((a, b) => a.grown - b.grown || a.weight - b.weight);
    const kept = [];
    for (const one of shown) {
      const crowded = one.grown && kept.some((other) => meet(one, other));
      one.text.classList.toggle("crowded", crowded);
      if (!crowded) kept.push(one);
    }
  }

  return (page, pixel) => {
    cancelAnimationFrame(due);
    due = requestAnimationFrame(() => thin(page, pixel));
  };
}
