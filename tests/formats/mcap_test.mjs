// The MCAP files that morepro writes, read by the library of the format's authors: every message, the index,
// the check sums. The CSV that they were converted from says what must be in them.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";

const require = createRequire(process.env.MOREPRO_FORMAT_MODULES + "/");
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const { crc32 } = require("@foxglove/crc");

const FRAMES = 20000;
const TOPIC = "/morepro/frame";
let folder, rows, columns, file;

const run = (...words) => execFileSync(process.env.MOREPRO, words, { cwd: folder, encoding: "utf8", stdio: "pipe" });

before(() => {
  folder = mkdtempSync(join(tmpdir(), "morepro-mcap-"));
  run("simulate", "--profile", "production", "--duration", "2", "--out", "run.csv");
  const lines = readFileSync(join(folder, "run.csv"), "utf8").trimEnd().split("\n");
  lines[20] = lines[20].replace(/,[^,]*$/, ",");  // a missing sample
  lines.splice(30, 5);  // missing rows
  writeFileSync(join(folder, "run.csv"), lines.join("\n") + "\n");
  run("convert", "run.csv", "run.mcap");
  const head = lines.findIndex((line) => !line.startsWith("#"));
  columns = lines[head].split(",");
  rows = lines.slice(head + 1).map((line) => line.split(","));
  file = readFileSync(join(folder, "run.mcap"));
});

after(() => rmSync(folder, { recursive: true }));

const readable = () => ({
  size: async () => BigInt(file.length),
  read: async (offset, size) => new Uint8Array(file.subarray(Number(offset), Number(offset + size))),
});

const json = (message) => JSON.parse(new TextDecoder().decode(message.data));

/** The row as an object of numbers, without what was not measured. */
const expected = (row) =>
  Object.fromEntries(columns.slice(1).flatMap((name, k) => (row[k + 1] === "" ? [] : [[name, Number(row[k + 1])]])));

test("every row is a message, to the last digit", async () => {
  const reader = await McapIndexedReader.Initialize({ readable: readable() });
  assert.equal(reader.statistics.messageCount, BigInt(FRAMES - 5));
  let k = 0;
  for await (const message of reader.readMessages()) {
    assert.equal(message.logTime, BigInt(rows[k][0].replace(".", "")) * 1000n);
    assert.deepEqual(json(message), expected(rows[k]));
    ++k;
  }
  assert.equal(k, rows.length);
});

test("sequence numbers show the missing rows", async () => {
  const reader = await McapIndexedReader.Initialize({ readable: readable() });
  let last;
  for await (const message of reader.readMessages()) last = message;
  assert.equal(last.sequence, FRAMES - 1);
});

test("a reader can seek", async () => {
  const reader = await McapIndexedReader.Initialize({ readable: readable() });
  assert.ok(reader.chunkIndexes.length > 3, "one chunk cannot be sought in");
  const times = [];
  for await (const { logTime } of reader.readMessages({ topics: [TOPIC], startTime: 1_500_000_000n, endTime: 1_500_900_000n }))
    times.push(logTime);
  assert.deepEqual(times, Array.from({ length: 10 }, (_, k) => 1_500_000_000n + 100_000n * BigInt(k)));
});

test("metadata and schema are there", async () => {
  const reader = await McapIndexedReader.Initialize({ readable: readable() });
  const metadata = [];
  for await (const record of reader.readMetadata({ name: "morepro" })) metadata.push(record.metadata);
  assert.equal(metadata[0].get("machine"), "reference");
  const [channel] = reader.channelsById.values();
  assert.deepEqual([channel.topic, channel.messageEncoding], [TOPIC, "json"]);
  const schema = reader.schemasById.get(channel.schemaId);
  assert.equal(schema.encoding, "jsonschema");
  assert.deepEqual(Object.keys(JSON.parse(new TextDecoder().decode(schema.data)).properties), columns.slice(1));
});

test("every check sum is right", () => {
  const reader = new McapStreamReader({ validateCrcs: true });
  reader.append(file);
  let chunks = 0;
  let end, footer;
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
    if (record.type === "DataEnd") end = record;
    if (record.type === "Footer") footer = record;
    if (record.type === "MessageIndex") ++chunks;
  }
  assert.ok(reader.done() && chunks > 3);
  const summary = Number(footer.summaryStart);
  assert.equal(end.dataSectionCrc, crc32(file.subarray(0, summary - 13)), "up to the record DataEnd of 13 bytes");
  assert.equal(footer.summaryCrc, crc32(file.subarray(summary, file.length - 8 - 4)));
});

test("a cut file is readable up to the cut, and a changed byte is found", () => {
  writeFileSync(join(folder, "cut.mcap"), file.subarray(0, file.length / 2));
  assert.throws(() => run("convert", "cut.mcap", "cut.csv"), /cut\.mcap: the recording was cut; \d+ frames/);
  run("convert", "cut.mcap", "cut.csv", "--accept-damaged");
  const cut = readFileSync(join(folder, "cut.csv"), "utf8").split("\n").filter((line) => line !== "");
  assert.ok(cut.length > 5000 && cut.length < FRAMES);
  assert.equal(cut.at(-1), rows[cut.length - 7].join(","));
  writeFileSync(join(folder, "cut.mcap"), file.subarray(0, 100_000));
  assert.throws(() => run("convert", "cut.mcap", "cut.csv"), /cut\.mcap: the recording was cut before its first chunk/);
  const damaged = Buffer.from(file);
  damaged[file.length / 2 | 0] ^= 1;
  writeFileSync(join(folder, "damaged.mcap"), damaged);
  assert.throws(() => run("convert", "damaged.mcap", "out.csv"), /damaged\.mcap: the chunk behind message \d+ is damaged/);
  file.copy(damaged);
  damaged[file.indexOf("reference")] ^= 1;  // metadata, in no chunk
  writeFileSync(join(folder, "damaged.mcap"), damaged);
  assert.throws(() => run("convert", "damaged.mcap", "out.csv"), /damaged\.mcap: the file is damaged/);
});
