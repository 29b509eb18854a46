// The whole story in a browser: set up, capture, the run, its table built and activated; what the page says is compared
// with what the Unix socket says. mdofd killed: stale is shown; started again: the page goes on by itself.
import assert from "node:assert/strict";
import fs from "node:fs";
import {accessible, launch, text, watch} from "./browser.mjs";
import {Daemon, kData} from "./daemon.mjs";
import {units} from "./units.mjs";

const kFirstView_bytes = 200_000;
const daemon = new Daemon(process.argv[2]);
const errors = [];
const step = (what) => console.log(`${(performance.now() / 1000).toFixed(1)} s: ${what}`);

async function setUp(page) {
  const sizes = [];
  page.on("response", (response) => { if (!/\/(events|rpc)/.test(response.url())) response.body().then((b) => sizes.push(b.length)).catch(() => {}); });
  const began = performance.now();
  await page.goto(daemon.url);
  await page.waitForFunction(() => [...document.querySelectorAll(".probe .value")].filter((v) => /\d/.test(v.textContent)).length === 5);
  step(`first values after ${Math.round(performance.now() - began)} ms, ${sizes.reduce((a, b) => a + b, 0)} bytes in ${sizes.length} files`);
  assert.ok(sizes.length > 5 && sizes.reduce((a, b) => a + b, 0) < kFirstView_bytes, "the first view is small");
  assert.match(await text(page, "#banner"), /SIMULATED: X, Y/);
  await page.waitForFunction(() => document.querySelector(".probe .state").textContent.includes("in range"));
  await page.waitForFunction(() => /simulator-X[^]*20\d\d|simulator-X[^]*19\d\d/.test(document.querySelector(".setup").innerText));  // its rate, measured
  await accessible(page, "Set up");
  assert.ok(await problemHeight_em(page) < 12, "the problem of a device is no tower of single words");
}

// Height of a row of the devices with a long problem, in letters.
const problemHeight_em = (page) => page.evaluate(async () => {
  const {setRows} = await import("/dom.js");
  const devices = document.querySelector('[aria-label="Devices of this axis"]');
  const said = "the device sends 278.4 scans per second instead of 300, and 107 scans were lost in 5 s; check the network or cable and the load";
  setRows(devices, [devices.columns.map(([head]) => head === "problem" ? said : "simulator-X")]);
  return devices.querySelector("tbody tr").offsetHeight / parseFloat(getComputedStyle(document.body).fontSize);
});

// Without a mouse: the link to the content, then the views.
async function byKeyboard(page) {
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press("Tab");
  assert.match(await page.evaluate(() => document.activeElement.className), /skip/);
  await page.keyboard.press("Tab");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  await page.getByRole("button", {name: "Start the run"}).waitFor();
}

// Empty targets are no free run that nobody asked for.
async function emptyTargets(page) {
  await page.getByLabel("Repeats").fill("");
  for (const [kind, labels] of [["list", ["Targets/mm"]], ["even", ["From/mm", "To/mm", "Interval/mm", "Jitter/mm", "Seed of the jitter"]]]) {
    await page.getByLabel("Targets are").selectOption(kind);
    for (const label of labels) await page.getByLabel(label).fill("");
    await page.getByRole("button", {name: "Start the run"}).click();
    await page.getByRole("alert").filter({hasText: labels.slice(0, 3).join(", ")}).waitFor();
    assert.equal(await page.getByRole("dialog").count(), 0, "nothing is asked of mdofd");
  }
  await page.getByLabel("From/mm").fill("0");
  await page.getByRole("button", {name: "Start the run"}).click();
  await page.getByRole("alert").filter({hasText: /To\/mm, Interval\/mm/}).filter({hasNotText: /From\/mm/}).waitFor();
}

async function capture(page) {
  await emptyTargets(page);
  await page.getByLabel("To/mm").fill("6");
  await page.getByLabel("Interval/mm").fill("2");
  await page.getByLabel("Repeats").fill("2");  // long enough that a slow browser still sees it measure
  await page.getByLabel("Note").fill("story");
  assert.match(await text(page, "form"), /4 targets, 16 points expected/);
  await page.getByRole("button", {name: "Start the run"}).click();
  const dialog = page.getByRole("dialog");
  await dialog.waitFor();
  await accessible(page, "the question for the token");
  await dialog.getByLabel("Token").fill("wrong");
  await dialog.getByRole("button", {name: "Use this token"}).click();
  await page.getByRole("alert").filter({hasText: /token/}).waitFor();
  assert.equal((await daemon.call("run.list")).total, 0, "nothing is begun with a wrong token");
  await page.getByRole("button", {name: "Start the run"}).click();
  await dialog.getByLabel("Token").fill(daemon.token());
  await dialog.getByRole("button", {name: "Use this token"}).click();
  await page.waitForFunction(() => /\b(?!0 )\d+ of 16 points; next target/.test(document.querySelector(".capture").innerText));
  await page.reload();
  await page.waitForFunction(() => /\b(?!16 )\d+ of 16 points/.test(document.querySelector(".capture")?.innerText));  // also before the next event
  await page.locator(".chart canvas").first().waitFor();
  assert.equal(await page.locator(".chart").count(), 5);
  await accessible(page, "Capture while it measures");
  await page.waitForFunction(() => /Run \d+ has ended: complete/.test(document.querySelector(".capture").innerText), null,
    {timeout: 120_000});  // a loaded computer may miss a stop, which the axis then visits again
  await page.getByRole("link", {name: /Show run/}).click();
}

async function runs(page) {
  const [{run}] = (await daemon.call("run.list")).runs;
  const whole = await daemon.call("run.get", {run});
  await page.getByRole("heading", {name: "Straightness", exact: true}).waitFor();
  const straightness = whole.uncertainty.EYX_straightness_um;
  const said = await text(page, ".view");
  const shown = said.match(/Straightness (−?[\d.]+) µm, U = ([\d.]+) µm/) ?? assert.fail(said);
  assert.ok(Math.abs(Number(shown[1]) - straightness.value) < 0.01 * straightness.value + 1e-3, `${shown[1]} is ${straightness.value}`);
  assert.ok(Math.abs(Number(shown[2]) / straightness.U - 1) < 0.06, `${shown[2]} is ${straightness.U}`);
  await page.getByText("noise and repeatability", {exact: true}).waitFor();  // its budget, which comes by a call of its own
  // Whether a target was approached twice depends on where the simulated axis is when the run begins.
  const [budget] = Object.values((await daemon.call("run.budget", {run, figure: "EYX_straightness_um"})).figures);
  assert.match(budget.u_covers, /^noise (and repeatability )?only/);
  assert.ok((await text(page, ".view")).includes(`U is incomplete: U contains ${budget.u_covers}`));
  await accessible(page, "one run");
  await page.getByRole("link", {name: "All runs"}).click();
  await page.getByLabel("Note contains").fill("story");
  await page.getByText("1 of 1 runs").waitFor();
  await accessible(page, "Runs");
  return run;
}

// A simulated run is in no control chart; a log that is replayed is.
async function controlCharts(page, run) {
  await page.getByRole("link", {name: "Runs"}).click();
  await page.getByRole("link", {name: "Control charts"}).click();
  await page.getByText("No stored run has a value for a control chart").waitFor();
  await page.getByText(new RegExp(`left out: run ${run}: `)).first().waitFor();
  const replayed = await daemon.call("run.replay", {path: `${kData}/log_X.csv.gz`, rig: fs.readFileSync(`${kData}/rig_X.toml`, "utf8")});
  await page.getByRole("combobox", {name: /^Axis/}).selectOption("Y");
  await page.getByRole("combobox", {name: /^Axis/}).selectOption("X");
  await page.getByText("1 value is too few for control limits").waitFor();
  const {figures} = await daemon.call("run.trend", {axis: "X"});
  await page.getByRole("combobox", {name: /^Figure/}).selectOption("EYX_straightness_um");
  const row = await page.getByRole("row", {name: `run ${replayed.run}`}).innerText();
  const {value} = figures.EYX_straightness_um.values[0];
  const shown = Number(row.split("\t")[2].replace("−", "-"));
  assert.ok(Math.abs(shown - value) <= 5e-3 * Math.abs(value), `${row} is ${value}`);
  await page.locator(".chart canvas").first().waitFor();
  await accessible(page, "control charts");
}

async function compensation(page, run) {
  await page.getByRole("link", {name: "Compensation"}).click();
  await page.getByText("No table is active").waitFor();
  await page.getByLabel(new RegExp(`run ${run},`)).check();
  await page.getByRole("button", {name: "Build the table"}).click();
  const dialog = page.getByRole("dialog");
  const activate = async (meanwhile) => {
    await page.getByRole("button", {name: "Activate table 1"}).click();
    await dialog.waitFor();
    await accessible(page, "the question before a table is activated");
    await dialog.getByLabel("Reason").fill("as the story wants it");
    for (const box of await dialog.getByRole("checkbox").all()) await box.check();
    await meanwhile();
    await dialog.getByRole("button", {name: "Activate"}).click();
  };
  await activate(async () => {  // another client changes what the question was asked of
    await daemon.call("compensation.activate", {table: 1, simulated: true, despite_warnings: true});
    await daemon.call("compensation.deactivate", {axis: "X"});
  });
  await page.locator(".notice.invalid").filter({hasText: /generation/}).waitFor();
  assert.deepEqual((await daemon.call("compensation.status")).axes, {});
  await activate(async () => {});
  await page.getByText(/^Table 1, generation \d+/).waitFor();
  const {axes} = await daemon.call("compensation.status");
  assert.equal(axes.X.table, 1);
  assert.deepEqual(axes.X.runs, [run]);
  const {history} = await daemon.call("history.list", {count: 1});
  assert.equal(history[0].deed, "compensation.activate");
  assert.equal(history[0].detail, "table 1 of X: as the story wants it");
  await page.getByText("as the story wants it").waitFor();
  await page.getByText("All values with u").waitFor();
  await accessible(page, "Compensation");
  await page.getByRole("link", {name: "Volume"}).click();
  await page.getByText("No table of the volume is active").waitFor();
  await accessible(page, "the volume");
}

async function restart(page) {
  await page.getByRole("link", {name: "Health"}).click();
  await page.getByText(/entr(y|ies) needs? attention|Everything works/).waitFor();
  await page.getByText(/h at the rate of run/).waitFor();
  await accessible(page, "Health");
  await page.getByRole("link", {name: "Set up"}).click();
  await page.locator(".probe .value").first().waitFor();
  await daemon.end("SIGKILL");
  await page.waitForFunction(() => /No connection to mdofd[^]*Last value/.test(document.getElementById("banner").innerText) && document.querySelector(".setup.stale"));
  assert.match(await text(page, ".setup"), /stale/);
  step("stale is shown");
  await accessible(page, "Set up while it is stale");
  const before = await text(page, ".where");
  await daemon.start();
  await page.waitForFunction((old) => !/No connection/.test(document.getElementById("banner").innerText) && !document.querySelector(".setup.stale") &&
    document.querySelector(".where").textContent !== old, before);
  step("goes on after the restart");
}

// mdofd ends while it measures: the run has ended, and the page says so, whatever it missed; it can be resumed.
async function killedWhileItMeasures(page) {
  await page.getByRole("link", {name: "Capture"}).click();
  await page.getByRole("button", {name: "Start the run"}).click();
  await page.waitForFunction(() => /Now: X at/.test(document.querySelector(".capture").innerText));
  await daemon.end("SIGKILL");
  await daemon.start();
  await page.waitForFunction(() => /Run \d+ has ended: aborted/.test(document.querySelector(".capture").innerText));
  await page.getByRole("link", {name: /Show run/}).first().click();
  await page.getByRole("button", {name: /^Resume/}).waitFor();
}

let browser;
try {
  await daemon.start();
  step("mdofd serves");
  browser = await launch();
  const page = await browser.newPage({viewport: {width: 1280, height: 900}});
  page.setDefaultTimeout(30_000);
  watch(page, errors);
  await setUp(page);
  await units(page);
  await byKeyboard(page);
  await capture(page);
  step("a run is measured");
  const run = await runs(page);
  await compensation(page, run);
  step("its table is active");
  await restart(page);
  await controlCharts(page, run);
  await killedWhileItMeasures(page);
  step("a run that mdofd left has ended");
  assert.deepEqual(errors, []);
} finally {
  await browser?.close();
  await daemon.close();
}
