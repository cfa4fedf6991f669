// The profile in colours: by the pressure angle, or by how sharp and how hollow it is, with a bar that says how much.
"use strict";

// So many depths of a colour can be told from one another.
const DEPTHS = 8;

// How deep the colour is at every place, from -1 to 1: of an angle its amount, of a radius of curvature its inverse, which
// is less than 0 where the profile is hollow; and with which values the bar ends, null for a straight profile.
function depthsOf({ arrays }, name) {
  const isRadius = name === "curvature_radius", known = arrays[name].map((value) => value ?? (isRadius ? Infinity : 0));
  const amounts = known.map((value) => (isRadius ? 1 / value : Math.abs(value)));
  const low = Math.min(0, ...amounts), high = Math.max(0, ...amounts), most = Math.max(high, -low) || 1;
  const valueOf = (amount) => (isRadius ? (amount ? 1 / amount : null) : amount);
  const bar = `--low: ${-100 * low / most}%; --high: ${100 * high / most}%; --middle: ${-100 * low / (high - low || 1)}%`;
  return { depths: amounts.map((amount) => amount / most), ends: [low, high].map(valueOf), bar };
}

const kindOf = (depth) => (depth < 0 ? "hollow" : "sharp");

// The profile of a turned cam in the colours of a quantity, or plain.
function paintProfile({ data, cam, painted }, name) {
  if (painted.name === name) return;
  painted.name = name;
  for (const band of cam.querySelectorAll(".band")) band.remove();
  if (!data.arrays[name]) return;
  // The places of contact as they lie on the cam that has not turned.
  const places = data.arrays.contact.map(([x, y], k) => {
    const angle = -data.sigma * k * data.step * Math.PI / 180, [c, s] = [Math.cos(angle), Math.sin(angle)];
    return [c * x - s * y, s * x + c * y].map((each) => Math.round(1000 * each) / 1000);
  });
  const bands = new Map(), { depths } = depthsOf(data, name);
  for (let k = 1; k < places.length; k += 1) {
    const depth = Math.round(DEPTHS * (depths[k - 1] + depths[k]) / 2) / DEPTHS;
    bands.set(depth, (bands.get(depth) ?? "") + pathOf([places[k - 1], places[k]]));
  }
  for (const [depth, d] of bands) drawSvg("path", `band ${kindOf(depth)}`, { d, style: `--depth: ${100 * Math.abs(depth)}%` }, cam);
}

function colouringOf({ word, state, decimal }) {
  // The choice, and of the chosen quantity the bar.
  return (data) => {
    const names = ["pressure_angle", "curvature_radius"].filter((name) => data.arrays[name]), { colour } = state.get();
    const choose = ({ target }) => state.set({ colour: target.value || null });
    const said = (value) => (value === null ? word("straight") : shortNumber(Number(value.toPrecision(3)), decimal()) + data.units[colour]);
    const barOf = ({ ends: [low, high], bar }) =>
      html`<p class="colour-bar"><span>${said(low)}</span><i style=${bar} aria-hidden="true"></i><span>${said(high)}</span></p>`;
    return html`<p class="colouring"><label>${word("colouring")} <select id="colour" @change=${choose}>${
      options([["", word("colour_none")], ...names.map((name) => [name, word(name)])], (value) => value === (colour ?? ""))}</select></label></p>
      ${data.arrays[colour] ? barOf(depthsOf(data, colour)) : nothing}`;
  };
}
