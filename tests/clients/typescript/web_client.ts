// A client of Frontalis with what a browser has: fetch and WebSocket, JSON and nothing generated.
//
// Creates a session, publishes a take over one WebSocket, shows it over another with credits, and reads it again across
// cuts; prints one line a promise and exits with 1 when one is broken.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { parseArgs } from "node:util";

import { WebSocket } from "ws"; // a browser has it, and Node from 22 on

const { values: options } = parseArgs({
  options: {
    server: { type: "string" }, // http://HOST:PORT or https://HOST:PORT
    package: { type: "string" }, // an actor's package
    frames: { type: "string" }, // a take: one PublishMarkersRequest a line
    "token-file": { type: "string" }, // of a publisher
    "operator-token-file": { type: "string" }, // of an operator, who imports actors
    "ca-cert": { type: "string" }, // not used: NODE_EXTRA_CA_CERTS names it
  },
});
const server = options.server ?? "http://127.0.0.1:7400";
const token = readToken(options["token-file"]);
const operatorToken = readToken(options["operator-token-file"]);
const session = "web";

// The messages are those of the .proto files in the protobuf JSON mapping; these are the fields that are used here.
interface Sample {
  frame: string; // 64-bit numbers are strings
  sequence: string;
  activations: number[];
  quality: "QUALITY_SOLVED" | "QUALITY_PARTIAL" | "QUALITY_HELD";
}
interface SubscribeResponse {
  header?: { run: string; controls: { name: string }[] };
  samples?: Sample[];
  skippedSamples?: string;
  error?: Problem;
}
interface PublishResponse {
  acceptedThrough?: string;
  rejected?: { number: string; reason: string; detail: string }[];
  error?: Problem;
}
interface Problem {
  type: string;
  status: number;
  detail: string;
}

function readToken(file: string | undefined): string | undefined {
  return file && readFileSync(file, "utf8").trim();
}

function bearer(token: string | undefined): Record<string, string> {
  return token ? { authorization: `Bearer ${token}` } : {};
}

async function call<T>(method: string, path: string, message?: unknown): Promise<T> {
  const answer = await fetch(`${server}/api/v1${path}`, {
    method,
    headers: { ...bearer(token), "content-type": "application/json" },
    ...(message === undefined ? {} : { body: JSON.stringify(message) }),
  });
  if (answer.headers.get("content-type") === "application/problem+json") {
    throw refused((await answer.json()) as Problem);
  }
  return (await answer.json()) as T;
}

function refused(problem: Problem): Error {
  return new Error(`${problem.status} ${problem.type}: ${problem.detail}`);
}

// Messages of a WebSocket in order; it ends when the server closes, and fails with what the server said last.
class Stream<Out, In extends { error?: Problem }> {
  #socket: WebSocket;
  #received: In[] = [];
  #isClosed = false;
  #wake = () => {};

  constructor(subprotocol: string) {
    // A browser cannot set headers here: the token is offered as a second subprotocol.
    const subprotocols = token ? [subprotocol, `frontalis.bearer.${token}`] : [subprotocol];
    this.#socket = new WebSocket(`${server.replace("http", "ws")}/api/v1/sessions/${session}/stream`, subprotocols);
    this.#socket.onmessage = ({ data }) => this.#notice(() => this.#received.push(JSON.parse(String(data))));
    this.#socket.onclose = () => this.#notice(() => (this.#isClosed = true));
  }

  #notice(what: () => void): void {
    what();
    this.#wake();
  }

  async send(message: Out): Promise<void> {
    if (this.#socket.readyState === WebSocket.CONNECTING) {
      await new Promise<void>((open) => (this.#socket.onopen = () => open()));
    }
    this.#socket.send(JSON.stringify(message));
  }

  async next(): Promise<In | undefined> {
    while (this.#received.length === 0 && !this.#isClosed) {
      await new Promise<void>((wake) => (this.#wake = wake));
    }
    const message = this.#received.shift();
    if (message?.error) throw refused(message.error);
    return message;
  }

  close(): void {
    this.#socket.close();
  }
}

async function importActor(): Promise<void> {
  const answer = await fetch(`${server}/api/v1/actors/reference`, {
    method: "PUT",
    headers: { ...bearer(operatorToken), "content-type": "application/octet-stream" },
    body: readFileSync(options.package!),
  });
  assert.equal(answer.status, 200, await answer.clone().text());
  console.log(`import: ${answer.status}`);
}

// Answers the number of the last frame.
async function publish(): Promise<string> {
  const stream = new Stream<unknown, PublishResponse>("frontalis.v1.publish+json");
  const lines = readFileSync(options.frames!, "utf8").trim().split("\n");
  const messages = lines.map((line) => JSON.parse(line));
  const last: string = messages.at(-1).frames.at(-1).number;
  for (const message of messages) await stream.send(message);
  for (let taken = "0"; taken !== last; ) {
    const answer = await stream.next();
    assert(answer, "the server closed early");
    assert.deepEqual(answer.rejected ?? [], []);
    taken = answer.acceptedThrough ?? taken;
  }
  stream.close();
  console.log(`publish: every frame up to ${last} taken`);
  return last;
}

// A renderer: two samples may be on their way; each that was shown lets another come, always the newest.
async function showTheLatest(last: string): Promise<void> {
  const stream = new Stream<unknown, SubscribeResponse>("frontalis.v1.subscribe+json");
  await stream.send({ start: { subscriber: "web", delivery: "DELIVERY_LATEST", credits: 2 } });
  let controls: string[] = [];
  for (let shown = ""; shown !== last; ) {
    const answer = await stream.next();
    assert(answer, "the server closed early");
    if (answer.header) controls = answer.header.controls.map((it) => it.name);
    for (const sample of answer.samples ?? []) {
      assert.equal(sample.activations.length, controls.length);
      shown = sample.frame;
      await stream.send({ credits: 1 });
    }
  }
  stream.close();
  console.log(`latest: frame ${last} shown, ${controls.length} controls`);
}

// A recorder: every sample in order, across cuts.
async function everySample(last: string, cutEvery: number): Promise<void> {
  const samples: Sample[] = [];
  let run: string | undefined;
  while (samples.at(-1)?.frame !== last) {
    const stream = new Stream<unknown, SubscribeResponse>("frontalis.v1.subscribe+json");
    const position = run ? { run, fromSequence: String(samples.length + 1) } : { fromOldest: true };
    await stream.send({ start: { delivery: "DELIVERY_EVERY_FRAME", ...position } });
    for (let received = 0; received < cutEvery && samples.at(-1)?.frame !== last; ) {
      const answer = await stream.next();
      assert(answer, "the server closed early");
      run = answer.header?.run ?? run;
      samples.push(...(answer.samples ?? []));
      received += answer.samples?.length ?? 0;
    }
    stream.close();
  }
  samples.forEach((sample, at) => assert.equal(sample.sequence, String(at + 1)));
  console.log(`resume: ${samples.length} samples in order across cuts, none missing`);
}

async function refusals(): Promise<void> {
  await assert.rejects(call("GET", "/sessions/nobody"), /404 urn:frontalis:problem:SESSION/);
  const stream = new Stream<unknown, SubscribeResponse>("frontalis.v1.subscribe+json");
  await stream.send({ start: { delivery: "DELIVERY_EVERY_FRAME", run: "999", fromSequence: "1" } });
  await assert.rejects(async () => {
    while (await stream.next());
  }, /416 urn:frontalis:problem:NEW_RUN/);
  console.log("refusal: SESSION as an answer, NEW_RUN in the stream");
}

await importActor();
await call("POST", "/sessions", { sessionId: session, actor: "actors/reference", kind: "CAPTURE_KIND_MARKERS" });
const last = await publish();
await showTheLatest(last);
await everySample(last, 20);
await refusals();
// Its id is free for a new run then, so that this client can be run again.
await call("POST", `/sessions/${session}/end`);
console.log("end: the session ended");
process.exit(0);
