# SPDX-License-Identifier: BSD-3-Clause
"""A virtual display of its own with the real ParaView window on it, which is worked with mouse and keys (xdotool)."""
import os
import subprocess
import time


class Screen:
    """A display of `width` x `height` pixels, with a home folder that is nobody's; to be used by `with`."""

    def __init__(self, width, height, home):
        self.size = (width, height)
        self.window = None
        reading, writing = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-noreset", "-nolisten", "tcp",
                                        "-screen", "0", f"{width}x{height}x24"],
                                       pass_fds=[writing], stderr=subprocess.DEVNULL)
        os.close(writing)
        with os.fdopen(reading) as number:
            self.display = ":" + number.readline().strip()
        self.environment = dict(os.environ, DISPLAY=self.display, HOME=home,
                                XDG_CONFIG_HOME=os.path.join(home, ".config"))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in (self.window, self.server):
            if process:
                process.kill()
                process.wait()

    def open_window(self, executable, *arguments, log=subprocess.DEVNULL, **environment):
        """Starts ParaView, as large as the screen, without settings of the user's and without a welcome."""
        width, height = self.size
        self.window = subprocess.Popen([executable, "--dr", "-geometry", f"{width}x{height}+0+0", *arguments],
                                       env={**self.environment, **environment}, stdout=log, stderr=log)

    def do(self, *words):
        """Passes commands to xdotool: do("key", "Return"), do("mousemove", 10, 20, "click", 1)."""
        subprocess.run(["xdotool", *map(str, words)], env=self.environment, check=True)

    def click_along(self, y, start, end, step=8):
        """Clicks one place after the other along a line."""
        self.do(*(word for x in range(start, end, step) for word in ("mousemove", x, y, "click", 1)))

    def wait_for(self, note, seconds=120):
        """Waits until a file is there; returns what it says, or None if the time or the window is over."""
        until = time.time() + seconds
        while time.time() < until:
            if os.path.exists(note):
                with open(note, encoding="utf-8") as file:
                    return file.read()
            if self.window.poll() is not None:
                return None
            time.sleep(0.2)
        return None
