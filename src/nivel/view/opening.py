"""Show a source in the user's browser until the user has enough."""

from __future__ import annotations

import asyncio
import webbrowser
from collections.abc import Awaitable, Callable
from contextlib import suppress

from nivel.view.server import LOOPBACK, Address, show
from nivel.view.sources import Source


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
