#!/usr/bin/env bash
# Frontalis with curl: everything that matters, one line a promise; ends with 1 when one is broken.
#
#   client.sh --server URL --package FILE --frames FILE [--ca-cert FILE]
#             [--token-file FILE (a publisher's)] [--operator-token-file FILE]
set -euo pipefail

while [ $# -gt 0 ]; do
  case $1 in
    --server) server=$2 ;;
    --package) package=$2 ;;
    --frames) frames=$2 ;;
    --token-file) token_file=$2 ;;
    --operator-token-file) operator_token_file=$2 ;;
    --ca-cert) ca_cert=$2 ;;
    *) echo "unknown: $1" >&2; exit 2 ;;
  esac
  shift 2
done
api=$server/api/v1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

options=(--silent --show-error --max-time 30)
if [ -n "${ca_cert:-}" ]; then
  options+=(--cacert "$ca_cert")
fi
# Each role its token, from a file: arguments are seen by everybody on the machine.
publisher=(--config "$work/publisher") operator=(--config "$work/operator")
use_token() { [ -z "$1" ] || printf 'header = "authorization: Bearer %s"\n' "$(cat "$1")"; }
use_token "${token_file:-}" > "$work/publisher"
use_token "${operator_token_file:-}" > "$work/operator"

fail() { echo "broken: $*" >&2; exit 1; }
# Answers in JSON, or ends with what the server refused.
ask() {
  curl "${options[@]}" --fail-with-body "$@" > "$work/answer" || fail "$*: $(head -c 2000 "$work/answer")"
  cat "$work/answer"
}
# expect TEXT FILE: the file holds the text.
expect() { grep -q -- "$1" "$2" || fail "no $1 in: $(head -c 2000 "$2")"; }

ask "${publisher[@]}" "$api/server" > "$work/server"
expect '"version":' "$work/server"
echo "server: $(cat "$work/server")"

# Upload, with progress: each line of the answer says how far the server is, the last one the result.
ask "${operator[@]}" --no-buffer --upload-file "$package" -H 'content-type: application/octet-stream' \
  -H 'accept: application/x-ndjson' "$api/actors/reference" > "$work/import"
expect '"progress":' "$work/import"
tail -n 1 "$work/import" > "$work/imported"
expect '"result":' "$work/imported"
echo "import: lines of progress: $(grep -c progress "$work/import"), then the actor"

ask "${operator[@]}" "$api/actors/reference/model.glb" > "$work/model.glb"
[ "$(head -c 4 "$work/model.glb")" = glTF ] || fail "the model is no GLB"
echo "model: $(wc -c < "$work/model.glb") bytes of GLB"

ask "${publisher[@]}" --json '{"sessionId": "curl", "actor": "actors/reference", "kind": "CAPTURE_KIND_MARKERS"}' \
  "$api/sessions" > "$work/session"
expect '"name":"sessions/curl"' "$work/session"
echo "session: created"

# Publish: one PublishMarkersRequest a line in, one PublishResponse a line out.
ask "${publisher[@]}" --no-buffer --data-binary @"$frames" -H 'content-type: application/x-ndjson' \
  "$api/sessions/curl/frames" > "$work/published"
head -n 1 "$work/published" > "$work/started"
expect '"started":' "$work/started"
last=$(grep -o '"number":"[0-9]*"' "$frames" | tail -n 1 | grep -o '[0-9]*')
expect "\"acceptedThrough\":\"$last\"" "$work/published"
echo "publish: $last frames taken"

# The same by hand: the start with two of the actor's markers, then a frame of them, the second of them not seen.
ask "${operator[@]}" "$api/actors/reference" > "$work/actor"
markers=$(grep -o '"markers":\[[^]]*' "$work/actor" | grep -o '"name":"[^"]*"' | head -n 2 | cut -d : -f 2 | paste -s -d , -)
ask "${publisher[@]}" --json '{"sessionId": "curl-2", "actor": "actors/reference", "kind": "CAPTURE_KIND_MARKERS"}' \
  "$api/sessions" > "$work/session"
ask "${publisher[@]}" --data-binary @- -H 'content-type: application/x-ndjson' \
  "$api/sessions/curl-2/frames" > "$work/published" << LINES
{"start": {"publisher": "rig-1", "unit": "LENGTH_UNIT_MILLIMETER", "rateHz": 120, "markerNames": [$markers]}}
{"frames": [{"number": "1", "captureTimeNanos": "8333333", "positions": [21.5, 32.0, 88.4, "NaN", "NaN", "NaN"]}]}
LINES
expect '"acceptedThrough":"1"' "$work/published"
ask "${publisher[@]}" -X POST "$api/sessions/curl-2/end" > "$work/ended"
echo "by hand: one frame taken"

# Poll: `after` is the last sequence that was read, `run` the run that it counts in.
after=0 polled=0
until grep -q "\"frame\":\"$last\"" "$work/polled" 2> "$work/none"; do
  ask "${publisher[@]}" "$api/sessions/curl/curves?after=$after&limit=40" > "$work/polled"
  polled=$((polled + $(grep -o '"sequence":' "$work/polled" | wc -l)))
  after=$(grep -o '"readThrough":"[0-9]*"' "$work/polled" | grep -o '[0-9]*' || echo "$after")
done
[ "$polled" = "$after" ] || fail "$polled samples up to sequence $after"
echo "poll: $polled samples up to sequence $after"

ask "${publisher[@]}" -X POST "$api/sessions/curl/end" > "$work/ended"
expect 'SESSION_STATE_ENDED' "$work/ended"
echo "end: the session ended"

# Follow: a session that ended is delivered whole, then the stream closes.
ask "${publisher[@]}" --no-buffer "$api/sessions/curl/events?delivery=every_frame&fromOldest=true" > "$work/events"
expect '"end":' "$work/events"
position=$(grep '^id:' "$work/events" | tail -n 1 | sed 's/^id: *//')
n_events=$(grep -o '"sequence":' "$work/events" | wc -l)
[ "$n_events" = "$polled" ] || fail "$n_events samples in the events, $polled polled"
echo "events: $n_events samples, the last at $position"

# Resume: what follows the last event that was received; here nothing does.
status=$(curl "${options[@]}" "${publisher[@]}" -o "$work/resumed" -w '%{http_code}' -H "last-event-id: $position" \
  "$api/sessions/curl/events?delivery=every_frame")
[ "$status" = 204 ] || fail "$status for a stream that was received whole"
echo "resume: 204, nothing is left"

# A refusal says what, why and where.
status=$(curl "${options[@]}" "${publisher[@]}" -o "$work/problem" -w '%{http_code} %{content_type}' "$api/sessions/nobody")
[ "$status" = '404 application/problem+json' ] || fail "$status"
expect '"type":"urn:frontalis:problem:SESSION"' "$work/problem"
echo "refusal: $(cat "$work/problem")"

# Without a token, where one is asked for.
if [ -n "${token_file:-}" ]; then
  status=$(curl --silent --cacert "$ca_cert" -o "$work/problem" -w '%{http_code}' "$api/sessions")
  [ "$status" = 401 ] || fail "$status without a token"
  echo "token: 401 without one"
fi
