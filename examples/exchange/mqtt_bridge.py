"""A machine on an MQTT broker: it takes its inputs from topics, and publishes its sensors in real time.

    pip install 'nivel[mqtt]'
    python mqtt_bridge.py trolley.yaml --broker localhost
    NIVEL_PASSWORD=… python mqtt_bridge.py trolley.yaml --broker plant --port 8883 --user crane --ca plant.pem

`nivel/trolley/set/push` sets the input `push`; `nivel/trolley/state` has time, inputs and sensors as JSON, 50 times a second.
Values outside the range of an input are limited. Texts that are no numbers are ignored. Where no value has come for a second (--watchdog),
as a line is cut or the other program has ended, all inputs go to their rest values until one comes.
"""

import argparse
import json
import math
import os
import time

import nivel


def operate(machine, client, *, every=0.02, duration=math.inf, watchdog=1.0):
    """Let the machine move in real time until `duration` [s]; `client` is connected, and its loop runs. watchdog [s] : after which inputs
    rest where no value has come."""
    root = f"nivel/{machine.name}"
    ranges = {name: each.range for name, each in machine.inputs.items()}
    rest = {name: each.rest_value for name, each in machine.inputs.items()}
    sim, wanted, came = machine.start(), {}, time.monotonic()

    def received(_client, _data, message):
        nonlocal came
        name = message.topic.rpartition("/")[2]
        try:
            value = float(message.payload)
        except ValueError:
            return
        if name in ranges and math.isfinite(value):
            low, high = ranges[name]
            wanted[name], came = min(max(value, low), high), time.monotonic()

    client.on_message = received
    client.on_connect = lambda *_: client.subscribe(f"{root}/set/+")  # again where the line was cut
    client.subscribe(f"{root}/set/+")
    begin = time.monotonic()
    while sim.time < duration and not sim.stopped_by:
        if time.monotonic() - came > watchdog:
            wanted.update(rest)
        sim.advance(every, dict(wanted))
        state = {"time": sim.time}
        state |= {name: sim[f"{name}.value"] for name in ranges}
        state |= {name: sim[f"sensor.{name}"] for name in machine.sensors}
        client.publish(f"{root}/state", json.dumps(state))
        time.sleep(max(0.0, begin + sim.time - time.monotonic()))
    return sim


def connected(broker, port, user="", password=None, ca=None):
    """A client of a broker. ca : file of certificates that are trusted, with which the line is encrypted."""
    import paho.mqtt.client as mqtt

    if user and ca is None:
        raise SystemExit("a password would be sent in clear text: give --ca FILE")
    client = mqtt.Client(mqtt.CallbackAPIVersion.VERSION2)
    if user:
        client.username_pw_set(user, password)
    if ca is not None:
        client.tls_set(ca_certs=ca)
    client.connect(broker, port)
    client.loop_start()
    return client


def main():
    given = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    given.add_argument("machine")
    given.add_argument("--broker", default="localhost")
    given.add_argument("--port", type=int, default=1883)
    given.add_argument("--user", default="", help="the password stands in the variable NIVEL_PASSWORD")
    given.add_argument("--ca", metavar="FILE", help="certificates that are trusted: the line is encrypted (TLS)")
    given.add_argument("--watchdog", type=float, default=1.0, metavar="SECONDS", help="inputs rest where none has come")
    words = given.parse_args()
    client = connected(words.broker, words.port, words.user, os.environ.get("NIVEL_PASSWORD"), words.ca)
    operate(nivel.load(words.machine), client, watchdog=words.watchdog)
    client.loop_stop()


if __name__ == "__main__":
    main()
