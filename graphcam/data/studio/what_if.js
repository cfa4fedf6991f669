// What if: a quantity over any one size, with the present cam on the curve and the pinned one beside it.
"use strict";

// So many designs make a curve; they are asked for in pieces, between which a picture can be asked for.
const DESIGNS = 200, PIECE = 25;

// What the curves are called among the values of the cam on the page; the others are its sizes.
const VALUE_NAMES = {
  least_prime_radius: "minimum_prime_radius", pressure_angle_rise: "max_pressure_angle_rise_deg",
  pressure_angle_return: "max_pressure_angle_return_deg", curvature_radius: "min_pitch_curvature_radius", max_v: "max_v",
};

function whatIfOf(page) {
  const { at, words, decimal, last } = page, state = page.state.get;
  let fields = [], asked = "", sweep = null, running = 0;

  const byPath = (isWanted) => fields.find(({ path }) => isWanted(path));
  const fieldOf = () =>
    byPath((path) => path === state().swept) || byPath((path) => /offset|distance/.test(path)) || fields[0];
  const now = (task, field) => valueAt(task, field.path) ?? (task === state().task ? field.value : null);

  // The sizes that the engine can sweep.
  function offer(found) {
    fields = found;
    draw();
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
    const { values = [], sizes = {} } = last, value = values.find((each) => each.id === VALUE_NAMES[id]);
    const own = VALUE_NAMES[id] ? value && Math.abs(value.exact) : sizes[id], exact = here === null ? "" : written(here, unit);
    const adopted = own === null || own === undefined ? exact : written(id === "curvature_radius" && here < 0 ? -own : own, unit);
    const more = () => html`<small>${words.not_rounded.replace("{value}", exact)}</small>`;
    return html`<strong>${adopted}</strong>${exact && exact !== adopted ? more() : nothing}`;
  }

  // A cam that differs in other sizes too does not lie on the curve.
  const isOnCurve = (field, task, pinned) =>
    alike(withChanges(task, changesOf(field, valueAt(pinned, field.path) ?? null)), pinned);

  function chartOf(curve, field, task, pinned) {
    const { at, limits = {}, from, to } = sweep, limit = limits[curve.id] ?? undefined;
    const scales = scalesOf(curve, at, limit);
    if (!scales.known) return nothing;
    const value = now(task, field), here = value === null ? null : valueOn(curve, at, value);
    const line = (name, d) => svg`<path class=${name} d=${d}></path>`;
    const dot = (size, name) => {
      const on = valueOn(curve, at, size), left = 100 * scales.x(size) / WIDE, top = 100 * scales.y(on) / HIGH;
      return on === null ? nothing : html`<i class=${name} style="left: ${left}%; top: ${top}%"></i>`;
    };
    const before = pinned && isOnCurve(field, task, pinned) ? now(pinned, field) : null;
    return html`<figure class="sweep">
      <figcaption><span>${letters(curve.title)}</span> <span class="said">${saidOf(curve, here)}</span></figcaption>
      <div class="plot" @click=${take}>
        <svg class="sweep-picture" viewBox="0 0 ${WIDE} ${HIGH}" preserveAspectRatio="none" aria-hidden="true">
          ${line("axis", `M0 ${HIGH - EDGE}H${WIDE}`)}
          ${limit === undefined ? nothing : line("limit", `M0 ${scales.y(limit)}H${WIDE}`)}
          ${line("curve", lineOf(at, curve.values, scales))}
          ${value === null ? nothing : line("cursor", `M${scales.x(value)} 0V${HIGH}`)}
        </svg>
        ${before === null ? nothing : dot(before, "pin-dot")}
        ${value === null ? nothing : dot(value, "dot")}
        <span class="high">${written(scales.high, curve.unit)}</span>
        <span class="low">${written(scales.low, curve.unit)}</span>
      </div>
      <p class="ends"><span>${written(from, field.unit)}</span><span>${written(to, field.unit)}</span></p></figure>`;
  }

  // A press on a chart takes the size there.
  function take({ currentTarget, clientX }) {
    const field = fieldOf(), box = currentTarget.getBoundingClientRect(), share = (clientX - box.left) / box.width;
    const value = sweep.from + share * (sweep.to - sweep.from);
    page.change(changesOf(field, Math.round(Math.round(value / field.step) * field.step * 1e6) / 1e6));
  }

  function chartsOf(field) {
    const { task, pin } = state();
    if (!sweep || sweep.path !== field?.path) return html`<p class="hint">${words.sweeping}</p>`;
    if (!sweep.curves) return html`<p class="hint">${letters(sweep.message || "")}</p>`;
    return repeat(sweep.curves, ({ id }) => id, (curve) => chartOf(curve, field, task, pin));
  }

  // The present cam and the pinned one, side by side.
  function both() {
    const pinned = pinnedValues(page);
    if (!pinned) return html`<p class="hint">${words.pin_about}</p>`;
    const columns = [["now", "now", ({ said }) => said.drawn], pinnedColumn(pinned)];
    return html`<h3>${words.side_by_side}</h3>${valuesTable(last, columns, words)}`;
  }

  function draw() {
    const field = fieldOf(), isChosen = (path) => path === field.path;
    render(html`
      <label class="from"><span>${words.over}</span>
        <select id="sweep-size" data-key="sweep-size" @change=${chosen}>${
          options(fields.map(({ path, name }) => [path, name]), isChosen)}</select></label>
      <div class="charts">${chartsOf(field)}</div>
      <button type="button" class="pins" ?hidden=${state().pin} @click=${() => at("pin").click()}>${words.pin}</button>
      <div>${both()}</div>`, at("panel-what-if"));
  }

  function chosen({ target }) {
    page.state.set({ swept: target.value });
    update();
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
      const from = place(k), to = place(k + PIECE - 1);
      const answer = await page.queue.question({ ask: "sweep", language: page.config.language, task, path, from, to, count: PIECE });
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

  return { offer, update, draw };
}
