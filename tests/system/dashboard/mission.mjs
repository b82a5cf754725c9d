// The programs of a mission, and a page that looks at it.
import { execFileSync, spawn } from "node:child_process";
import { createWriteStream, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";

export async function until(what, condition, seconds = 60) {
  const end = Date.now() + seconds * 1000;
  let last;
  for (;;) {
    try {
      last = await condition();
      if (last) return last;
    } catch (error) {
      last = error;
    }
    if (Date.now() > end) throw new Error(`not within ${seconds} s: ${what} (${last})`);
    await new Promise((again) => setTimeout(again, 50));
  }
}

export async function freePort() {
  const server = createServer();
  await new Promise((open) => server.listen(0, "127.0.0.1", open));
  const { port } = server.address();
  await new Promise((closed) => server.close(closed));
  return port;
}

class Program {
  output = "";
  constructor(path, args, log) {
    this.child = spawn(path, args, { stdio: ["pipe", "pipe", "pipe"] });
    const file = createWriteStream(log);
    for (const stream of [this.child.stdout, this.child.stderr])
      stream.on("data", (data) => {
        this.output += data;
        file.write(data);
      });
    this.ended = new Promise((end) => this.child.on("exit", (code) => end(code)));
  }
  say(line) {
    this.child.stdin.write(`${line}\n`);
  }
  prints(text, seconds) {
    return until(`"${text}" is printed`, () => this.output.includes(text), seconds);
  }
  async stop(signal = "SIGTERM") {
    this.child.kill(signal);
    return this.ended;
  }
}

export class Mission {
  programs = [];
  folder = mkdtempSync(join(tmpdir(), "lifeline-dashboard-"));
  name = `page-${process.pid}`;
  domain = String(100 + (process.pid % 60));

  constructor(bin, source) {
    this.bin = bin;
    this.qos = join(source, "config/qos/loopback.xml");
  }
  start(program, args) {
    const made = new Program(join(this.bin, program), args, join(this.folder, `${program}-${this.programs.length}.log`));
    this.programs.push(made);
    return made;
  }
  joined(...args) {
    return [...args, "--domain", this.domain, "--mission", this.name, "--qos", this.qos];
  }
  coordinator(port, records = join(this.folder, "records")) {
    return this.start("lifeline-coordinator", this.joined("run", "--dashboard", `127.0.0.1:${port}`, "--record", records, "--state", join(this.folder, "state"), "--report", join(this.folder, "report")));
  }
  helmet(id, source, ...more) {
    return this.start("lifeline-agent", this.joined("run", "--id", id, "--source", source, ...more));
  }
  /// What a helmet reads its button from.
  button() {
    const path = join(this.folder, "button");
    execFileSync("mkfifo", [path]);
    return { path, write: (octets) => writeFileSync(path, octets) };
  }
  voice(id) {
    return this.start("lifeline-helmet-voice", [id, this.domain, this.name, this.qos]);
  }
  async end() {
    for (const program of this.programs) program.child.kill("SIGKILL");
    await Promise.all(this.programs.map((program) => program.ended));
    rmSync(this.folder, { recursive: true, force: true });
  }
}
