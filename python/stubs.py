#!/usr/bin/env python3
"""Writes the type stubs of the module tanglebin._core from the signatures in its docstrings.

    stubs.py FOLDER     where FOLDER/tanglebin has the module; the stubs go beside it
"""

import importlib
import inspect
import re
import sys
from pathlib import Path

HEADER = '''"""Made by python/stubs.py from the module."""

import os
import pathlib
from typing import Any, Callable, ClassVar, Dict, List, Optional, Sequence, Tuple, overload

import numpy
import numpy.typing
'''
# Of what pybind11 writes, what type checkers know by other names.
TYPES = [
    (r"\bint\[\d+\]", "int"),  # a list of so many
    (r"tanglebin\._core\.", ""),
    (r"\bfunction\b", "Callable[[float, float], object]"),
]
TYPES_OF_ARGUMENTS = [
    (r"numpy\.ndarray(\[[\w.]+\])?", "numpy.typing.ArrayLike"),
    (r"\bos\.PathLike\b", "str | os.PathLike[str]"),
    (r"\bList\[", "Sequence["),
]
TYPES_OF_RESULTS = [
    (r"numpy\.ndarray(\[[\w.]+\])", r"numpy.typing.NDArray\1"),
    (r"numpy\.ndarray(?!\[)", "numpy.typing.NDArray[Any]"),
    (r"\bos\.PathLike\b", "pathlib.Path"),
]
LEFT_OUT = {"__getstate__", "__setstate__", "__hash__", "__reduce_ex__", "__doc__"}


def replaced(text, replacements):
    for pattern, replacement in TYPES + replacements:
        text = re.sub(pattern, replacement, text)
    return text


def split_arguments(text):
    """Splits at the commas that are in no brackets and no quotes."""
    parts, depth, quoted = [""], 0, False
    for character in text:
        quoted ^= character == "'"
        depth += 0 if quoted else (character in "([{<") - (character in ")]}>")
        if character == "," and depth == 0 and not quoted:
            parts.append("")
        else:
            parts[-1] += character
    return [part.strip() for part in parts if part.strip()]


def argument(text):
    name, _, rest = text.partition(":")
    if name in ("self", "*args", "**kwargs"):
        return name
    kind, equals, _ = rest.partition(" = ")
    return f"{name}: {replaced(kind.strip(), TYPES_OF_ARGUMENTS)}" + (" = ..." if equals else "")


def signatures(documented):
    """The signatures of a function's docstring, as (arguments, result), and the rest of the docstring."""
    text = documented.__doc__ or ""
    name = documented.__name__
    found = re.findall(rf"^(?:\d+\. )?{re.escape(name)}\((?!\*args)(.*)\) -> (.*)$", text, re.MULTILINE)
    comment = re.sub(rf"^(?:\d+\. )?{re.escape(name)}\(.*$|^Overloaded function\.$", "", text, flags=re.MULTILINE)
    return [(split_arguments(arguments), replaced(result, TYPES_OF_RESULTS)) for arguments, result in found], comment


def docstring(text, indent):
    text = (text or "").strip()
    text += " " if text.endswith('"') else ""
    return [indent + line if line else "" for line in f'r"""{text}"""'.splitlines()] if text else [indent + "..."]


def function(name, documented, indent=""):
    overloads, comment = signatures(documented)
    lines = []
    for arguments, result in overloads:
        if indent:
            arguments = ["self"] + arguments[1:]
        if name in ("__eq__", "__ne__"):
            arguments = ["self", "other: object"]
        if len(overloads) > 1:
            lines.append(f"{indent}@overload")
        lines.append(f"{indent}def {name}({', '.join(map(argument, arguments))}) -> {result}:")
        lines += docstring(comment, indent + "    ")
    return lines


def attribute(name, member):
    result = re.search(r"-> (.*)", member.fget.__doc__ or "")
    kind = replaced(result.group(1), TYPES_OF_RESULTS) if result else "Any"
    lines = ["    @property", f"    def {name}(self) -> {kind}:"] + docstring(member.__doc__, "        ")
    if member.fset:
        given = re.search(r"\((.*)\) -> None", member.fset.__doc__ or "")
        value = split_arguments(given.group(1))[-1].partition(": ")[2] if given else "Any"
        kind = replaced(value, TYPES_OF_ARGUMENTS)
        lines += [f"    @{name}.setter", f"    def {name}(self, value: {kind}) -> None: ..."]
    return lines


def class_body(described):
    lines = []
    for name, kind in vars(described).get("__annotations__", {}).items():
        lines.append(f"    {name}: {kind}")
    for name, member in sorted(vars(described).items()):
        if name in LEFT_OUT:
            continue
        if name == "__members__":
            lines.append(f"    {name}: ClassVar[Dict[str, {described.__name__}]]")
        elif isinstance(member, property):
            lines += attribute(name, member)
        elif isinstance(member, described):
            lines.append(f"    {name}: ClassVar[{described.__name__}]")
        elif inspect.isroutine(member) and signatures(member)[0]:
            lines += function(name, member, "    ")
    return lines


def described_class(described):
    base = described.__bases__[0]
    bases = f"({base.__name__})" if issubclass(described, Exception) else ""
    return [f"class {described.__name__}{bases}:"] + docstring(described.__doc__, "    ") + class_body(described)


def stubs(module):
    lines = [HEADER]
    for name, member in sorted(vars(module).items()):
        if inspect.isclass(member):
            lines += described_class(member)
        elif inspect.isroutine(member):
            lines += function(name, member)
        elif name == "__version__" or not name.startswith("_"):
            lines.append(f"{name}: {type(member).__name__}")
        else:
            continue
        lines.append("")
    return "\n".join(lines)


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    sys.path.insert(0, str(folder))
    # The module alone: the package around it may not be complete yet.
    module = importlib.import_module("tanglebin._core")
    (folder / "tanglebin" / "_core.pyi").write_text(stubs(module), encoding="utf-8")
