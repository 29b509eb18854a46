// mdofd with a page and a simulated axis, and its Unix socket for checks that do not go through the page.
import {spawn} from "node:child_process";
import fs from "node:fs";
import net from "node:net";
import os from "node:os";
import path from "node:path";
import {fileURLToPath} from "node:url";

export const kData = fileURLToPath(new URL("../data/five-probe", import.meta.url));
const kPatience_ms = 30_000;

const axis = (letter, targets) => `
[[axis]]
rig = "${kData}/rig_${letter}.toml"
[axis.device]
driver = "simulator"
rate_hz = 2000
dwell_s = 0.3
speed_mm_s = 100
acceleration_mm_s2 = 4000
targets_mm = ${JSON.stringify(targets)}
repeats = 3
loop = true
`;

const freePort = () => new Promise((resolve) => {
  const server = net.createServer().listen(0, "127.0.0.1", () => {
    const {port} = server.address();
    server.close(() => resolve(port));
  });
});

export class Daemon {
  constructor(program) {
    this.program = program;
    this.folder = fs.mkdtempSync(path.join(os.tmpdir(), "mdof-web-"));
    this.socket = path.join(this.folder, "s");
    this.config = path.join(this.folder, "mdofd.toml");
  }
  async start() {
    this.port ??= await freePort();
    this.url = `http://127.0.0.1:${this.port}`;
    fs.writeFileSync(this.config, `[store]\ndatabase = "${this.folder}/mdof.db"\n[rpc]\nsocket = "${this.socket}"\n` +
      `[http]\nlisten = "127.0.0.1:${this.port}"\ntoken_file = "${this.folder}/token"\n` +
      `[machine]\nchain = "w-Y-X-b-Z-t"\n${axis("X", [0, 2, 4, 6])}${axis("Y", [0, 2, 4])}`);
    const log = fs.openSync(path.join(this.folder, "log"), "a");
    this.process = spawn(this.program, ["--config", this.config], {stdio: ["ignore", log, log]});
    const end = Date.now() + kPatience_ms;
    for (;;) {
      try {
        return await this.call("server.info");
      } catch (error) {
        if (this.process.exitCode !== null || Date.now() > end)
          throw new Error(`mdofd does not serve: ${fs.readFileSync(path.join(this.folder, "log"), "utf8")}`, {cause: error});
        await new Promise((resolve) => setTimeout(resolve, 20));
      }
    }
  }
  token() { return fs.readFileSync(path.join(this.folder, "token"), "utf8").trim(); }
  end(signal) {
    return new Promise((resolve) => {
      if (!this.process || this.process.exitCode !== null || this.process.signalCode) return resolve();
      this.process.once("exit", resolve);
      this.process.kill(signal);
    });
  }
  async close() {
    await this.end("SIGTERM");
    fs.rmSync(this.folder, {recursive: true});
  }
  call(method, params = {}) {
    return new Promise((resolve, reject) => {
      let text = "";
      const client = net.createConnection(this.socket);
      client.on("error", reject).on("data", (data) => {
        text += data;
        if (!text.endsWith("\n")) return;
        client.end();
        const reply = JSON.parse(text);
        reply.error ? reject(new Error(reply.error.message)) : resolve(reply.result);
      });
      client.write(JSON.stringify({jsonrpc: "2.0", id: 1, method, params}) + "\n");
    });
  }
}
