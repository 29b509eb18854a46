// Live values and events. All tabs of a browser use one common stream, because a browser opens at
// most six connections to a server. The tab that has the lock opens the stream and sends all
// messages to the other tabs. When this tab is closed, another tab gets the lock.
const kTopics = ["live.update", "run.event"];
const kInterval_ms = Number(new URLSearchParams(location.search).get("interval_ms")) || 50;
const kReopen_ms = 2000;  // wait before opening the stream again after an HTTP error
const kSay_ms = 1000;     // interval at which the tab with the stream reports its state

const listeners = new Map();  // name -> set of functions
// Without locks (no secure context) each tab has its own stream.
const channel = navigator.locks && "BroadcastChannel" in window ? new BroadcastChannel("mdof-live") : null;
let connected = false;
let saidAt = -Infinity;  // performance.now() at the last message from the tab with the stream

// Calls the listener with each message of this name. Names:
// - the topics
// - "connected": true or false
// - "gap": events may be missing; the listener must read its data again
export function on(name, listener) {
  if (!listeners.has(name)) listeners.set(name, new Set());
  listeners.get(name).add(listener);
  return () => listeners.get(name).delete(listener);
}

function deliver(name, value) {
  saidAt = performance.now();
  if (name === "connected") {
    if (value === connected) return;
    connected = value;
  }
  for (const listener of listeners.get(name) ?? []) listener(value);
}

function send(name, value) {
  channel?.postMessage({name, value});
  deliver(name, value);
}

export const isConnected = () => connected && performance.now() - saidAt < 5 * kSay_ms;

function open() {
  const source = new EventSource(`/events?topics=${kTopics.join(",")}&interval_ms=${kInterval_ms}`);
  let before = saidAt > -Infinity;  // whether the stream was open before, here or in another tab
  source.onopen = () => {
    send("connected", true);
    if (before) send("gap");
    before = true;
  };
  source.onerror = () => {
    send("connected", false);
    if (source.readyState !== EventSource.CLOSED) return;  // the browser retries by itself
    setTimeout(() => { open(); send("gap"); }, kReopen_ms);
  };
  for (const topic of kTopics)
    source.addEventListener(topic, (message) => {
      const {missed, value} = JSON.parse(message.data);
      if (topic === "run.event" && missed > 0) send("gap");
      send(topic, value);
    });
  source.addEventListener("lost", () => send("gap"));
}

export function start() {
  if (channel) channel.onmessage = ({data}) => deliver(data.name, data.value);
  const hold = () => {
    open();
    setInterval(() => send("connected", connected), kSay_ms);
    return new Promise(() => {});  // keeps the lock until the tab is closed
  };
  channel ? navigator.locks.request("mdof-live", hold) : hold();
}
