"""What schemathesis cannot know from the description: what packages and frames look like, and how lines are read.

FRONTALIS_PACKAGE names an actor package, in centimeters.
"""

import json
import os
import pathlib

import hypothesis.strategies as st
import schemathesis

PACKAGE = pathlib.Path(os.environ["FRONTALIS_PACKAGE"]).read_bytes()
LINES = "application/x-ndjson"

# Any bytes fit the schema of a binary body, but only a package is accepted. What is no package has tests of its own.
for kind in ("application/zip", "model/gltf-binary", "application/octet-stream"):
    schemathesis.openapi.media_type(kind, st.just(PACKAGE))

# The schema describes one line. A publication is a start and then frames; each frame is judged on its own.
COORDINATES = st.floats(-1e6, 1e6, width=32) | st.just("NaN")
FRAMES = st.fixed_dictionaries(
    {"number": st.integers(0, 2**64 - 1).map(str), "positions": st.lists(COORDINATES, max_size=100)}
)
START = {"publisher": "schemathesis", "unit": "LENGTH_UNIT_CENTIMETER", "rateHz": 60}


def publication(messages):
    lines = [{"start": START}, *({"frames": frames} for frames in messages)]
    return "".join(json.dumps(line) + "\n" for line in lines).encode()


schemathesis.openapi.media_type(LINES, st.lists(st.lists(FRAMES, max_size=3), max_size=3).map(publication))


@schemathesis.hook
def before_call(_context, case, _kwargs):
    """A package in another unit than the query says is refused, as it should be: say its own."""
    units = ("LENGTH_UNIT_MILLIMETER", "LENGTH_UNIT_METER")
    if case.method == "PUT" and (case.query or {}).get("unit") in units:
        case.query["unit"] = "LENGTH_UNIT_CENTIMETER"


@schemathesis.deserializer("application/zip", "model/gltf-binary")
def binary(_context, response):
    return response.content.decode("latin-1")


@schemathesis.deserializer(LINES)
def last_line(_context, response):
    return json.loads(response.content.splitlines()[-1])
