"""A shell completes every command and every option that --help lists."""

import os
import pty
import select
import shutil
import subprocess
import time
from pathlib import Path

import pytest

BASH_COMPLETION = Path("/usr/share/bash-completion/bash_completion")
# Calls the completion as bash does when the tab key is pressed at the end of the words given.
PRESS_TAB_IN_BASH = """
source "$1"; source "$2"; shift 2
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMP_LINE="$*" COMP_POINT=${#COMP_LINE}
_tanglebin
printf '%s\\n' "${COMPREPLY[@]}"
"""


@pytest.fixture
def manual(build):
    return build / "packaging" / "manual"


def completed_by_bash(manual, *words):
    if not BASH_COMPLETION.exists():
        pytest.skip("bash-completion is not installed")
    command = ["bash", "-c", PRESS_TAB_IN_BASH, "bash", BASH_COMPLETION, manual / "tanglebin.bash", "tanglebin", *words]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()


def test_bash_completes_every_command(manual, options):
    assert set(completed_by_bash(manual, "")) == {*filter(None, options), *options[""]}
    assert completed_by_bash(manual, "gen") == ["generate"]


def test_bash_completes_every_option(manual, options):
    for command in filter(None, options):
        assert completed_by_bash(manual, command, "--") == options[command]
    assert completed_by_bash(manual, "verify", "--rep") == ["--repair"]


def test_bash_completes_files(manual, tmp_path, monkeypatch):
    (tmp_path / "recipe.toml").touch()
    monkeypatch.chdir(tmp_path)
    assert completed_by_bash(manual, "generate", "rec") == ["recipe.toml"]
    assert completed_by_bash(manual, "generate", "recipe.toml", "--out", "rec") == ["recipe.toml"]


class Zsh:
    """A zsh at a terminal, in which the completion is installed."""

    def __init__(self, folder):
        process, self.terminal = pty.fork()
        if process == 0:
            os.environ.update(TERM="dumb", COLUMNS="200", LINES="500")
            os.execlp("zsh", "zsh", "-f", "-i")
        self.type(f"fpath=({folder} $fpath); autoload -U compinit; compinit -D -u; LISTMAX=10000; PS1=; stty -echo cols 200\n")

    def type(self, text):
        os.write(self.terminal, text.encode())

    def shown_until_all_of(self, expected):
        """What it shows, at the latest after a minute."""
        shown, end = "", time.monotonic() + 60
        while not all(text in shown for text in expected) and time.monotonic() < end:
            if select.select([self.terminal], [], [], 1)[0]:
                shown += os.read(self.terminal, 65536).decode(errors="replace")
        return shown

    def listed_for(self, line, expected):
        self.type(f"{line}\t")
        shown = self.shown_until_all_of(expected)
        self.type("\x15")  # an empty line again
        return shown

    def close(self):
        os.close(self.terminal)  # which hangs it up


@pytest.fixture
def zsh(manual, tmp_path):
    if not shutil.which("zsh"):
        pytest.skip("zsh is not installed")
    shutil.copy(manual / "tanglebin.zsh", tmp_path / "_tanglebin")
    shell = Zsh(tmp_path)
    yield shell
    shell.close()


def test_zsh_completes_every_command_and_option(zsh, options):
    commands = [f"{command} " for command in filter(None, options)]
    shown = zsh.listed_for("tanglebin ", commands)
    assert [command for command in commands if command not in shown] == []
    for command in filter(None, options):
        shown = zsh.listed_for(f"tanglebin {command} --", options[command])
        assert [option for option in options[command] if option not in shown] == []
