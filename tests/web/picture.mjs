// The pictures of README.md, on simulated axes: a run while it is measured, and the map of a plane.
//
// usage: page_test MDOFD FOLDER picture PICTURES     PICTURES: the folder for them
import path from "node:path";
import {launch} from "./browser.mjs";
import {Daemon} from "./daemon.mjs";

const daemon = new Daemon(process.argv[2]);
const bend = (mm, um) => Array.from({length: 13}, (_, i) => [mm * i / 12, um * Math.sin(i / 3) + um * i / 20]);
const errors = (name, mm, um) => `${name}_um = ${JSON.stringify(bend(mm, um))}\nu_${name}_um = 0.1\n`;
const machine = `name = "demonstration"
machine = {chain = "w-Y-X-b-t"}
[[axis]]
id = "X"
holds_at_mm = [0, 0, 0]
point = "moving"
${errors("EXX", 60, 1.5)}${errors("EYX", 60, -0.8)}[[axis]]
id = "Y"
holds_at_mm = [0, 0, 0]
point = "moving"
${errors("EYY", 40, -1.2)}${errors("EXY", 40, 0.9)}`;
let browser;
try {
  await daemon.start();
  browser = await launch();
  const page = await browser.newPage({viewport: {width: 1100, height: 760}, colorScheme: "light"});
  const {run} = await daemon.call("run.start", {axis: "X", targets_mm: [0, 2, 4, 6], repeats: 4, note: "demonstration"});
  await page.goto(`${daemon.url}/#capture`);
  await page.waitForFunction(() => /(1[2-9]|2\d) of 32 points/.test(document.querySelector(".capture")?.innerText), undefined, {timeout: 60_000});
  await page.screenshot({path: path.join(process.argv[4], "capture.png")});
  await daemon.call("run.stop", {run, abort: true});
  const {table} = await daemon.call("compensation.build_volume", {machine, axes: "XY", step_mm: 5, incomplete: true});
  await daemon.call("compensation.activate", {table, simulated: true, despite_warnings: true, reason: "demonstration"});
  await page.setViewportSize({width: 900, height: 960});
  await page.goto(`${daemon.url}/#compensation/volume`);
  await page.getByText("Largest correction").waitFor();
  await page.screenshot({path: path.join(process.argv[4], "plane.png")});
} finally {
  await browser?.close();
  await daemon.close();
}
