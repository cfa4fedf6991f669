// What if: a quantity over any one size, with the present cam on the curve and the pinned one beside it.
"use strict";

// So many designs make a curve; they are asked for in pieces, between which a picture can be asked for.
const DESIGNS = 200, PIECE = 25;

// What the curves are called among the values of the cam on the page; the others are its sizes.
const VALUE_NAMES = {
  least_prime_radius: "minimum_prime_radius", pressure_angle_rise: "max_pressure_angle_rise_deg",
  pressure_angle_return: "max_pressure_angle_return_deg", curvature_radius: "min_pitch_curvature_radius", max_v: "max_v",
};

function whatIfOf(element, words, { ask, state, shown, change, choose, decimal, language }) {
  const size = make("select", { id: "sweep-size", "data-key": "sweep-size" });
  const charts = make("div", { class: "charts" }), both = make("div");
  const pin = make("button", { type: "button", class: "pins", text: words.pin, onclick: () => document.getElementById("pin").click() });
  element.append(make("label", { class: "from" }, make("span", { text: words.over }), size), charts, pin, both);
  let fields = [], asked = "", sweep = null, running = 0;

  const fieldOf = () => fields.find((field) => field.path === size.value);
  const now = (task, field) => valueAt(task, field.path) ?? (task === state().task ? field.value : null);

  // The sizes that the engine can sweep.
  function offer(found) {
    const optionsOf = (all) => JSON.stringify(all.map((field) => [field.path, field.name])), same = optionsOf(found) === optionsOf(fields);
    fields = found;
    if (same) return;
    const before = state().swept ?? size.value;
    size.replaceChildren(...fields.map((field) => make("option", { value: field.path, text: field.name })));
    const wanted = fields.find((field) => field.path === before) || fields.find((field) => /offset|distance/.test(field.path)) || fields[0];
    if (wanted) size.value = wanted.path;
  }

  // --- a chart: 300 by 110, the curve between its least and greatest value -------------------------------------------------

  const WIDE = 300, HIGH = 110, EDGE = 8;

  function scalesOf(curve, at, limit) {
    const known = [...curve.values, ...(limit === undefined ? [] : [limit])].filter((value) => value !== null);
    const least = Math.min(...known), most = Math.max(...known), { from, to } = sweep;
    // What stays the same is drawn level, in the middle.
    const flat = most - least < 1e-6 * Math.abs(most), by = flat ? 0.05 * Math.abs(most) || 1 : 0;
    const low = least - by, high = most + by, span = high - low;
    return {
      low, high, known: known.length > 0,
      x: (value) => WIDE * (value - from) / (to - from || 1),
      y: (value) => HIGH - EDGE - (HIGH - 2 * EDGE) * (value - low) / span,
    };
  }

  function lineOf(at, values, { x, y }) {
    let d = "", on = false;
    values.forEach((value, k) => {
      if (value !== null) d += `${on ? "L" : "M"}${x(at[k]).toFixed(1)} ${y(value).toFixed(1)}`;
      on = value !== null;
    });
    return d;
  }

  // The curve's value at a size, between two designs.
  function valueOn({ values }, at, value) {
    const k = at.findIndex((one, j) => j > 0 && one >= value);
    if (value < at[0] || k < 1 || values[k] === null || values[k - 1] === null) return null;
    return values[k - 1] + (values[k] - values[k - 1]) * (value - at[k - 1]) / (at[k] - at[k - 1] || 1);
  }

  const written = (value, unit) => `${shortNumber(Number(value.toPrecision(4)), decimal())} ${unit}`.replace(" °", "°").trim();

  // The curves are exact, and rounded is nothing; the cam on the page has sizes that were adopted.
  function saidOf({ id, unit }, here) {
    const { values = [], sizes = {} } = shown(), value = values.find((each) => each.id === VALUE_NAMES[id]);
    const own = VALUE_NAMES[id] ? value && Math.abs(value.exact) : sizes[id], exact = here === null ? "" : written(here, unit);
    const adopted = own === null || own === undefined ? exact : written(id === "curvature_radius" && here < 0 ? -own : own, unit);
    return [make("strong", { text: adopted }), exact && exact !== adopted ? make("small", { text: words.not_rounded.replace("{value}", exact) }) : null];
  }

  function chartOf(curve, field, task, pinned) {
    const { at, limits = {} } = sweep, limit = limits[curve.id] ?? undefined, scales = scalesOf(curve, at, limit);
    if (!scales.known) return null;
    const picture = make("div"), svg = drawSvg("svg", "sweep-picture", { viewBox: `0 0 ${WIDE} ${HIGH}`, preserveAspectRatio: "none", "aria-hidden": "true" }, picture);
    drawSvg("path", "axis", { d: `M0 ${HIGH - EDGE}H${WIDE}` }, svg);
    if (limit !== undefined) drawSvg("path", "limit", { d: `M0 ${scales.y(limit)}H${WIDE}` }, svg);
    drawSvg("path", "curve", { d: lineOf(at, curve.values, scales) }, svg);
    const value = now(task, field), here = value === null ? null : valueOn(curve, at, value);
    if (value !== null) drawSvg("path", "cursor", { d: `M${scales.x(value)} 0V${HIGH}` }, svg);
    const dots = [[pinned && now(pinned, field), "pin-dot"], [value, "dot"]].map(([size, name]) => {
      const on = size === null || size === undefined ? null : valueOn(curve, at, size);
      // A cam that differs in other sizes too does not lie on the curve.
      if (on === null || (name === "pin-dot" && !alike(withChanges(task, pinned && changesOf(field, valueAt(pinned, field.path) ?? null)), pinned))) return null;
      return make("i", { class: name, style: `left: ${100 * scales.x(size) / WIDE}%; top: ${100 * scales.y(on) / HIGH}%` });
    });
    return make("figure", { class: "sweep" },
      make("figcaption", {}, make("span", { text: curve.title }), " ", make("span", { class: "said" }, saidOf(curve, here))),
      make("div", { class: "plot" }, picture.firstChild, dots,
        make("span", { class: "high", text: written(scales.high, curve.unit) }), make("span", { class: "low", text: written(scales.low, curve.unit) })),
      make("p", { class: "ends" }, make("span", { text: written(sweep.from, field.unit) }), make("span", { text: written(sweep.to, field.unit) })));
  }

  // A press on a chart takes the size there.
  charts.addEventListener("click", (event) => {
    const plot = event.target.closest(".plot"), field = fieldOf();
    if (!plot || !field || !sweep) return;
    const box = plot.getBoundingClientRect(), share = (event.clientX - box.left) / box.width;
    const value = sweep.from + share * (sweep.to - sweep.from);
    change(changesOf(field, Math.round(Math.round(value / field.step) * field.step * 1e6) / 1e6));
  });

  function draw() {
    const field = fieldOf(), { task, pin: pinned } = state();
    if (!sweep || !field || sweep.path !== field.path) return charts.replaceChildren(make("p", { class: "hint", text: words.sweeping }));
    if (!sweep.curves) return charts.replaceChildren(make("p", { class: "hint", text: sweep.message || "" }));
    charts.replaceChildren(...sweep.curves.map((curve) => chartOf(curve, field, task, pinned)).filter(Boolean));
  }

  async function update() {
    const field = fieldOf(), { task } = state();
    if (!field) return;
    // What the curve is over does not change it.
    const key = JSON.stringify([field.path, field.min, field.max, withChanges(task, changesOf(field, field.min))]);
    if (key === asked) return draw();
    asked = key;
    if (sweep?.path !== field.path) draw();
    running += 1;
    await compute(field, task, running);
  }

  async function compute({ path, min, max }, task, own) {
    const place = (k) => min + (max - min) * k / (DESIGNS - 1);
    let found = null;
    for (let k = 0; k < DESIGNS; k += PIECE) {
      const answer = await ask({ ask: "sweep", language, task, path, from: place(k), to: place(k + PIECE - 1), count: PIECE });
      if (own !== running) return;
      found = answer.ok === false ? { path, message: answer.error.message } : joined(found, answer);
      if (!found.curves) break;
    }
    sweep = { ...found, from: min, to: max };
    draw();
  }

  // A piece without any design has no curves.
  function joined(found, piece) {
    if (!found) return piece;
    const curves = new Map([...found.curves, ...piece.curves].map((curve) => [curve.id, curve]));
    const valuesIn = (each, id) => each.curves.find((curve) => curve.id === id)?.values || each.at.map(() => null);
    return {
      ...found, at: [...found.at, ...piece.at], limits: { ...found.limits, ...piece.limits },
      curves: [...curves.values()].map((curve) => ({ ...curve, values: [...valuesIn(found, curve.id), ...valuesIn(piece, curve.id)] })),
    };
  }
  size.addEventListener("change", () => {
    choose(size.value);
    update();
  });

  // The present cam and the pinned one, side by side.
  function compare(values, pinned) {
    pin.hidden = Boolean(pinned);
    both.replaceChildren(...(pinned ? [make("h3", { text: words.side_by_side }), valuesTable(values, [["now", "now", ({ said }) => said.drawn], pinnedColumn(pinned)], words)] : [make("p", { class: "hint", text: words.pin_about })]));
  }

  return { offer, update, draw, compare };
}
