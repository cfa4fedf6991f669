// The studio in a notebook: its page in a frame; requests go to the kernel, the task and the view go both ways.
"use strict";

const SHARED = ["task", "view"];

function render({ model, el }) {
  const frame = document.createElement("iframe");
  // Several frames may show one model: an answer goes to the one that has asked.
  const asked = `${Date.now()}-${Math.random()}`;
  Object.assign(frame, { title: model.get("title"), srcdoc: model.get("page") });
  Object.assign(frame.style, { width: "100%", height: `${model.get("height")}px`, border: "0" });

  const post = (body) => frame.contentWindow?.postMessage({ studio: "widget", ...body }, "*");
  const told = () => post({ state: Object.fromEntries(SHARED.map((name) => [name, model.get(name)])) });

  function heard({ source, data }) {
    if (source !== frame.contentWindow || data?.studio !== "widget") return;
    if (data.request) model.send({ frame: asked, id: data.id, request: data.request });
    if (data.state) take(data.state);
  }

  function take(state) {
    // A page that has just begun tells nothing: it wants to know.
    if (!Object.keys(state).length) return told();
    for (const name of SHARED) if (name in state) model.set(name, state[name]);
    model.save_changes();
  }

  const answered = (content) => content.frame === asked && post({ id: content.id, response: content.response });
  const changed = SHARED.map((name) => `change:${name}`).join(" ");
  window.addEventListener("message", heard);
  model.on("msg:custom", answered);
  model.on(changed, told);
  el.append(frame);
  return () => {
    window.removeEventListener("message", heard);
    model.off("msg:custom", answered);
    model.off(changed, told);
  };
}

export default { render };
