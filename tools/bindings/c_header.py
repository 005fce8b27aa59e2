"""Parser of pelagic.h: enums, structs with their defaults, handles, callbacks and functions, with
their comments.

It reads the C that the header uses and no more. Text that it cannot read is an error, so that no
declaration is lost.
"""
import dataclasses
import re

SIZES = {"int8_t": 1, "uint8_t": 1, "uint16_t": 2, "int32_t": 4, "uint32_t": 4, "int64_t": 8, "uint64_t": 8, "float": 4, "double": 8,
         "size_t": 8, "ptrdiff_t": 8, "char": 1}
POINTER_BYTES = 8


@dataclasses.dataclass
class Type:
    """`base` with a suffix of pointers, of which each is "*" or "*const", or a function pointer."""
    base: str
    is_const: bool = False
    pointers: tuple = ()
    function: "Callback | None" = None

    def c(self):
        return ("const " if self.is_const else "") + self.base + "".join(self.pointers)

    def declare(self, name):
        if self.function:
            return f"{self.function.result.c()} (*{name})({', '.join(p.type.declare(p.name) for p in self.function.parameters)})"
        return f"{self.c()} {name}"


@dataclasses.dataclass
class Parameter:
    name: str
    type: Type


@dataclasses.dataclass
class Field:
    name: str
    type: Type
    count: int = 0          # elements of an array; 0: no array
    doc: str = ""
    enum: "Enum | None" = None  # of the values, which only the comment names

    @property
    def is_flag(self):
        return self.type.c() == "int32_t" and re.match("Nonzero[: ]", self.doc) is not None


@dataclasses.dataclass
class Struct:
    name: str
    fields: list
    doc: str = ""
    # of fields that are not 0, as C writes them: numbers and enumerators
    defaults: dict = dataclasses.field(default_factory=dict)

    @property
    def has_size(self):
        """Whether the library reads the struct, which later versions may then extend."""
        return self.fields[0].name == "struct_size"

    @property
    def has_pointers(self):
        return any(f.type.pointers or f.type.function for f in self.fields)


@dataclasses.dataclass
class Enum:
    prefix: str             # "PELAGIC_SPECTRUM_"
    values: list            # of (name without the prefix, value, comment)
    typedef: str = ""
    doc: str = ""


@dataclasses.dataclass
class Callback:
    name: str
    result: Type
    parameters: list
    doc: str = ""


@dataclasses.dataclass
class Function:
    name: str
    result: Type
    parameters: list
    doc: str = ""
    section: str = ""
    is_experimental: bool = False


@dataclasses.dataclass
class Header:
    version: tuple = ()
    enums: list = dataclasses.field(default_factory=list)
    structs: list = dataclasses.field(default_factory=list)
    handles: list = dataclasses.field(default_factory=list)  # of (name, comment)
    callbacks: list = dataclasses.field(default_factory=list)
    functions: list = dataclasses.field(default_factory=list)
    status: str = ""        # the typedef of results

    def struct(self, name):
        return next((s for s in self.structs if s.name == name), None)

    def callback(self, name):
        return next((c for c in self.callbacks if c.name == name), None)

    def is_handle(self, name):
        return any(handle == name for handle, _ in self.handles)


class Comments:
    """The comments of a text, by position. `code` is the text with blanks in their place."""

    def __init__(self, text):
        self.text, self.code, self.found = text, text, []
        for match in re.finditer(r"/\*.*?\*/", text, re.S):
            self.found.append(match.span())
            self.code = self.code[:match.start()] + re.sub(r"[^\n]", " ", match[0]) + self.code[match.end():]

    def content(self, span):
        lines = self.text[span[0] + 2:span[1] - 2].split("\n")
        return "\n".join(re.sub(r"^\s*\* ?", "", line) if i else line.strip() for i, line in enumerate(lines)).strip()

    def before(self, position):
        """The comment that ends directly above a position, or before it on its line."""
        for begin, end in self.found:
            between = self.text[end:position]
            if end <= position and not between.strip() and between.count("\n") <= 1:
                line = self.code[self.code.rfind("\n", 0, begin) + 1:begin]
                return "" if line.strip() else self.content((begin, end))
        return ""

    def after(self, position):
        """The comment that follows on the same line."""
        for span in self.found:
            if span[0] >= position and not self.text[position:span[0]].strip(" ,;"):
                return self.content(span)
        return ""

    def of(self, begin, end):
        return self.before(begin) or self.after(end)


def split_outside_parentheses(text):
    depth, parts = 0, [""]
    for character in text:
        depth += (character == "(") - (character == ")")
        if character == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return parts


def read_type(text):
    match = re.fullmatch(r"\s*(const\s+)?(?:struct\s+)?(\w+)\s*((?:\*\s*(?:const)?\s*)*)", text)
    if not match:
        raise ValueError(f"unknown type: {text}")
    pointers = tuple(re.sub(r"\s", "", p) for p in re.findall(r"\*\s*(?:const)?", match[3]))
    return Type(match[2], bool(match[1]), pointers)


def read_parameters(text):
    if text.strip() == "void":
        return []
    parameters = []
    for part in split_outside_parentheses(text):
        if match := re.fullmatch(r"\s*(.+?)\(\*(\w+)\)\((.*)\)\s*", part, re.S):
            callback = Callback(match[2], read_type(match[1]), read_parameters(match[3]))
            parameters.append(Parameter(match[2], Type(match[2], function=callback)))
        else:
            match = re.fullmatch(r"\s*(.*?)(\w+)\s*", part, re.S)
            parameters.append(Parameter(match[2], read_type(match[1])))
    return parameters


def read_enum(body, at, comments, typedef, doc):
    values = []
    for match in re.finditer(r"(\w+)\s*=\s*(\d+)\s*(,|$|\s*\Z)", body):
        values.append((match[1], int(match[2]), comments.of(at + match.start(), at + match.end(2))))
    if re.sub(r"\w+\s*=\s*\d+\s*,?", "", body).strip():
        raise ValueError(f"unknown enumerators: {body}")
    names = [name for name, _, _ in values]
    shared = 0
    while len({name[:shared + 1] for name in names}) == 1:
        shared += 1
    prefix = names[0][:names[0].rfind("_", 0, shared) + 1]
    return Enum(prefix, [(name[len(prefix):], value, text) for name, value, text in values], typedef, doc)


def read_fields(body, at, comments):
    fields = []
    for match in re.finditer(r"[^;]+;", body):
        text = match[0][:-1]
        begin = at + match.start() + len(text) - len(text.lstrip())
        doc = comments.of(begin, at + match.end())
        first = re.match(r"\s*((?:const\s+)?(?:struct\s+)?\w+)\s*(.*)", text, re.S)
        for declarator in first[2].split(","):
            parts = re.fullmatch(r"\s*((?:\*|const|\s)*?)(\w+)(?:\[(\d+)\])?\s*", declarator, re.S)
            fields.append(Field(parts[2], read_type(f"{first[1]} {parts[1]}"), int(parts[3] or 0), doc))
    return fields


def read_defaults(struct, body):
    """The assignments of pelagic_..._make()."""
    if not re.match(r"\s*PELAGIC_(MAKE|ZEROS|RECORD)\(" + struct.name + r"\b", body):
        raise ValueError(f"{struct.name}_make does not begin with zeros")
    names = {field.name for field in struct.fields}
    for statement in body.split(";")[1:-1]:
        if match := re.fullmatch(r"\s*\w+\.(\w+) = ([-.\w]+)", statement):
            struct.defaults[match[1]] = match[2]
        if (match[1] not in names) if match else not re.fullmatch(r"\s*return \w+", statement):
            raise ValueError(f"unknown default: {statement}")


def link_enums(header):
    """Finds the enum of int32_t fields: their comments name it, as PELAGIC_SPECTRUM_..."""
    prefixes = {enum.prefix: enum for enum in header.enums}
    for struct in header.structs:
        for field in struct.fields:
            if field.type.c() == "int32_t" and (match := re.search(r"\b(PELAGIC_[A-Z_]+_)\.\.\.", field.doc)):
                field.enum = prefixes[match[1]]


def link_callbacks(header):
    for struct in header.structs:
        for field in struct.fields:
            field.type.function = header.callback(field.type.base)
    for function in header.functions:
        for parameter in function.parameters:
            parameter.type.function = parameter.type.function or header.callback(parameter.type.base)


def read_header(text):
    text = re.sub(r"(?m)^[ \t]*/\* (?:generated from schema/.*|end of generated) \*/\n", "", text)
    comments = Comments(text)
    # What C++ needs, and preprocessor lines, with blanks in their place.
    code = comments.code
    for pattern in (r'^#ifdef __cplusplus\n(extern "C" \{|\})\n#endif', r"^#(?:[^\n]*\\\n)*[^\n]*"):
        code = re.sub(pattern, lambda m: re.sub(r"[^\n]", " ", m[0]), code, flags=re.M)
    header, rest = Header(), code

    def matches(pattern):
        nonlocal rest
        for match in re.finditer(pattern, code, re.S):
            if rest[match.start():match.end()].strip():
                rest = rest[:match.start()] + re.sub(r"[^\n]", " ", match[0]) + rest[match.end():]
                yield match

    header.version = tuple(int(re.search(rf"#define PELAGIC_VERSION_{part} (\d+)", text)[1]) for part in ("MAJOR", "MINOR", "PATCH"))
    sections = [(m.start(), m[1]) for m in re.finditer(r"^/\* ---- (.*?) -+ \*/", text, re.M)]
    for match in matches(r"\btypedef struct (\w+) \{([^}]*)\} (\w+);"):
        header.structs.append(Struct(match[3], read_fields(match[2], match.start(2), comments), comments.before(match.start())))
    for match in matches(r"\bstatic inline (\w+) \1_make\(void\) \{([^}]*)\}"):
        read_defaults(header.struct(match[1]), match[2])
    for match in matches(r"\btypedef struct (\w+) \1;"):
        header.handles.append((match[1], comments.before(match.start())))
    for match in matches(r"(?:\btypedef int32_t (\w+);\s*)?\benum \{([^}]*)\};"):
        header.enums.append(read_enum(match[2], match.start(2), comments, match[1] or "", comments.before(match.start())))
        header.status = header.status or match[1] or ""
    for match in matches(r"\btypedef ([\w\s*]+?)\(\*(\w+)\)\(([^;]*)\);"):
        header.callbacks.append(Callback(match[2], read_type(match[1]), read_parameters(match[3]), comments.before(match.start())))
    for match in matches(r"\bPELAGIC_(API|EXPERIMENTAL) ([\w\s*]+?)(\w+)\(([^;]*)\);"):
        section = next((title for start, title in reversed(sections) if start < match.start()), "The library")
        header.functions.append(Function(match[3], read_type(match[2]), read_parameters(match[4]), comments.before(match.start()), section,
                                         match[1] == "EXPERIMENTAL"))
    if rest.strip():
        raise ValueError(f"unknown declaration: {rest.strip().splitlines()[0]}")
    link_callbacks(header)
    link_enums(header)
    return header


def size_and_alignment(header, type_):
    if type_.pointers or type_.function:
        return POINTER_BYTES, POINTER_BYTES
    if struct := header.struct(type_.base):
        size, _, alignment = layout_of(header, struct)
        return size, alignment
    size = 4 if type_.base == header.status else SIZES[type_.base]
    return size, size


def field_bytes(header, field):
    return size_and_alignment(header, field.type)[0] * (field.count or 1)


def layout_of(header, struct):
    """Size, offsets by field name, and alignment, by the rules of 64-bit systems."""
    end, largest, offsets = 0, 1, {}
    for field in struct.fields:
        _, alignment = size_and_alignment(header, field.type)
        offsets[field.name] = end = -(-end // alignment) * alignment
        end += field_bytes(header, field)
        largest = max(largest, alignment)
    return -(-end // largest) * largest, offsets, largest
