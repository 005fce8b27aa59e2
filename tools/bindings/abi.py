"""The binary interface that all versions 1.x keep: stable functions, and the structs and
enumerators that they use."""
import c_header


def types_of(function):
    for type_ in [function.result, *(parameter.type for parameter in function.parameters)]:
        yield type_
        if type_.function:
            yield from types_of(type_.function)


def stable_structs(header):
    """Names of the structs that stable functions reach, in the header's order."""
    found, open_ = set(), [t for f in header.functions if not f.is_experimental for t in types_of(f)]
    while open_:
        type_ = open_.pop()
        struct = header.struct(type_.base)
        if struct and struct.name not in found:
            found.add(struct.name)
            for field in struct.fields:
                open_ += [field.type, *(types_of(field.type.function) if field.type.function else ())]
    return [struct.name for struct in header.structs if struct.name in found]


def declaration(function):
    return f"{function.result.c()} {function.name}({', '.join(p.type.declare('').strip() for p in function.parameters) or 'void'})"


def write(header, layout):
    """Lines of a stored interface.

    layout  sizes, offsets and enumerators by name (c_layout.compiled_layout)
    """
    structs = set(stable_structs(header))
    numbers = {name: number for name, number in layout.items() if name.startswith("PELAGIC_") or name.split(".")[0] in structs}
    return "".join(f"{name} {number}\n" for name, number in numbers.items()) + "".join(
        f"{declaration(function)}\n" for function in header.functions if not function.is_experimental)


def breaks(stored, now):
    """Differences that break applications of the stored version. Later versions may add
    declarations, and fields at the end of a struct with struct_size, which may grow.

    stored, now  lines as write() makes them
    """
    def split(lines):
        numbers = dict(line.split() for line in lines.splitlines() if "(" not in line)
        return numbers, {line for line in lines.splitlines() if "(" in line}

    (old_numbers, old_functions), (new_numbers, new_functions) = split(stored), split(now)
    for name, number in old_numbers.items():
        may_grow = f"{name}.struct_size" in old_numbers
        if name not in new_numbers or (int(new_numbers[name]) < int(number) if may_grow else new_numbers[name] != number):
            yield f"{name}: {number} in version 1.0, now {new_numbers.get(name, 'missing')}"
    for function in sorted(old_functions - new_functions):
        yield f"{function}: in version 1.0, now missing or different"
