// Every view as pictures, light and dark, wide and narrow; eight tabs with one stream; the heap over MINUTES at 30 Hz.
//
// usage: long.mjs MDOFD FOLDER [MINUTES]     pictures go to FOLDER/screens
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import zlib from "node:zlib";
import {accessible, launch, text, watch} from "./browser.mjs";
import {Daemon, kData} from "./daemon.mjs";

const [, , program, folder, minutes = "60"] = process.argv;
const kWidths = [1280, 390];
const kSettled_min = 1;  // the heap of a page that has just opened grows for a while
const kHeap = 0.02;
const daemon = new Daemon(program);
const errors = [];
const say = (what) => console.log(`${(performance.now() / 1000).toFixed(0)} s: ${what}`);
const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

const kMachine = `name = "m"
machine = {chain = "w-Y-X-b-t"}
[[axis]]
id = "X"
holds_at_mm = [0, 0, 0]
point = "moving"
EXX_um = [[0, 0], [20, 1.2], [40, 1.7], [60, 3.1]]
EYX_um = [[0, 0], [20, 0.8], [40, 0.3], [60, -0.4]]
u_EXX_um = 0.1
u_EYX_um = 0.1
[[axis]]
id = "Y"
holds_at_mm = [0, 0, 0]
point = "moving"
EYY_um = [[0, 0], [20, -0.9], [40, -1.8]]
EXY_um = [[0, 0], [20, 0.5], [40, 1.4]]
u_EYY_um = 0.1
u_EXY_um = 0.1
`;

async function measured(axis, targets_mm, note) {
  const {run} = await daemon.call("run.start", {axis, targets_mm, repeats: 2, note});
  while ((await daemon.call("run.get", {run})).state === "open") await sleep(300);
  return run;
}

// Replays a recorded log whose readings are larger by a varying part, so that a control chart has limits.
async function replayed() {
  const lines = zlib.gunzipSync(fs.readFileSync(`${kData}/log_X.csv.gz`)).toString().trim().split("\n");
  const [head, ...rows] = lines.filter((line) => !line.startsWith("#"));
  const probe = head.split(",").map((name) => /^[A-E](_|$)/.test(name));
  assert.ok(probe.filter(Boolean).length === 5, head);
  const rig = fs.readFileSync(`${kData}/rig_X.toml`, "utf8");
  for (let k = 0; k < 10; ++k) {
    const log = path.join(folder, `log-${k}.csv`), factor = 1 + 0.01 * Math.sin(k * k);
    fs.writeFileSync(log, [head, ...rows.map((row) => row.split(",").map((cell, i) => probe[i] && cell ? cell * factor : cell).join(","))].join("\n") + "\n");
    await daemon.call("run.replay", {path: log, rig});
  }
}

async function imported() {
  const file = path.join(folder, "laser.csv");
  const readings = [1, 2, 3].flatMap((k) => [1, -1].flatMap((d) => [0, 10, 20, 30].map((x) => [x, d, k, (Math.sin(x / 9) + 0.1 * d + 0.02 * k).toFixed(3)])));
  fs.writeFileSync(file, "target_mm,direction,run,deviation_um\n" + readings.map((row) => row.join(",") + "\n").join(""));
  return (await daemon.call("run.import", {path: file, axis: "X", u_um: 0.05})).run;
}

// Two runs of X and one of Y, two tables of which one is active, a table of the volume, replayed logs, an imported run.
async function world() {
  const x = await measured("X", [0, 2, 4, 6], "before scraping");
  const later = await measured("X", [0, 2, 4, 6], "after scraping");
  const y = await measured("Y", [0, 2, 4], "");
  const {table} = await daemon.call("compensation.build", {runs: [x]});
  await daemon.call("compensation.build", {runs: [later]});
  const volume = await daemon.call("compensation.build_volume", {machine: kMachine, axes: "XY", step_mm: 10, incomplete: true});
  await replayed();
  return {x, later, y, table, volume: volume.table, laser: await imported()};
}

// Activates a table of an axis or of the volume. Both at once would correct twice.
async function activate(table, other) {
  await daemon.call("compensation.deactivate", {axis: other});
  await daemon.call("compensation.activate", {table, simulated: true, despite_warnings: true, reason: "for the picture"});
}

// Each view: address, and what is done before the picture.
function views({x, later, y, table, volume, laser}) {
  const tables = async (page) => {
    await activate(table, "volume");
    await page.getByRole("button", {name: "Show table 2"}).click();
    await page.locator(".chart canvas").first().waitFor();
  };
  const plane = async (page) => {
    await activate(volume, "X");
    await page.getByText("Largest correction").waitFor();
  };
  return {
    setup: ["#setup", (page) => page.getByText(/Noise s =/).first().waitFor()], capture: ["#capture"],
    measuring: ["#capture", (page) => page.locator(".chart canvas").first().waitFor()],
    runs: ["#runs"], run: [`#runs/${x}`], with: [`#runs/${later}/with/${x}`], square: [`#runs/${x}/square/${y}`],
    imported: [`#runs/${laser}`], trend: ["#runs/trend", (page) => page.getByText(/upper limit|beyond/).first().waitFor()],
    compensation: ["#compensation/X", tables], volume: ["#compensation/volume", plane], health: ["#health", (page) => page.getByText(/h at the rate/).waitFor()],
  };
}

async function pictures(browser, found) {
  const screens = path.join(folder, "screens");
  fs.mkdirSync(screens, {recursive: true});
  for (const colorScheme of ["light", "dark"])
    for (const width of kWidths) {
      const page = await browser.newPage({viewport: {width, height: 900}, colorScheme});
      watch(page, errors);
      for (const [name, [hash, act]] of Object.entries(views(found))) {
        const run = name === "measuring" ? (await daemon.call("run.start", {axis: "X", targets_mm: [0, 2, 4, 6], repeats: 9})).run : null;
        await page.goto(daemon.url + "/" + hash);
        await page.reload();
        await page.locator("h1").waitFor();
        await act?.(page);
        await page.getByText("Loading …").waitFor({state: "detached"});
        await sleep(name === "measuring" ? 4000 : 700);
        await accessible(page, `${name}, ${colorScheme}, ${width} px`);
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${name} fits ${width} px`);
        assert.ok(await page.evaluate(() => [...document.querySelectorAll(".dygraph-axis-label")].every((label) =>
          getComputedStyle(label).color === getComputedStyle(document.body).color)), `labels of the charts are seen: ${name}, ${colorScheme}`);
        await page.screenshot({path: path.join(screens, `${name}-${colorScheme}-${width}.png`), fullPage: true});
        if (run) await daemon.call("run.stop", {run, abort: true});
      }
      await page.close();
    }
  say(`pictures are in ${screens}`);
}

const moves = (page) => page.evaluate(() => new Promise((resolve) => {
  const place = document.querySelector(".where"), before = place.textContent, began = performance.now();
  const look = () => place.textContent !== before ? resolve(true) : performance.now() - began > 20_000 ? resolve(false) : setTimeout(look, 50);
  look();
}));

async function eightTabs(browser) {
  const context = await browser.newContext();
  const streams = [];
  const tabs = [];
  for (let i = 0; i < 8; ++i) {
    const page = await context.newPage();
    watch(page, errors);
    page.on("request", (request) => { if (request.url().includes("/events")) streams.push(page); });
    await page.goto(daemon.url);
    await page.locator(".where").waitFor();
    tabs.push(page);
  }
  for (const tab of tabs) assert.ok(await moves(tab), "every tab is alive");
  assert.equal(streams.length, 1, "one stream for all tabs");
  const [first] = streams;
  await first.close();
  for (const tab of tabs.filter((t) => t !== first)) assert.ok(await moves(tab), "alive after the tab with the stream was closed");
  assert.equal(streams.length, 2, "another tab has taken over");
  await context.close();
  say("eight tabs were alive over one stream, and after it was closed");
}

async function heap(browser) {
  const page = await browser.newPage({viewport: {width: 1280, height: 900}});
  watch(page, errors);
  const session = await page.context().newCDPSession(page);
  await page.goto(`${daemon.url}/?interval_ms=33`);
  await page.locator(".where").waitFor();
  await page.evaluate(async () => {
    const live = await import("/live.js");
    window.updates = 0;
    live.on("live.update", () => ++window.updates);
  });
  // The least of some: what has just come is no growth.
  const used = async () => {
    const found = [];
    for (let i = 0; i < 10; ++i) {
      await session.send("HeapProfiler.collectGarbage");
      found.push((await session.send("Runtime.getHeapUsage")).usedSize);
      await sleep(300);
    }
    return Math.min(...found);
  };
  await sleep(kSettled_min * 60_000);
  const began = performance.now(), first = await used(), updates = await page.evaluate(() => window.updates);
  let last = first;
  while (performance.now() - began < Number(minutes) * 60_000) {
    await sleep(Math.min(60_000, Number(minutes) * 60_000));
    last = await used();
    say(`heap ${last} bytes, ${(100 * (last / first - 1)).toFixed(2)} % after ${((performance.now() - began) / 60_000).toFixed(0)} min`);
  }
  const rate = (await page.evaluate(() => window.updates) - updates) / ((performance.now() - began) / 1000) / 2;  // two axes
  say(`${rate.toFixed(1)} values a second of each axis`);
  assert.ok(Math.abs(last / first - 1) < kHeap, `heap ${first} -> ${last}`);
  assert.match(await text(page, ".where"), /X at/);
  await page.close();
}

let browser;
try {
  await daemon.start();
  browser = await launch();
  await pictures(browser, await world());
  await eightTabs(browser);
  await heap(browser);
  assert.deepEqual(errors, []);
} finally {
  await browser?.close();
  await daemon.close();
}
