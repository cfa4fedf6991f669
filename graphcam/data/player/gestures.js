// Fingers and the wheel on a pane move what is seen of its drawing: one finger shifts it, two and the wheel bring it closer.
"use strict";

// `onDrawing` says what stands at a place of the window, `zoomAbout(factor, point)` and `shift(by)` move it, in the
// drawing's own millimetres; `wanted` says of a finger or a wheel whether it is meant.
function gesturesOf(pane, { onDrawing, zoomAbout, shift, wanted = () => true }) {
  const touching = new Map();

  function spread() {
    const [a, b] = [...touching.values()];
    return { length: Math.hypot(a.x - b.x, a.y - b.y), x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
  }

  pane.addEventListener("pointerdown", (event) => {
    if (!wanted(event)) return;
    touching.set(event.pointerId, { x: event.clientX, y: event.clientY });
    pane.setPointerCapture(event.pointerId);
    pane.classList.add("dragged");
  });
  pane.addEventListener("pointermove", (event) => {
    const before = touching.get(event.pointerId);
    if (!before) return;
    const pinch = touching.size === 2 ? spread() : null;
    const from = onDrawing(before.x, before.y), to = onDrawing(event.clientX, event.clientY);
    touching.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (pinch) {
      const now = spread();
      zoomAbout(now.length / (pinch.length || 1), onDrawing(now.x, now.y));
    }
    shift({ x: (to.x - from.x) / touching.size, y: (to.y - from.y) / touching.size });
  });
  for (const end of ["pointerup", "pointercancel"]) {
    pane.addEventListener(end, (event) => {
      touching.delete(event.pointerId);
      if (!touching.size) pane.classList.remove("dragged");
    });
  }
  pane.addEventListener("wheel", (event) => {
    if (!wanted(event)) return;
    event.preventDefault();
    zoomAbout(Math.exp(-event.deltaY / 400), onDrawing(event.clientX, event.clientY));
  }, { passive: false });
}
