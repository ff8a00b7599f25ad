"""A client of Frontalis over HTTP, with Python's standard library and nothing else.

Imports an actor, creates a session, publishes a take as newline-delimited JSON, polls its curves, follows them as
server-sent events across a cut; prints one line a promise and exits with 1 when one is broken.
"""

import argparse
import http.client
import json
import ssl
import sys
from pathlib import Path
from urllib.parse import urlencode, urlsplit

TIMEOUT_SECS = 30
SESSION = "python-http"


class Refused(Exception):
    """An answer of `application/problem+json`."""

    def __init__(self, problem: dict):
        super().__init__(problem["detail"])
        self.problem = problem
        self.reason = problem["type"].removeprefix("urn:frontalis:problem:")


class Server:
    """One server, with what it wants to be shown."""

    def __init__(self, url: str, token: str | None, ca_cert: Path | None):
        self.address = urlsplit(url)
        self.headers = {"authorization": f"Bearer {token}"} if token else {}
        self.tls = ssl.create_default_context(cafile=ca_cert) if self.address.scheme == "https" else None

    def open(self, method: str, path: str, body=None, headers=None) -> http.client.HTTPResponse:
        """Sends a request and waits for the head of its answer; the body may be read while it comes."""
        host = self.address.netloc
        if self.tls:
            connection = http.client.HTTPSConnection(host, timeout=TIMEOUT_SECS, context=self.tls)
        else:
            connection = http.client.HTTPConnection(host, timeout=TIMEOUT_SECS)
        connection.request(method, f"/api/v1{path}", body=body, headers={**self.headers, **(headers or {})})
        answer = connection.getresponse()
        if answer.getheader("content-type") == "application/problem+json":
            raise Refused(json.load(answer))
        return answer

    def call(self, method: str, path: str, message=None):
        """One message in, one message out."""
        body = None if message is None else json.dumps(message)
        headers = {} if body is None else {"content-type": "application/json"}
        with self.open(method, path, body, headers) as answer:
            return json.load(answer)


def show_server(server: Server) -> None:
    about = server.call("GET", "/server")
    print(f"server: version {about['version']}, you are {about['caller']['name']}")


def import_actor(server: Server, package: bytes) -> None:
    headers = {"content-type": "application/octet-stream"}
    with server.open("PUT", "/actors/reference", package, headers) as answer:
        actor = json.load(answer)["actor"]
    assert actor["name"] == "actors/reference", actor["name"]
    print(f"import: {len(actor['muscles'])} muscles, {len(actor['markers'])} markers")


def create_session(server: Server) -> None:
    session = server.call(
        "POST",
        "/sessions",
        {"sessionId": SESSION, "actor": "actors/reference", "kind": "CAPTURE_KIND_MARKERS"},
    )
    assert session["status"]["state"] == "SESSION_STATE_WAITING", session
    print(f"session: {session['name']} waits for frames")


def publish(server: Server, take: Path) -> int:
    """Sends the take, one PublishMarkersRequest a line; answers the number of its last frame."""
    lines = take.read_bytes().splitlines(keepends=True)
    last = int(json.loads(lines[-1])["frames"][-1]["number"])
    headers = {"content-type": "application/x-ndjson"}
    with server.open("POST", f"/sessions/{SESSION}/frames", iter(lines), headers) as answer:
        answers = [json.loads(line) for line in answer]
    assert "started" in answers[0], answers[0]
    assert not any("rejected" in it or "error" in it for it in answers), answers
    taken = max(int(it.get("acceptedThrough", 0)) for it in answers)
    assert taken == last, taken
    print(f"publish: {taken} frames taken in run {answers[0]['started']['run']}")
    return last


def poll(server: Server, last: int) -> list[dict]:
    """Asks again and again for what came since."""
    samples, query = [], {"limit": 25}
    while not samples or int(samples[-1]["frame"]) < last:
        answer = server.call("GET", f"/sessions/{SESSION}/curves?{urlencode(query)}")
        samples += answer.get("samples", [])
        # A sequence means nothing without its run.
        query |= {"run": answer["header"]["run"], "after": answer.get("readThrough", "0")}
    assert [int(it["sequence"]) for it in samples] == list(range(1, len(samples) + 1))
    print(f"poll: {len(samples)} samples, 25 at most in an answer")
    return samples


def events(answer: http.client.HTTPResponse):
    """The events of a stream: id, kind and data (WHATWG HTML, section 9.2)."""
    event = {"id": None, "event": "message", "data": []}
    for line in answer:
        field, _, value = line.decode().rstrip("\r\n").partition(":")
        value = value.removeprefix(" ")
        if field == "data":
            event["data"].append(value)
        elif field in ("id", "event"):
            event[field] = value
        elif field == "" and event["data"]:
            yield event["id"], event["event"], json.loads("\n".join(event["data"]))
            event = {"id": event["id"], "event": "message", "data": []}


def follow(server: Server, last: int, cut_every: int) -> list[dict]:
    """Every sample in order, across cuts: `Last-Event-ID` says where to go on."""
    samples, position = [], None
    path = f"/sessions/{SESSION}/events?{urlencode({'delivery': 'every_frame', 'fromOldest': 'true'})}"
    while not samples or int(samples[-1]["frame"]) < last:
        resume = {"last-event-id": position} if position else {}
        received = 0
        with server.open("GET", path, headers={"accept": "text/event-stream", **resume}) as answer:
            for id, kind, data in events(answer):
                if kind == "problem":
                    raise Refused(data)
                samples += data.get("samples", [])
                received += len(data.get("samples", []))
                position = id or position
                if received >= cut_every or (samples and int(samples[-1]["frame"]) == last):
                    break
    assert [int(it["sequence"]) for it in samples] == list(range(1, len(samples) + 1))
    print(f"events: {len(samples)} samples in order across cuts, the last at {position}")
    return samples


def refusals(server: Server) -> None:
    try:
        server.call("GET", "/sessions/nobody")
    except Refused as refused:
        assert (refused.problem["status"], refused.reason) == (404, "SESSION"), refused.problem
        print(f"refusal: {refused.problem['status']} {refused.reason}, {refused}")
    else:
        raise AssertionError("a session that is not there was found")
    try:
        server.call("POST", "/sessions", {"session_id": "x", "actors": "typo"})
    except Refused as refused:
        assert refused.problem["status"] == 400, refused.problem
        print(f"refusal: {refused.problem['status']} {refused.reason}, {refused}")
    else:
        raise AssertionError("an unknown field was taken")


def end_session(server: Server) -> None:
    session = server.call("POST", f"/sessions/{SESSION}/end")
    assert session["status"]["state"] == "SESSION_STATE_ENDED", session["status"]
    print(f"end: {session['name']} after {session['status']['framesReceived']} frames")


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--server", required=True, help="http://HOST:PORT or https://HOST:PORT")
    parser.add_argument("--package", required=True, type=Path, help="an actor's package")
    parser.add_argument("--frames", required=True, type=Path, help="a take: one PublishMarkersRequest a line")
    parser.add_argument("--token-file", type=Path, help="of a publisher")
    parser.add_argument("--operator-token-file", type=Path, help="of an operator, who imports actors")
    parser.add_argument("--ca-cert", type=Path)
    arguments = parser.parse_args()

    def connect(token_file: Path | None) -> Server:
        token = token_file.read_text().strip() if token_file else None
        return Server(arguments.server, token, arguments.ca_cert)

    server = connect(arguments.token_file)
    show_server(server)
    import_actor(connect(arguments.operator_token_file), arguments.package.read_bytes())
    create_session(server)
    last = publish(server, arguments.frames)
    polled = poll(server, last)
    followed = follow(server, last, cut_every=20)
    assert polled == followed, "two doors, two answers"
    refusals(server)
    end_session(server)


if __name__ == "__main__":
    sys.exit(main())
