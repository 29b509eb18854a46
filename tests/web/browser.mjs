// A browser and what all scripts ask of it.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import {pathToFileURL} from "node:url";

const packages = process.env.MDOF_WEB_PACKAGES;
const {chromium} = await import(pathToFileURL(path.join(packages, "playwright-core/index.mjs")));
const axe = fs.readFileSync(path.join(packages, "axe-core/axe.min.js"), "utf8");

export const launch = () => chromium.launch({executablePath: process.env.CHROMIUM, args: ["--no-sandbox", "--disable-gpu",
  "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"]});

// Errors of the page are kept in `errors`; those of a network that is gone are no errors of the page.
export function watch(page, errors) {
  page.on("pageerror", (error) => errors.push(String(error.stack)));
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !/net::ERR_|Failed to load resource/.test(message.text())) errors.push(message.text());
  });
}

// WCAG 2 A and AA, and the best practices of axe: none violated. axe is run in a world of its own: the page's security
// policy allows no script from elsewhere, and its rules stay as they are.
export async function accessible(page, what) {
  const session = await page.context().newCDPSession(page);
  const {frameTree} = await session.send("Page.getFrameTree");
  const {executionContextId: contextId} = await session.send("Page.createIsolatedWorld", {frameId: frameTree.frame.id});
  const run = async (expression) => {
    const {result, exceptionDetails} = await session.send("Runtime.evaluate", {expression, contextId, awaitPromise: true, returnByValue: true});
    assert.ok(!exceptionDetails, JSON.stringify(exceptionDetails));
    return result.value;
  };
  await run(axe);
  const {violations, passes} = await run("axe.run().then(({violations, passes}) => ({passes: passes.length, violations: violations.map((v) => " +
    "v.id + ': ' + v.help + ' ' + v.nodes.slice(0, 3).map((n) => n.html).join(' | '))}))");
  await session.detach();
  assert.deepEqual(violations, [], `axe: ${what}`);
  assert.ok(passes > 10, `axe looked at ${what}`);
}

export const text = (page, selector) => page.locator(selector).innerText();
