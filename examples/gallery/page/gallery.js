// The page round the gallery: a list of scenes with pictures, an address for each of them, and a bar while it loads.
// `gl.js`, which is loaded before this file, has `load`, which starts the program, and `wasm_exports`, its functions.
"use strict";

const element = (id) => document.getElementById(id);
let scenes = [];
let starting = null;

// The scene that the address names, as a number; -1 if none.
function wanted() {
  const name = /^#scene=(.+)$/.exec(location.hash)?.[1];
  return name === undefined ? -1 : scenes.findIndex((scene) => scene.name === decodeURIComponent(name));
}

function showCards() {
  const card = (scene) => {
    const link = document.createElement("a");
    link.href = `#scene=${scene.name}`;
    const picture = document.createElement("img");
    Object.assign(picture, { src: `${scene.name}.png`, alt: scene.title, loading: "lazy", width: 320, height: 200 });
    const title = document.createElement("b");
    title.textContent = scene.title;
    const about = document.createElement("span");
    about.textContent = scene.about;
    link.append(picture, title, about);
    return link;
  };
  element("cards").replaceChildren(...scenes.map(card));
}

// Fetches the program once and starts it; a bar says how far it is.
function start() {
  starting ??= (async () => {
    const answer = await fetch("gallery.wasm");
    if (!answer.ok) throw new Error(`gallery.wasm: ${answer.status}`);
    // The length of a compressed response is that of the compressed bytes: the size was written when the page was built.
    const { size } = await (await fetch("size.json")).json();
    const parts = [];
    let received = 0;
    for (const reader = answer.body.getReader(); ;) {
      const { done, value } = await reader.read();
      if (done) break;
      parts.push(value);
      received += value.length;
      element("bar").value = received / size;
    }
    const program = URL.createObjectURL(new Blob(parts, { type: "application/wasm" }));
    load(program);
    while (typeof wasm_exports === "undefined" || wasm_exports.gallery_scene() < 0) {
      await new Promise((resolve) => setTimeout(resolve, 20));
    }
    URL.revokeObjectURL(program);
    if (matchMedia("(pointer: coarse)").matches) wasm_exports.gallery_has_touch();
    element("loading").hidden = true;
    return wasm_exports;
  })();
  return starting;
}

function complain(error) {
  element("words").textContent = `The gallery does not start: ${error.message ?? error}`;
  element("loading").hidden = false;
  console.error(error);
}

async function follow() {
  if (location.hash === "#hashes") return printHashes();
  const scene = wanted();
  const isShown = scene >= 0;
  element("stage").hidden = !isShown;
  element("list").hidden = isShown;
  // A hidden gallery uses no battery.
  if (typeof wasm_exports !== "undefined") wasm_exports.gallery_rest(Number(!isShown));
  if (!isShown) return;
  const program = await start();
  program.gallery_rest(Number(wanted() < 0));
  program.gallery_choose(scene);
  element("glcanvas").focus();
}

// A scene that was chosen in the program itself goes into the address. It is written only when it has changed there, so that a new
// address that the program has not read yet stays.
let before = -1;
setInterval(() => {
  if (element("stage").hidden || typeof wasm_exports === "undefined") return;
  const shown = wasm_exports.gallery_scene();
  if (shown !== before && scenes[shown] !== undefined && wanted() !== shown) {
    history.replaceState(null, "", `#scene=${scenes[shown].name}`);
  }
  before = shown;
}, 250);

// Escape ends the full screen; only the page gets that event.
document.addEventListener("fullscreenchange", () => {
  if (!document.fullscreenElement && typeof wasm_exports !== "undefined") wasm_exports.gallery_has_left_full_screen();
});

// The states of all scenes after some hundred steps, to be compared with those of `gallery --hashes`.
async function printHashes() {
  element("stage").hidden = false;
  const program = await start();
  element("stage").hidden = true;
  element("list").hidden = true;
  const out = element("hashes");
  out.hidden = false;
  for (const [index, scene] of scenes.entries()) {
    for (let number = 0; ; number++) {
      const hash = BigInt.asUintN(64, program.gallery_hash(index, number));
      if (hash === 0n) break;
      out.append(`${scene.name} ${number} ${hash.toString(16).padStart(16, "0")}\n`);
      await new Promise((resolve) => setTimeout(resolve));
    }
  }
  out.dataset.done = "yes";
}

(async () => {
  scenes = await (await fetch("scenes.json")).json();
  showCards();
  window.addEventListener("hashchange", () => follow().catch(complain));
  await follow();
})().catch(complain);
