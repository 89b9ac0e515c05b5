"""Processes with a time limit; only those that were started here are ended."""
import os
import pathlib
import subprocess
import sys
import threading
import time

MACHINES = {"almec": "netduinoplus2", "mps2-an386": "mps2-an386", "mps2-an500": "mps2-an500"}


def skip_without(*programs):
    """Ends the test as skipped where a build is missing; as failed where the environment says that all must be there."""
    missing = [str(p) for p in programs if not pathlib.Path(p).is_file()]
    if missing:
        print("not built: " + ", ".join(missing))
        sys.exit(1 if os.environ.get("MOREPRO_REQUIRE_TARGETS") else 77)


def qemu(board, image, serial="null", arguments=(), extra=()):
    """Command line that runs `image` on `board`; `arguments` reach it by semihosting."""
    config = "enable=on,target=native" + "".join(f",arg={a}" for a in (image, *arguments))
    return ["qemu-system-arm", "-M", MACHINES[board], "-display", "none", "-monitor", "none", "-serial", serial,
            "-semihosting-config", config, *extra, "-kernel", str(image)]


def run(command, timeout_s):
    """(exit status, what it printed, seconds); a process that takes longer is ended and raises TimeoutExpired."""
    start = time.monotonic()
    done = subprocess.run([str(c) for c in command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=timeout_s)
    return done.returncode, done.stdout.decode(errors="replace"), time.monotonic() - start


class Line:
    """A process whose standard input and output are a serial line. Use it in a with statement."""

    def __init__(self, command, timeout_s):
        self._process = subprocess.Popen([str(c) for c in command], stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0)
        self._guard = threading.Timer(timeout_s, self._process.kill)
        self._guard.start()
        self._left = b""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._guard.cancel()
        self._process.kill()
        self._process.wait()

    def in_background(self, job):
        """For what sends: the peer may hold the line until its answers are read."""
        threading.Thread(target=job, daemon=True).start()

    def send(self, data):
        try:
            for at in range(0, len(data), 4096):
                self._process.stdin.write(data[at:at + 4096])
        except (BrokenPipeError, OSError):
            pass

    def record(self):
        """The next record's bytes without the delimiter; EOFError when the process is gone or was ended."""
        while b"\0" not in self._left:
            more = self._process.stdout.read(65536)
            if not more:
                raise EOFError("the line went dead")
            self._left += more
        part, self._left = self._left.split(b"\0", 1)
        return part
