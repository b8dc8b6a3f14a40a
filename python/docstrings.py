#!/usr/bin/env python3
"""Writes the comments of C++ headers as constants, so that one text serves both languages.

    docstrings.py SOURCE OUTPUT HEADER...

`tanglebin/geometry/bin.hpp` becomes the constants `tanglebin::doc::geometry::Bin`, `Bin_length`, … Comments of one
name in the headers of a room, as of overloads, are put together. A binding that asks for a name without a comment
does not compile.
"""

import re
import sys
from pathlib import Path

# The words of C++ that Python has others for.
PYTHON_WORDS = [
    (r"\bstd::invalid_argument", "InputError"),
    (r"\bstd::length_error", "ValueError"),
    (r"\bstd::runtime_error", "RuntimeError"),
    (r"\bnullopt\b", "None"),
    (r"\bThrows\b", "Raises"),
    (r"\bthrows\b", "raises"),
    (r"\b(\w+)::(\w+)", r"\1.\2"),
    (r" \(\w+\.hpp\)", ""),
    (r"\bas\s+(?:validate\(\w*\)(?:,\s+|\s+and\s+)?)+\s+do(?:es)?\b", "if an argument is not valid"),
    (r"\s+as\s+validate\(\w*\)\s+has\s+it\b", ""),
    (r"\bwhat\(\)", "str()"),
    (r"\bthe\s+data\s+in\s+the\s+stream\b", "the data in the file"),
    (r"; of a stream, to `directory`", ""),
    (r"\bfill_dataset\(\)", "generate_dataset()"),
    (r"\bas\s+check_cloud\(\)", "if the cloud contradicts itself"),
    (r"\bthe file \(`name`\)", "the file"),
    (r"\s+without random numbers \(resolve\(\)\)", ""),
]
# What only C++ has: a sentence about it is left out.
ONLY_IN_CPP = [
    r"`at_step`",
    r"`at_place`",
    r"`before_attempt`",
    r"caller\s+checks\s+the\s+stream",
    r"The stream may",
    r"SIGINT",
    r"Not thread-safe",
    r"printable\(\)",
    r"plain member",
]
SCOPE = re.compile(r"^(?:struct|class|enum class)\s+(\w+)[^;]*\{$")


def without_sentences_for_cpp(text):
    sentences = re.findall(r".+?(?:(?<=\.)\s+(?=[A-Z`])|$)", text, re.DOTALL)
    kept = [sentence for sentence in sentences if not any(re.search(only, sentence) for only in ONLY_IN_CPP)]
    return "".join(kept).rstrip()


def in_python(text):
    text = without_sentences_for_cpp(text)
    for pattern, replacement in PYTHON_WORDS:
        text = re.sub(pattern, replacement, text)
    return text


def without_template_arguments(declaration):
    previous = None
    while previous != declaration:
        previous, declaration = declaration, re.sub(r"<[^<>]*>", "", declaration)
    return declaration


def declared_name(declaration):
    """The name that a declaration declares; None if it declares nothing that a binding may ask for."""
    declaration = re.sub(r"^(?:struct|class|enum class)\s+", "", declaration)
    head = re.split(r"\s=\s|\{|;|,$|\s:\s", without_template_arguments(declaration))[0]
    names = re.findall(r"\w+", head.split("(")[0])
    return None if not names or "operator" in names else names[-1]


def comments(header):
    """Each commented declaration of a header: its name, as Struct_member in a struct, and the comment."""
    scopes = []  # of structs and the like: their names
    above = []  # the comment lines above the declaration
    last = None  # the member whose comment may go on in the next line
    for line in header.read_text(encoding="utf-8").splitlines():
        line = line.strip()
        if line.startswith("///<") and last is not None:
            yield last, line[4:].strip()
            continue
        last = None
        if line.startswith("///"):
            above.append(line[3:].strip())
            continue
        if line.startswith(("//", "#", "template", "public:", "private:")):
            continue
        declaration, _, beside = line.partition("///<")
        declaration = declaration.strip()
        comment = beside.strip() or "\n".join(above)
        above = []
        name = declared_name(declaration) if declaration else None
        if name and comment:
            last = "_".join(scopes + [name])
            yield last, comment
        opened = SCOPE.match(declaration)
        if opened:
            scopes.append(opened.group(1))
        elif declaration == "};" and scopes:
            scopes.pop()


def collect(source, headers):
    rooms = {}
    for header in headers:
        room = rooms.setdefault(header.relative_to(source / "tanglebin").parts[0], {})
        of_header = {}
        for name, comment in comments(header):
            of_header.setdefault(name, []).append(in_python(comment))
        for name, parts in of_header.items():
            # A comment beside a member goes on in the next line; comments of overloads are paragraphs.
            joined = (" " if "_" in name else "\n\n").join(parts)
            room[name] = f"{room[name]}\n\n{joined}" if name in room else joined
    return rooms


def write(rooms, output):
    lines = ["// Made by python/docstrings.py from the comments of the headers.", "#pragma once", ""]
    for room, names in sorted(rooms.items()):
        lines.append(f"namespace tanglebin::doc::{room} {{")
        lines += [f'inline constexpr const char* {name} = R"doc({text})doc";' for name, text in sorted(names.items())]
        lines += [f"}}  // namespace tanglebin::doc::{room}", ""]
    output.write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    source, output, *headers = map(Path, sys.argv[1:])
    write(collect(source, headers), output)
