// The cam angle: its slider, the mechanism at it, the cam that turns by itself or by hand.
"use strict";

// Degrees in a millisecond: six turns a minute.
const SPEED = 0.036;
const halfDegree = (degrees) => ((Math.round(2 * degrees) / 2) % 360 + 360) % 360;

function camAngleOf(page) {
  const { at, word, state, last, decimal } = page, now = state.get;
  const turning = { on: false, before: null, exact: 0 };
  const curves = new WeakMap(), stood = new Map(), colouring = colouringOf(page);

  // --- what is shown of it ----------------------------------------------------------------------------------------------

  function showScene(pane) {
    const data = last.mechanism;
    if (!data) return;
    if (pane.turned?.data !== data) pane.turned = { data, painted: {}, ...mechanismOf(pane.at("scene"), data) };
    paintProfile(pane.turned, now().colour);
    pane.turned.show(pane.turned.placeAt(now().phi));
    pane.stage.look({ name: "mechanism", frame: data.box }, { held: Boolean(page.hand) });
  }

  // All that goes with the cam angle and needs no answer of the engine.
  function follow() {
    for (const pane of page.panes) if (pane.names().includes("mechanism")) showScene(pane);
    if (page.turns()) showLive();
    page.showHands();
  }

  const showsPlan = () => page.panes.some((pane) => pane.names().includes("plan"));

  // The velocity plan goes with it too, from station to station.
  function followPlan() {
    const far = (last.stations || []).map((degrees) => Math.abs(degrees - now().phi));
    if (far.length && showsPlan()) state.set({ station: far.indexOf(Math.min(...far)) });
  }

  // The mechanism has no steps: its panel says what is read off at this angle.
  function showLive() {
    const data = last.mechanism, { turned } = page.panes[0];
    if (!data || !turned) return;
    const k = turned.placeAt(now().phi);
    const rowOf = (name) => html`<div><dt>${word(name)}</dt>
      <dd><strong data-live=${name}>${turned.read(name, k)}</strong></dd>
      <svg class="spark" viewBox="0 0 360 60" preserveAspectRatio="none" aria-hidden="true"></svg></div>`;
    page.stepPanel.tell(html`<h2>${letters(turned.phaseAt(now().phi).name)}</h2>
      <p class="about">${letters(data.about)}</p>
      ${colouring(data)}<dl class="live">${data.live.map(rowOf)}</dl>
      <p class="hint">${word("live_exact")}</p>`);
    at("panel-step").querySelectorAll(".spark").forEach((picture, j) => showSpark(picture, data, data.live[j], k));
  }

  function showSpark(picture, data, name, k) {
    if (picture.data !== data) {
      picture.replaceChildren();
      Object.assign(picture, { data, moved: sparkOf(picture, data, name) });
    }
    picture.moved(k);
  }

  function showPhi() {
    const { phi } = now(), phases = last.mechanism?.phases || [], wide = at("phases").clientWidth / 360;
    const here = Math.max(0, phases.findLastIndex((phase) => phase.start <= phi));
    const isMute = ({ symbol, extent }) => wide > 0 && isTight(symbol.replace("_", ""), wide * extent);
    const barOf = (phase, k) => html`<span class="${isMute(phase) ? "mute" : ""}${k === here ? " here" : ""}"
      style="flex-grow: ${phase.extent}" title=${phase.name}>${letters(phase.symbol)}</span>`;
    render(phases.map(barOf), at("phases"));
    at("phi").value = phi;
    at("phi-said").textContent = `${shortNumber(Math.round(phi * 10) / 10, decimal())}°`;
    at("phi").setAttribute("aria-valuetext", `φ = ${at("phi-said").textContent}`);
    if (last.mechanism) page.strip.mechanism(last.mechanism, phi);
  }

  // The cam angle in the diagrams over it: one line through all of them, and what each comes to there.
  function showCursor(pane, handles) {
    const layer = pane.stage.layers.cursors, frame = pane.stage.whole(), knob = handles.find(({ id, shape }) => shape === "x" && isOwn(id));
    layer.replaceChildren();
    if (!knob || !frame) return;
    const [x] = knob.at, own = page.picture(pane), side = x > frame[0] + 0.75 * frame[2] ? "end" : "start";
    drawSvg("path", "cursor", { d: `M${x} ${frame[1] - frame[3]}v${3 * frame[3]}` }, layer);
    const taken = !turning.on && !page.hand ? [...pane.at("steps").querySelectorAll("text")].map((text) => text.getBoundingClientRect()) : [];
    for (const { name, ordinate } of own?.down ? own.views : []) {
      const y = heightOf(pane, name, x), at = y + own.down[name];
      if (`${name}/phi` !== knob.id) drawSvg("circle", "here", { cx: x, cy: at, r: 1 }, layer);
      const said = shortNumber(Number((-y * ordinate.per_mm).toPrecision(3)), decimal()) + (ordinate.unit === "°" ? "°" : "");
      const reading = drawSvg("text", "reading", { x, y: at }, layer);
      reading.textContent = said;
      standFree(reading, name, taken, side, y > 0);
    }
  }

  // Beside its point, and at rest where no letters of the drawing stand; while something moves it does not hop.
  function standFree(reading, name, taken, side, below) {
    const put = (place) => Object.entries(place).forEach(([key, value]) => reading.setAttribute(key, value));
    const meets = (own, box) => own.left < box.right && box.left < own.right && own.top < box.bottom && box.top < own.bottom;
    const isFree = (place) => {
      put(place);
      const own = reading.getBoundingClientRect();
      return !taken.some((box) => meets(own, box));
    };
    const places = [side, side === "end" ? "start" : "end"].flatMap((anchor) => [below, !below].map((down) => ({
      "text-anchor": anchor, dx: anchor === "end" ? "-.9em" : ".9em", dy: down ? "1.2em" : "-.5em",
    })));
    if (taken.length) stood.set(name, places.find(isFree) || places[0]);
    put(stood.get(name)?.["text-anchor"] === side || taken.length ? stood.get(name) : places[0]);
  }

  // --- handles as they stand on the page -----------------------------------------------------------------------------------

  // The cam angle on the cam itself and on the curves of the diagrams: the page knows where.
  const isOwn = (id) => id === "mechanism/phi" || DIAGRAMS.some((name) => id === `${name}/phi`);

  function heightOf(pane, name, x) {
    const view = pane.gallery.view(name);
    if (!view) return 0;
    if (!curves.has(view)) curves.set(view, curvesOf(view));
    return heightAt(curves.get(view), x);
  }

  // Those of a pane; of diagrams one under another the cam angle has one for all, and a border stands in the lowest but one.
  function handlesIn(pane, handles) {
    const names = pane.names(), down = page.picture(pane)?.down || {}, borders = names.includes("displacement") ? "displacement" : names.at(-1);
    const isWanted = ({ id, view }) => names.length < 2 || (id.endsWith("/phi") ? view === names[0] : id.includes("/border") ? view === borders : /\/(lift|point)/.test(id));
    return handles.filter((handle) => names.includes(handle.view) && isWanted(handle)).flatMap((handle) => {
      if (handle.axes[0].path === "phi") {
        if (isOwn(handle.id)) handle = withAngle(pane, handle);
        else if (turning.on) return [];
      }
      return [{ ...handle, at: [handle.at[0], handle.at[1] + (down[handle.view] || 0)] }];
    });
  }

  function withAngle(pane, handle) {
    if (handle.shape === "turn") return onCam(handle);
    const { phi } = now(), x = phi / last.degrees_per_mm;
    return { ...handle, at: [x, heightOf(pane, handle.view, x)], axes: [{ ...handle.axes[0], value: Math.round(phi * 10) / 10 }] };
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

  function turnTo({ handle, to: [x, y], fine }) {
    if (handle !== "mechanism/phi") {
      const by = fine ? 10 : 2, degrees = Math.round(x * last.degrees_per_mm * by) / by;
      return state.set({ phi: Math.max(0, Math.min(360, degrees)) });
    }
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

  return { showScene, showLive, showPhi, showCursor, follow, followPlan, showsPlan, isOwn, handlesIn, turnTo, turn, still, turning: () => turning.on };
}
