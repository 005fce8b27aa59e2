"""Reads the YAML that Unity 2022.3 writes as text: https://docs.unity3d.com/2022.3/Documentation/Manual/FormatDescription.html"""
import dataclasses
import re

HEAD = "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n"
KEY = re.compile(r"([^:{}\[\]]+):(?: (.*))?$")


class Unreadable(ValueError):
    pass


@dataclasses.dataclass
class Document:
    class_number: int
    type_name: str
    fields: dict


def value_of(text):
    """A scalar, an empty list, or a flow mapping of scalars."""
    if text == "[]":
        return []
    if text.startswith("{"):
        if not text.endswith("}"):
            raise Unreadable(f"{text} does not end")
        return dict(pair.split(": ", 1) for pair in text[1:-1].split(", ") if pair)
    return text


class Lines:
    """Lines of a document as (indentation, text), without the dash of list items."""

    def __init__(self, text):
        self.lines = [(len(line) - len(line.lstrip(" ")), line.strip(" ")) for line in text.splitlines()]
        self.at = 0

    def peek(self):
        return self.lines[self.at] if self.at < len(self.lines) else (-1, "")

    def block(self, indentation):
        """A mapping or a list at an indentation."""
        return self.items(indentation) if self.peek()[1].startswith("- ") else self.mapping(indentation)

    def items(self, indentation):
        found = []
        while self.peek()[0] == indentation and self.peek()[1].startswith("- "):
            text = self.peek()[1][2:]
            if text.startswith("{") or not KEY.match(text):
                found.append(value_of(text))
                self.at += 1
            else:
                self.lines[self.at] = (indentation + 2, text)
                found.append(self.mapping(indentation + 2))
        return found

    def mapping(self, indentation):
        found = {}
        while self.peek()[0] == indentation and not self.peek()[1].startswith("- "):
            matched = KEY.match(self.peek()[1])
            if not matched or matched[1] in found:
                raise Unreadable(f"{self.peek()[1]!r} is no new key")
            self.at += 1
            # Unity writes lists at the indentation of their key.
            deeper, text = self.peek()
            if matched[2] or not (deeper > indentation or (deeper == indentation and text.startswith("- "))):
                found[matched[1]] = value_of(matched[2] or "")
            else:
                found[matched[1]] = self.block(deeper)
        return found


def documents(text):
    """The objects of a file by their numbers."""
    if not text.startswith(HEAD + "--- ") or not text.endswith("\n"):
        raise Unreadable("not as Unity begins and ends a file")
    found = {}
    for part in text[len(HEAD) + len("--- "):].split("\n--- "):
        head, body = part.split("\n", 1)
        matched = re.fullmatch(r"!u!(\d+) &(\d+)", head)
        if not matched or int(matched[2]) in found:
            raise Unreadable(f"{head!r} is no new object")
        lines = Lines(body)
        root = lines.mapping(0)
        if lines.at < len(lines.lines) or len(root) != 1:
            raise Unreadable(f"object {matched[2]} has a line that belongs to none: {lines.peek()[1]!r}")
        type_name, fields = next(iter(root.items()))
        found[int(matched[2])] = Document(int(matched[1]), type_name, fields)
    return found


def references(value, path=""):
    """Yields (path, reference) for all references of a value to objects."""
    if isinstance(value, dict) and "fileID" in value:
        yield path, value
    elif isinstance(value, dict):
        for key, part in value.items():
            yield from references(part, f"{path}.{key}")
    elif isinstance(value, list):
        for part in value:
            yield from references(part, path + "[]")
