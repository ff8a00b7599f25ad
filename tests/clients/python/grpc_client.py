"""A client of Frontalis made from the .proto files alone.

Imports an actor, creates a session, publishes a take, follows it in both deliveries and across a cut, and reads health
and reflection; prints one line a promise and exits with 1 when one is broken.
"""

import argparse
import queue
import sys
import tempfile
from pathlib import Path
from urllib.parse import urlsplit

import grpc
from google.protobuf import json_format
from grpc_health.v1 import health_pb2, health_pb2_grpc
from grpc_reflection.v1alpha.proto_reflection_descriptor_database import (
    ProtoReflectionDescriptorDatabase,
)
from grpc_tools import protoc

CHUNK_BYTES = 256 * 1024
TIMEOUT_SECS = 30


def generate_stubs(proto: Path, out: Path) -> None:
    """Makes the modules of every .proto file under `proto` and puts them on the path."""
    files = sorted(str(it.relative_to(proto)) for it in proto.glob("frontalis/v1/*.proto"))
    well_known = Path(protoc.__file__).parent / "_proto"
    arguments = ["protoc", f"-I{proto}", f"-I{well_known}", f"--python_out={out}", f"--grpc_python_out={out}", *files]
    if protoc.main(arguments) != 0:
        sys.exit("the .proto files do not compile")
    sys.path.insert(0, str(out))


def connect(url: str, token_file: Path | None, ca_cert: Path | None) -> grpc.Channel:
    """A channel whose every call carries the token."""
    address = urlsplit(url)
    if address.scheme != "https":
        channel = grpc.insecure_channel(address.netloc)
    else:
        trusted = ca_cert.read_bytes() if ca_cert else None
        channel = grpc.secure_channel(address.netloc, grpc.ssl_channel_credentials(trusted))
    if token_file is None:
        return channel
    return grpc.intercept_channel(channel, Bearer(token_file.read_text().strip()))


class CallDetails(grpc.ClientCallDetails):
    """What is known of a call before it is made."""

    def __init__(self, of: grpc.ClientCallDetails, metadata):
        self.method, self.timeout, self.credentials = of.method, of.timeout, of.credentials
        self.wait_for_ready, self.compression, self.metadata = of.wait_for_ready, of.compression, metadata


class Bearer(
    grpc.UnaryUnaryClientInterceptor,
    grpc.UnaryStreamClientInterceptor,
    grpc.StreamUnaryClientInterceptor,
    grpc.StreamStreamClientInterceptor,
):
    """Writes `authorization: Bearer TOKEN` on every call."""

    def __init__(self, token: str):
        self.header = ("authorization", f"Bearer {token}")

    def _call(self, continuation, details, request):
        return continuation(CallDetails(details, [*(details.metadata or []), self.header]), request)

    intercept_unary_unary = intercept_unary_stream = intercept_stream_unary = intercept_stream_stream = _call


def show_server(channel) -> None:
    from frontalis.v1 import server_pb2, server_pb2_grpc

    stub = server_pb2_grpc.ServerServiceStub(channel)
    server = stub.GetServer(server_pb2.GetServerRequest(), timeout=TIMEOUT_SECS).server
    print(f"server: version {server.version}, you are {server.caller.name}")


def import_actor(channel, package: bytes) -> None:
    from frontalis.v1 import actor_pb2, actor_pb2_grpc

    def messages():
        yield actor_pb2.ImportActorRequest(start=actor_pb2.ImportActorStart(actor_id="reference"))
        for at in range(0, len(package), CHUNK_BYTES):
            yield actor_pb2.ImportActorRequest(chunk=package[at : at + CHUNK_BYTES])

    stub = actor_pb2_grpc.ActorServiceStub(channel)
    actor = stub.ImportActor(messages(), timeout=TIMEOUT_SECS).actor
    assert actor.name == "actors/reference", actor.name
    print(f"import: {len(actor.muscles)} muscles, {len(actor.markers)} markers, {actor.n_vertices} vertices")


def export_actor(channel) -> None:
    from frontalis.v1 import actor_pb2, actor_pb2_grpc

    stub = actor_pb2_grpc.ActorServiceStub(channel)
    chunks = stub.ExportActor(actor_pb2.ExportActorRequest(name="actors/reference"), timeout=TIMEOUT_SECS)
    exported = b"".join(it.chunk for it in chunks)
    assert exported.startswith(b"glTF"), exported[:4]
    print(f"export: {len(exported)} bytes")


def publish(channel, take: Path) -> int:
    """Sends the take, one message a line; answers the number of its last frame."""
    from frontalis.v1 import capture_pb2, capture_pb2_grpc

    lines = take.read_text().splitlines()
    messages = [json_format.Parse(it, capture_pb2.PublishMarkersRequest()) for it in lines]
    messages[0].start.session = "sessions/python"
    last = messages[-1].frames[-1].number
    stub = capture_pb2_grpc.CaptureServiceStub(channel)
    answers = list(stub.PublishMarkers(iter(messages), timeout=TIMEOUT_SECS))
    assert answers[0].HasField("started")
    assert answers[-1].accepted_through == last, answers[-1]
    assert not any(it.rejected for it in answers), answers
    print(f"publish: {last} frames taken, epoch {answers[0].started.epoch}")
    return last


def follow_every_frame(channel, last: int, cut_every: int) -> None:
    """Every sample in order, across cuts: run and sequence say where to go on."""
    from frontalis.v1 import curve_pb2, curve_pb2_grpc

    stub = curve_pb2_grpc.CurveServiceStub(channel)
    start = curve_pb2.SubscribeStart(
        session="sessions/python", delivery=curve_pb2.DELIVERY_EVERY_FRAME, from_oldest=True
    )
    samples = []
    while not samples or samples[-1].frame != last:
        answers = stub.Follow(start, timeout=TIMEOUT_SECS)
        header = next(answers).header
        received = 0
        for answer in answers:
            samples += answer.samples
            received += len(answer.samples)
            if received >= cut_every or (samples and samples[-1].frame == last):
                break
        answers.cancel()
        start.from_oldest = False
        start.run, start.from_sequence = header.run, samples[-1].sequence + 1
    assert [it.sequence for it in samples] == list(range(1, len(samples) + 1))
    for sample in samples:
        assert sample.quality == curve_pb2.QUALITY_SOLVED, sample
        assert len(sample.activations) == len(header.controls)
    print(f"every frame: {len(samples)} samples of {len(header.controls)} controls in order, across cuts")


def subscribe_to_the_latest(channel, last: int) -> None:
    from frontalis.v1 import curve_pb2, curve_pb2_grpc

    requests = queue.Queue()
    start = curve_pb2.SubscribeStart(session="sessions/python", credits=2)
    requests.put(curve_pb2.SubscribeRequest(start=start))
    stub = curve_pb2_grpc.CurveServiceStub(channel)
    answers = stub.Subscribe(iter(requests.get, None), timeout=TIMEOUT_SECS)
    assert next(answers).HasField("header")
    newest = next(it for it in answers if it.samples).samples[-1]
    requests.put(curve_pb2.SubscribeRequest(credits=1))
    heartbeat = next(it for it in answers if it.HasField("state"))
    answers.cancel()
    requests.put(None)
    assert newest.frame == last, newest.frame
    print(f"latest: frame {newest.frame} at once, heartbeat in state {heartbeat.state.session_state}")


def end_session(channel) -> None:
    """Its id is free for a new run then, so that this client can be run again."""
    from frontalis.v1 import session_pb2, session_pb2_grpc

    request = session_pb2.EndSessionRequest(name="sessions/python")
    session_pb2_grpc.SessionServiceStub(channel).EndSession(request, timeout=TIMEOUT_SECS)
    print("end: the session ended")


def refusal(channel):
    from frontalis.v1 import session_pb2, session_pb2_grpc

    stub = session_pb2_grpc.SessionServiceStub(channel)
    try:
        stub.GetSession(session_pb2.GetSessionRequest(name="sessions/nobody"), timeout=TIMEOUT_SECS)
    except grpc.RpcError as error:
        assert error.code() == grpc.StatusCode.NOT_FOUND, error
        details = dict(error.trailing_metadata()).get("grpc-status-details-bin", b"")
        assert b"google.rpc.ErrorInfo" in details, details
        print(f"refusal: {error.code().name}, {error.details()}")
        return
    raise AssertionError("a session that is not there was found")


def health_and_reflection(channel):
    stub = health_pb2_grpc.HealthStub(channel)
    for service in ["", "frontalis.v1.CaptureService"]:
        answer = stub.Check(health_pb2.HealthCheckRequest(service=service), timeout=TIMEOUT_SECS)
        assert answer.status == health_pb2.HealthCheckResponse.SERVING, (service, answer.status)
    print("health: serving")
    services = set(ProtoReflectionDescriptorDatabase(channel).get_services())
    expected = {f"frontalis.v1.{it}Service" for it in ["Actor", "Capture", "Curve", "Server", "Session"]}
    assert expected <= services, services
    print(f"reflection: {', '.join(sorted(services))}")


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--server", required=True, help="http://HOST:PORT or https://HOST:PORT")
    parser.add_argument("--proto", required=True, type=Path, help="the folder of the .proto files")
    parser.add_argument("--package", required=True, type=Path, help="an actor's package")
    parser.add_argument("--frames", required=True, type=Path, help="a take: one PublishMarkersRequest a line")
    parser.add_argument("--token-file", type=Path, help="of a publisher")
    parser.add_argument("--operator-token-file", type=Path, help="of an operator, who imports actors")
    parser.add_argument("--ca-cert", type=Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as out:
        generate_stubs(arguments.proto, Path(out))
        from frontalis.v1 import session_pb2, session_pb2_grpc

        channel = connect(arguments.server, arguments.token_file, arguments.ca_cert)
        show_server(channel)
        operator = connect(arguments.server, arguments.operator_token_file, arguments.ca_cert)
        import_actor(operator, arguments.package.read_bytes())
        export_actor(operator)
        request = session_pb2.CreateSessionRequest(
            session_id="python", actor="actors/reference", kind=session_pb2.CAPTURE_KIND_MARKERS
        )
        session_pb2_grpc.SessionServiceStub(channel).CreateSession(request, timeout=TIMEOUT_SECS)
        last = publish(channel, arguments.frames)
        follow_every_frame(channel, last, cut_every=20)
        subscribe_to_the_latest(channel, last)
        end_session(channel)
        refusal(channel)
        health_and_reflection(channel)


if __name__ == "__main__":
    main()
