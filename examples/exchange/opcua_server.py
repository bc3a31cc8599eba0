"""A machine as an OPC UA server: inputs are variables that clients write, sensors are variables that they read, in real time.

    pip install 'nivel[opcua]'
    python opcua_server.py trolley.yaml --endpoint opc.tcp://localhost:4840/nivel
    NIVEL_PASSWORD=… python opcua_server.py trolley.yaml --user crane --certificate server.pem --key server-key.pem

The object `trolley` has the variables `time`, `push`, `place` and so on. Values outside the range of an input are limited. Who operates it
writes another number into `heartbeat` at least once a second (--watchdog); else all inputs go to their rest values until it does.
"""

import argparse
import asyncio
import hmac
import math
import os
import time

from asyncua import Server, ua
from asyncua.crypto.permission_rules import User, UserRole

import nivel

SPACE = "urn:nivel"


class OneUser:
    """Lets one user in, who knows the password."""

    def __init__(self, name, password):
        self._name, self._password = name, password

    def get_user(self, _server, username=None, password=None, certificate=None):
        """The user, or None."""
        known = username == self._name and hmac.compare_digest((password or "").encode(), self._password.encode())
        return User(role=UserRole.User, name=username) if known else None


async def secured(endpoint, user="", password="", certificate=None, key=None):
    """A server that lets all in, or one user over lines that are encrypted."""
    if user and not (password and certificate and key):
        raise SystemExit(
            "a user needs NIVEL_PASSWORD, --certificate and --key: else the password is sent in clear text"
        )
    server = Server(user_manager=OneUser(user, password) if user else None)
    await server.init()
    server.set_endpoint(endpoint)
    if user:
        server.set_security_policy([ua.SecurityPolicyType.Basic256Sha256_SignAndEncrypt])
        server.set_security_IDs(["Username"])
        await server.load_certificate(certificate)
        await server.load_private_key(key)
    return server


async def operate(machine, server, *, every=0.02, duration=math.inf, ready=None, watchdog=1.0):
    """Let the machine move in real time until `duration` [s]. ready : event that is set when clients can connect. watchdog [s] : after
    which inputs rest where `heartbeat` is as it was."""
    space = await server.register_namespace(SPACE)
    thing = await server.nodes.objects.add_object(space, machine.name)
    inputs = {name: await thing.add_variable(space, name, each.rest_value) for name, each in machine.inputs.items()}
    heartbeat = await thing.add_variable(space, "heartbeat", 0)
    for node in (*inputs.values(), heartbeat):
        await node.set_writable()
    names = {"time": "time", **{name: f"sensor.{name}" for name in machine.sensors}}
    outputs = {name: await thing.add_variable(space, name, 0.0) for name in names}
    sim = machine.start()
    async with server:
        if ready is not None:
            ready.set()
        begin = time.monotonic()
        beat, came = await heartbeat.read_value(), -math.inf  # at rest until someone operates it
        while sim.time < duration and not sim.stopped_by:
            if (latest := await heartbeat.read_value()) != beat:
                beat, came = latest, time.monotonic()
            rests = time.monotonic() - came > watchdog
            wanted = {name: None if rests else await node.read_value() for name, node in inputs.items()}
            sim.advance(every, {name: limited(value, machine.inputs[name]) for name, value in wanted.items()})
            for name, node in outputs.items():
                await node.write_value(float(sim[names[name]]))
            await asyncio.sleep(max(0.0, begin + sim.time - time.monotonic()))
    return sim


def limited(value, given):
    """What a client has written, within the range of the input; what is no number is its rest value."""
    number = float(value) if isinstance(value, int | float) and math.isfinite(value) else given.rest_value
    return min(max(number, given.range[0]), given.range[1])


def main():
    given = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    given.add_argument("machine")
    given.add_argument("--endpoint", default="opc.tcp://localhost:4840/nivel")
    given.add_argument("--user", default="", help="who may connect; the password stands in the variable NIVEL_PASSWORD")
    given.add_argument("--certificate", metavar="FILE", help="of the server: lines are signed and encrypted")
    given.add_argument("--key", metavar="FILE", help="private key of the certificate")
    given.add_argument("--watchdog", type=float, default=1.0, metavar="SECONDS", help="inputs rest without a heartbeat")
    words = given.parse_args()
    password = os.environ.get("NIVEL_PASSWORD", "")

    async def run():
        server = await secured(words.endpoint, words.user, password, words.certificate, words.key)
        await operate(nivel.load(words.machine), server, watchdog=words.watchdog)

    asyncio.run(run())


if __name__ == "__main__":
    main()
