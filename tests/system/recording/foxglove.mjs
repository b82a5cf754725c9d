// foxglove.mjs PORT: connects as Foxglove does, under both names of its protocol, and ends well once each connection has
// had a map, a transform, a pose and a scan, decoded by what the server says of their types. Then what must be refused.
import protocol from "@foxglove/ws-protocol";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import WebSocket from "ws";

const { FoxgloveClient } = protocol;
const url = `ws://127.0.0.1:${process.argv[2]}`;
const wanted = ["OccupancyGrid", "TFMessage", "PoseStamped", "LaserScan", "Path"].map((name) => `/${name}`);

function fail(text) {
  console.error(`foxglove: ${text}`);
  process.exit(1);
}
setTimeout(() => fail("not all messages came in time"), 120_000).unref();

function check(type, message) {
  if (type.endsWith("/OccupancyGrid") && message.data.length !== message.info.width * message.info.height)
    fail("a map's cells are not as many as its sides say");
  if (type.endsWith("/TFMessage") && message.transforms.length === 0) fail("a message without transforms");
  if (type.endsWith("/PoseStamped") && !Number.isFinite(message.pose.position.x)) fail("a pose that is none");
  if (type.endsWith("/LaserScan") && message.ranges.length === 0) fail("a scan without ranges");
}

/** Resolves once all wanted types were read. */
function watch(protocol) {
  return new Promise((resolve) => {
    const ws = new WebSocket(url, [protocol]);
    ws.on("upgrade", (response) => {
      if (response.headers["sec-websocket-protocol"] !== protocol) fail(`${protocol} was not chosen`);
      // The client knows the older name only.
      Object.defineProperty(ws, "protocol", { value: FoxgloveClient.SUPPORTED_SUBPROTOCOL });
    });
    const client = new FoxgloveClient({ ws });
    const readers = new Map();
    const seen = new Set();
    let session = "";
    client.on("error", (error) => fail(`${protocol}: ${error.message ?? error}`));
    client.on("serverInfo", (info) => { session = info.sessionId; });
    client.on("status", (status) => fail(`${protocol}: the server warns: ${status.message}`));
    client.on("advertise", (channels) => {
      for (const channel of channels) {
        if (channel.encoding !== "cdr" || channel.schemaEncoding !== "ros2msg") fail(`${channel.topic}: not CDR`);
        const reader = new MessageReader(parse(channel.schema, { ros2: true }));
        readers.set(client.subscribe(channel.id), { type: channel.schemaName, reader });
      }
    });
    client.on("message", ({ subscriptionId, timestamp, data }) => {
      const { type, reader } = readers.get(subscriptionId);
      if (session === "" || timestamp < 1_600_000_000_000_000_000n) fail("a message without session or time");
      check(type, reader.readMessage(data));
      seen.add(type);
      if (!wanted.every((name) => [...seen].some((had) => had.endsWith(name)))) return;
      client.close();
      resolve();
    });
  });
}

/** Resolves with the status that refuses the connection. */
function refused(protocols, origin) {
  return new Promise((resolve) => {
    const ws = new WebSocket(url, protocols, { origin });
    ws.on("open", () => fail(`${protocols} from ${origin} was let in`));
    ws.on("unexpected-response", (_request, response) => resolve(response.statusCode));
    ws.on("error", () => {});
  });
}

/** Resolves with the server's answer to a text that is no request. */
function answer(text) {
  return new Promise((resolve) => {
    const ws = new WebSocket(url, ["foxglove.websocket.v1"]);
    ws.on("open", () => ws.send(text));
    ws.on("message", (data) => {
      const got = JSON.parse(data.toString());
      if (got.op !== "status") return;
      ws.close();
      resolve(got.message);
    });
  });
}

if ((await refused(["chat"], undefined)) !== 400) fail("another protocol must be refused with 400");
if ((await refused(["foxglove.sdk.v1"], "https://evil.example")) !== 403) fail("another page must be refused with 403");
if (!(await answer("{")).includes("JSON")) fail("a broken request must be answered");
if (!(await answer('{"op":"subscribe","subscriptions":[{"id":-1}]}')).includes("channelId")) fail("and so must this");
await Promise.all([watch("foxglove.sdk.v1"), watch("foxglove.websocket.v1")]);
console.log("foxglove: both protocols gave all types");
process.exit(0);
