"""Show a source in the user's browser until the user has enough."""

from __future__ import annotations

import asyncio
import webbrowser
from collections.abc import Callable

from nivel.view.server import LOOPBACK, Address, show
from nivel.view.sources import Source


def serve(source: Source, *, host: str, port: int, browser: bool, say: Callable[[str], None]) -> None:
    """Listen and, with `browser`, open the page; returns after Ctrl-C. `say` gets sentences for the user.

    Raises ModelError where the address cannot be used.
    """

    def ready(address: Address) -> None:
        say(f"viewer: {address.url} (Ctrl-C ends it)")
        if host not in LOOPBACK:
            say(f"others reach it at {address.others_url}; the token in it lets them in")
        if browser and not webbrowser.open(address.url):
            say("no browser could be opened here: open the address yourself")

    try:
        asyncio.run(show(source, Address.of(host, port), ready))
    except KeyboardInterrupt:
        say("viewer ended")
