"""Ctrl-C while a call runs."""

import os
import signal
import threading


class Interruption:
    """Sends this process SIGINT when `progress` is called for the first time, or after some seconds at the latest."""

    def __init__(self, at_the_latest=20):
        self.calls = 0
        self.timer = threading.Timer(at_the_latest, self.send)

    def send(self):
        os.kill(os.getpid(), signal.SIGINT)

    def progress(self, done, total):
        self.calls += 1
        if self.calls == 1:
            self.send()

    def __enter__(self):
        self.timer.start()
        return self

    def __exit__(self, *error):
        self.timer.cancel()
