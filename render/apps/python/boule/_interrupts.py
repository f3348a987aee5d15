"""What Ctrl-C means to calls on other threads than the main one, which alone gets signals."""

from __future__ import annotations

import signal
import sys
import threading


def is_main():
    """Whether this is the main thread."""
    return threading.get_ident() == threading.main_thread().ident


def raises():
    """Whether a SIGINT becomes a KeyboardInterrupt. A handler of one's own decides for itself."""
    handler = signal.getsignal(signal.SIGINT)
    handler = getattr(handler, "func", handler)  # that of asyncio.run() is a partial
    of_asyncio = getattr(handler, "__module__", None) == "asyncio.runners"
    return handler is signal.default_int_handler or of_asyncio


def handled():
    """The KeyboardInterrupt that the main thread is handling, or None."""
    main = threading.main_thread()
    current = getattr(sys, "_current_exceptions", dict)().get(main.ident)  # from Python 3.10 on
    exception = current[1] if isinstance(current, tuple) else current  # a tuple before 3.12
    return exception if isinstance(exception, KeyboardInterrupt) else None


def has_ended_main():
    """Whether the main thread has ended by a KeyboardInterrupt, and waits for other threads."""
    frame = sys._current_frames().get(threading.main_thread().ident)
    while frame is not None and frame.f_back is not None:
        frame = frame.f_back
    waits = frame is not None and frame.f_code is threading._shutdown.__code__  # type: ignore
    return waits and isinstance(getattr(sys, "last_value", None), KeyboardInterrupt)
