// SPDX-License-Identifier: MIT
// Reads a recording as Foxglove does and compares it with the log it was made of:
// node foxglove_reader.cjs NODE_MODULES RECORDING.mcap LOG.csv
const fs = require('fs');
const path = require('path');

const [modules, recording, log] = process.argv.slice(2);
const from = (name) => require(path.join(modules, name));
const { McapIndexedReader, McapStreamReader } = from('@mcap/core');
const { loadDecompressHandlers } = from('@mcap/support');
const { parse } = from('@foxglove/rosmsg');
const { MessageReader } = from('@foxglove/rosmsg2-serialization');
const { Log } = from('@foxglove/schemas/jsonschema');

const bytes = fs.readFileSync(recording);
const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, length) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + length))),
};

function expect(holds, what) {
  if (!holds) throw new Error(`${recording}: ${what}`);
}

function decoder(channel, schema) {
  const text = new TextDecoder().decode(schema.data);
  if (channel.messageEncoding === 'json') {
    expect(schema.encoding === 'jsonschema', `${channel.topic}: JSON with schema ${schema.encoding}`);
    JSON.parse(text);
    return (data) => JSON.parse(new TextDecoder().decode(data));
  }
  expect(channel.messageEncoding === 'cdr' && schema.encoding === 'ros2msg', `${channel.topic}: not CDR by ros2msg`);
  const reader = new MessageReader(parse(text, { ros2: true }));
  return (data) => reader.readMessage(data);
}

function checkEvent(message) {
  for (const member of Object.keys(Log.properties)) expect(member in message, `an event without ${member}`);
  const levels = Log.properties.level.oneOf.map((one) => one.const);
  expect(levels.includes(message.level), `an event of level ${message.level}`);
  expect(Number.isInteger(message.timestamp.sec) && Number.isInteger(message.timestamp.nsec), 'an event without time');
  expect(typeof message.message === 'string' && message.message.length > 0, 'an event that says nothing');
}

function checkStates(states) {
  const [header, ...rows] = fs.readFileSync(log, 'utf8').trim().split('\n').map((line) => line.split(','));
  expect(states.length === rows.length, `${states.length} joint states, ${rows.length} rows`);
  const column = (name) => header.indexOf(name);
  const parts = [['q', 'position'], ['dq', 'velocity'], ['tau', 'effort']];
  rows.forEach((row, i) => parts.forEach(([name, part]) => {
    for (let joint = 0; column(`${name}${joint + 1}`) >= 0; joint += 1) {
      const text = row[column(`${name}${joint + 1}`)];
      const value = states[i].message[part][joint];
      expect(text === '' ? Number.isNaN(value) : value === Number(text), `row ${i + 1} of ${part} is not the log's`);
    }
    expect(Math.abs(Number(states[i].logTime) / 1e9 - Number(row[column('t')])) < 1e-9, `time of row ${i + 1}`);
  }));
}

async function readIndexed() {
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers: await loadDecompressHandlers() });
  const decoders = new Map();
  const topics = new Map();
  for (const channel of reader.channelsById.values()) {
    decoders.set(channel.id, decoder(channel, reader.schemasById.get(channel.schemaId)));
    topics.set(channel.id, { topic: channel.topic, messages: [] });
  }
  let before = -1n;
  for await (const { channelId, logTime, data } of reader.readMessages({ validateCrcs: true })) {
    expect(logTime >= before, 'messages out of order');
    before = logTime;
    topics.get(channelId).messages.push({ logTime, message: decoders.get(channelId)(data) });
  }
  for (const [id, { topic, messages }] of topics) {
    expect(BigInt(messages.length) === (reader.statistics.channelMessageCounts.get(id) ?? 0n), `${topic}: another count`);
  }
  for await (const { name, metadata } of reader.readMetadata()) {
    if (name === 'faultline/diagnosis') for (const text of metadata.values()) JSON.parse(text);
  }
  return new Map([...topics.values()].map(({ topic, messages }) => [topic, messages]));
}

async function readStream() {
  const reader = new McapStreamReader({ validateCrcs: true, decompressHandlers: await loadDecompressHandlers() });
  reader.append(bytes);
  let count = 0;
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) if (record.type === 'Message') count += 1;
  expect(reader.done(), 'the stream does not end');
  return count;
}

async function main() {
  const topics = await readIndexed();
  const counts = [...topics].map(([topic, messages]) => `${topic} ${messages.length}`);
  const total = [...topics.values()].reduce((sum, messages) => sum + messages.length, 0);
  expect(total === await readStream(), 'index and stream differ');
  checkStates(topics.get('/joint_states'));
  (topics.get('/faultline/diagnosis') ?? []).forEach(({ message }) => checkEvent(message));
  console.log(`${path.basename(recording)}: ${counts.join(', ')}`);
}

main().catch((error) => { console.error(String(error)); process.exitCode = 1; });
