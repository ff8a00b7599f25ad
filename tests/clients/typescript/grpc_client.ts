// A client of Frontalis made from the .proto files alone, over gRPC and over gRPC-web.
//
// Publishes a performance, shows it with credits, reads it again across a cut; prints one line a promise and exits with
// 1 when one is broken.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { parseArgs } from "node:util";

import { create, fromJsonString } from "@bufbuild/protobuf";
import { Code, ConnectError, createClient, type Interceptor, type Transport } from "@connectrpc/connect";
import { createGrpcTransport, createGrpcWebTransport } from "@connectrpc/connect-node";

import { ActorService } from "./gen/frontalis/v1/actor_pb.ts";
import { CaptureService, PublishMarkersRequestSchema } from "./gen/frontalis/v1/capture_pb.ts";
import { CurveService, Delivery, Quality, SubscribeRequestSchema } from "./gen/frontalis/v1/curve_pb.ts";
import type { CurveSample, SubscribeRequest } from "./gen/frontalis/v1/curve_pb.ts";
import { ServerService } from "./gen/frontalis/v1/server_pb.ts";
import { CaptureKind, SessionService } from "./gen/frontalis/v1/session_pb.ts";

const CHUNK_BYTES = 256 * 1024;
const SESSION = "sessions/typescript";

const { values: options } = parseArgs({
  options: {
    server: { type: "string" }, // http://HOST:PORT or https://HOST:PORT
    package: { type: "string" }, // an actor's package
    frames: { type: "string" }, // a take: one PublishMarkersRequest a line
    "token-file": { type: "string" }, // of a publisher
    "operator-token-file": { type: "string" }, // of an operator, who imports actors
    "ca-cert": { type: "string" },
  },
});
const baseUrl = options.server ?? "http://127.0.0.1:7400";

// The token travels with every call.
function withToken(file: string | undefined): Interceptor {
  const token = file && readFileSync(file, "utf8").trim();
  return (next) => (request) => {
    if (token) request.header.set("authorization", `Bearer ${token}`);
    return next(request);
  };
}
const nodeOptions = options["ca-cert"] ? { ca: readFileSync(options["ca-cert"]) } : {};

const interceptors = [withToken(options["token-file"])];
const grpc = createGrpcTransport({ baseUrl, interceptors, nodeOptions });
// What a browser can do: HTTP/1.1, and no stream of requests.
const grpcWeb = createGrpcWebTransport({ baseUrl, httpVersion: "1.1", interceptors, nodeOptions });
const operator = createGrpcTransport({
  baseUrl,
  interceptors: [withToken(options["operator-token-file"])],
  nodeOptions,
});

// Requests that are written while answers are read.
class Requests<T> implements AsyncIterable<T> {
  #waiting: T[] = [];
  #wake = () => {};
  #closed = false;

  push(request: T): void {
    this.#waiting.push(request);
    this.#wake();
  }

  close(): void {
    this.#closed = true;
    this.#wake();
  }

  async *[Symbol.asyncIterator](): AsyncIterator<T> {
    for (;;) {
      const next = this.#waiting.shift();
      if (next !== undefined) yield next;
      else if (this.#closed) return;
      else await new Promise<void>((wake) => (this.#wake = wake));
    }
  }
}

async function next<T>(answers: AsyncIterator<T>): Promise<T> {
  const { done, value } = await answers.next();
  assert(!done, "the stream ended early");
  return value;
}

async function server(transport: Transport, door: string): Promise<void> {
  const { server } = await createClient(ServerService, transport).getServer({});
  assert(server?.caller);
  console.log(`server over ${door}: version ${server.version}, TLS ${server.tls}, you are ${server.caller.name}`);
}

async function importActor(): Promise<void> {
  const bytes = readFileSync(options.package!);
  async function* messages() {
    yield { start: { actorId: "reference" } };
    for (let at = 0; at < bytes.length; at += CHUNK_BYTES) yield { chunk: bytes.subarray(at, at + CHUNK_BYTES) };
  }
  const { actor } = await createClient(ActorService, operator).importActor(messages());
  assert.equal(actor?.name, "actors/reference");
  console.log(`import: ${actor.muscles.length} muscles, ${actor.markers.length} markers`);
}

async function createSession(): Promise<void> {
  const { session } = await createClient(SessionService, grpc).createSession({
    sessionId: "typescript",
    actor: "actors/reference",
    kind: CaptureKind.MARKERS,
  });
  assert.equal(session?.name, SESSION);
  console.log(`session: ${session.name} of ${session.actor}`);
}

// Answers the number of the last frame.
async function publish(): Promise<bigint> {
  const lines = readFileSync(options.frames!, "utf8").trim().split("\n");
  const messages = lines.map((line) => fromJsonString(PublishMarkersRequestSchema, line));
  const start = messages[0]?.start;
  assert(start);
  start.session = SESSION;
  async function* requests() {
    yield* messages;
  }
  let taken = 0n;
  for await (const answer of createClient(CaptureService, grpc).publishMarkers(requests())) {
    assert.deepEqual(answer.rejected, []);
    if (answer.acceptedThrough > taken) taken = answer.acceptedThrough;
  }
  const last = messages.at(-1)?.frames.at(-1)?.number;
  assert.equal(taken, last);
  console.log(`publish: every frame up to ${taken} taken`);
  return taken;
}

// A renderer: the newest sample wins, and one that is busy skips instead of falling behind.
async function showWithCredits(publishing: () => Promise<bigint>): Promise<void> {
  const requests = new Requests<SubscribeRequest>();
  const start = { session: SESSION, subscriber: "typescript", delivery: Delivery.LATEST, credits: 1 };
  requests.push(create(SubscribeRequestSchema, { start }));
  const answers = createClient(CurveService, grpc).subscribe(requests)[Symbol.asyncIterator]();

  const { header } = await next(answers);
  assert(header, "the first answer holds the header");
  const controls = header.controls.map((it) => it.name);

  const last = await publishing();
  await everySample(grpc, last);

  // One credit: one sample, however many frames came since.
  const shown: CurveSample[] = [];
  let skipped = 0n;
  while (shown.at(-1)?.frame !== last) {
    const answer = await next(answers);
    if (answer.skippedSamples > skipped) skipped = answer.skippedSamples;
    for (const sample of answer.samples) {
      show(controls, sample);
      shown.push(sample);
      requests.push(create(SubscribeRequestSchema, { credits: 1 }));
    }
  }
  requests.close();
  await answers.return?.();
  assert.equal(shown.length, 2, "one credit lets one stale sample through, then comes the newest");
  console.log(`credits: ${shown.length} samples shown, the newest is frame ${last}, ${skipped} skipped`);
}

// What a renderer does with a sample: solved and partial values are shown, held ones stand still already.
function show(controls: string[], sample: CurveSample): Map<string, number> {
  assert.notEqual(sample.quality, Quality.UNSPECIFIED);
  assert.equal(sample.activations.length, controls.length);
  return new Map(controls.map((name, at) => [name, sample.activations[at] ?? 0]));
}

// A recorder: every sample in order, none missing, across any number of cuts.
async function everySample(transport: Transport, last: bigint, cutEvery = Infinity): Promise<CurveSample[]> {
  const client = createClient(CurveService, transport);
  const samples: CurveSample[] = [];
  let run = 0n;
  while (samples.at(-1)?.frame !== last) {
    const position = run === 0n ? { fromOldest: true } : { run, fromSequence: BigInt(samples.length + 1) };
    const cut = new AbortController();
    let received = 0;
    try {
      const start = { session: SESSION, delivery: Delivery.EVERY_FRAME, ...position };
      for await (const answer of client.follow(start, { signal: cut.signal })) {
        if (answer.header) run = answer.header.run;
        for (const sample of answer.samples) {
          samples.push(sample);
          received += 1;
        }
        if (samples.at(-1)?.frame === last || received >= cutEvery) cut.abort();
      }
    } catch (error) {
      if (!cut.signal.aborted) throw error;
    }
  }
  samples.forEach((sample, at) => assert.equal(sample.sequence, BigInt(at + 1)));
  return samples;
}

async function resume(transport: Transport, door: string, last: bigint): Promise<CurveSample[]> {
  const samples = await everySample(transport, last, 20);
  console.log(`resume over ${door}: ${samples.length} samples in order across cuts, none missing`);
  return samples;
}

async function refusal(transport: Transport, door: string): Promise<void> {
  const asked = createClient(SessionService, transport).getSession({ name: "sessions/nobody" });
  const error = await asked.then(() => assert.fail("a session that is not there was found"), ConnectError.from);
  assert.equal(error.code, Code.NotFound);
  console.log(`refusal over ${door}: ${Code[error.code]}, ${error.rawMessage}`);
}

// Its id is free for a new run then, so that this client can be run again.
async function endSession(): Promise<void> {
  const { session } = await createClient(SessionService, grpc).endSession({ name: SESSION });
  assert.equal(session?.name, SESSION);
  console.log(`end: ${session.name}`);
}

async function main(): Promise<void> {
  await server(grpc, "grpc");
  await server(grpcWeb, "grpc-web");
  await importActor();
  await createSession();
  let last = 0n;
  await showWithCredits(async () => (last = await publish()));
  const samples = await resume(grpc, "grpc", last);
  assert.deepEqual(await resume(grpcWeb, "grpc-web", last), samples);
  await endSession();
  await refusal(grpc, "grpc");
  await refusal(grpcWeb, "grpc-web");
}

await main();
// A connection that stays open would keep the program alive.
process.exit(0);
