"""The server of a live machine: one page operates it, nonsense is dropped and counted, datagrams have their format."""

import asyncio
import json
import random
import socket
import struct
import threading
import time
from contextlib import AsyncExitStack, closing, contextmanager
from itertools import count

import numpy as np
import pytest
import websockets

import cart
from browsing import served
from nivel.errors import ModelError
from nivel.integrate.loop.paced import DONE
from nivel.live.datagrams import HEAD, INPUTS, VERSION, Counts, Datagrams, place_of
from nivel.live.preparation import SILENCE
from nivel.live.source import ONLY_WATCH, LiveSource
from nivel.system.layout import frame_layout
from nivel.view.records import FRAME, SAMPLES
from nivel.view.server import Address
from nivel.view.stream import NotUnderstoodError, read_message
from patience import PATIENCE


@pytest.fixture(scope="module")
def live():
    """A running session and the viewing of its page."""
    with cart.running() as session, served(LiveSource(session)) as viewing:
        session.command("run")
        yield session, viewing


def packed_inputs(values, sequence, stamp):
    """A datagram of inputs."""
    return HEAD.pack(INPUTS, VERSION, len(values), sequence, 0, stamp) + np.asarray(values, "<f8").tobytes()


def connected(viewing):
    port = viewing.address.port
    return websockets.connect(
        f"ws://127.0.0.1:{port}/stream", origin=f"http://127.0.0.1:{port}", max_size=None, proxy=None, close_timeout=0.5
    )


async def statuses(page, wanted):
    """Messages of the server until one of them fulfils a condition."""
    while True:
        content = await asyncio.wait_for(page.recv(), PATIENCE)
        if isinstance(content, str):
            message = json.loads(content)
            if wanted(message):
                return message


def test_inputs_come_back_in_frames_many_times_a_second(live):
    """A page that acknowledges every frame gets one after the other, and among them one that has what it wanted."""
    _, viewing = live

    async def talk():
        frames, came_back = 0, False
        async with connected(viewing) as page:
            await page.send('{"type": "take", "on": 1}')
            while frames < 30 or not came_back:
                content = await asyncio.wait_for(page.recv(), PATIENCE)
                if not isinstance(content, bytes) or struct.unpack_from("<I", content)[0] != FRAME:
                    continue
                frames += 1
                await page.send(json.dumps({"type": "shown", "frame": struct.unpack_from("<I", content, 4)[0]}))
                await page.send('{"type": "drive", "values": [0, 1.5]}')
                came_back |= struct.unpack_from("<f", content, len(content) - 4)[0] == 1.5

    asyncio.run(asyncio.wait_for(talk(), PATIENCE))


def test_pages_of_different_pace_get_the_same_samples(live):
    """One acknowledges every frame at once, the other late: both have every moment of the same regular times, with the same numbers."""
    session, viewing = live
    session.command("reset")
    session.command("run")
    cart.until(lambda: session.mode == "running")

    async def watch(delay, enough):
        rows, frames = [], 0
        async with connected(viewing) as page:
            while frames < enough or not rows or rows[-1][-1, 0] < 1.5:
                content = await asyncio.wait_for(page.recv(), PATIENCE)
                kind = struct.unpack_from("<I", content)[0] if isinstance(content, bytes) else 0
                if kind == SAMPLES:
                    width = struct.unpack_from("<I", content, 4)[0]
                    rows.append(np.frombuffer(content, "<f8", offset=8).reshape(-1, width))
                elif kind == FRAME:
                    frames += 1
                    await asyncio.sleep(delay)
                    await page.send(json.dumps({"type": "shown", "frame": struct.unpack_from("<I", content, 4)[0]}))
        return np.concatenate(rows)

    async def both():
        return await asyncio.wait_for(asyncio.gather(watch(0.0, 13), watch(0.25, 3)), PATIENCE)

    session.operate([1.0, 1.0])
    quick, slow = asyncio.run(both())
    spacing = session.pace.every * session.pace.tick
    for rows in (quick, slow):
        np.testing.assert_allclose(np.diff(rows[:, 0]), spacing, rtol=1e-6)
    last = min(quick[-1, 0], slow[-1, 0])
    assert slow[0, 0] == quick[0, 0]
    np.testing.assert_array_equal(quick[quick[:, 0] <= last], slow[slow[:, 0] <= last])
    assert np.ptp(quick[:, 1]) > 0.0  # the gauge of its speed


def test_one_page_operates_and_another_may_not(live):
    session, viewing = live

    async def talk():
        async with connected(viewing) as first, connected(viewing) as second:
            await statuses(first, lambda m: m["type"] == "status" and m["driver"] == "nobody")
            await first.send('{"type": "take", "on": 1}')
            await statuses(first, lambda m: m["type"] == "status" and m["driver"] == "you")
            await second.send('{"type": "take", "on": 1}')
            note = await statuses(second, lambda m: m["type"] == "note")
            await second.send('{"type": "command", "word": "pause", "number": 0}')
            refused = await statuses(second, lambda m: m["type"] == "note")
            await second.send('{"type": "drive", "values": [1, 1]}')
            await first.send('{"type": "drive", "values": [0, 2]}')
            while session.live.target[:2].tolist() != [0.0, 2.0]:
                await asyncio.wait_for(first.recv(), PATIENCE)
            targets = session.live.target[:2].tolist()
            await first.send('{"type": "take", "on": 0}')
            await second.send('{"type": "take", "on": 1}')
            await statuses(second, lambda m: m["type"] == "status" and m["driver"] == "you")
            return note["text"], refused["text"], targets

    note, refused, targets = asyncio.run(talk())
    assert note == "another person operates the machine"
    assert refused == "take the controls first"
    assert targets == [0.0, 2.0]
    assert session.mode == "running"


@pytest.mark.parametrize("frames", [20, pytest.param(300, marks=pytest.mark.full)])
def test_twenty_watchers_of_whom_four_stop_reading_change_nothing_for_the_operator(live, frames):
    """Who reads nothing holds nobody up: sixteen watchers and the operator get frame after frame, the operator's wish among them."""
    session, viewing = live
    session.command("run")

    async def next_frame(page):
        """Acknowledged, as the page does."""
        while True:
            content = await page.recv()
            if isinstance(content, bytes) and struct.unpack_from("<I", content)[0] == FRAME:
                await page.send(json.dumps({"type": "shown", "frame": struct.unpack_from("<I", content, 4)[0]}))
                return content

    async def watch(page):
        for _ in range(frames // 2):
            await next_frame(page)

    async def drive(page):
        await page.send('{"type": "take", "on": 1}')
        seen, back = 0, 0
        while seen < frames or not back:
            await page.send('{"type": "drive", "values": [0, 0.75]}')
            content = await next_frame(page)
            seen, back = seen + 1, back + (struct.unpack_from("<f", content, len(content) - 4)[0] == 0.75)

    async def talk():
        async with AsyncExitStack() as stack:
            pages = [await stack.enter_async_context(connected(viewing)) for _ in range(20)]
            for page in pages[:4]:
                page.transport.pause_reading()
            operator = await stack.enter_async_context(connected(viewing))
            await asyncio.gather(drive(operator), *(watch(page) for page in pages[4:]))
            open_now = len(viewing.streams)
            for page in pages[:4]:
                page.transport.resume_reading()
            return open_now

    assert asyncio.run(asyncio.wait_for(talk(), PATIENCE)) == 21
    assert session.mode == "running"


def nonsense(random_numbers):
    """A message that is none: bytes, broken JSON, records with wrong parts, names that look like paths."""
    while understood(message := anything(random_numbers)):
        pass
    return message


def understood(message):
    try:
        read_message(message)
    except NotUnderstoodError:
        return False
    return True


def anything(random_numbers):
    pick = random_numbers.randrange(6)
    if pick == 0:
        return random_numbers.randbytes(random_numbers.randrange(60))
    if pick == 1:
        return "".join(chr(random_numbers.randrange(32, 1000)) for _ in range(random_numbers.randrange(60)))
    kind = random_numbers.choice(["drive", "take", "command", "want", "move", "reset", "shown", "x", None, 7])
    values = [None, True, -1, 1e999, "../../etc/passwd", "__import__('os')", [1] * 70, ["a"], {"a": []}, [[[]]]]
    keys = random_numbers.sample(["values", "on", "word", "number", "coordinate", "value", "request"], 2)
    return json.dumps({"type": kind, **{key: random_numbers.choice(values) for key in keys}})


@pytest.mark.parametrize("count", [5_000, pytest.param(100_000, marks=pytest.mark.full)])
def test_random_messages_are_dropped_and_counted(live, count):
    session, viewing = live
    numbers = random.Random(count)

    async def talk():
        async with connected(viewing) as page:
            for _ in range(count):
                await page.send(nonsense(numbers))
            return (await statuses(page, lambda m: m["type"] == "status" and m["dropped"] >= count))["dropped"]

    ticks = int(session.live.control[DONE])
    assert asyncio.run(talk()) == count
    cart.until(lambda: int(session.live.control[DONE]) > ticks)
    assert session.mode == "running"
    cart.until(lambda: session.values() == {"lever": 0.0, "brake": 1.0}, "inputs at rest")


def test_places_of_datagrams_are_looked_up_at_once():
    assert place_of("localhost:9000", "udp") == ("127.0.0.1", 9000)
    assert place_of("9001", "udp") == ("127.0.0.1", 9001)
    with pytest.raises(ModelError, match="HOST:PORT was expected"):
        place_of("127.0.0.1:x", "udp")
    with pytest.raises(ModelError, match="is no host that is known here"):
        place_of("no host:9000", "udp-to")


class Stub:
    """A session of two inputs without a solver, and a clock that is set."""

    def __init__(self):
        self.inputs = (None, None)
        self.facts = {"layout": frame_layout([], [], ["rail.displacement"], [], [])}
        self.newest = None
        self.heard = []
        self.now = 100.0

    def operate(self, values):
        self.heard.append(values)

    @contextmanager
    def datagrams(self):
        with closing(Datagrams(self, None, None, clock=lambda: self.now)) as outside:
            yield outside


HONEST, STRANGER = ("127.0.0.1", 1), ("127.0.0.1", 2)


def test_a_second_of_garbage_does_not_make_an_honest_sender_unheard():
    """100 000 malformed datagrams within a second, from its own address and from another: every honest one between them is taken."""
    stub = Stub()
    with stub.datagrams() as outside:
        for k in range(100):
            stub.now += 0.01
            for n in range(1000):
                outside.take(b"x", STRANGER if n % 2 else HONEST)
            outside.take(packed_inputs([0.5, 0.5], k + 1, 0), HONEST)
        assert outside.counts == Counts(taken=100, malformed=100_000)
        assert stub.heard == [[0.5, 0.5]] * 100


def test_too_many_datagrams_of_a_sender_charge_it_alone_and_only_while_they_come():
    """Of 20 000 in no time a sender has 4096 taken. A hundredth of a second later it has earned forty more, as if it had never sent them;
    after the watchdog's silence another one is heard at once."""
    stub = Stub()
    with stub.datagrams() as outside:
        for k in range(20_000):
            outside.take(packed_inputs([0.0, 0.0], k + 1, 0), STRANGER)
        assert (outside.counts.taken, outside.counts.excessive) == (4096, 20_000 - 4096)
        stub.now += 0.01
        for k in range(100):
            outside.take(packed_inputs([0.0, 0.0], 30_000 + k, 0), STRANGER)
        assert outside.counts.taken == 4096 + 40
        stub.now += SILENCE
        outside.take(packed_inputs([1.0, 1.0], 1, 0), HONEST)
        assert stub.heard[-1] == [1.0, 1.0]


def test_a_datagram_far_ahead_makes_its_sender_unheard_for_the_silence_of_the_watchdog_at_most():
    """One with a sequence 2³¹ - 1 ahead, then one each hundredth of a second as before: those within the silence are stale, not more."""
    stub = Stub()
    with stub.datagrams() as outside:
        outside.take(packed_inputs([0.0, 0.0], 1, 0), HONEST)
        outside.take(packed_inputs([0.0, 0.0], 2**31, 0), HONEST)
        taken = []
        for k in range(200):
            stub.now += 0.01
            outside.take(packed_inputs([1.0, 0.0], k + 2, 0), HONEST)
            taken.append(outside.counts.taken == 2 + len(taken) + 1 - outside.counts.stale)
        assert all(taken)
        assert outside.counts.stale == pytest.approx(SILENCE / 0.01, abs=1)
        assert outside.counts.taken == 202 - outside.counts.stale


def test_a_sender_that_was_started_again_is_taken_after_the_silence_of_the_watchdog():
    """From sequence 0 on, from its old port or a new one. Before, a stranger is not heard while the first one is."""
    for place in (HONEST, STRANGER):
        stub = Stub()
        with stub.datagrams() as outside:
            outside.take(packed_inputs([1.0, 0.0], 1000, 0), HONEST)
            stub.now += 0.9 * SILENCE
            assert outside.is_driving
            outside.take(packed_inputs([0.0, 0.0], 0, 0), place)
            assert stub.heard == [[1.0, 0.0]]
            assert outside.counts.stale + outside.counts.others == 1
            stub.now += 0.2 * SILENCE
            assert not outside.is_driving
            outside.take(packed_inputs([0.25, 0.0], 0, 0), place)
            outside.take(packed_inputs([0.5, 0.0], 1, 0), place)
            assert stub.heard == [[1.0, 0.0], [0.25, 0.0], [0.5, 0.0]]


def test_an_honest_sender_is_heard_while_another_sends_garbage(live):
    """Through real sockets, while a thread sends as fast as it can."""
    session, _ = live
    outside = Datagrams(session, ("127.0.0.1", 0), None)
    stop = threading.Event()

    def flood():
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            while not stop.is_set():
                sender.sendto(b"x", outside.address)

    thread = threading.Thread(target=flood)
    thread.start()
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            sequence = count(1)

            def is_heard():
                sender.sendto(packed_inputs([0.25, 0.5], next(sequence), 0), outside.address)
                return outside.counts.taken > 5 and outside.counts.malformed > 1000

            cart.until(is_heard, "an honest sender")
    finally:
        stop.set()
        thread.join()
        outside.close()
    assert outside.counts.excessive == 0


class Program:
    """Drives a machine as long as a test says so."""

    is_driving = True


def test_a_page_can_only_watch_while_a_program_drives():
    """Not one of its commands is done, and each is answered in words; when the program is silent, the machine can be paused and reset."""
    program = Program()
    with cart.running() as session, served(LiveSource(session, program)) as viewing:
        session.command("run")

        async def refusal(page, word):
            await page.send(json.dumps({"type": "command", "word": word, "number": 0.1}))
            return (await statuses(page, lambda m: m["type"] == "note"))["text"]

        async def talk():
            async with connected(viewing) as page:
                status = await statuses(page, lambda m: m["type"] == "status")
                words = ("reset", "pause", "restore", "save", "step", "speed", "run")
                refused = [await refusal(page, word) for word in words]
                await page.send('{"type": "take", "on": 1}')
                refused.append((await statuses(page, lambda m: m["type"] == "note"))["text"])
                await page.send('{"type": "drive", "values": [1, 2]}')
                await page.send('{"type": "hold", "body": 0, "point": [0, 0, 0], "towards": [1, 0, 0], "on": 1}')
                untouched = session.mode, session.speed, int(session.live.control[DONE]) > 0
                program.is_driving = False
                free = await statuses(page, lambda m: m["type"] == "status" and not m["watches"])
                await page.send('{"type": "command", "word": "pause", "number": 0}')
                await statuses(page, lambda m: m["type"] == "status" and m["mode"] == "paused")
                await page.send('{"type": "command", "word": "reset", "number": 0}')
                while int(session.live.control[DONE]):
                    await asyncio.wait_for(page.recv(), PATIENCE)
                await page.send('{"type": "take", "on": 1}')
                taken = await statuses(page, lambda m: m["type"] == "note")
                return status, refused, untouched, free, taken["text"]

        status, refused, untouched, free, taken = asyncio.run(talk())
        assert session.live.target[:2].tolist() == [0.0, 1.0]
        assert not session.live.target[2:].any()
    assert (status["driver"], status["watches"]) == ("program", ONLY_WATCH)
    assert refused == [ONLY_WATCH] * 8
    assert untouched == ("running", 1.0, True)
    assert free["driver"] == "program"
    assert "come by datagrams" in taken


def test_a_page_without_the_token_is_not_let_in(live):
    session, _ = live

    async def talk(viewing, query):
        port = viewing.address.port
        address = f"ws://127.0.0.1:{port}/stream{query}"
        async with websockets.connect(address, origin=f"http://127.0.0.1:{port}", max_size=None, proxy=None) as page:
            return await statuses(page, lambda m: m["type"] == "status")

    with served(LiveSource(session), Address("127.0.0.1", 0, "secret")) as viewing:
        for query in ("", "?token=", "?token=secre"):
            with pytest.raises(websockets.exceptions.InvalidStatus):
                asyncio.run(talk(viewing, query))
        assert asyncio.run(talk(viewing, "?token=secret"))["driver"] == "nobody"


def test_datagrams_operate_the_machine_and_bad_ones_are_counted(live):
    session, _ = live
    # no time passes, so that nobody is taken for silent
    outside = Datagrams(session, ("127.0.0.1", 0), None, clock=lambda: 0.0)
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            for k in range(40):
                sender.sendto(packed_inputs([-0.5, 0.5], k + 1, time.monotonic_ns()), outside.address)
                time.sleep(0.01)
            cart.until(lambda: session.live.target[:2].tolist() == [-0.5, 0.5])
            for bad in (b"", b"NVLI", packed_inputs([1.0], 99, 0), packed_inputs([np.nan, 0.0], 99, 0), b"X" * 40):
                sender.sendto(bad, outside.address)
            sender.sendto(packed_inputs([1.0, 1.0], 3, 0), outside.address)
            cart.until(lambda: outside.counts.stale == 1)
    finally:
        outside.close()
    assert outside.counts == Counts(taken=40, malformed=5, stale=1)
    assert session.live.target[:2].tolist() == [-0.5, 0.5]
