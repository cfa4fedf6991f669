// The worker of a page in one file: made of texts that the page carries, so that nothing is fetched.
"use strict";

function startEngine({ engine }) {
  const worker = new Worker(URL.createObjectURL(new Blob([engine], { type: "text/javascript" })));
  // They stand behind the scripts, and are not needed twice.
  function handOver() {
    const carried = [...document.querySelectorAll("script[data-part]")];
    worker.postMessage({ parts: Object.fromEntries(carried.map((part) => [part.dataset.part, part.textContent])) });
    for (const part of carried) part.remove();
  }
  if (document.readyState === "loading") addEventListener("DOMContentLoaded", handOver, { once: true });
  else handOver();
  return worker;
}
