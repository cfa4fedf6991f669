// The site keeps itself for the time without a network.
"use strict";

if ("serviceWorker" in navigator) {
  addEventListener("load", () => navigator.serviceWorker.register("service-worker.js").catch((error) => console.warn(error)));
}
