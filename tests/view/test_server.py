"""The server: only its own pages on this machine, or with the token; bounded; newest frame only, one on its way."""

import asyncio
import http.client
import json
import random
import socket
import struct
from urllib.parse import urlsplit

import numpy as np
import pytest
import websockets

import synthetic_run as pendulum
from browsing import served
from many_bodies import moment, stage
from nivel.errors import ModelError
from nivel.results import Memory
from nivel.view import stream
from nivel.view.package import Block
from nivel.view.records import COLUMN, FRAME, PACKAGE
from nivel.view.server import MOST_PAGES, Address, Viewing, start
from nivel.view.sources import Playback
from packages import Live
from patience import PATIENCE


def swinging():
    memory = Memory()
    memory.begin(pendulum.header())
    memory.take(pendulum.frames(np.linspace(0.0, 1.0, 101)))
    return memory.close({"outcome": "done"})


@pytest.fixture(scope="module")
def playing():
    with served(Playback([swinging()])) as viewing:
        yield viewing


def get(viewing, path="/", host=None, method="GET"):
    connection = http.client.HTTPConnection("127.0.0.1", viewing.address.port, timeout=PATIENCE)
    connection.request(method, path, headers={"Host": host or f"127.0.0.1:{viewing.address.port}"})
    answer = connection.getresponse()
    return answer, answer.read()


def connect(viewing, path="/stream", **headers):
    port = viewing.address.port
    origin = headers.pop("origin", f"http://127.0.0.1:{port}")
    return websockets.connect(
        f"ws://127.0.0.1:{port}{path}", origin=origin, additional_headers=headers, max_size=None, proxy=None
    )


def test_the_page_is_served_with_a_strict_policy(playing):
    answer, body = get(playing)
    assert answer.status == 200
    assert b"<script>" in body
    policy = answer.getheader("Content-Security-Policy")
    assert "default-src 'none'" in policy
    assert "unsafe-eval" not in policy
    assert "script-src 'sha256-" in policy
    assert answer.getheader("X-Content-Type-Options") == "nosniff"


@pytest.mark.parametrize("path", ["/other", "/../etc/passwd", "/viewer.js", "//", "/stream/x"])
def test_there_is_nothing_else(playing, path):
    assert get(playing, path)[0].status == 404


@pytest.mark.parametrize("path", ["//[", "//[::1", "//]", "//[x]/stream", "///[/stream"])
def test_an_address_that_is_none_is_refused_without_an_error(playing, path, caplog):
    assert get(playing, path)[0].status in (400, 404)
    assert not [record for record in caplog.records if record.exc_info]
    assert get(playing)[0].status == 200


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "OPTIONS", "HEAD"])
def test_nothing_but_get_is_answered(playing, method):
    answer, _ = get(playing, method=method)
    assert answer.status in (405, 400)  # 400: websockets before 16 refuses by itself
    if answer.status == 405:
        assert answer.getheader("Allow") == "GET"


@pytest.mark.parametrize("host", ["evil.example", "[", "evil.example:80", "127.0.0.1.evil.example"])
def test_other_names_of_this_machine_are_refused(playing, host):
    assert get(playing, host=host)[0].status == 403


@pytest.mark.parametrize("origin", ["http://evil.example", "null", None, "https://127.0.0.1:1", "http://127.0.0.1"])
def test_pages_of_other_origins_are_refused(playing, origin):
    async def attempt():
        async with connect(playing, origin=origin):
            pass

    with pytest.raises(websockets.InvalidStatus) as caught:
        asyncio.run(attempt())
    assert caught.value.response.status_code == 403


def test_a_token_is_needed_where_others_can_reach_the_server():
    assert Address.of("127.0.0.1", 0).token == Address.of("localhost", 0).token == ""
    address = Address.of("0.0.0.0", 0)
    assert len(address.token) >= 32
    with served(Playback([swinging()]), address) as viewing:
        assert viewing.address.url.endswith(f"?token={address.token}")
        assert get(viewing)[0].status == 403
        assert get(viewing, "/?token=wrong")[0].status == 403
        assert get(viewing, f"/?token={address.token}")[0].status == 200

        async def talk(query):
            async with connect(viewing, f"/stream{query}") as page:
                return await page.recv()

        with pytest.raises(websockets.InvalidStatus):
            asyncio.run(talk(""))
        assert asyncio.run(talk(f"?token={address.token}"))[:4] == struct.pack("<I", PACKAGE)


@pytest.mark.parametrize(("host", "own"), [("0.0.0.0", "127.0.0.1"), ("::", "[::1]"), ("192.168.7.1", "192.168.7.1")])
def test_the_address_that_is_said_can_be_opened(host, own):
    address = Address(host, 8640, "secret")
    assert address.url == f"http://{own}:8640/?token=secret"
    assert address.others_url.endswith(":8640/?token=secret")
    assert not address.others_url.startswith(("http://0.0.0.0", "http://[::]", "http://127.", "http://[::1]"))


def test_the_page_of_all_addresses_opens_at_this_machines_own():
    with served(Playback([swinging()]), Address.of("0.0.0.0", 0)) as viewing:
        parts = urlsplit(viewing.address.url)
        answer, _ = get(viewing, f"/?{parts.query}", host=parts.netloc)
        assert (parts.hostname, answer.status) == ("127.0.0.1", 200)


def test_columns_come_when_they_are_asked_for(playing):
    result = swinging()

    async def talk():
        async with connect(playing) as page:
            assert (await page.recv())[8:12] != b""
            await page.send(json.dumps({"type": "want", "request": 7, "stage": 0, "name": "hinge.angle"}))
            content = await page.recv()
            assert struct.unpack_from("<II", content) == (COLUMN, 7)
            np.testing.assert_allclose(np.frombuffer(content, "<f4", offset=12), result.array("hinge.angle"), rtol=1e-6)
            for stage_number, name in ((0, "hinge.angel"), (5, "hinge.angle"), (0, "position"), (0, "time" * 50)):
                await page.send(json.dumps({"type": "want", "request": 8, "stage": stage_number, "name": name}))
                answer = json.loads(await page.recv())
                assert (answer["type"], answer["request"]) == ("refused", 8)

    asyncio.run(talk())


def test_random_bytes_do_no_harm(playing):
    rng = random.Random(20031)
    for _ in range(40):
        with socket.create_connection(("127.0.0.1", playing.address.port), timeout=PATIENCE) as raw:
            raw.sendall(rng.randbytes(rng.randrange(1, 4000)))

    async def talk():
        for _ in range(40):
            async with connect(playing) as page:
                await page.recv()
                await page.send(rng.choice([rng.randbytes(200), rng.randbytes(30).hex(), "{" * 100]))
                with pytest.raises(websockets.ConnectionClosed) as caught:
                    await page.recv()
                assert caught.value.rcvd.code == 1008
        async with connect(playing) as page:
            await page.recv()
            await page.send("x" * 5000)
            with pytest.raises(websockets.ConnectionClosed) as caught:
                await page.recv()
            assert caught.value.rcvd.code == 1009

    asyncio.run(talk())
    assert get(playing)[0].status == 200


async def chatter(page):
    for _ in range(20_000):
        await page.send('{"type": "shown", "frame": 1}')
    await asyncio.wait_for(page.recv(), PATIENCE)


def test_too_many_messages_and_too_many_pages_are_refused(playing):
    async def talk():
        async with connect(playing) as page:
            await page.recv()
            with pytest.raises(websockets.ConnectionClosed):
                await chatter(page)
        pages = [await connect(playing) for _ in range(MOST_PAGES)]
        for page in pages:
            await page.recv()
        late = await connect(playing)
        with pytest.raises(websockets.ConnectionClosed):
            await late.recv()
        for page in pages:
            await page.close()

    asyncio.run(talk())


def test_a_slow_page_gets_the_newest_frame_and_never_two(monkeypatch):
    monkeypatch.setattr(stream, "PATIENCE", 10 * PATIENCE)  # nothing is given up for lost
    block = Block()
    live = Live(stage(block), block)

    async def talk(viewing):
        async with connect(viewing) as page:
            await page.recv()
            live.show(1.0, *moment(0.01))
            first = await asyncio.wait_for(page.recv(), PATIENCE)
            assert struct.unpack_from("<IId", first) == (FRAME, 1, 1.0)
            for k in range(2, 101):
                live.show(float(k), *moment(0.01 * k))
                await asyncio.sleep(0.002)
            with pytest.raises(TimeoutError):  # not acknowledged: nothing follows
                await asyncio.wait_for(page.recv(), 0.5)
            await page.send(json.dumps({"type": "shown", "frame": 1}))
            _, number, time = struct.unpack_from("<IId", await asyncio.wait_for(page.recv(), PATIENCE))
            assert (number, time) == (2, 100.0)  # what came in between is left out

    with served(live) as viewing:
        asyncio.run(talk(viewing))


def test_a_frame_that_nobody_acknowledges_is_given_up_after_a_while():
    block = Block()
    live = Live(stage(block), block)
    live.show(0.0, *moment(0.0))

    async def talk(viewing):
        async with connect(viewing) as page:
            await page.recv()
            await page.recv()
            live.show(1.0, *moment(1.0))
            _, number, _ = struct.unpack_from("<IId", await asyncio.wait_for(page.recv(), PATIENCE))
            assert number == 2

    with served(live) as viewing:
        asyncio.run(talk(viewing))


def test_ports_and_addresses_that_cannot_be_used_are_said():
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(
            ModelError, match=f"^port {port} of 127.0.0.1 is used by another program; choose another with --port"
        ):
            asyncio.run(start(Viewing(Playback([swinging()]), Address("127.0.0.1", port))))
    with pytest.raises(ModelError, match="no address that this machine can listen at"):
        asyncio.run(start(Viewing(Playback([swinging()]), Address("192.0.2.1", 0, "token"))))


def test_what_goes_on_when_the_server_has_ended_is_not_disturbed():
    block = Block()
    live = Live(stage(block), block)
    with served(live):
        live.show(0.0, *moment(0.0))
    live.show(1.0, *moment(1.0))
    assert live.frame()[0] == 1.0
