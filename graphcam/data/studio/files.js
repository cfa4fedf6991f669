// Files: a task is saved and opened, sheets are written by who serves the page, a link is copied.
"use strict";

function filesOf(page) {
  const { at, word, config, state, queue, wire } = page, now = state.get;

  function said(text, wrong = false, more = nothing) {
    render([text, more], at("written"));
    at("written").classList.toggle("over", wrong);
  }
  const refused = ({ error }) => said([error.message, error.remedy].filter(Boolean).join("; "), true);

  // Another task takes the place of this one; undo brings it back.  Resolves to whether it can be drawn.
  const load = (task, name = now().name, more = {}) => page.wantWhole({ task, name, ...more });

  async function save() {
    const answer = await queue.question({ ask: "task_file", task: now().task });
    if (answer.ok === false) return refused(answer);
    const href = URL.createObjectURL(new Blob([answer.text], { type: "application/toml" }));
    Object.assign(document.createElement("a"), { href, download: answer.name }).click();
    setTimeout(() => URL.revokeObjectURL(href), 1000);
    said(word("saved"));
  }

  async function open() {
    const [file] = at("file").files;
    if (!file) return;
    const answer = await queue.question({ ask: "open", text: await file.text() });
    at("file").value = "";
    if (answer.ok === false) return refused(answer);
    said(file.name);
    load(answer.task);
  }

  // Files of others are replaced only when that is asked for.
  function askAbout({ others, folder }, kind) {
    const all = others.slice(0, 5).join(", ") + (others.length > 5 ? " ..." : "");
    const text = word("others_there").replace("{folder}", folder).replace("{files}", all);
    const writeAll = () => write(kind, true);
    said(text, true, html` <button type="button" id="replace" @click=${writeAll}>${word("replace_them")}</button>`);
    at("replace").focus();
  }

  async function write(kind, replace = false) {
    said(word("writing"));
    try {
      const answer = await wire.write(kind, now().task, replace);
      if (answer.others) askAbout(answer, kind);
      else if (answer.error) refused(typeof answer.error === "string" ? { error: { message: answer.error } } : answer);
      else said(word("written").replace("{folder}", answer.folder).replace("{files}", answer.files.join(", ")));
    } catch (error) {
      said(String(error.message || error), true);
    }
  }

  async function copyLink() {
    const hash = await page.address.write(page.place());
    await page.writeAddress();
    try { await navigator.clipboard.writeText(location.href); } catch { /* the address line has it */ }
    const text = word(hash ? "link_copied" : "link_too_long");
    page.announce(text);
    render(text, at("told-limits"));
    setTimeout(page.showStatus, 2500);
  }

  at("save").addEventListener("click", save);
  at("open").addEventListener("click", () => at("file").click());
  at("file").addEventListener("change", open);
  at("link").addEventListener("click", copyLink);
  at("builtin")?.addEventListener("change", ({ target }) => load(config.builtin[target.value], target.value));
  for (const button of document.querySelectorAll("[data-write]")) button.addEventListener("click", () => write(button.dataset.write));

  return { load };
}
