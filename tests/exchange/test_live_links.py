"""Links of machines to other programs: a broker of MQTT and clients of OPC UA move the trolley of the examples."""

import asyncio
import json
import runpy
import socket
import threading
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import nivel
from needing import needs
from patience import PATIENCE

EXAMPLES = Path(__file__).parents[2] / "examples" / "exchange"


@pytest.fixture(scope="module")
def trolley():
    return nivel.load(EXAMPLES / "trolley.yaml")


def packet(kind, content):
    return bytes([kind, len(content)]) + content


class Broker(threading.Thread):
    """As much of a broker of MQTT 3.1.1 as one client needs: it answers, keeps what is published, and has messages for who subscribes."""

    def __init__(self, retained):
        super().__init__(daemon=True)
        self.retained, self.published = retained, []
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]

    def run(self):
        link, _ = self.listener.accept()
        with self.listener, link, link.makefile("rb") as stream:
            while head := stream.read(1):
                size, shift = 0, 0
                while True:
                    byte = stream.read(1)[0]
                    size |= (byte & 127) << shift
                    shift += 7
                    if byte < 128:
                        break
                content = stream.read(size)
                match head[0] >> 4:
                    case 1:  # connect
                        link.sendall(packet(0x20, b"\0\0"))
                    case 8:  # subscribe
                        link.sendall(packet(0x90, content[:2] + b"\0"))
                        for topic, text in self.retained:
                            link.sendall(packet(0x30, len(topic).to_bytes(2, "big") + topic.encode() + text))
                    case 3:  # publish
                        length = int.from_bytes(content[:2], "big")
                        self.published.append((content[2 : 2 + length].decode(), json.loads(content[2 + length :])))


def test_a_machine_follows_topics_of_mqtt_and_publishes_its_state(trolley):
    mqtt = needs("paho.mqtt.client")
    topics = [("nivel/trolley/set/push", text) for text in (b"no number", b"nan", b"9000")]
    broker = Broker([*topics, ("nivel/trolley/set/other", b"1")])
    broker.start()
    client = mqtt.Client(mqtt.CallbackAPIVersion.VERSION2)
    client.connect("127.0.0.1", broker.port)
    client.loop_start()
    operate = runpy.run_path(str(EXAMPLES / "mqtt_bridge.py"))["operate"]
    sim = operate(trolley, client, duration=0.4)
    client.disconnect()
    client.loop_stop()
    broker.join(timeout=PATIENCE)
    assert {topic for topic, _ in broker.published} == {"nivel/trolley/state"}
    states = [state for _, state in broker.published]
    assert len(states) == 20
    assert states[-1]["push"] == 500.0  # the end of its range
    assert states[-1]["place"] == sim["rail.displacement"]
    # the same inputs in a simulation of its own
    again = trolley.start()
    for state in states:
        again.advance(0.02, {"push": state["push"]})
        assert (again["sensor.place"], again["sensor.sway"]) == (state["place"], state["sway"])


def test_a_machine_is_a_server_of_opc_ua(trolley):
    opcua = needs("asyncua")
    with socket.create_server(("127.0.0.1", 0)) as free:
        endpoint = f"opc.tcp://127.0.0.1:{free.getsockname()[1]}/nivel"
    example = runpy.run_path(str(EXAMPLES / "opcua_server.py"))

    sim = trolley.start()
    machine = SimpleNamespace(name=trolley.name, inputs=trolley.inputs, sensors=trolley.sensors, start=lambda: sim)

    async def session():
        ready = asyncio.Event()
        running = asyncio.create_task(example["operate"](machine, endpoint, ready=ready))
        await ready.wait()
        async with opcua.Client(endpoint) as client:
            space = await client.get_namespace_index(example["SPACE"])
            thing = await client.nodes.objects.get_child(f"{space}:trolley")
            node = {name: await thing.get_child(f"{space}:{name}") for name in ("time", "push", "place", "speed")}
            await node["push"].write_value(9000.0)
            while await node["speed"].read_value() <= 0.0:
                await asyncio.sleep(0.01)
            seen = {name: await each.read_value() for name, each in node.items()}
        running.cancel()
        return seen

    seen = asyncio.run(asyncio.wait_for(session(), PATIENCE))
    assert seen["time"] > 0.0
    assert seen["speed"] > 0.0
    assert sim["push.value"] == 500.0
    assert sim["rail.displacement"] >= seen["place"] > 0.0


def test_what_is_no_number_is_the_rest_value(trolley):
    needs("asyncua")
    limited = runpy.run_path(str(EXAMPLES / "opcua_server.py"))["limited"]
    given = trolley.inputs["push"]
    assert [limited(each, given) for each in (10, -1e9, np.nan, "x", None)] == [10.0, -500.0, 0.0, 0.0, 0.0]


def test_the_bridge_of_ros_has_the_datagrams_of_live():
    """ROS itself is not there: its header against that of the datagrams."""
    from nivel.live import datagrams

    text = (EXAMPLES / "ros2" / "bridge.py").read_text(encoding="utf-8")
    compile(text, "bridge.py", "exec")
    assert f'struct.Struct("{datagrams.HEAD.format}")' in text
