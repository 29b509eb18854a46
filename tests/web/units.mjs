// Known answers for what the page itself calculates, in the browser that runs it.
import assert from "node:assert/strict";

export async function units(page) {
  const found = await page.evaluate(async () => {
    const {Noise, verdict, shimText, stateOf, rangeText} = await import("/views/setup.js");
    const {approachesText, lineAt} = await import("/views/run_detail.js");
    const {difference, differenceOfRuns} = await import("/views/run_pair.js");
    const {valueAt, changeOfCorrection, statedDifferently} = await import("/views/compensation.js");
    const {expected, progressOf, targetsFrom} = await import("/views/capture.js");
    const {rowsOf, means, passes} = await import("/charts.js");
    const {squarenessPicture} = await import("/pictures.js");
    const {controlSeries, verdict: control} = await import("/views/run_trend.js");
    const {hoursLeft} = await import("/views/health.js");
    const {layer} = await import("/views/volume.js");
    const {fixed, measured, short} = await import("/dom.js");
    const machine = await import("/machine.js");
    // An axis that no message changes.
    const value = {axis: "U", age_s: 3, stale: true, waiting_for: "E"};
    machine.state.newest.set("U", {value, at: performance.now()});
    const places = [[5, "good", true], [5, "suspect", false], [null, "missing", null]].map(([encoder_mm, encoder_quality, still]) =>
      machine.placeText({axis: "U", encoder_mm, encoder_quality, still}, 1));
    const age = [machine.ageOf("U"), machine.staleReason("U")];
    machine.state.newest.delete("U");
    // Lists in pages of 41: 106 runs of which only the oldest is complete; the second list has no total.
    const {newest, pages} = await import("/rpc.js"), fetched = window.fetch;
    window.fetch = async (url, options) => {
      const {method, params} = JSON.parse(options?.body ?? "{}");
      if (!method?.startsWith("list.")) return fetched(url, options);
      const runs = Array.from({length: 106}, (_, i) => ({run: 106 - i, state: i === 105 ? "complete" : "aborted"})).slice(params.offset, params.offset + 41);
      return {text: async () => JSON.stringify({result: {runs, ...method === "list.total" ? {total: 106} : {}}})};
    };
    const isComplete = (r) => r.state === "complete";
    const lists = await Promise.all([newest("list.total", {}, "runs", isComplete, 20), newest("list.total", {}, "runs", isComplete, 20, 50),
      newest("list.total", {}, "runs", () => true, 20), newest("list.other", {}, "runs", isComplete, 20)].map(async (one) => {
      const {items, searched, isAll} = await one;
      return [items.length, searched, isAll];
    }));
    lists.push((await pages("list.other", {}, "runs")).runs.length, (await pages("list.total", {}, "runs")).runs.length);
    window.fetch = fetched;
    const probe = {id: "A", direction: [0, 0, 1], low_um: -100, high_um: 100};
    const card = {probe, noise: {pooled: [0.01, 60]}};
    // Two stops at places far apart: ss of 0 2 is 2, of 10 14 is 8, each with one degree of freedom; then 20 times 100.
    const noise = new Noise();
    const few = [[0, 1], [2, 1], [5, 0], [10, 1], [14, 1]];
    for (const [x, still] of few) noise.add(x, still);
    const tooFew = noise.pooled;
    noise.add(0, false);
    for (let i = 0; i < 20; ++i) noise.add(100, true);
    const points = [{position_mm: 0, forward: {k: 1}}, {position_mm: 10, forward: {k: 3}}];
    return {
      age, places, lists,
      // Target 1 forward was measured three times, target 2 in reverse was not solved.
      progress: [progressOf([[1, 1, 5], [1, 1, 5], [1, 1, 5], [1, -1, 5], [2, -1, null]].map(([target, direction, x]) => ({target, direction, EYX_um: x})), {targets_mm: [0, 2], repeats: 2}), progressOf([], {}).of],
      angles: [[1, 1], [-1], [1, -1], [null, 1, -1]].map((all) => approachesText(all.map((direction) => ({direction})))),
      // The target is pushed along what the probe measures: its reading rises.
      right: verdict(5, card, [0, 0, 1]), wrong: verdict(-5, card, [0, 0, 1]), across: verdict(5, card, [1, 0, 0]), none: verdict(0.1, card, [0, 0, 1]),
      noise: [tooFew, noise.pooled],
      shim: shimText(40, probe), shim_back: shimText(-40, probe), centred: shimText(5, probe),
      states: [[0, "good"], [60, "good"], [-90, "simulated"], [0, "over_range"]].map(([um, q]) => stateOf(um, q, -100, 100, false)[2]),
      ranges: [rangeText(-1.234, 37), rangeText(null, null)],
      no_reading: [shimText(null, probe), shimText(5, probe, "missing"), shimText(100, probe, "over_range"), stateOf(null, "good", -100, 100, false)[2]],
      // 2 um/m over the travel of the body: over 50 mm of the encoder 0.1 um up, or down where the body goes the other way.
      lines: [lineAt({slope_um_per_m: 2, intercept_um: 1}, "+", [0, 50]), lineAt({slope_um_per_m: 2, intercept_um: 1}, "-", [0, 50]), lineAt(undefined, "+", [0, 1])],
      // Forward +2, reverse -2 in both runs; one has the reverse at 5 mm alone.
      of_runs: [...differenceOfRuns([0, 5].flatMap((x) => [1, -1].map((d) => ({target_mm: x, direction: d, k: 2 * d}))),
        [{target_mm: 0, direction: 1, k: 2}, {target_mm: 5, direction: 1, k: 2}, {target_mm: 5, direction: -1, k: -2}], "k")],
      // The same errors, but added with the other sign: the command changes by twice the error.
      changes: (() => {
        const of = (factor, k) => ({table: 1, travel: factor < 0 ? "+" : "-", correction: {k: {factor, command: "Y", reason: "no axis"}}, points: [{position_mm: 0, forward: {k}}, {position_mm: 9, forward: {k: null}}]});
        return [changeOfCorrection(of(1, 3), of(-1, 3), "forward", "k"), changeOfCorrection(of(-1, 3), of(-1, 1), "forward", "k"),
          changeOfCorrection(of(null, 3), of(-1, 3), "forward", "k"), statedDifferently(of(1, 3), of(-1, 3)).length, statedDifferently(of(1, 3), of(1, 4)).length];
      })(),
      nothing_there: [valueAt([{position_mm: 0, forward: {k: null}}, {position_mm: 1, forward: {k: 4}}], "forward", "k", 0.5)],
      twice: passes([[0, 1], [0, 2], [5, 3]].map(([x, k]) => ({run: 1, direction: null, target_mm: x, k})), "k").map((one) => [one.label, one.points.length, one.marks]),
      difference: [...difference(new Map([[0, 3], [5, 4]]), new Map([[0.004, 1], [7, 0]]))],
      between: [valueAt(points, "forward", "k", 5), valueAt(points, "forward", "k", 10), valueAt(points, "forward", "k", 11), valueAt(points, "forward", "k", -1)],
      targets: ["0 12.5\n25;30, 35,", "0,10", "0 0,5", "0 ten", ""].map((text) => { try { return targetsFrom(text); } catch (error) { return error.message.split(" ")[1]; } }),
      expected: [expected({from_mm: 0, to_mm: 30, interval_mm: 5, repeats: 5}), expected({targets_mm: [1, 2], repeats: 0}), expected({from_mm: 0, to_mm: 1, interval_mm: 0})],
      rows: rowsOf([{points: [[1, 0, 1, 2], [0, 0, 0, 0]]}, {points: [[1, 4, 5, 6], [2, 0, null, 0]]}]),
      // Both approaches count alike, however often each was passed.
      means: [...means([{target_mm: 0, direction: 1, k: 1}, {target_mm: 0, direction: 1, k: 3}, {target_mm: 0, direction: -1, k: 6}], "k")],
      undirected: [0, 1, -1].map((d) => [...means([{target_mm: 0, direction: null, k: 2}, {target_mm: 0, direction: 1, k: 4}], "k", d)]),
      // Six passes of one target: the first two are one range, with the outlier of the first.
      passes: passes([9, 1, 2, 3, 4, 5].map((k, i) => ({run: i + 1, direction: 1, target_mm: 0, k, U: {k: 1}})), "k").map((one) => [one.label, one.points]),
      // EB0Z turns about Y, from +Z to +X: a positive one makes the angle from +X to +Z smaller.
      squares: [["X", "Y", 3], ["X", "Z", 3], ["Y", "Z", 3], ["X", "Z", -3]].map((of) => squarenessPicture(...of).getAttribute("aria-label").match(/larger|smaller/)[0]),
      // 36 MB of 100 s, 3.6 GB left.
      hours: hoursLeft({free_bytes: 3.6e9, newest_recording: {bytes: 36e6}}, {scans: 100_000, plausibility: {rate_hz: 1000}}),
      layer: layer([[0, 0, 0], [0, 0, 5], [1, 0, 5]], "XY", 5).length,
      // Two values with limits, the second beyond; one value without.
      control: controlSeries({centre: 1, values: [{value: 1, u: 0.5, low: 0, high: 2, signal: ""}, {value: 9, u: null, low: 0, high: 2, signal: "outside"}]}).map((one) => one.points),
      no_limits: controlSeries({centre: null, values: [{value: 1, u: 0.5, low: null, high: null, signal: ""}]}).map((one) => one.points.length),
      controlled: [control("EYX_slope_urad", {values: [1, 2], baseline: 0}), control("EYX_slope_urad", {values: [1], baseline: 8, moved: null}),
        control("EYX_slope_urad", {values: [1], baseline: 8, moved: {by: -5.9, u_by: 0.2, since_runs: [9]}})],
      numbers: [fixed(-0.0001, 2), fixed(-1.5, 1), fixed(null, 2), measured({value: 1.83045, U: 0.0886, k: 2}, "µm"), measured({value: 1}, "µm"), short(0.000123456)],
    };
  });
  assert.deepEqual(found.progress, [{points: 5, of: 8, awaited_mm: null, done: 3}, null]);
  assert.deepEqual(found.lists, [[1, 106, true], [0, 82, false], [20, 41, false], [1, 106, true], 106, 106]);
  assert.deepEqual(found.angles, ["forward only", "reverse only", "mean of both approaches", "mean of both approaches"]);
  assert.deepEqual(found.places, ["U at 5.0 mm, at rest", "U at 5.0 mm, moving, position suspect", "U: position unknown, because the encoder sends no position"]);
  assert.ok(found.age[0] >= 3 && found.age[0] < 10);
  assert.equal(found.age[1], "the values are late, because probe E sends no samples");
  assert.deepEqual(found.no_reading, ["Shim: not known, because the probe has no usable reading", "Shim: not known, because the probe has no usable reading",
    "Shim at least 100.0 µm: move the probe towards +Z, or the target towards −Z", "no reading"]);
  assert.deepEqual(found.lines, [[[0, 1], [50, 1.1]], [[0, 1], [50, 0.9]], []]);
  assert.deepEqual(found.of_runs, [[0, 0], [5, 0]]);
  assert.deepEqual(found.changes, [[[0, 6]], [[0, -2]], null, 2, 0]);
  assert.deepEqual(found.nothing_there, [null]);
  assert.deepEqual(found.twice, [["1?", 2, true], ["1? (2)", 1, true]]);
  assert.deepEqual(found.undirected, [[[0, 2.5]], [[0, 3]], [[0, 2]]]);
  assert.deepEqual(found.passes, [["older +", [[0, 1, 5, 9]]], ["3+", [[0, 1, 2, 3]]], ["4+", [[0, 2, 3, 4]]], ["5+", [[0, 3, 4, 5]]], ["6+", [[0, 4, 5, 6]]]]);
  assert.deepEqual(found.squares, ["larger", "smaller", "larger", "larger"]);
  assert.match(found.right, /as the rig states/);
  assert.match(found.wrong, /REVERSED.*probe A/);
  assert.match(found.across, /right angles/);
  assert.equal(found.none, "no change yet");
  assert.equal(found.shim, "Shim 40.0 µm: move the probe towards +Z, or the target towards −Z");
  assert.equal(found.shim_back, "Shim 40.0 µm: move the probe towards −Z, or the target towards +Z");
  assert.match(found.centred, /no shim/);
  assert.deepEqual(found.noise, [null, [Math.sqrt((2 + 8 + 0) / 21), 21]]);
  assert.deepEqual(found.states, ["in range", "off centre", "near the end of the range", "over range"]);
  assert.deepEqual(found.ranges, ["Last second: −1.23 to 37.00 µm", "Last second: no reading"]);
  assert.deepEqual(found.difference, [[0, 2]]);
  assert.deepEqual(found.between, [2, 3, null, null]);
  assert.deepEqual(found.targets, [[0, 12.5, 25, 30, 35], '"0,10"', '"0,5"', '"ten"', []]);
  assert.deepEqual(found.expected, [{targets: 7, points: 70}, {targets: 2, points: null}, null]);
  assert.deepEqual(found.rows, [[0, [0, 0, 0], [null, null, null]], [1, [0, 1, 2], [4, 5, 6]]]);
  assert.deepEqual(found.means, [[0, 4]]);
  assert.equal(found.hours, 100 * 100 / 3600);
  assert.equal(found.layer, 2);
  assert.deepEqual(found.control, [[[1, 0.5, 1, 1.5], [2, 9, 9, 9]], [[2, 9, 9, 9]], [[1, 1, 1, 1], [2, 1, 1, 1]], [[1, 0, 0, 0], [2, 0, 0, 0]], [[1, 2, 2, 2], [2, 2, 2, 2]]]);
  assert.deepEqual(found.no_limits, [1, 0, 0, 0, 0]);
  assert.deepEqual(found.controlled, ["● 2 values are too few for control limits.", "● EYX slope has not moved.",
    "▲ EYX slope has moved by −5.90 µrad (u = 0.200 µrad) since run 9."]);
  assert.deepEqual(found.numbers, ["0.00", "−1.5", "–", "1.830 µm, U = 0.089 µm (k = 2.00)", "1.000 µm, U not known", "0.000123"]);
}
