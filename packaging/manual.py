#!/usr/bin/env python3
"""Writes the manual pages, and the completions for bash and zsh, from what the program's --help says.

    manual.py PROGRAM FOLDER

FOLDER gets tanglebin.1, a page for each command such as tanglebin-scan.1, and tanglebin.bash and tanglebin.zsh.
"""

import gzip
import re
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

DESCRIPTION_COLUMN = 30
RECIPES = "/usr/share/tanglebin/recipes"
DOCUMENTS = "/usr/share/doc/tanglebin"


class Entry(NamedTuple):
    """A line of --help: an option, a positional argument or a command."""

    name: str
    value: str  # what follows the name, such as "FLOAT=600"; empty for a flag
    description: str


class Help(NamedTuple):
    description: str
    usage: str
    sections: dict  # "Options", "Positionals", "Subcommands": entries
    footer: list  # lines


def entry_of(left, description):
    name, _, value = left.strip().partition(" ")
    return Entry(name.rpartition(",")[2], value, description.strip())


def entries_of(lines):
    """Takes the entries at the begin of lines, and leaves the rest."""
    entries = []
    while lines and lines[0].startswith("  "):
        line = lines.pop(0)
        if lines and lines[0].startswith(" " * DESCRIPTION_COLUMN):  # no room beside the name
            entries.append(entry_of(line, lines.pop(0)))
        else:
            entries.append(entry_of(line[:DESCRIPTION_COLUMN], line[DESCRIPTION_COLUMN:]))
    return entries


def parsed(text):
    lines = text.splitlines()
    description, usage = lines.pop(0), lines.pop(0).removeprefix("Usage: ")
    sections = {}
    while len(lines) > 1 and re.fullmatch(r"\w+:", lines[1]) and not lines[0]:
        title = lines[1].rstrip(":")
        del lines[:2]
        sections[title] = entries_of(lines)
    return Help(description, usage, sections, lines)


def read_help(program, *command):
    return parsed(subprocess.run([program, *command, "--help"], check=True, capture_output=True, text=True).stdout)


def roff(text):
    text = re.sub(r"\bdocs/", DOCUMENTS + "/", text).replace("\\", r"\e")
    for character, escape in {"-": r"\-", "'": r"\(aq", "`": r"\(ga", "^": r"\(ha", "~": r"\(ti"}.items():
        text = text.replace(character, escape)
    return r"\&" + text if text.startswith(".") else text


def list_of(entries):
    lines = []
    for entry in entries:
        value = rf" \fI{roff(entry.value)}\fR" if entry.value else ""
        lines += [".TP", rf"\fB{roff(entry.name)}\fR{value}", roff(entry.description)]
    return lines


def paragraphs_of(lines):
    """A line that begins with a capital letter begins a paragraph."""
    paragraphs = []
    for line in lines:
        if line[0].isupper():
            paragraphs.append(line)
        else:
            paragraphs[-1] += " " + line
    return paragraphs


def sections_of_footer(footer):
    examples = [line.strip() for line in footer if line.startswith("  ")]
    rest = paragraphs_of(line for line in footer if line and not line.startswith("  ") and line != "Example:")
    status = [line.removeprefix("Exit status: ") for line in rest if line.startswith("Exit status: ")]
    notes = [line for line in rest if not line.startswith("Exit status: ")]
    lines = []
    if examples:
        lines += [".SH EXAMPLES", ".nf", *map(roff, examples), ".fi"]
    if status:
        lines += [".SH EXIT STATUS", *map(roff, status)]
    if notes:
        lines += [".SH NOTES", "\n.PP\n".join(map(roff, notes))]
    return lines


def page(name, help_, version, see_also):
    summary = help_.description.rstrip(".")
    lines = [f'.TH {name.upper()} 1 "" "tanglebin {version}" "User Commands"', ".nh"]
    lines += [".SH NAME", rf"{roff(name)} \- {roff(summary[0].lower() + summary[1:])}"]
    lines += [".SH SYNOPSIS", rf"\fB{roff(help_.usage)}\fR"]
    lines += [".SH DESCRIPTION", roff(summary) + "."]
    for title, heading in [("Positionals", "ARGUMENTS"), ("Options", "OPTIONS"), ("Subcommands", "COMMANDS")]:
        if title in help_.sections:
            lines += [f".SH {heading}", *list_of(help_.sections[title])]
    lines += sections_of_footer(help_.footer)
    lines += [".SH FILES", ".TP", rf"\fB{RECIPES}\fR", "Recipes to start from", ".TP", rf"\fB{DOCUMENTS}\fR", "Formats, methods and measures"]
    lines += [".SH SEE ALSO", ",\n".join(rf"\fB{roff(other)}\fR(1)" for other in see_also)]
    return "\n".join(lines) + "\n"


BASH = """\
# Completion for bash. Made by packaging/manual.py from what --help says.
_tanglebin() {{
  local cur prev words cword split
  _init_completion -s || return
  if ((cword == 1)); then
    COMPREPLY=($(compgen -W '{commands} {options}' -- "$cur"))
  elif [[ $cur != -* ]]; then
    _filedir
  else
    local options
    case ${{words[1]}} in
{cases}
    esac
    COMPREPLY=($(compgen -W "$options" -- "$cur"))
  fi
}}
complete -F _tanglebin tanglebin
"""

ZSH = """\
#compdef tanglebin
# Completion for zsh. Made by packaging/manual.py from what --help says.
if ((CURRENT == 2)); then
  local -a commands=(
{commands}
  )
  _describe command commands
  _arguments {options}
  return
fi
local command=$words[2]
shift words
((CURRENT--))
case $command in
{cases}
esac
"""


def bash_completion(program, commands):
    names = {command: " ".join(option.name for option in help_.sections["Options"]) for command, help_ in commands.items()}
    cases = "\n".join(f"      {command}) options='{options}' ;;" for command, options in names.items())
    options = " ".join(option.name for option in program.sections["Options"])
    return BASH.format(commands=" ".join(commands), options=options, cases=cases)


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def zsh_specification(option):
    description = re.sub(r"([\[\]])", r"\\\1", option.description)
    # An option with a value may be given again, and the value may follow "=".
    if option.value:
        return quoted(f"*{option.name}=[{description}]:value:_files")
    return quoted(f"{option.name}[{description}]")


def zsh_completion(program, commands):
    describe = "\n".join("    " + quoted(f"{command}:{help_.description}") for command, help_ in commands.items())
    cases = []
    for command, help_ in commands.items():
        specifications = [zsh_specification(option) for option in help_.sections["Options"]]
        cases.append(f"  {command})\n    _arguments \\\n      " + " \\\n      ".join([*specifications, "'*:file:_files'"]) + " ;;")
    options = " ".join(zsh_specification(option) for option in program.sections["Options"])
    return ZSH.format(commands=describe, options=options, cases="\n".join(cases))


def write_gzipped(file, text):
    file.write_bytes(gzip.compress(text.encode(), mtime=0))


def main(path, folder):
    version = subprocess.run([path, "--version"], check=True, capture_output=True, text=True).stdout.split()[0]
    program = read_help(path)
    commands = {command.name: read_help(path, command.name) for command in program.sections["Subcommands"]}
    folder.mkdir(parents=True, exist_ok=True)
    pages = [f"tanglebin-{command}" for command in commands]
    write_gzipped(folder / "tanglebin.1.gz", page("tanglebin", program, version, pages))
    for name, help_ in zip(pages, commands.values()):
        write_gzipped(folder / f"{name}.1.gz", page(name, help_, version, ["tanglebin"]))
    (folder / "tanglebin.bash").write_text(bash_completion(program, commands))
    (folder / "tanglebin.zsh").write_text(zsh_completion(program, commands))


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
