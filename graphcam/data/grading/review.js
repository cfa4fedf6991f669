"use strict";
// The review page: what was read is corrected, confirmed and exported.  Places are mm of paper, y up; the pictures have y down.

const data = JSON.parse(document.getElementById("data").textContent);
const STEP = 0.1, LONG_STEP = 1, JUMP = 10;
const GRASP = 16; // Pixels about a point in which it is taken.
const RING = 1.8; // Radius of what shows a plotted point, mm.
const CHOSEN = 1.2; // ... of the one that is chosen.
const LARGER = 4;
const MAGNIFIED = 10; // Deviations from what is right are drawn so many times as long.
const EVERY = 4; // mm between them.
const FARTHEST = 12; // mm off up to which they are drawn: a foreign drawing would be covered by them.
const text = data.texts;
let changed = false;

function said(template, values) {
  return template.replace(/\{(\w+)\}/g, (place, name) => (name in values ? values[name] : place));
}

function written(number, decimals) {
  return number.toFixed(decimals).replace("-", "−").replace(".", data.decimal);
}

// A number as a person writes it: with a point or with a comma.
function numberOf(typed) {
  const plain = typed.trim().replace("−", "-").replace(",", ".");
  return /^[-+]?(\d+\.?\d*|\.\d+)$/.test(plain) ? Number(plain) : NaN;
}

function element(name, attributes) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

function path(points, closed) {
  return points.map(([x, y], k) => `${k ? "L" : "M"}${x.toFixed(2)} ${(-y).toFixed(2)}`).join("") + (closed ? "Z" : "");
}

function distance(a, b) {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}

// The place on a line that is nearest to a point.
function foot(point, line) {
  let best = line[0], least = distance(point, best);
  for (let k = 1; k < line.length; k++) {
    const [ax, ay] = line[k - 1], dx = line[k][0] - ax, dy = line[k][1] - ay, length = dx * dx + dy * dy;
    const t = length ? Math.min(1, Math.max(0, ((point[0] - ax) * dx + (point[1] - ay) * dy) / length)) : 0;
    const at = [ax + t * dx, ay + t * dy], far = distance(point, at);
    if (far < least) [best, least] = [at, far];
  }
  return best;
}

// One drawn answer: what was read of it, and what is made of it.
class Drawn {
  constructor(said, kept) {
    const { points, ...rest } = said;
    Object.assign(this, rest);
    this.read = points || [];
    this.verdict = kept ? kept.verdict : "";
    this.photo = kept ? kept.photo : "";
    this.now = kept && kept.verdict === "corrected" ? kept.value : null;
  }

  get points() { return this.now || this.read; }

  get isCurve() { return this.mark === "curve"; }

  // How much a point k comes along with the point of index ``at``: by its way along the curve from there.
  weights(at, reach) {
    const points = this.points, weights = points.map((_, k) => (k === at ? 1 : 0));
    if (!this.isCurve) return weights;
    for (const way of [1, -1]) {
      let run = 0;
      for (let n = 1; n < points.length; n++) {
        let k = at + way * n;
        if (this.closed) k = (k + points.length) % points.length;
        if (k < 0 || k >= points.length) break;
        const before = this.closed ? (k - way + points.length) % points.length : k - way;
        run += distance(points[k], points[before]);
        if (run >= reach) break;
        weights[k] = Math.max(weights[k], Math.cos((Math.PI * run) / (2 * reach)) ** 2);
      }
    }
    return weights;
  }

  correct(points) {
    this.now = points;
    this.verdict = "corrected";
    this.photo = this.digest;
  }

  undo() {
    this.now = null;
    this.verdict = this.photo = "";
  }

  get correction() {
    if (!this.verdict) return null;
    const value = this.verdict === "corrected" ? this.points.map(([x, y]) => [+x.toFixed(3), +y.toFixed(3)]) : null;
    return { verdict: this.verdict, value, photo: this.photo };
  }
}

// The picture of a view with what is drawn in it.
class Board {
  constructor(figure, said, answers, student) {
    this.figure = figure;
    this.answers = answers.filter((answer) => said.answers.includes(answer.name));
    this.student = student;
    this.svg = figure.querySelector("svg");
    this.place = figure.querySelector(".board");
    this.output = figure.querySelector("output");
    this.frame = this.svg.getAttribute("viewBox").split(" ").map(Number);
    this.answer = this.answers[0];
    this.chosen = -1;
    this.adding = false;
    for (const tool of figure.querySelectorAll("[data-tool]")) {
      tool.addEventListener(tool.tagName === "SELECT" ? "change" : "click", () => this.use(tool));
    }
    this.place.addEventListener("keydown", (event) => this.key(event));
    this.svg.addEventListener("pointerdown", (event) => this.grasp(event));
    // A finger scrolls the page, but where it takes a point.
    this.svg.addEventListener("touchstart", (event) => {
      if (this.adding || this.near(this.at(event.touches[0])) >= 0) event.preventDefault();
    }, { passive: false });
    this.draw();
  }

  tool(name) { return this.figure.querySelector(`[data-tool="${name}"]`); }

  get reach() { return Number(this.tool("reach").value); }

  // The place of a pointer, mm.
  at(event) {
    const place = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.svg.getScreenCTM().inverse());
    return [place.x, -place.y];
  }

  near(place) {
    if (!this.answer) return -1;
    const grasp = GRASP / this.svg.getScreenCTM().a;
    let best = -1, least = grasp;
    this.answer.points.forEach((point, k) => {
      const far = distance(point, place);
      if (far < least) [best, least] = [k, far];
    });
    return best;
  }

  use(tool) {
    const name = tool.dataset.tool;
    if (name === "answer") { this.answer = this.answers.find((one) => one.name === tool.value); this.chosen = -1; }
    if (name === "previous" || name === "next") this.choose(this.chosen + (name === "next" ? 1 : -1) * (this.answer.isCurve ? JUMP : 1));
    if (name === "zoom") tool.setAttribute("aria-pressed", tool.getAttribute("aria-pressed") !== "true");
    if (name === "add") this.add(this.middle());
    if (name === "remove") this.remove();
    if (name === "undo" && this.answer) { this.answer.undo(); this.chosen = -1; this.tell(); }
    this.draw();
  }

  choose(k) {
    const count = this.answer ? this.answer.points.length : 0;
    this.chosen = count ? ((k % count) + count) % count : -1;
  }

  middle() {
    const [left, top, width, height] = this.svg.getAttribute("viewBox").split(" ").map(Number);
    return [left + width / 2, -(top + height / 2)];
  }

  add(place) {
    if (!this.answer || this.answer.isCurve) return;
    this.answer.correct([...this.answer.points, place]);
    this.chosen = this.answer.points.length - 1;
    this.place.focus();
    this.tell();
  }

  remove() {
    if (!this.answer || this.answer.isCurve || this.chosen < 0 || this.answer.points.length < 2) return;
    this.answer.correct(this.answer.points.filter((_, k) => k !== this.chosen));
    this.choose(this.chosen);
    this.tell();
  }

  move(from, dx, dy, weights) {
    this.answer.correct(from.map(([x, y], k) => [x + weights[k] * dx, y + weights[k] * dy]));
    this.tell();
    this.draw();
  }

  tell() { this.student.changed(); }

  key(event) {
    if (!this.answer || event.ctrlKey || event.altKey || event.metaKey) return;
    const length = event.shiftKey ? LONG_STEP : STEP;
    const ways = { ArrowLeft: [-length, 0], ArrowRight: [length, 0], ArrowUp: [0, length], ArrowDown: [0, -length] };
    const steps = { PageDown: 1, PageUp: -1 };
    if (event.key in ways) {
      if (this.chosen < 0) this.choose(0);
      if (this.chosen >= 0) this.move(this.answer.points, ...ways[event.key], this.answer.weights(this.chosen, this.reach));
    } else if (event.key in steps) this.choose(this.chosen + steps[event.key] * (event.shiftKey ? JUMP : 1));
    else if (event.key === "Home") this.choose(0);
    else if (event.key === "End") this.choose(-1);
    else if (event.key === "Delete") this.remove();
    else return;
    event.preventDefault();
    this.draw();
  }

  grasp(event) {
    const start = this.at(event), k = this.near(start);
    if (k < 0 || event.button) return;
    event.preventDefault();
    this.place.focus({ preventScroll: true });
    this.chosen = k;
    const from = this.answer.points, weights = this.answer.weights(k, this.reach);
    let moved = false;
    const follow = (next) => {
      const [x, y] = this.at(next);
      moved = moved || distance([x, y], start) > 0.05;
      if (moved) this.move(from, x - start[0], y - start[1], weights);
    };
    const leave = () => {
      this.svg.removeEventListener("pointermove", follow);
      this.svg.classList.remove("hold");
      this.draw();
    };
    this.svg.setPointerCapture(event.pointerId);
    this.svg.classList.add("hold");
    this.svg.addEventListener("pointermove", follow);
    this.svg.addEventListener("pointerup", leave, { once: true });
    this.svg.addEventListener("pointercancel", leave, { once: true });
    // Not while it is held: the picture would run away under the pointer.
    this.draw(false);
  }

  draw(framed = true) {
    const own = this.svg.querySelector(".own"), right = this.svg.querySelector(".right");
    own.replaceChildren();
    right.replaceChildren();
    for (const answer of this.answers) {
      const shade = answer === this.answer ? "" : "faint";
      if (answer.isCurve) {
        if (answer.points.length) own.append(element("path", { d: path(answer.points, answer.closed), class: shade }));
      } else {
        for (const [x, y] of answer.points) own.append(element("circle", { cx: x.toFixed(2), cy: (-y).toFixed(2), r: RING, class: shade }));
      }
      if (answer.right && document.body.classList.contains("shows-right")) this.drawRight(answer, right);
    }
    for (const name of ["previous", "next", "undo"]) this.tool(name).disabled = !this.answer || !this.answer.points.length;
    for (const part of this.figure.querySelectorAll(".for-curves")) part.hidden = !this.answer || !this.answer.isCurve;
    for (const part of this.figure.querySelectorAll(".for-points")) part.hidden = !this.answer || this.answer.isCurve;
    this.tool("remove").disabled = this.chosen < 0 || !this.answer || this.answer.points.length < 2;
    const point = this.answer && this.answer.points[this.chosen];
    if (point) {
      own.append(element("circle", { cx: point[0].toFixed(2), cy: (-point[1]).toFixed(2), r: CHOSEN, class: "chosen" }));
      const values = { answer: this.answer.name, number: this.chosen + 1, count: this.answer.points.length };
      this.output.textContent = said(text.point, { ...values, x: written(point[0], 2), y: written(point[1], 2) });
    } else this.output.textContent = "";
    if (framed) this.show(point);
  }

  show(point) {
    const [left, top, width, height] = this.frame;
    if (this.tool("zoom").getAttribute("aria-pressed") !== "true") {
      this.svg.setAttribute("viewBox", this.frame.join(" "));
      return;
    }
    const [x, y] = point ? [point[0], -point[1]] : [left + width / 2, top + height / 2];
    this.svg.setAttribute("viewBox", [x - width / 2 / LARGER, y - height / 2 / LARGER, width / LARGER, height / LARGER].join(" "));
  }

  drawRight(answer, group) {
    const own = answer.closed ? [...answer.points, answer.points[0]] : answer.points;
    let places = answer.right;
    if (answer.isCurve) {
      group.append(element("path", { d: path(answer.right, false) }));
      let run = EVERY;
      places = answer.right.filter((point, k) => {
        run += k ? distance(point, answer.right[k - 1]) : 0;
        if (run < EVERY) return false;
        run = 0;
        return true;
      });
    } else {
      for (const [x, y] of places) group.append(element("path", { d: `M${x - 1} ${-y}h2M${x} ${-y - 1}v2` }));
    }
    if (!own.length || !answer.isCurve) return;
    const whiskers = places.map((point) => [point, foot(point, own)]).filter((ends) => distance(...ends) <= FARTHEST)
      .map(([[x, y], [u, v]]) => path([[x, y], [x + MAGNIFIED * (u - x), y + MAGNIFIED * (v - y)]], false));
    group.append(element("path", { d: whiskers.join(""), class: "off" }));
  }
}

class Student {
  constructor(article, said) {
    this.article = article;
    this.id = said.student;
    const kept = said.corrections;
    this.known = JSON.stringify(kept) !== JSON.stringify({ answers: {}, bars: {}, reviewed: false });
    this.drawn = said.drawn.map((one) => new Drawn(one, kept.answers[one.name]));
    this.selects = new Map();
    this.counts = new Map();
    for (const section of article.querySelectorAll("[data-answer]")) this.judge(section);
    this.boards = [...article.querySelectorAll("[data-view]")].map(
      (figure) => new Board(figure, said.views[figure.dataset.view], this.drawn, this));
    this.numbers = [...article.querySelectorAll("[data-number]")];
    for (const field of this.numbers) {
      const one = kept.answers[field.dataset.number];
      if (one) field.value = String(one.value).replace(".", data.decimal);
      field.addEventListener("input", () => { this.check(field); this.changed(); });
    }
    this.bars = [...article.querySelectorAll("[data-bar]")];
    for (const field of this.bars) {
      const one = (kept.bars[field.dataset.page] || [])[field.dataset.bar];
      if (one) field.value = String(one).replace(".", data.decimal);
      field.addEventListener("input", () => { this.check(field); this.changed(); });
    }
    this.reviewed = article.querySelector("[data-reviewed]");
    this.reviewed.checked = kept.reviewed;
    this.reviewed.addEventListener("change", () => this.changed());
    this.show();
  }

  judge(section) {
    const answer = this.drawn.find((one) => one.name === section.dataset.answer);
    const select = section.querySelector("[data-verdict]");
    this.selects.set(answer, select);
    this.counts.set(answer, section.querySelector("[data-number-of-points]"));
    select.addEventListener("change", () => {
      answer.verdict = select.value;
      answer.photo = select.value ? answer.digest : "";
      this.changed();
      this.boards.forEach((board) => board.draw());
    });
  }

  // Says what is wrong with a field; true where nothing is.
  check(field) {
    const value = numberOf(field.value), length = Number(field.dataset.length);
    let wrong = "";
    if (field.value.trim() && Number.isNaN(value)) wrong = text.noNumber;
    else if (field.value.trim() && length) {
      const [low, high] = data.stretch.map((part) => part * length);
      if (value < low || value > high) wrong = said(text.measureAgain, { low: written(low, 1), high: written(high, 1) });
    }
    field.setAttribute("aria-invalid", Boolean(wrong));
    document.getElementById(field.getAttribute("aria-describedby")).textContent = wrong;
    return !wrong;
  }

  changed() {
    changed = true;
    this.show();
    progress();
  }

  show() {
    for (const [answer, select] of this.selects) {
      select.querySelector('[value="corrected"]').disabled = !answer.now;
      select.value = answer.verdict;
      // As many points as are asked for, or the answer is not marked.
      const count = answer.points.length, wanted = answer.wanted, counts = this.counts.get(answer);
      counts.hidden = !wanted || count === wanted || !["confirmed", "corrected"].includes(answer.verdict);
      counts.textContent = counts.hidden ? "" : said(text.number, { count, wanted });
    }
  }

  get wrongFields() { return [...this.numbers, ...this.bars].filter((field) => !this.check(field)); }

  get corrections() {
    const answers = {}, bars = {};
    for (const answer of this.drawn) if (answer.correction) answers[answer.name] = answer.correction;
    for (const field of this.numbers) {
      if (field.value.trim()) answers[field.dataset.number] = { verdict: "corrected", value: numberOf(field.value), photo: "" };
    }
    for (const field of this.bars) {
      if (!field.value.trim()) continue;
      bars[field.dataset.page] = bars[field.dataset.page] || [null, null];
      bars[field.dataset.page][field.dataset.bar] = numberOf(field.value);
    }
    return { answers, bars, reviewed: this.reviewed.checked };
  }

  get isEmpty() {
    const { answers, bars, reviewed } = this.corrections;
    return !Object.keys(answers).length && !Object.keys(bars).length && !reviewed;
  }
}

const students = [...document.querySelectorAll("[data-student]")].map(
  (article) => new Student(article, data.students[article.dataset.student]));

function progress() {
  const done = students.filter((one) => one.reviewed.checked).length;
  document.getElementById("progress").textContent = said(text.progress, { done, count: students.length });
}

function exportAll() {
  const wrong = students.flatMap((one) => one.wrongFields);
  if (wrong.length) {
    wrong[0].focus();
    return;
  }
  const listed = students.filter((one) => one.known || !one.isEmpty).map((one) => [one.id, one.corrections]);
  const exported = { format: data.format, exercise: data.exercise, students: Object.fromEntries(listed) };
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([JSON.stringify(exported)], { type: "application/json" }));
  link.download = "photo-corrections.json";
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  changed = false;
}

document.getElementById("export").addEventListener("click", exportAll);
document.getElementById("show-right").addEventListener("change", (event) => {
  document.body.classList.toggle("shows-right", event.target.checked);
  students.forEach((one) => one.boards.forEach((board) => board.draw()));
});
document.getElementById("only-open").addEventListener("change", (event) => {
  document.body.classList.toggle("only-open", event.target.checked);
  document.getElementById("nothing-open").hidden = !event.target.checked || Boolean(document.querySelector(".student.open"));
});
window.addEventListener("beforeunload", (event) => { if (changed) event.preventDefault(); });
progress();
