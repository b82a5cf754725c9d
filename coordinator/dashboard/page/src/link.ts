// The WebSocket: joins by itself, again and again, and says how old what it knows is.
import { create, fromBinary, toBinary } from "@bufbuild/protobuf";
import type { MessageInitShape } from "@bufbuild/protobuf";
import { ClientFrameSchema, ServerFrameSchema, type ServerFrame } from "./dashboard_pb";

const LEAST_WAIT_MS = 300;
const MOST_WAIT_MS = 5000;
// The server says something ten times a second while helmets move, and twice a second in any case.
const SILENT_MS = 4000;

type Content = Exclude<MessageInitShape<typeof ClientFrameSchema>["content"], undefined>;

/// What stands behind # in the address: `look`, and the token. It is not sent to the server with the page's request.
function readFragment(): { look: boolean; token: string } {
  const parts = new URLSearchParams(location.hash.slice(1));
  const token = parts.get("token") ?? sessionStorage.getItem("token") ?? "";
  if (parts.has("token")) sessionStorage.setItem("token", token);
  const look = parts.has("look") || (sessionStorage.getItem("look") === "yes" && !parts.has("token"));
  sessionStorage.setItem("look", look ? "yes" : "no");
  if (parts.has("token")) history.replaceState(null, "", look ? "#look" : "/");
  return { look, token: /^[0-9a-f]{1,64}$/.test(token) ? token : "" };
}

export class Link {
  heardAtMs = 0;
  isOpen = false;
  /// Attempts since it was last open.
  attempts = 0;
  onFrame: (frame: ServerFrame) => void = () => {};
  onState: () => void = () => {};
  private socket: WebSocket | null = null;
  private waitMs = LEAST_WAIT_MS;
  private lastRequest = 0;
  private readonly waiting = new Map<number, (whyNot: string) => void>();
  private readonly access = readFragment();
  private maps: string[] = [""];

  start(): void {
    this.join();
    setInterval(() => {
      if (this.socket && performance.now() - this.heardAtMs > SILENT_MS) this.socket.close();
    }, 1000);
  }

  /// Tiles of these maps, from now on.
  watch(maps: string[]): void {
    if (maps.join("\n") === this.maps.join("\n")) return;
    this.maps = maps;
    if (this.isOpen) void this.ask({ case: "watch", value: { maps } });
  }

  /// Sends an order; "" once it is done, else why not.
  ask(content: Content): Promise<string> {
    if (!this.socket || !this.isOpen) return Promise.resolve("-");
    const requestId = ++this.lastRequest;
    const frame = create(ClientFrameSchema, { requestId, content });
    this.socket.send(toBinary(ClientFrameSchema, frame));
    return new Promise((done) => this.waiting.set(requestId, done));
  }

  private join(): void {
    const path = this.access.look ? "/watch" : "/live";
    const protocols = ["lifeline.v1", ...(this.access.token ? [`token.${this.access.token}`] : [])];
    const socket = new WebSocket(`ws://${location.host}${path}`, protocols);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    this.heardAtMs = performance.now();
    socket.onmessage = (message: MessageEvent<ArrayBuffer>) => {
      this.heardAtMs = performance.now();
      const frame = fromBinary(ServerFrameSchema, new Uint8Array(message.data));
      if (frame.content.case === "hello") this.greeted();
      if (frame.content.case === "answer") this.answered(frame.content.value.requestId, frame.content.value.whyNot);
      this.onFrame(frame);
    };
    socket.onclose = () => this.lost(socket);
  }

  private greeted(): void {
    this.isOpen = true;
    this.waitMs = LEAST_WAIT_MS;
    this.attempts = 0;
    if (this.maps.join("\n") !== "") void this.ask({ case: "watch", value: { maps: this.maps } });
    this.onState();
  }

  private answered(requestId: number, whyNot: string): void {
    this.waiting.get(requestId)?.(whyNot);
    this.waiting.delete(requestId);
  }

  private lost(socket: WebSocket): void {
    if (socket !== this.socket) return;
    this.socket = null;
    this.isOpen = false;
    this.attempts++;
    for (const done of this.waiting.values()) done("-");
    this.waiting.clear();
    this.onState();
    setTimeout(() => this.join(), this.waitMs);
    this.waitMs = Math.min(MOST_WAIT_MS, this.waitMs * 1.7);
  }
}
