"""Links of machines to other programs: a broker of MQTT and clients of OPC UA move the trolley of the examples."""

import asyncio
import json
import runpy
import shutil
import socket
import ssl
import subprocess
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

    def __init__(self, retained, tls=None):
        super().__init__(daemon=True)
        self.retained, self.published, self.tls, self.hello = retained, [], tls, b""
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]

    def run(self):
        link, _ = self.listener.accept()
        if self.tls is not None:
            link = self.tls.wrap_socket(link, server_side=True)
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
                        self.hello = content
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
    sim = operate(trolley, client, duration=0.4, watchdog=PATIENCE)
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
        server = await example["secured"](endpoint)
        running = asyncio.create_task(example["operate"](machine, server, ready=ready, watchdog=PATIENCE))
        await ready.wait()
        async with opcua.Client(endpoint) as client:
            space = await client.get_namespace_index(example["SPACE"])
            thing = await client.nodes.objects.get_child(f"{space}:trolley")
            node = {
                name: await thing.get_child(f"{space}:{name}")
                for name in ("time", "push", "place", "speed", "heartbeat")
            }
            await node["push"].write_value(9000.0)
            assert sim["push.value"] == 0.0  # nobody operates it yet
            await node["heartbeat"].write_value(1)
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


@pytest.fixture(scope="module")
def certificate(tmp_path_factory):
    if shutil.which("openssl") is None:
        pytest.skip("there is no openssl")
    folder = tmp_path_factory.mktemp("keys")
    words = "req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN=localhost -keyout key.pem -out cert.pem"
    names = "subjectAltName=IP:127.0.0.1,URI:urn:freeopcua:client"
    subprocess.run(["openssl", *words.split(), "-addext", names], cwd=folder, check=True, capture_output=True)
    return str(folder / "cert.pem"), str(folder / "key.pem")


def test_a_broker_gets_user_and_password_over_tls_and_inputs_rest_when_nothing_comes(trolley, certificate):
    needs("paho.mqtt.client")
    tls = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    tls.load_cert_chain(*certificate)
    broker = Broker([("nivel/trolley/set/push", b"9000")], tls)
    broker.start()
    example = runpy.run_path(str(EXAMPLES / "mqtt_bridge.py"))
    with pytest.raises(SystemExit, match="clear text"):
        example["connected"]("127.0.0.1", broker.port, "crane", "secret")
    client = example["connected"]("127.0.0.1", broker.port, "crane", "secret", certificate[0])
    sim = example["operate"](trolley, client, duration=0.4, watchdog=0.1)
    client.disconnect()
    client.loop_stop()
    broker.join(timeout=PATIENCE)
    assert b"crane" in broker.hello
    assert b"secret" in broker.hello
    assert sim["push.value"] == 0.0


@pytest.mark.full
def test_a_server_of_opc_ua_lets_one_user_in_and_rests_without_a_heartbeat(trolley, certificate):
    opcua = needs("asyncua")
    with socket.create_server(("127.0.0.1", 0)) as free:
        endpoint = f"opc.tcp://127.0.0.1:{free.getsockname()[1]}/nivel"
    example = runpy.run_path(str(EXAMPLES / "opcua_server.py"))
    sim = trolley.start()
    machine = SimpleNamespace(name=trolley.name, inputs=trolley.inputs, sensors=trolley.sensors, start=lambda: sim)

    async def client(password):
        made = opcua.Client(endpoint)
        made.set_user("crane")
        made.set_password(password)
        await made.set_security_string(f"Basic256Sha256,SignAndEncrypt,{','.join(certificate)}")
        return made

    async def session():
        ready = asyncio.Event()
        server = await example["secured"](endpoint, "crane", "secret", *certificate)
        running = asyncio.create_task(example["operate"](machine, server, ready=ready, watchdog=0.2))
        await ready.wait()
        with pytest.raises(opcua.ua.UaError):
            await (await client("guessed")).connect()
        async with await client("secret") as link:
            space = await link.get_namespace_index(example["SPACE"])
            thing = await link.nodes.objects.get_child(f"{space}:trolley")
            push, beat = [await thing.get_child(f"{space}:{name}") for name in ("push", "heartbeat")]
            await push.write_value(100.0)
            await beat.write_value(1)
            while sim["push.value"] != 100.0:
                await asyncio.sleep(0.005)
            while sim["push.value"] != 0.0:
                await asyncio.sleep(0.005)
        running.cancel()

    asyncio.run(asyncio.wait_for(session(), PATIENCE))


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
