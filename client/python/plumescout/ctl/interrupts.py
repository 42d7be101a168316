# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Work that Ctrl-C ends, whatever it is at."""

import os
import select
import signal
import threading
from typing import Any

_DONE = b"\0"  # no signal has this number
_GRACE_S = 2.0  # to take away what is half done
_interrupted = threading.Event()


def sleep(seconds):
    """Of the work; an interrupt ends it."""
    _interrupted.wait(seconds)


def carry_out(work, stop, code):
    """Has work() done, and returns what it returns, or raises what it raises. Interrupted, it calls
    stop(), from another thread, and gives the work time to end; then it returns the code, or ends
    the program with it.

    The work has a thread of its own: an exception in the midst of gRPC's leaves locks taken, and
    calls that nobody ends, for which the end of the channel waits for ever."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        return work()
    news, teller = os.pipe()
    os.set_blocking(teller, False)
    outcome: list[tuple[Any, BaseException | None]] = []

    def run():
        try:
            outcome.append((work(), None))
        except BaseException as error:  # raised again where it is waited for
            outcome.append((None, error))
        os.write(teller, _DONE)

    # The number of a signal is written as it comes, by no code of Python's. The handler is there
    # lest the default one raises something.
    signal.set_wakeup_fd(teller, warn_on_full_buffer=False)
    signal.signal(signal.SIGINT, lambda *_: None)
    threading.Thread(target=run, daemon=True).start()
    if os.read(news, 1) != _DONE:
        _interrupted.set()
        threading.Thread(target=stop, daemon=True).start()
        if not select.select([news], [], [], _GRACE_S)[0] or os.read(news, 1) != _DONE:
            os._exit(code)  # what goes on would be waited for
        outcome = [(code, None)]
    signal.set_wakeup_fd(-1)
    signal.signal(signal.SIGINT, lambda *_: os._exit(code))
    result, error = outcome[0]
    if error is not None:
        raise error
    return result
