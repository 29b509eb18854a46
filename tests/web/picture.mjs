// The picture of README.md: a run on simulated axes while it is measured.
//
// usage: page_test MDOFD FOLDER picture FILE.png
import {launch} from "./browser.mjs";
import {Daemon} from "./daemon.mjs";

const daemon = new Daemon(process.argv[2]);
let browser;
try {
  await daemon.start();
  browser = await launch();
  const page = await browser.newPage({viewport: {width: 1100, height: 760}, colorScheme: "light"});
  await daemon.call("run.start", {axis: "X", targets_mm: [0, 2, 4, 6], repeats: 4, note: "demonstration"});
  await page.goto(`${daemon.url}/#capture`);
  await page.waitForFunction(() => /(1[2-9]|2\d) of 32 points/.test(document.querySelector(".capture")?.innerText), undefined, {timeout: 60_000});
  await page.screenshot({path: process.argv[4]});
} finally {
  await browser?.close();
  await daemon.close();
}
