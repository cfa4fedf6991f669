// The cam angle: its slider, the mechanism at it, the cam that turns by itself or by hand.
"use strict";

// Degrees in a millisecond: ten turns a minute.
const SPEED = 0.06;
const halfDegree = (degrees) => ((Math.round(2 * degrees) / 2) % 360 + 360) % 360;

function camAngleOf(page) {
  const { at, word, state, last, decimal } = page, now = state.get;
  const turning = { on: false, before: null, exact: 0 };
  let turned = null, sparks = [];

  // --- what is shown of it ----------------------------------------------------------------------------------------------

  function showScene() {
    const data = last.mechanism;
    if (!data) return;
    if (turned?.data !== data) turned = { data, ...mechanismOf(at("scene"), data) };
    turned.show(turned.placeAt(now().phi));
    page.stage.look("mechanism", data.box, { held: Boolean(page.hand) });
  }

  // The mechanism has no steps: its panel says what is read off at this angle.
  function showLive() {
    const data = last.mechanism, panel = at("panel-step");
    if (!data || !turned) return;
    if (panel.shows !== data || !panel.querySelector(".live")) buildLive(data, panel);
    const k = turned.placeAt(now().phi);
    lettered(panel.querySelector("h2"), turned.phaseAt(now().phi).name);
    for (const said of panel.querySelectorAll("[data-live]")) said.textContent = turned.read(said.dataset.live, k);
    sparks.forEach((move) => move(k));
  }

  function buildLive(data, panel) {
    panel.shows = data;
    const rows = data.live.map((name) => {
      const row = make("div", {}, make("dt", { text: word(name) }), make("dd", {}, make("strong", { "data-live": name })));
      return { row, name, picture: drawSvg("svg", "spark", { viewBox: "0 0 360 60", preserveAspectRatio: "none", "aria-hidden": "true" }, row) };
    });
    page.stepPanel.tell(make("h2"), make("p", { class: "about", text: data.about }), make("dl", { class: "live" }, rows.map(({ row }) => row)));
    sparks = rows.map(({ name, picture }) => sparkOf(picture, data, name));
  }

  function showPhi() {
    const { phi } = now(), phases = last.mechanism?.phases || [];
    at("phi").value = phi;
    at("phi-said").textContent = `${shortNumber(Math.round(phi * 10) / 10, decimal())}°`;
    at("phi").setAttribute("aria-valuetext", `φ = ${at("phi-said").textContent}`);
    if (at("phases").phases !== JSON.stringify(phases)) {
      at("phases").phases = JSON.stringify(phases);
      at("phases").replaceChildren(...phases.map((phase) => make("span", { style: `flex-grow: ${phase.extent}`, title: phase.name, text: phase.symbol })));
    }
    const wide = at("phases").clientWidth / 360;
    [...at("phases").children].forEach((bar, k) => bar.classList.toggle("mute", wide > 0 && isTight(phases[k].symbol.replace("_", ""), wide * phases[k].extent)));
    const here = Math.max(0, phases.findLastIndex((phase) => phase.start <= phi));
    [...at("phases").children].forEach((bar, k) => bar.classList.toggle("here", k === here));
    if (last.mechanism) page.strip.mechanism(last.mechanism, phi);
  }

  // The cam angle in a diagram over it.
  function showCursor(handles) {
    const layer = page.stage.layers.cursors, frame = page.stage.whole();
    layer.replaceChildren();
    for (const handle of handles) {
      if (handle.axes[0]?.path !== "phi" || handle.shape !== "x" || !frame) continue;
      drawSvg("path", "cursor", { d: `M${handle.at[0]} ${frame[1] - frame[3]}v${3 * frame[3]}` }, layer);
    }
  }

  // --- by hand -----------------------------------------------------------------------------------------------------------

  const markAngle = () => Math.atan2(last.mechanism.mark[1], last.mechanism.mark[0]);

  // The cam is taken hold of at its mark, which turns with it.
  function onCam(handle) {
    if (handle.shape !== "turn" || !last.mechanism) return handle;
    const { mark, sigma } = last.mechanism, far = 0.7 * Math.hypot(...mark);
    const angle = markAngle() + sigma * now().phi * Math.PI / 180;
    return {
      ...handle, at: [far * Math.cos(angle), -far * Math.sin(angle)], along: [Math.sin(angle), Math.cos(angle)],
      axes: [{ ...handle.axes[0], value: Math.round(now().phi * 10) / 10 }],
    };
  }

  function turnTo([x, y]) {
    const degrees = (Math.atan2(-y, x) - markAngle()) * 180 / Math.PI;
    state.set({ phi: halfDegree(last.mechanism.sigma * degrees) });
  }

  // --- by itself -----------------------------------------------------------------------------------------------------------

  function tick(time) {
    if (!turning.on) return;
    if (turning.before !== null) turning.exact = (turning.exact + (time - turning.before) * SPEED) % 360;
    turning.before = time;
    state.set({ phi: turning.exact });
    requestAnimationFrame(tick);
  }

  function markTurning() {
    document.body.classList.toggle("turning", turning.on);
    for (const name of ["title", "aria-label"]) at("play").setAttribute(name, word(turning.on ? "pause" : "play"));
    page.hands.away(turning.on);
  }

  function turn() {
    if (turning.on) return still();
    Object.assign(turning, { on: true, before: null, exact: now().phi });
    markTurning();
    requestAnimationFrame(tick);
  }

  function still() {
    if (!turning.on) return;
    turning.on = false;
    markTurning();
    state.set({ phi: halfDegree(now().phi) });
    page.ask();
  }

  return { showScene, showLive, showPhi, showCursor, onCam, turnTo, turn, still, turning: () => turning.on };
}
