"""What schemathesis cannot know from the description: how an actor package looks, and how lines of JSON are read."""

import json
import os
import pathlib

import hypothesis.strategies as st
import schemathesis

PACKAGE = pathlib.Path(os.environ["FRONTALIS_PACKAGE"]).read_bytes()

# Any bytes fit the schema of a binary body, but only a package is accepted. What is no package has tests of its own.
for media_type in ("application/zip", "model/gltf-binary", "application/octet-stream"):
    schemathesis.openapi.media_type(media_type, st.just(PACKAGE))


@schemathesis.deserializer("application/zip", "model/gltf-binary")
def binary(_context, response):
    return response.content.decode("latin-1")


@schemathesis.deserializer("application/x-ndjson")
def last_line(_context, response):
    return json.loads(response.content.splitlines()[-1])
