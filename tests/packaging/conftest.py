"""What the tests share. TANGLEBIN_BUILD, TANGLEBIN_SOURCE and TANGLEBIN_PROGRAM say where everything is."""

import os
import re
import subprocess
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def build():
    return Path(os.environ["TANGLEBIN_BUILD"])


@pytest.fixture(scope="session")
def source():
    return Path(os.environ["TANGLEBIN_SOURCE"])


def options_in(text):
    return re.findall(r"^  (?:-\w,)?(--[\w-]+)", text, re.MULTILINE)


@pytest.fixture(scope="session")
def options():
    """Each command's options, as its --help has them; those of the program itself under the name ""."""

    def help_of(*command):
        return subprocess.run([os.environ["TANGLEBIN_PROGRAM"], *command, "--help"], check=True, capture_output=True, text=True).stdout

    commands = re.findall(r"^  (\w+)", help_of().partition("Subcommands:")[2], re.MULTILINE)
    assert "generate" in commands
    return {"": options_in(help_of()), **{command: options_in(help_of(command)) for command in commands}}
