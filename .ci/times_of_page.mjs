// Prints how long the last frames of scenes took on the page of the gallery in headless Chromium, as `gallery SCENE --times` does
// of the window, and the time of the steps that `gallery --hashes` makes in all scenes.
// node times_of_page.mjs ADDRESS CHROMIUM FOLDER SECONDS SCENE..., with playwright-core where node finds it from FOLDER.
import { createRequire } from "node:module";
import { join } from "node:path";

const [address, executablePath, folder, seconds, ...names] = process.argv.slice(2);
const { chromium } = createRequire(join(folder, "package.json"))("playwright-core");
const args = ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const browser = await chromium.launch({ executablePath, headless: true, args });
try {
  for (const name of names) {
    // As large as the window.
    const context = await browser.newContext({ viewport: { width: 1280, height: 760 } });
    const page = await context.newPage();
    await page.goto(`${address}/#scene=${name}`);
    const isShown = (name) => typeof wasm_exports !== "undefined" && scenes[wasm_exports.gallery_scene()]?.name === name;
    await page.waitForFunction(isShown, name, { timeout: 120_000 });
    await page.waitForTimeout(1000 * Number(seconds));
    const times = await page.evaluate(() => [0, 1, 2].map((which) => wasm_exports.gallery_times(which)));
    const [frame, steps, drawing] = times.map((ms) => ms.toFixed(2).padStart(7));
    console.log(`${name.padEnd(14)} frame ${frame} ms, steps ${steps} ms, drawing ${drawing} ms`);
    await context.close();
  }
  const page = await (await browser.newContext()).newPage();
  await page.goto(`${address}/#scene=pinball`);
  await page.waitForFunction(() => typeof wasm_exports !== "undefined" && wasm_exports.gallery_scene() >= 0);
  const ms = await page.evaluate(() => {
    wasm_exports.gallery_rest(1);
    const start = performance.now();
    scenes.forEach((_, scene) => wasm_exports.gallery_hash(scene, 0));
    return performance.now() - start;
  });
  console.log(`steps of all scenes: ${(ms / 1000).toFixed(2)} s`);
} finally {
  await browser.close();
}
