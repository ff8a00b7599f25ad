"""Reads the file of a take with the packages mcap and mcap-protobuf-support alone, and prints what it holds as JSON.

The file may be that of a take under way, of one that a crash cut short, or of one that is over: the schemas are in it.

    .venv/bin/python tests/clients/python/read_take.py 12A_3.mcap
"""

import json
import sys

from mcap.exceptions import EndOfFile
from mcap.reader import make_reader
from mcap.records import Channel, Message, Schema
from mcap.stream_reader import StreamReader
from mcap_protobuf.decoder import DecoderFactory


def messages(stream):
    """Every message with its channel, in the file's order; a file under way simply ends."""
    schemas, channels, factory = {}, {}, DecoderFactory()
    records = StreamReader(stream, validate_crcs=True).records
    while True:
        try:
            record = next(records)
        except (StopIteration, EndOfFile):
            return
        if isinstance(record, Schema):
            schemas[record.id] = record
        elif isinstance(record, Channel):
            channels[record.id] = record
        elif isinstance(record, Message):
            channel = channels[record.channel_id]
            decode = factory.decoder_for(channel.message_encoding, schemas[channel.schema_id])
            yield channel.topic, decode(record.data)


def held(path):
    found = {"/markers": [], "/curves": [], "/events": []}
    with open(path, "rb") as stream:
        for topic, message in messages(stream):
            found[topic].append(message)
    frames, samples, events = found["/markers"], found["/curves"], found["/events"]
    return {
        "frames": [frame.number for frame in frames],
        "positionSums": [sum(value for value in frame.positions if value == value) for frame in frames],
        "samples": [sample.frame for sample in samples],
        "activationSums": [sum(sample.activations) for sample in samples],
        "events": [event.WhichOneof("event") for event in events],
        "take": next((event.header.take for event in events if event.HasField("header")), ""),
        "indexed": indexed(path),
    }


def indexed(path):
    """Messages by channel, as the index of a file that is over has them; none without an index."""
    with open(path, "rb") as stream:
        try:
            reader = make_reader(stream, decoder_factories=[DecoderFactory()])
            if reader.get_summary() is None:
                return None
        except Exception:  # The file has no end yet, which the package tells in several ways.
            return None
        counts = {}
        for _schema, channel, _message, _decoded in reader.iter_decoded_messages():
            counts[channel.topic] = counts.get(channel.topic, 0) + 1
        statistics = reader.get_summary().statistics
        assert statistics.message_count == sum(counts.values()), (statistics, counts)
        return counts


if __name__ == "__main__":
    print(json.dumps(held(sys.argv[1])))
