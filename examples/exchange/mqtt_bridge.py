"""A machine on an MQTT broker: it takes its inputs from topics, and publishes its sensors in real time.

    pip install 'nivel[mqtt]'
    python mqtt_bridge.py trolley.yaml --broker localhost

`nivel/trolley/set/push` sets the input `push`; `nivel/trolley/state` has time, inputs and sensors as JSON, 50 times a second.
Values outside the range of an input are limited. Texts that are no numbers are ignored.
"""

import argparse
import json
import math
import time

import nivel


def operate(machine, client, *, every=0.02, duration=math.inf):
    """Let the machine move in real time until `duration` [s]; `client` is connected, and its loop runs."""
    root = f"nivel/{machine.name}"
    ranges = {name: each.range for name, each in machine.inputs.items()}
    sim, wanted = machine.start(), {}

    def received(_client, _data, message):
        name = message.topic.rpartition("/")[2]
        try:
            value = float(message.payload)
        except ValueError:
            return
        if name in ranges and math.isfinite(value):
            low, high = ranges[name]
            wanted[name] = min(max(value, low), high)

    client.on_message = received
    client.subscribe(f"{root}/set/+")
    begin = time.monotonic()
    while sim.time < duration and not sim.stopped_by:
        sim.advance(every, dict(wanted))
        state = {"time": sim.time}
        state |= {name: sim[f"{name}.value"] for name in ranges}
        state |= {name: sim[f"sensor.{name}"] for name in machine.sensors}
        client.publish(f"{root}/state", json.dumps(state))
        time.sleep(max(0.0, begin + sim.time - time.monotonic()))
    return sim


def main():
    import paho.mqtt.client as mqtt

    given = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    given.add_argument("machine")
    given.add_argument("--broker", default="localhost")
    given.add_argument("--port", type=int, default=1883)
    words = given.parse_args()
    client = mqtt.Client(mqtt.CallbackAPIVersion.VERSION2)
    client.connect(words.broker, words.port)
    client.loop_start()
    operate(nivel.load(words.machine), client)
    client.loop_stop()


if __name__ == "__main__":
    main()
