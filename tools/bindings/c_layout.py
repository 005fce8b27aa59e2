"""Checks what c_header.py read of pelagic.h with a C compiler: sizes, offsets, enumerators, defaults
and the types of functions."""
import pathlib
import subprocess
import tempfile

import c_header


HEAD = ["#include <stddef.h>", "#include <stdio.h>", '#include "pelagic.h"', ""]


def program(header):
    """A C program that prints the layout that the compiler uses, and compiles only if the types of
    the functions are right."""
    lines = [*HEAD]
    for function in header.functions:
        parameters = ", ".join(p.type.declare(p.name) for p in function.parameters) or "void"
        lines.append(f"{function.result.c()} (*check_{function.name})({parameters}) = {function.name};")
    lines += ["", "int main(void) {"]
    for struct in header.structs:
        lines.append(f'    printf("{struct.name} %zu\\n", sizeof({struct.name}));')
        for field in struct.fields:
            lines.append(f'    printf("{struct.name}.{field.name} %zu\\n", offsetof({struct.name}, {field.name}));')
    for enum in header.enums:
        for name, _, _ in enum.values:
            lines.append(f'    printf("{enum.prefix}{name} %d\\n", {enum.prefix}{name});')
    return "\n".join(lines + ["    return 0;", "}", ""])


def numbers(header):
    """The fields of structs that pelagic_..._make() returns, without pointers and arrays."""
    for struct in header.structs:
        for field in struct.fields if struct.has_size or struct.defaults else []:
            if field.name != "struct_size" and not field.count and not field.type.pointers and field.type.base in c_header.SIZES:
                yield struct, field


def program_of_defaults(header):
    """A C program that prints the numbers of pelagic_..._make()."""
    lines = [*HEAD, "int main(void) {"]
    for struct, field in numbers(header):
        lines.append(f'    printf("{struct.name}.{field.name} %.17g\\n", (double){struct.name}_make().{field.name});')
    return "\n".join(lines + ["    return 0;", "}", ""])


def output(text, folder_of_header, compiler):
    """Pairs of a name and a number, which a program prints. It is linked without the library, so that
    functions stay undefined."""
    with tempfile.TemporaryDirectory() as folder:
        source, binary = pathlib.Path(folder, "layout.c"), pathlib.Path(folder, "layout")
        source.write_text(text)
        flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-DPELAGIC_STATIC", f"-I{folder_of_header}"]
        if "(*check_" in text:
            subprocess.run([compiler, *flags, "-fsyntax-only", source], check=True)
            source.write_text("\n".join(line for line in text.split("\n") if "(*check_" not in line))
        subprocess.run([compiler, *flags, source, "-o", binary], check=True)
        lines = subprocess.run([binary], check=True, capture_output=True, text=True).stdout.splitlines()
    return [line.split() for line in lines]


def compiled_layout(header, folder_of_header, compiler):
    return {name: int(number) for name, number in output(program(header), folder_of_header, compiler)}


def compiled_defaults(header, folder_of_header, compiler):
    return {name: float(number) for name, number in output(program_of_defaults(header), folder_of_header, compiler)}


def read_defaults(header):
    """The same names and numbers from the parsed header."""
    enumerators = {enum.prefix + name: value for enum in header.enums for name, value, _ in enum.values}
    values = {f"{struct.name}.{field.name}": struct.defaults.get(field.name, "0") for struct, field in numbers(header)}
    return {name: float(enumerators.get(value, value)) for name, value in values.items()}


def read_layout(header):
    """The same names and numbers from the parsed header."""
    numbers = {}
    for struct in header.structs:
        size, offsets, _ = c_header.layout_of(header, struct)
        numbers[struct.name] = size
        numbers.update({f"{struct.name}.{field}": offset for field, offset in offsets.items()})
    for enum in header.enums:
        numbers.update({enum.prefix + name: value for name, value, _ in enum.values})
    return numbers


def differences(there, here):
    return [f"{name}: C has {there.get(name)}, not {here.get(name)}" for name in sorted(there.keys() | here.keys())
            if there.get(name) != here.get(name)]
