"""A machine as an OPC UA server: inputs are variables that clients write, sensors are variables that they read, in real time.

    pip install 'nivel[opcua]'
    python opcua_server.py trolley.yaml --endpoint opc.tcp://localhost:4840/nivel

The object `trolley` has the variables `time`, `push`, `place` and so on. Values outside the range of an input are limited.
"""

import argparse
import asyncio
import math
import time

from asyncua import Server

import nivel

SPACE = "urn:nivel"


async def operate(machine, endpoint, *, every=0.02, duration=math.inf, ready=None):
    """Let the machine move in real time until `duration` [s]. ready : event that is set when clients can connect."""
    server = Server()
    await server.init()
    server.set_endpoint(endpoint)
    space = await server.register_namespace(SPACE)
    thing = await server.nodes.objects.add_object(space, machine.name)
    inputs = {name: await thing.add_variable(space, name, each.rest_value) for name, each in machine.inputs.items()}
    for node in inputs.values():
        await node.set_writable()
    names = {"time": "time", **{name: f"sensor.{name}" for name in machine.sensors}}
    outputs = {name: await thing.add_variable(space, name, 0.0) for name in names}
    sim = machine.start()
    async with server:
        if ready is not None:
            ready.set()
        begin = time.monotonic()
        while sim.time < duration and not sim.stopped_by:
            sim.advance(
                every, {name: limited(await node.read_value(), machine.inputs[name]) for name, node in inputs.items()}
            )
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
    words = given.parse_args()
    asyncio.run(operate(nivel.load(words.machine), words.endpoint))


if __name__ == "__main__":
    main()
