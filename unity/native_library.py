"""Reads the processor, the needed libraries and the exports of a native library."""
import struct

MACHINES = {62: "x86-64", 183: "arm64"}


class Unreadable(ValueError):
    pass


def elf_sections(data):
    offset, size, count = (struct.unpack_from("<Q", data, 40)[0], *struct.unpack_from("<HH", data, 58))
    for i in range(count):
        yield struct.unpack_from("<IIQQQQIIQQ", data, offset + i * size)


def text_at(data, begin):
    return data[begin:data.index(b"\0", begin)].decode()


def read_elf(data):
    """Processor, needed libraries and exported functions of a shared library in ELF, 64 bits."""
    if data[:6] != b"\x7fELF\x02\x01":
        raise Unreadable("not a 64-bit ELF file")
    if struct.unpack_from("<H", data, 16)[0] != 3:
        raise Unreadable("not a shared library")
    sections = list(elf_sections(data))
    needed, exports = [], set()
    for _, kind, _, _, offset, size, link, _, _, entry in sections:
        strings = sections[link][4] if link < len(sections) else 0
        if kind == 6:  # SHT_DYNAMIC; DT_NEEDED is 1
            for at in range(offset, offset + size, entry):
                tag, value = struct.unpack_from("<QQ", data, at)
                if tag == 1:
                    needed.append(text_at(data, strings + value))
        elif kind == 11:  # SHT_DYNSYM; section 0: defined elsewhere
            for at in range(offset, offset + size, entry):
                name, _, _, section = struct.unpack_from("<IBBH", data, at)
                if section:
                    exports.add(text_at(data, strings + name))
    return MACHINES.get(struct.unpack_from("<H", data, 18)[0], "another processor"), needed, exports


def read_pe(data):
    """Processor, no needed libraries, and exported functions of a DLL."""
    header = struct.unpack_from("<I", data, 60)[0] if data[:2] == b"MZ" else 0
    if not header or data[header:header + 4] != b"PE\0\0":
        raise Unreadable("not a DLL")
    machine, section_count, optional_bytes = (*struct.unpack_from("<HH", data, header + 4), struct.unpack_from("<H", data, header + 20)[0])
    if machine != 0x8664:
        return "another processor", [], set()
    sections = [struct.unpack_from("<8sIIII", data, header + 24 + optional_bytes + 40 * i) for i in range(section_count)]

    def at(address):
        for _, size, begin, raw_size, raw in sections:
            if begin <= address < begin + max(size, raw_size):
                return address - begin + raw
        raise Unreadable("no export table")

    table = at(struct.unpack_from("<I", data, header + 24 + 112)[0])
    count, names = struct.unpack_from("<I", data, table + 24)[0], at(struct.unpack_from("<I", data, table + 32)[0])
    return "x86-64", [], {text_at(data, at(struct.unpack_from("<I", data, names + 4 * i)[0])) for i in range(count)}
