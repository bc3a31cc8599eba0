"""A server for the page: on this machine only, or for others with a token. It gives out what it holds and writes nothing.

It answers two addresses: `/`, the page, and `/stream`, the connection of the page. Pages of other origins are refused, and so are
names of this machine that are not its own (rebound ones), connections without the token, long or many messages, and many pages.
"""

from __future__ import annotations

import asyncio
import errno
import hmac
import os
import secrets
import socket
import webbrowser
from collections.abc import Awaitable, Callable
from contextlib import suppress
from http import HTTPStatus
from typing import TYPE_CHECKING, Any, Final
from urllib.parse import parse_qs, urlsplit

from nivel.errors import ModelError
from nivel.lazy import Struct, field, websockets
from nivel.view.page import script_hash, served_page
from nivel.view.sources import Source
from nivel.view.stream import LARGEST, REFUSED, Stream

if TYPE_CHECKING:
    from websockets.asyncio.server import Server, ServerConnection
    from websockets.http11 import Request, Response


LOOPBACK: Final = ("127.0.0.1", "localhost", "::1")
OWN: Final = {"0.0.0.0": "127.0.0.1", "::": "::1"}  # of all addresses of a machine the one that it has for itself
MOST_PAGES: Final = 32
HANDSHAKE: Final = 5.0  # seconds that a connection may take to say what it wants
PORTS: Final = range(8640, 8660)  # tried in their order


class Address(Struct, frozen=False):
    """Where the server listens. port : 0 for a free one. token : needed in the address of the page, or empty."""

    host: str = "127.0.0.1"
    port: int = 0
    token: str = ""

    @classmethod
    def of(cls, host: str, port: int) -> Address:
        """With a new token where others than this machine can reach it."""
        return cls(host, port, "" if host in LOOPBACK else secrets.token_urlsafe(24))

    @property
    def url(self) -> str:
        """To be opened in a browser of this machine; `0.0.0.0` and `::` are no addresses to open."""
        return self._at(OWN.get(self.host, self.host))

    @property
    def others_url(self) -> str:
        """To be opened in a browser of another machine."""
        return self._at(_outside(self.host) if self.host in OWN else self.host)

    def _at(self, host: str) -> str:
        host = f"[{host}]" if ":" in host else host
        return f"http://{host}:{self.port}/" + (f"?token={self.token}" if self.token else "")


class Viewing(Struct, frozen=False):
    """A server and the pages connected to it."""

    source: Source
    address: Address
    streams: set[Stream] = field(default_factory=set)

    async def talk(self, connection: ServerConnection) -> None:
        """One page, as long as it stays."""
        if len(self.streams) >= MOST_PAGES:
            await connection.close(REFUSED, "too many pages")
            return
        stream = Stream(connection, self.source)
        self.streams.add(stream)
        try:
            await stream.run()
        except* websockets.exceptions.ConnectionClosed:
            pass
        finally:
            self.streams.discard(stream)

    def answer(self, connection: ServerConnection, request: Request) -> Response | None:
        """The page, or a refusal; None lets a page in."""
        try:
            parts = urlsplit(request.path)
        except ValueError:  # `//[` begins an address that is none
            return _respond(connection, HTTPStatus.BAD_REQUEST, "This is no address.")
        # websockets before 16 refuses all but GET by itself, and does not say which it was
        if getattr(request, "method", "GET") != "GET":
            return _respond(connection, HTTPStatus.METHOD_NOT_ALLOWED, "Only GET is answered.")
        if not self._is_own_name(request.headers.get_all("Host")) or not self._has_token(parts.query):
            return _respond(connection, HTTPStatus.FORBIDDEN, "Forbidden: open the address that `nivel view` printed.")
        if parts.path == "/stream":
            own = request.headers.get_all("Origin") == [f"http://{request.headers['Host']}"]
            return None if own else _respond(connection, HTTPStatus.FORBIDDEN, "Forbidden.")
        if parts.path != "/":
            return _respond(connection, HTTPStatus.NOT_FOUND, "There is nothing here.")
        return _respond(connection, HTTPStatus.OK, served_page(), page=True)

    def _is_own_name(self, hosts: list[str]) -> bool:
        if len(hosts) != 1:
            return False
        if self.address.token:
            return True
        try:
            return urlsplit(f"//{hosts[0]}").hostname in LOOPBACK
        except ValueError:  # `[` is no name of a host
            return False

    def _has_token(self, query: str) -> bool:
        if not self.address.token:
            return True
        given = parse_qs(query).get("token", [""])[0]
        return hmac.compare_digest(given.encode(), self.address.token.encode())

    def has_news(self) -> None:
        """All pages are to get a frame."""
        for stream in self.streams:
            stream.has_news()


def _outside(everywhere: str) -> str:
    """The address that others know this machine by, or its name where that is not known; asks nobody."""
    family, unused = (socket.AF_INET6, "2001:db8::1") if ":" in everywhere else (socket.AF_INET, "192.0.2.1")
    try:
        with socket.socket(family, socket.SOCK_DGRAM) as probe:
            probe.connect((unused, 9))  # sends nothing: only the way there is looked up
            return str(probe.getsockname()[0])
    except OSError:
        return socket.gethostname()


def _respond(connection: ServerConnection, status: HTTPStatus, text: str, *, page: bool = False) -> Response:
    response = connection.respond(status, text)
    headers = response.headers
    if page:
        del headers["Content-Type"]
        headers["Content-Type"] = "text/html; charset=utf-8"
        headers["Content-Security-Policy"] = (
            f"default-src 'none'; script-src {script_hash()}; style-src 'unsafe-inline'; img-src data: blob:; connect-src 'self'; "
            "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
        )
    if status is HTTPStatus.METHOD_NOT_ALLOWED:
        headers["Allow"] = "GET"
    headers["X-Content-Type-Options"] = "nosniff"
    headers["Referrer-Policy"] = "no-referrer"
    headers["Cache-Control"] = "no-store"
    return response


async def start(viewing: Viewing) -> Server:
    """Listen; the address gets the port that was found.

    Raises ModelError where the port is taken.
    """
    loop = asyncio.get_running_loop()

    def changed() -> None:
        with suppress(RuntimeError):  # the server has ended, what it showed goes on
            loop.call_soon_threadsafe(viewing.has_news)

    viewing.source.on_change = changed
    address = viewing.address
    ports = [address.port] if address.port else [*PORTS, 0]
    problem = OSError("no port is free")
    for port in ports:
        try:
            server = await websockets.asyncio.server.serve(
                viewing.talk,
                address.host,
                port,
                process_request=viewing.answer,
                compression=None,
                max_size=LARGEST,
                max_queue=16,
                open_timeout=HANDSHAKE,
                close_timeout=1.0,
                server_header=None,
                logger=_quiet(),
            )
        except OSError as error:
            problem = error
            continue
        address.port = next(iter(server.sockets)).getsockname()[1]
        return server
    raise ModelError(_refusal(address, problem))


def _quiet() -> Any:
    """A logger that says nothing: whatever strangers send is no news."""
    import logging

    logger = logging.getLogger("nivel.view.server")
    logger.disabled = True
    return logger


def _refusal(address: Address, problem: OSError) -> str:
    # what asyncio says of a port repeats the address: the system's own words are shorter
    is_known = problem.errno is not None and not isinstance(problem, socket.gaierror)
    reason = (os.strerror(problem.errno or 0) if is_known else problem.strerror or str(problem)).lower()
    if problem.errno == errno.EADDRINUSE:
        return f"port {address.port} of {address.host} is used by another program; choose another with --port, or none for a free one"
    if problem.errno == errno.EACCES:
        return f"port {address.port} of {address.host} may not be used: {reason}; choose one from 1024 on with --port"
    return f"{address.host} is no address that this machine can listen at: {reason}; choose another with --host"


async def show(source: Source, address: Address, ready: Callable[[Address], None]) -> None:
    """Show `source` until cancelled; `ready` gets the address with its port."""
    viewing = Viewing(source, address)
    server = await start(viewing)
    async with server:
        ready(address)
        await server.serve_forever()


class Stop:
    """Ends what is served, from another thread or a handler of signals. is_asked : it was asked to. has_ended : nothing is served any
    more."""

    def __init__(self) -> None:
        self.is_asked = self.has_ended = False
        self._end: Callable[[], object] | None = None

    @property
    def can_be_asked(self) -> bool:
        """Whether something is served now that it can end."""
        return self._end is not None

    def ask(self) -> None:
        """End it; also what is served only later."""
        self.is_asked = True
        if self._end is not None:
            with suppress(RuntimeError):  # it has ended just now
                self._end()

    async def around(self, served: Awaitable[None]) -> None:
        """What is served, until it is asked to end."""
        loop, task = asyncio.get_running_loop(), asyncio.ensure_future(served)
        self._end = lambda: loop.call_soon_threadsafe(task.cancel)
        if self.is_asked:
            task.cancel()
        try:
            await task
        except asyncio.CancelledError:
            if not self.is_asked:
                raise
        finally:
            self._end, self.has_ended = None, True


def serve(
    source: Source, *, host: str, port: int, browser: bool, say: Callable[[str], None], stop: Stop | None = None
) -> None:
    """Listen and, with `browser`, open the page; returns after Ctrl-C, or when `stop` is asked. `say` gets sentences for the user.

    Raises ModelError where the address cannot be used.
    """

    def ready(address: Address) -> None:
        say(f"viewer: {address.url} (Ctrl-C ends it)")
        if host not in LOOPBACK:
            say(f"others reach it at {address.others_url}; the token in it lets them in")
        if browser and not webbrowser.open(address.url):
            say("no browser could be opened here: open the address yourself")

    with suppress(KeyboardInterrupt):
        asyncio.run((stop or Stop()).around(show(source, Address.of(host, port), ready)))
    say("viewer ended")
