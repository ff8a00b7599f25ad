"""A client of Frontalis made from the .proto files alone.

Imports an actor, creates a session, publishes a synthetic performance, follows it in both deliveries, and reads health
and reflection; prints one line a promise and exits with 1 when one is broken.
"""

import argparse
import math
import queue
import sys
import tempfile
from pathlib import Path

import grpc
from grpc_health.v1 import health_pb2, health_pb2_grpc
from grpc_reflection.v1alpha.proto_reflection_descriptor_database import (
    ProtoReflectionDescriptorDatabase,
)
from grpc_tools import protoc

N_FRAMES = 90
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


def import_actor(channel, package: bytes):
    from frontalis.v1 import actor_pb2, actor_pb2_grpc

    def messages():
        yield actor_pb2.ImportActorRequest(start=actor_pb2.ImportActorStart(actor_id="reference"))
        for at in range(0, len(package), CHUNK_BYTES):
            yield actor_pb2.ImportActorRequest(chunk=package[at : at + CHUNK_BYTES])

    stub = actor_pb2_grpc.ActorServiceStub(channel)
    actor = stub.ImportActor(messages(), timeout=TIMEOUT_SECS).actor
    assert actor.name == "actors/reference", actor.name
    print(f"import: {len(actor.muscles)} muscles, {len(actor.markers)} markers, {actor.n_vertices} vertices")
    return actor


def neutral_markers(channel):
    """Where the actor's markers are on its neutral face, centimeters, read from the exported package."""
    from frontalis.v1 import actor_pb2, actor_pb2_grpc

    stub = actor_pb2_grpc.ActorServiceStub(channel)
    chunks = stub.ExportActor(actor_pb2.ExportActorRequest(name="actors/reference"), timeout=TIMEOUT_SECS)
    exported = b"".join(it.chunk for it in chunks)
    assert len(exported) > 10_000, len(exported)
    return marker_positions_of_glb(exported)


def marker_positions_of_glb(glb: bytes):
    import json
    import struct

    json_length = struct.unpack_from("<I", glb, 12)[0]
    document = json.loads(glb[20 : 20 + json_length])
    buffer = glb[20 + json_length + 8 :]
    mesh = document["meshes"][0]
    primitive = mesh["primitives"][0]

    def accessor(index):
        it = document["accessors"][index]
        view = document["bufferViews"][it["bufferView"]]
        start = view.get("byteOffset", 0) + it.get("byteOffset", 0)
        width = {"SCALAR": 1, "VEC3": 3}[it["type"]]
        code, size = {5126: ("f", 4), 5125: ("I", 4), 5123: ("H", 2)}[it["componentType"]]
        stride = view.get("byteStride", width * size)
        return [struct.unpack_from(f"<{width}{code}", buffer, start + n * stride) for n in range(it["count"])]

    vertices = accessor(primitive["attributes"]["POSITION"])
    indices = [it[0] for it in accessor(primitive["indices"])]
    positions = []
    for marker in mesh["extras"]["frontalis"]["markers"]:
        place = marker.get("position", marker)
        if isinstance(place, list):
            positions.append([it * 100 for it in place])
        elif "vertex" in place:
            positions.append([it * 100 for it in vertices[place["vertex"]]])
        else:
            corners = [vertices[it] for it in indices[3 * place["triangle"] :][:3]]
            weights = place["barycentric"]
            positions.append([100 * sum(w * c[axis] for w, c in zip(weights, corners)) for axis in range(3)])
    return positions


def frame(capture_pb2, markers, number: int):
    """The face nods a little; the first frames are still."""
    turn = 0.1 * math.sin(max(0, number - 20) / 20)
    sin, cos = math.sin(turn), math.cos(turn)
    positions = []
    for x, y, z in markers:
        positions += [x, cos * y - sin * z, sin * y + cos * z]
    return capture_pb2.MarkerFrame(number=number, capture_time_nanos=number * 16_666_667, positions=positions)


def publish(channel, markers):
    from frontalis.v1 import capture_pb2, capture_pb2_grpc, common_pb2

    def messages():
        yield capture_pb2.PublishMarkersRequest(
            start=capture_pb2.PublishStart(
                session="sessions/python",
                publisher="python",
                unit=common_pb2.LENGTH_UNIT_CENTIMETER,
                ingest=capture_pb2.INGEST_LOSSLESS,
                rate_hz=60,
            )
        )
        for first in range(1, N_FRAMES + 1, 10):
            frames = [frame(capture_pb2, markers, number) for number in range(first, first + 10)]
            yield capture_pb2.PublishMarkersRequest(frames=frames)

    stub = capture_pb2_grpc.CaptureServiceStub(channel)
    answers = list(stub.PublishMarkers(messages(), timeout=TIMEOUT_SECS))
    assert answers[0].HasField("started")
    assert answers[-1].accepted_through == N_FRAMES, answers[-1]
    assert not any(it.rejected for it in answers), answers
    print(f"publish: {N_FRAMES} frames taken, epoch {answers[0].started.epoch}")


def follow_every_frame(channel):
    from frontalis.v1 import curve_pb2, curve_pb2_grpc

    stub = curve_pb2_grpc.CurveServiceStub(channel)
    start = curve_pb2.SubscribeStart(
        session="sessions/python", delivery=curve_pb2.DELIVERY_EVERY_FRAME, from_oldest=True
    )
    answers = stub.Follow(start, timeout=TIMEOUT_SECS)
    header = next(answers).header
    samples = []
    for answer in answers:
        samples += answer.samples
        if samples and samples[-1].frame == N_FRAMES:
            break
    answers.cancel()
    assert [it.sequence for it in samples] == list(range(1, N_FRAMES + 1))
    worst = max(max(abs(x) for x in it.activations) for it in samples)
    assert worst < 0.1, f"a rigid head moves no muscle, yet one contracts by {worst}"
    print(f"every frame: {len(samples)} samples of {len(header.controls)} controls, still face within {worst:.3f}")


def subscribe_to_the_latest(channel):
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
    assert newest.frame == N_FRAMES, newest.frame
    print(f"latest: frame {newest.frame} at once, heartbeat in state {heartbeat.state.session_state}")


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
    expected = {f"frontalis.v1.{it}Service" for it in ["Actor", "Capture", "Curve", "Session"]}
    assert expected <= services, services
    print(f"reflection: {', '.join(sorted(services))}")


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--server", required=True)
    parser.add_argument("--proto", required=True, type=Path)
    parser.add_argument("--package", required=True, type=Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as out:
        generate_stubs(arguments.proto, Path(out))
        from frontalis.v1 import session_pb2, session_pb2_grpc

        with grpc.insecure_channel(arguments.server) as channel:
            import_actor(channel, arguments.package.read_bytes())
            markers = neutral_markers(channel)
            request = session_pb2.CreateSessionRequest(
                session_id="python", actor="actors/reference", kind=session_pb2.CAPTURE_KIND_MARKERS
            )
            session_pb2_grpc.SessionServiceStub(channel).CreateSession(request, timeout=TIMEOUT_SECS)
            publish(channel, markers)
            follow_every_frame(channel)
            subscribe_to_the_latest(channel)
            refusal(channel)
            health_and_reflection(channel)


if __name__ == "__main__":
    main()
