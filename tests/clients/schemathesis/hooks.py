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


# Which controls there are depends on the actor.
EXCLUSIVE = ("lips_pressor", "orbicularis_oris")
BOUNDED = ("jaw_rotation", "frontalis_left", "frontalis_right", "zygomatic_major_left", "zygomatic_major_right")


@schemathesis.hook
def before_call(_context, case, _kwargs):
    """A package in another unit than the query says is refused, as it should be: say its own."""
    units = ("LENGTH_UNIT_MILLIMETER", "LENGTH_UNIT_METER")
    if case.method == "PUT" and (case.query or {}).get("unit") in units:
        case.query["unit"] = "LENGTH_UNIT_CENTIMETER"
    settings = case.body.get("settings") if isinstance(case.body, dict) else None
    if isinstance(settings, dict):
        fit_to_the_actor(settings)


def fit_to_the_actor(settings):
    """What fits the schema is refused when it names controls that are not there, or contradicts itself: say what can be."""
    if settings.get("plain") is True:
        settings["plain"] = False
    bounds, pairs = settings.get("bounds"), settings.get("exclusivePairs")
    if consists_of_objects(bounds):
        del bounds[len(BOUNDED) :]
        for control, own in zip(BOUNDED, bounds):
            rename(own, "control", control)
            lower, upper = own.get("lower") or 0, own.get("upper") or 0
            if is_number(lower) and is_number(upper) and float(lower) > float(upper):
                own["lower"], own["upper"] = upper, lower
    if consists_of_objects(pairs):
        for pair in pairs:
            for key, control in zip(("first", "second"), EXCLUSIVE):
                rename(pair, key, control)


def consists_of_objects(value):
    return isinstance(value, list) and all(isinstance(it, dict) for it in value)


def rename(entry, key, control):
    # What is no text is not repaired: it has to be refused.
    if isinstance(entry.get(key, ""), str):
        entry[key] = control


def is_number(value):
    try:
        float(value)
    except (TypeError, ValueError):
        return False
    return True


@schemathesis.deserializer("application/zip", "model/gltf-binary")
def binary(_context, response):
    return response.content.decode("latin-1")


@schemathesis.deserializer(LINES)
def last_line(_context, response):
    return json.loads(response.content.splitlines()[-1])
