// The site of the studio works without a network once it was opened: all of a build is kept, under the sum of the build.
// BUILD and FILES, those whose names differ from build to build, stand above.
"use strict";

const PAGE = ["./", "index.html"];
const KEPT = `graphcam studio ${registration.scope} `;
const OWN = KEPT + BUILD;

async function keep() {
  const cache = await caches.open(OWN);
  await cache.addAll([...FILES, ...PAGE.map((address) => new Request(address, { cache: "reload" }))]);
}

async function forgetOthers() {
  const others = (await caches.keys()).filter((name) => name.startsWith(KEPT) && name !== OWN);
  await Promise.all(others.map((name) => caches.delete(name)));
  await clients.claim();
}

async function found(request) {
  const cache = await caches.open(OWN);
  return (await cache.match(request, { ignoreSearch: true })) || fetch(request);
}

addEventListener("install", (event) => event.waitUntil(keep()));
addEventListener("activate", (event) => event.waitUntil(forgetOthers()));
addEventListener("fetch", (event) => {
  const { method, url } = event.request;
  if (method === "GET" && url.startsWith(registration.scope)) event.respondWith(found(event.request));
});
