// Tests the page of the gallery in Chromium: compares pictures, presses keys, drags with the mouse and with a
// finger, fills the screen, drops a file on it, and compares the states of all scenes with those that the program has natively.
// node look_at_page.mjs ADDRESS CHROMIUM HASHES FOLDER, with playwright-core where node finds it from FOLDER.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { gunzipSync } from "node:zlib";

const [address, executablePath, hashes, folder] = process.argv.slice(2);
const { chromium } = createRequire(join(folder, "package.json"))("playwright-core");
const args = ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
  "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];
const [LIST, HELD, PRECISE] = [1, 2, 4];

const failures = [];
function check(fact, what) {
  console.log(`${fact ? "ok  " : "FAIL"} ${what}`);
  if (!fact) failures.push(what);
}

const browser = await chromium.launch({ executablePath, headless: true, args });

async function open(options, hash) {
  const page = await (await browser.newContext(options)).newPage();
  page.on("pageerror", (error) => check(false, `no error: ${error.message}`));
  page.on("console", (message) => message.type() === "error" && check(false, `no error: ${message.text()}`));
  page.on("request", (request) => {
    const url = request.url();
    const isOurs = url.startsWith(address) || url.startsWith(`blob:${address}`) || url.startsWith("data:");
    if (!isOurs) check(false, `nothing is asked of others: ${url}`);
  });
  await page.goto(`${address}/${hash}`);
  return page;
}

const state = (page) => page.evaluate(() => wasm_exports.gallery_state());

async function shows(page, name) {
  const is = (name) => typeof wasm_exports !== "undefined" && scenes[wasm_exports.gallery_scene()]?.name === name &&
    element("loading").hidden;
  await page.waitForFunction(is, name, { timeout: 120_000 });
  await page.waitForTimeout(1500);
}

// Waits until a condition holds, at most some seconds.
async function becomes(page, is, seconds = 10) {
  for (let waited = 0; waited < 10 * seconds; waited++) {
    if (is(await state(page))) return true;
    await page.waitForTimeout(100);
  }
  return false;
}

// Number of colours of a picture: a blank one has one.
async function colors(page, path) {
  const picture = (await page.screenshot({ path })).toString("base64");
  return page.evaluate(async (picture) => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${picture}`)).blob());
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    return new Set(new Uint32Array(context.getImageData(0, 0, image.width, image.height).data.buffer)).size;
  }, picture);
}

// Points of the page, at one of which a body can be grabbed.
function* grid(width, height) {
  for (let y = 0.85; y > 0.3; y -= 0.04) {
    for (let x = 0.1; x < 0.95; x += 0.06) yield [Math.round(x * width), Math.round(y * height)];
  }
}

async function look() {
  const page = await open({ viewport: { width: 900, height: 600 } }, "");
  await page.waitForSelector("#cards a");
  const cards = await page.locator("#cards a").count();
  check(cards >= 30, `${cards} cards`);
  check(await colors(page, join(folder, "list.png")) > 100, "the list is drawn");
  await page.locator("#cards a[href='#scene=demo_scene_2']").click();
  await shows(page, "demo_scene_2");
  check(await colors(page, join(folder, "demo_scene_2.png")) > 100, "a scene is drawn");
  check(!(await state(page) & PRECISE), "it begins with the faithful set in 2D");
  await page.keyboard.press("m");
  check(await becomes(page, (now) => now & PRECISE), "a key chooses the other set");
  await page.evaluate(() => { location.hash = "#scene=pit_500"; });
  await shows(page, "pit_500");
  check(await drag(page, mouse(page), 900, 600), "the mouse holds, drags and lets go");
  check(await fillsTheScreen(page), "the full screen comes and goes, however it was left before");
  check(await drop(page), "a scene that is dropped on the page is shown");
  await page.keyboard.press("Escape");
  check(await becomes(page, (now) => now & LIST), "Escape opens the list");
  await page.evaluate(() => { location.hash = ""; });
  await page.waitForSelector("#cards a", { state: "visible" });
  await page.evaluate(() => { location.hash = "#scene=pinball"; });
  await shows(page, "pinball");
  check(await page.evaluate(() => !element("stage").hidden), "from the cards it goes on");
  await page.context().close();
}

const mouse = (page) => ({
  down: async ([x, y]) => { await page.mouse.move(x, y); await page.mouse.down(); },
  move: ([x, y]) => page.mouse.move(x, y, { steps: 5 }),
  up: () => page.mouse.up(),
});

async function finger(page) {
  const client = await page.context().newCDPSession(page);
  const send = (type, points) => client.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y]) => ({ x, y })) });
  return { down: (at) => send("touchStart", [at]), move: (at) => send("touchMove", [at]), up: () => send("touchEnd", []) };
}

async function drag(page, pointer, width, height) {
  for (const [x, y] of grid(width, height)) {
    await pointer.down([x, y]);
    if (await becomes(page, (now) => now & HELD, 1.5)) {
      await pointer.move([x, y - 40]);
      const holds = await becomes(page, (now) => now & HELD, 3);
      await pointer.up();
      return holds && becomes(page, (now) => !(now & HELD));
    }
    await pointer.up();
    await page.waitForTimeout(150);
  }
  return false;
}

// By the key, and then without it, as Escape does in a browser that has a screen.
async function fillsTheScreen(page) {
  const isFull = (wanted) => page.waitForFunction((wanted) => (document.fullscreenElement !== null) === wanted, wanted, { timeout: 5000 })
    .then(() => page.waitForTimeout(500)).then(() => true, () => false);
  for (let time = 0; time < 2; time++) {
    await page.keyboard.press("f");
    if (!(await isFull(true))) return false;
    await page.evaluate(() => document.exitFullscreen());
    if (!(await isFull(false))) return false;
  }
  return true;
}

async function drop(page) {
  const text = gunzipSync(readFileSync("tests/golden/traces/stack_20.json.gz")).toString();
  await page.evaluate((text) => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([text], "mine.json"));
    element("glcanvas").dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
  }, text);
  const isShown = () => wasm_exports.gallery_scene() === scenes.length;
  return page.waitForFunction(isShown, null, { timeout: 5000 }).then(() => true, () => false);
}

async function touch() {
  const [width, height] = [390, 760];
  const options = { viewport: { width, height }, hasTouch: true, isMobile: true, deviceScaleFactor: 1 };
  const page = await open(options, "#scene=pit_500");
  await shows(page, "pit_500");
  check(await drag(page, await finger(page), width, height), "a finger holds, drags and lets go");
  check(await colors(page, join(folder, "phone.png")) > 100, "a phone draws it");
  const fits = await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth);
  check(fits, "nothing is wider than a phone");
  await page.context().close();
}

async function compare() {
  const page = await open({}, "#hashes");
  await page.waitForSelector("#hashes[data-done]", { state: "attached", timeout: 240_000 });
  const lines = (text) => text.trim().split("\n").map((line) => line.split(" "));
  const here = lines(await page.textContent("#hashes"));
  const native = lines(readFileSync(hashes, "utf8"));
  const same = native.filter(([name, number, hash], at) => here[at]?.join() === [name, number, hash].join());
  const kinds = new Set(same.map(([, , , engine, set]) => `${engine} ${set}`));
  check(here.length === native.length && same.length === native.length,
    `${same.length} of ${native.length} states are the native ones, of ${new Set(native.map(([name]) => name)).size} scenes`);
  check(kinds.size === 4, `both engines with both sets: ${[...kinds].join(", ")}`);
  await page.context().close();
}

try {
  await look();
  await touch();
  await compare();
} finally {
  await browser.close();
}
if (failures.length > 0) {
  console.error(`${failures.length} checks failed`);
  process.exit(1);
}
