"""Reads and checks native libraries: ELF of 64 bits, and DLLs."""
import dataclasses
import struct

MACHINES = {62: "x86-64", 183: "arm64"}
WINDOWS_LIBRARIES = {"kernel32.dll", "msvcrt.dll", "ucrtbase.dll", "api-ms-win-crt"}  # as read_pe() names them
LOAD, NOTE, GNU_STACK, GNU_RELRO = 1, 4, 0x6474E551, 0x6474E552


class Unreadable(ValueError):
    pass


@dataclasses.dataclass
class Segment:
    kind: int
    flags: int
    offset: int
    address: int
    file_bytes: int
    memory_bytes: int
    alignment: int

    @property
    def end(self):
        return self.address + self.memory_bytes


@dataclasses.dataclass
class Library:
    machine: str
    needed: list
    exports: set
    imports: set = dataclasses.field(default_factory=set)
    segments: list = dataclasses.field(default_factory=list)  # of an ELF file
    relocates_code: bool = False
    search_path: bool = False
    api_level: int = None  # of Android, which the NDK's start-up object states

    def loads(self):
        return [segment for segment in self.segments if segment.kind == LOAD]


def elf_sections(data):
    offset, size, count = (struct.unpack_from("<Q", data, 40)[0], *struct.unpack_from("<HH", data, 58))
    for i in range(count):
        yield struct.unpack_from("<IIQQQQIIQQ", data, offset + i * size)


def elf_segments(data):
    offset, size, count = (struct.unpack_from("<Q", data, 32)[0], *struct.unpack_from("<HH", data, 54))
    for i in range(count):
        kind, flags, begin, address, _, file_bytes, memory_bytes, alignment = struct.unpack_from("<IIQQQQQQ", data, offset + i * size)
        yield Segment(kind, flags, begin, address, file_bytes, memory_bytes, alignment)


def android_api_level(data, segments):
    """The API level in the note that the NDK's crtbegin_so.o has, or None."""
    for note in (segment for segment in segments if segment.kind == NOTE):
        at, end = note.offset, note.offset + note.file_bytes
        while at + 12 <= end:
            name_bytes, description_bytes, kind = struct.unpack_from("<III", data, at)
            name, at = data[at + 12:at + 12 + name_bytes], at + 12 + (name_bytes + 3) // 4 * 4
            if name == b"Android\0" and kind == 1:
                return struct.unpack_from("<I", data, at)[0]
            at += (description_bytes + 3) // 4 * 4
    return None


def text_at(data, begin):
    return data[begin:data.index(b"\0", begin)].decode()


def read_elf(data):
    """A shared library, or a program that is position-independent, in ELF of 64 bits."""
    if data[:6] != b"\x7fELF\x02\x01":
        raise Unreadable("not a 64-bit ELF file")
    if struct.unpack_from("<H", data, 16)[0] != 3:
        raise Unreadable("not a shared library")
    sections, segments = list(elf_sections(data)), list(elf_segments(data))
    library = Library(MACHINES.get(struct.unpack_from("<H", data, 18)[0], "another processor"), [], set(), segments=segments,
                      api_level=android_api_level(data, segments))
    for _, kind, _, _, offset, size, link, _, _, entry in sections:
        strings = sections[link][4] if link < len(sections) else 0
        if kind == 6:  # SHT_DYNAMIC
            for at in range(offset, offset + size, entry):
                tag, value = struct.unpack_from("<QQ", data, at)
                if tag == 1:  # DT_NEEDED
                    library.needed.append(text_at(data, strings + value))
                library.search_path |= tag in (15, 29)  # DT_RPATH, DT_RUNPATH
                library.relocates_code |= tag == 22 or (tag == 30 and value & 4 != 0)  # DT_TEXTREL, DF_TEXTREL
        elif kind == 11:  # SHT_DYNSYM; section 0: defined elsewhere
            for at in range(offset, offset + size, entry):
                name, _, _, section = struct.unpack_from("<IBBH", data, at)
                if name:
                    (library.exports if section else library.imports).add(text_at(data, strings + name))
    return library


def read_pe(data):
    """A DLL, or a program for Windows."""
    header = struct.unpack_from("<I", data, 60)[0] if data[:2] == b"MZ" else 0
    if not header or data[header:header + 4] != b"PE\0\0":
        raise Unreadable("not a DLL")
    machine, section_count, optional_bytes = (*struct.unpack_from("<HH", data, header + 4), struct.unpack_from("<H", data, header + 20)[0])
    if machine != 0x8664:
        return Library("another processor", [], set())
    sections = [struct.unpack_from("<8sIIII", data, header + 24 + optional_bytes + 40 * i) for i in range(section_count)]

    def at(address):
        for _, size, begin, raw_size, raw in sections:
            if begin <= address < begin + max(size, raw_size):
                return address - begin + raw
        raise Unreadable("no export table")

    table, _, imported = struct.unpack_from("<III", data, header + 24 + 112)
    library = Library("x86-64", [], set())
    if imported:
        entry = at(imported)
        while name := struct.unpack_from("<I", data, entry + 12)[0]:
            name = text_at(data, at(name)).lower()
            library.needed.append("api-ms-win-crt" if name.startswith("api-ms-win-crt-") else name)
            entry += 20
    if table or struct.unpack_from("<H", data, header + 22)[0] & 0x2000:  # a program exports nothing
        count, names = struct.unpack_from("<I", data, at(table) + 24)[0], at(struct.unpack_from("<I", data, at(table) + 32)[0])
        library.exports = {text_at(data, at(struct.unpack_from("<I", data, names + 4 * i)[0])) for i in range(count)}
    return library


def page_problems(library, page_bytes, is_android):
    """Why a system with pages of this size, or smaller ones, cannot map an ELF file, or not safely."""
    loads, pages = library.loads(), lambda address: address // page_bytes
    for i, load in enumerate(loads):
        if load.alignment < page_bytes or load.alignment & (load.alignment - 1):
            yield f"aligns LOAD segment {i} to {load.alignment} bytes, expected {page_bytes}"
        elif (load.address - load.offset) % page_bytes:
            yield f"has LOAD segment {i} at other bytes of a page in the file and in memory"
        elif i and pages(load.address) <= pages(loads[i - 1].end - 1):
            yield f"has LOAD segments {i - 1} and {i} in one page of {page_bytes} bytes"
    for relro in (segment for segment in library.segments if segment.kind == GNU_RELRO and is_android):
        # Android's loader protects whole pages, rounded up.
        protected_end = -(-relro.end // page_bytes) * page_bytes
        if any(load.flags & 2 and max(load.address, relro.end) < min(load.end, protected_end) for load in loads):
            yield f"has writable data in the last page of {page_bytes} bytes of its RELRO segment"


def problems(library, machine, libraries, functions, page_bytes=4096, api_level=None, exactly=False):
    """What prevents an application from loading a library, as predicates.

    libraries   that the system provides
    functions   that the library exports; exactly: and no others
    api_level   of the oldest Android, if the library is for Android
    """
    if library.machine != machine:
        yield f"is for {library.machine}, expected {machine}"
        return
    if extra := [name for name in library.needed if name not in libraries]:
        yield f"needs {', '.join(extra)}, which the system does not provide"
    if missing := sorted(set(functions) - library.exports):
        yield f"does not export {missing[0]}: it is not this version of Pelagic"
    if exactly and (extra := sorted(library.exports - set(functions))):
        yield f"exports {extra[0]}, which is not in the interface"
    if not library.segments:
        return
    yield from page_problems(library, page_bytes, api_level is not None)
    if any(segment.kind == GNU_STACK and segment.flags & 1 for segment in library.segments):
        yield "has an executable stack"
    if library.relocates_code:
        yield "has relocations in its code"
    if library.search_path:
        yield "has a search path for libraries"
    if api_level is not None:
        if library.api_level is None or library.api_level > api_level:
            yield f"was built for API level {library.api_level or 'none'}, expected at most {api_level}"
        if unresolved := sorted(name for name in library.imports if name.startswith("_Z")):
            yield f"imports {unresolved[0]}, though its C++ library should be part of it"
