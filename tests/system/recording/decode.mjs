// Reads lines of JSON, each a message of a recording ({topic, type, cdr: base64}), decodes it with a ROS 2
// message reader that is none of ours, and writes what it says as one line of JSON each.
import { createInterface } from "node:readline";
import { ros2humble } from "@foxglove/rosmsg-msgs-common";
import { MessageReader } from "@foxglove/rosmsg2-serialization";

/** The definition of a type and of all that it is made of, the type itself first. */
function definitionsOf(type) {
  const found = new Map();
  const add = (name) => {
    if (found.has(name)) return;
    const definition = ros2humble[name] ?? ros2humble[name.replace("/msg/", "/")];
    if (definition === undefined) throw new Error(`${name}: no such type in ROS 2`);
    found.set(name, { ...definition, name });
    for (const field of definition.definitions) if (field.isComplex === true) add(field.type);
  };
  add(type);
  return [...found.values()];
}

/** JSON has no infinities, no NaN and no arrays of octets. */
function plain(key, value) {
  if (ArrayBuffer.isView(value)) return Array.from(value, (number) => plain("", number));
  return typeof value === "number" && !Number.isFinite(value) ? String(value) : value;
}

const readers = new Map();
for await (const line of createInterface({ input: process.stdin })) {
  const { topic, type, cdr } = JSON.parse(line);
  if (!readers.has(type)) readers.set(type, new MessageReader(definitionsOf(type)));
  const message = readers.get(type).readMessage(Buffer.from(cdr, "base64"));
  process.stdout.write(JSON.stringify({ topic, type, message }, plain) + "\n");
}
