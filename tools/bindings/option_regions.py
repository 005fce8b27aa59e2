"""The regions that options.py writes: each takes a Schema and gives lines without their indentation."""
import itertools
import re
import textwrap

from schema import UNITS, number_of

CPP_TYPES = {"double": "double", "float": "float", "int": "int", "uint32": "std::uint32_t", "bool": "bool"}
C_TYPES = {"double": "double", "float": "float", "int": "int32_t", "uint32": "uint32_t", "bool": "int32_t", "enum": "int32_t"}
COMMENT_WIDTH, C_WIDTH, CODE_WIDTH = 96, 110, 114


def named(text, name_of):
    """A text with its {names} as a language writes them."""
    return re.sub(r"\{(\w+)\}", lambda match: name_of(match[1]), text)


def camel_case(name):
    first, *others = name.split("_")
    return first + "".join(part[0].upper() + part[1:] for part in others)


def description(option, also=None, values=""):
    """The sentences about an option: what it is; its range. What its default stands for, and more."""
    text = named(option.text, str) + values
    if option.type not in ("enum", "bool", "uint32", "own") or option.shown:
        text += "; " + named(option.in_descriptions(), str)
    text += "."
    if option.derived and option.derivation:
        text += f" {option.also() if also is None else also}: {named(option.derivation, str)}."
    return text + (" " + named(option.more, str) if option.more else "")


def wrapped(text, first, others=None, width=COMMENT_WIDTH):
    """Lines of a text, which do not break within a range such as "[0, 1]"."""
    kept = re.sub(r"[\[(][^\[\]()]*\]", lambda match: match[0].replace(" ", "\0"), text)
    lines = textwrap.wrap(kept, width, initial_indent=first, subsequent_indent=first if others is None else others,
                          break_long_words=False, break_on_hyphens=False)
    return [line.replace("\0", " ") for line in lines]


# ---- C++ ----------------------------------------------------------------------------------------

def cpp_number(option, value):
    text = str(value)
    if option.type == "float" and re.search(r"[.e]", text):
        return text + "f"
    return {"True": "true", "False": "false"}.get(text, text)


def cpp_default(option):
    if option.records or option.own_type("C++"):
        return "{}"
    if option.enum:
        return f"{option.enum.name.split('::')[-1]}::{option.default.replace('-', '_')}"
    return cpp_number(option, option.default)


def cpp_type(option):
    if option.own_type("C++"):
        return option.own_type("C++")
    if option.records:
        return f"FixedList<{option.records.struct}, {option.max}>"
    return option.enum.name.split("::")[-1] if option.enum else CPP_TYPES[option.type]


def cpp_fields(schema):
    """The members of a struct."""
    lines = []
    options = [option for option in schema.options if option.is_in("C++")]
    for (type_, text), alike in itertools.groupby(options, lambda option: (cpp_type(option), description(option))):
        member = f"{type_} {', '.join(f'{option.name} = {cpp_default(option)}' for option in alike)};"
        lines += with_comment(member, text, f"  ///< {of_member(text)}", wrapped(sentence(text), "/// "))
    return aligned(lines, "  ///< ")


def aligned(lines, mark):
    """Lines whose comments begin in one column in each run of lines that have one."""
    result = []
    for has_mark, run in itertools.groupby(lines, lambda line: mark in line):
        parts = [line.split(mark) for line in run]
        column = max(len(part[0]) for part in parts)
        result += [f"{code:{column}}{mark}{comment[0]}" if has_mark else code for code, *comment in parts]
    return result


def sentence(text):
    """A text with a capital, unless it begins with a formula, and a full stop."""
    return (text[0].upper() if re.match(r"[a-z]+[ ,:;]", text) else text[0]) + text[1:].rstrip(".") + "."


def of_member(text):
    """A description as it stands on the line of its member."""
    return text.rstrip(".")


def with_comment(member, text, after, above, width=COMMENT_WIDTH):
    """A member with its description on its line, if that is one sentence and fits, else above it."""
    return [member + after] if len(member + after) < width and (width == C_WIDTH or ". " not in text) else [*above, member]


PI_IN_CPP = {"-2 pi": "-two_pi", "2 pi": "two_pi", "pi/180": "two_pi / 360", "4 pi/9": "2 * two_pi / 9",
             "-pi/2": "-half_pi", "pi/2": "half_pi"}
RESTRICTIONS = {"a power of two": "Restriction::powers_of_two", "an even number": "Restriction::even"}


def cpp_limits(option):
    if option.type == "uint32":
        return "0", "4294967295.0"
    if not option.limits():
        largest = f"std::numeric_limits<{option.type}>::max()"
        return "-" + largest, largest
    low, high, _ = option.limits()
    return PI_IN_CPP.get(low, low), PI_IN_CPP.get(high, high)


def cpp_table(schema):
    """The rows of a table of NumericField."""
    lines = []
    for option in schema.options:
        if option.type in ("enum", "bool", "records", "own"):
            continue
        is_above = option.type != "uint32" and option.limits() and option.limits()[2]
        restriction = RESTRICTIONS.get(option.must_be, "Restriction::above_min" if is_above else "")
        first = f'{{"{option.name}", &{schema.struct}::{option.name}, {", ".join(cpp_limits(option))},'
        rest = f'"{named(option.in_messages(), str)}"'
        if option.derived:
            rest += f", {restriction or 'Restriction::none'}, {option.also()}"
        elif restriction:
            rest += f", {restriction}"
        rest += "},"
        lines += [f"{first} {rest}"] if len(first) + len(rest) < CODE_WIDTH else [first, " " + rest]
    return lines


def cpp_enums(schema):
    """Enumerations of a namespace and their names."""
    lines = []
    for enum in schema.enums:
        lines += [""] if lines else []
        lines += wrapped(enum.text, "/// ") if enum.text else []
        if any(text for _, text in enum.values):
            lines.append(f"enum class {enum.name} {{")
            for (_, text), value in zip(enum.values, enum.cpp_values()):
                lines += ["    " + line for line in wrapped(sentence(named(text, str)), "/// ")] + [f"    {value},"]
            lines.append("};")
        else:
            lines.append(f"enum class {enum.name} {{ {', '.join(enum.cpp_values())} }};")
        lines += ["template <>", f"struct EnumNames<{enum.name}> {{"]
        array, names = f"    static constexpr std::array<std::string_view, {len(enum.values)}> all = {{", ", ".join(f'"{name}"' for name, _ in enum.values)
        lines += [f"{array}{names}}};"] if len(array + names) < CODE_WIDTH else [array, f"        {names}}};"]
        lines.append("};")
    return lines


# ---- the command line ---------------------------------------------------------------------------

def flag_of(option):
    suffix = UNITS[option.unit][0] if option.unit else ""
    return option.name.removesuffix(suffix).replace("_", "-")


def flags(schema):
    """The rows of a table of numeric flags and keys of files."""
    lines = []
    for option in schema.options:
        if option.enum or option.records:
            continue
        needs = f"Needs::{option.needs or 'nothing'}"
        first = f'{{"{flag_of(option)}", "{option.name}", "{option.flag_help or option.text}",'
        rest = f'help_group::{option.group}, {needs}, "{option.flag_default}", "{option.flag_accepted}"}},'
        lines += [f"{first} {rest}"] if len(first) + len(rest) < CODE_WIDTH else [first, " " + rest]
    return lines


def named_flags(schema):
    """Calls of visit for the flags of enumerations."""
    return [f'visit("{flag_of(option)}", &{schema.struct}::{option.name}, "{option.flag_help or option.text}", Needs::{option.needs or "nothing"});'
            for option in schema.options if option.enum]


def record_keys(schema):
    """Calls of visit for the keys of a record in files and on the command line."""
    return [f'visit("{option.key or flag_of(option).replace("-", "_")}", &{schema.struct}::{option.name}, "{option.flag_accepted}");'
            for option in schema.options]


def variable_of(schema):
    """What code calls a struct: the last word of its name."""
    return schema.c.split("_")[-1]


def checks(schema):
    """Checks of enumerations and lists in check()."""
    lines = []
    for option in schema.options:
        member = f"{variable_of(schema)}.{option.name}"
        if option.enum:
            lines += [f"if (static_cast<std::size_t>({member}) >= names_of<{option.enum.name}>().size())",
                      f'    return "{option.name} is no known model";']
        if option.records:
            check = f"check_{cpp_reader(option.records).removesuffix('_of')}"
            lines += [f'if (const std::string reason = check_records("{option.name}", {member}, {check});', "    !reason.empty())",
                      "    return reason;"]
    return lines


# ---- C ------------------------------------------------------------------------------------------

def c_comment(text):
    lines = wrapped(text, "/* ", " * ", C_WIDTH)
    lines[-1] += " */"
    return lines


def c_default_of(option):
    return option.default if option.c_default is None else option.c_default


def c_type(option):
    return option.own_type("C") or (option.records.c if option.records else C_TYPES[option.type])


def c_options(schema):
    """The options of the C struct, those of 4 bytes first, so that the struct has no holes."""
    options = [option for option in schema.options if option.is_in("C")]
    options += [option.count() for option in options if option.records]
    return sorted(options, key=lambda option: option.type in ("double", "records", "own"))


def c_fields(schema):
    """The members of a C struct after struct_size."""
    lines = []
    for (type_, text), options in itertools.groupby(c_options(schema), lambda option: (c_type(option), c_description(option))):
        names = [option.name + (f"[{option.max}]" if option.records else "") for option in options]
        member = f"{type_} {', '.join(names)};"
        lines += with_comment(member, text, f" /* {of_member(text)} */", c_comment(sentence(text)), C_WIDTH)
    return aligned(lines, " /* ")


def c_description(option):
    if "C" in (option.texts or {}):
        return " ".join(option.texts["C"].split())
    text = description(option, also=c_default_of(option) if option.derived_value is None else None)
    if option.type == "bool":
        return f"Nonzero {text}"
    return f"{option.enum.c}...; {text}" if option.enum else text


def c_enums(schema):
    lines = []
    for enum in schema.enums:
        lines += [""] if lines else []
        if not any(text for _, text in enum.values):
            lines.append(f"enum {{ {', '.join(f'{name} = {i}' for i, name in enumerate(enum.c_values()))} }};")
            continue
        lines.append("enum {")
        values = []
        for i, ((_, text), name) in enumerate(zip(enum.values, enum.c_values())):
            comma = "," if i + 1 < len(enum.values) else ""
            about = named(text, str)
            values += with_comment(f"{name} = {i}{comma}", about, f" /* {of_member(about)} */", c_comment(sentence(about)), C_WIDTH)
        lines += ["    " + line for line in aligned(values, " /* ")] + ["};"]
    return lines


def c_make(schema):
    """The function that returns the defaults."""
    name, zeros = variable_of(schema), "PELAGIC_RECORD" if schema.is_record else "PELAGIC_ZEROS"
    statements = []
    for option in c_options(schema):
        value = option.enum.c_values()[[v for v, _ in option.enum.values].index(option.default)] if option.enum else c_default_of(option)
        if str(value) not in ("0", "False") and (not option.enum or option.enum.c_values()[0] != value):
            statements.append(f"{name}.{option.name}\0=\0{value};")
    head = f"static inline {schema.c} {schema.c}_make(void) {{"
    if not statements and not schema.is_record:
        return [f"{head} PELAGIC_MAKE({schema.c}); }}"]
    text = " ".join([f"{zeros}({schema.c},\0{name});", *statements, f"return\0{name};"])
    body = textwrap.wrap(text, C_WIDTH, initial_indent="    ", subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)
    return [head, *(line.replace("\0", " ") for line in body), "}"]


def c_struct(schema):
    """A C struct of nothing but options, and the function that returns the defaults."""
    size = [] if schema.is_record else ["uint32_t struct_size;"]
    return [f"typedef struct {schema.c} {{", *("    " + line for line in size + c_fields(schema)), f"}} {schema.c};", *c_make(schema)]


def c_checks(schema):
    """Checks that C and C++ number the values of enumerations alike."""
    return [f"static_assert({c} == static_cast<int>({enum.name}::{cpp}));"
            for enum in schema.enums for c, cpp in zip(enum.c_values(), enum.cpp_values())]


def cpp_reader(schema):
    """The function that reads a record of C: wave_system_of(from, prefix). That which writes one begins with c_."""
    return schema.c.removeprefix("pelagic_") + "_of"


def c_reads(schema):
    """Statements that read a C struct `from` into a C++ one `to`; `prefix` begins names in messages of enumerations. Options
    with types of their own are converted by hand."""
    lines = []
    for option in schema.options:
        if not option.is_in("C") or not option.is_in("C++") or option.types:
            continue
        member = f"from.{option.name}"
        if option.records:
            member = f'records_of({member}, from.{option.count().name}, prefix, "{option.name}", {cpp_reader(option.records)})'
        elif option.enum:
            member = f'enum_of<{option.enum.name}>({member}, prefix, "{option.name}", "one of {option.enum.c}...")'
        elif option.type == "bool":
            member += " != 0"
        elif option.c_default is not None:
            member = f"{member} == {option.c_default} ? {option.default} : {member}"
        lines.append(f"to.{option.name} = {member};")
    return lines


def c_writes(schema):
    """Statements that write a C++ struct `from` to a C one `to`."""
    lines = []
    for option in schema.options:
        if not option.is_in("C"):
            continue
        member = f"from.{option.name}"
        if option.records:
            lines.append(f"to.{option.count().name} = write_records({member}, to.{option.name}, c_{cpp_reader(option.records)});")
            continue
        if option.enum:
            member = f"static_cast<std::int32_t>({member})"
        elif option.c_default is not None:
            member = f"{member} == {option.default} ? {option.c_default} : {member}"
        lines.append(f"to.{option.name} = {member};")
    return lines


# ---- Python, TypeScript, Markdown -----------------------------------------------------------------

PYTHON_TYPES = {"double": "float", "float": "float", "int": "int", "uint32": "int", "bool": "bool", "enum": "str"}


def python_type(option):
    if option.own_type("Python"):
        return option.own_type("Python")
    return f"tuple[{option.records.struct}, ...]" if option.records else PYTHON_TYPES[option.type]


def python_default(option):
    if option.own_default("Python"):
        return option.own_default("Python")
    if option.own_type("Python"):
        return "None"
    if option.records:
        return "()"
    if option.enum:
        return f'"{option.default}"'
    text = str(option.default)
    return text if option.type in ("int", "uint32", "bool") or re.search(r"[.e]", text) else text + ".0"


def python_fields(schema):
    """The fields of a dataclass."""
    lines = []
    for option in schema.options:
        if not option.is_in("Python"):
            continue
        words = [f'"{name}"' + (f" ({named(about, str).rstrip('.')})" if about else "") for name, about in option.enum.values] if option.enum else []
        text = sentence(description(option, values=": " + ", ".join(words) if words else ""))
        lines.append(f"{option.name}: {python_type(option)} = {python_default(option)}")
        lines += wrapped('"""' + text + '"""', "")
    return lines


def python_options(schema):
    """The options of a function, switches first."""
    return sorted((option for option in schema.options if option.is_in("Python")), key=lambda option: option.type == "own")


def python_parameters(schema):
    """The parameters of a function."""
    return [f"{option.name}: {python_type(option)} = {python_default(option)}," for option in python_options(schema)]


def python_arguments(schema):
    """The parameters in a docstring."""
    lines = []
    for option in python_options(schema):
        lines += wrapped(f"{option.name}: {description(option)}", "", "    ", COMMENT_WIDTH - 8)
    return lines


def python_names(schema):
    """Entries of a dictionary: the option and the prefix of its constants in C."""
    return [f'"{option.name}": "{option.enum.c}",' for option in schema.options if option.enum]


def javascript_number(value):
    return repr(float(value)).removesuffix(".0") if not isinstance(value, bool) else str(value).lower()


def typescript_text(option):
    """What it is, unit: range. More. Default."""
    if option.texts and "TypeScript" in option.texts:
        return " ".join(option.texts["TypeScript"].split())
    if option.own_type("TypeScript"):
        return " ".join(sentence(named(text, camel_case)) for text in (option.text, option.more) if text)
    text = sentence(named(option.text, camel_case)).removesuffix(".")
    if option.enum:
        text += "." + "".join(f' "{name}": {named(about, camel_case).rstrip(".")}.' for name, about in option.enum.values if about)
    elif option.type == "bool":
        text += "."
    else:
        shown = f", {named(option.shown, camel_case)}" if option.shown else ""
        text += (f", {UNITS[option.unit][1]}" if option.unit else "") + f": {named(option.in_messages(), camel_case)}{shown}."
    if option.more:
        text += " " + named(option.more, camel_case)
    if option.required:
        return text
    if option.records:
        return f"{text} Default: none."
    default = f'"{option.default}"' if option.enum else javascript_number(option.default)
    return f"{text} Default {default}" + (f": {named(option.derivation, camel_case)}." if option.derived and option.derived_value is None else ".")


def typescript_fields(schema):
    """The properties of an interface."""
    lines = []
    for option in schema.options:
        if not option.is_in("TypeScript"):
            continue
        text = typescript_text(option)
        comment = f"/** {text} */"
        lines += [comment] if len(comment) <= COMMENT_WIDTH else ["/**"] + wrapped(text, " * ") + [" */"]
        words = " | ".join(f"'{name}'" for name, _ in option.enum.values) if option.enum and not option.types else option.own_type("TypeScript")
        type_ = f"{option.records.struct}[]" if option.records else "boolean" if option.type == "bool" else "number"
        lines.append(f"{camel_case(option.name)}{'' if option.required else '?'}: {words or type_};")
    return lines


def typescript_names(schema):
    """Elements of a list of names."""
    return [f'"{camel_case(option.name)}",' for option in schema.options if option.is_in("TypeScript")]


def word_options(schema):
    """Elements of a list of options whose values are words."""
    return [f'word_option<{option.enum.name}, &{schema.struct}::{option.name}>("{camel_case(option.name)}"),'
            for option in schema.options if option.enum]


# ---- Blender --------------------------------------------------------------------------------------

BLENDER_UNITS = {"m": ', subtype="DISTANCE"', "rad": ', subtype="ANGLE"', "m/s": ', unit="VELOCITY"', "s": ', unit="TIME_ABSOLUTE"'}


def blender_name(option):
    return option.blender.get("name", option.name.removesuffix(UNITS[option.unit][0]) if option.unit else option.name)


def blender_property(option, label_of):
    """The class of a property and its arguments."""
    if option.enum:
        items = [f'    ("{name}", "{name}", "{sentence(named(text, label_of)).removesuffix(".")}", {i}),' for i, (name, text) in enumerate(option.enum.values)]
        return "EnumProperty", [f'default="{option.default}", items=(', *items[:-1], items[-1].rstrip(",") + "),"]
    low, high = (number_of(limit) for limit in option.limits()[:2]) if option.type != "uint32" else (0, 0)
    low = min(low, 0) if option.derived else option.blender.get("min", low)
    if option.must_be == "a power of two":
        powers = [2 ** k for k in range(int(number_of(option.limits()[0])).bit_length() - 1, int(high).bit_length())]
        return "EnumProperty", [f'default="{option.default}",',
                                f'items=[("0", "Automatic", "{named(option.derivation, label_of)}", 0)] + [(str(n), str(n), "", n) for n in {tuple(powers)}],']
    default = f"{float(c_default_of(option)):.10g}"
    if option.type in ("int", "uint32"):
        return "IntProperty", [f"default={default}, min={int(low)}" + (f", max={int(high)}" if high else "") + ","]
    unit = BLENDER_UNITS.get(option.unit, ', subtype="FACTOR"' if (low, high) == (0, 1) else "")
    return "FloatProperty", [f"default={default}, min={low:.10g}, max={high:.10g}{unit},"]


def blender_options(schema):
    return [option for option in schema.options if option.blender]


def blender_properties(schema):
    """Properties of a PropertyGroup."""
    labels = {option.name: option.blender["label"] for option in blender_options(schema)}
    label_of = lambda name: labels.get(name, name)
    lines = []
    for option in blender_options(schema):
        kind, arguments = blender_property(option, label_of)
        text = sentence(named(option.blender.get("text", option.text), label_of)).removesuffix(".")
        if option.derived and kind != "EnumProperty":
            text += f"; 0: {named(option.derivation, label_of)}" if c_default_of(option) == 0 else ""
        lines += [f"{blender_name(option)}: {kind}(", f'    name="{option.blender["label"]}", update=changed,']
        lines += ["    " + line for line in arguments]
        described = wrapped(text, '"', '"')
        lines += [f"    {'description=' if i == 0 else '            '}{line}{' ' if i + 1 < len(described) else ''}\"" + (")" if i + 1 == len(described) else "")
                  for i, line in enumerate(described)]
    return lines


def blender_settings(schema):
    """Rows of a table: the property, the field of the library, the panel, the seas that have it."""
    return [f'Setting("{blender_name(option)}", "{option.name}", "{option.blender["panel"]}", "{option.needs}"),' for option in blender_options(schema)]


def page_values(option):
    """The columns of a page's table: what an option accepts, and its default."""
    if option.types:
        is_default = option.enum and not option.own_type("C++")
        return option.shown, f"`{option.default}`" if is_default else "required" if option.required else "none" if option.type == "own" else "derived"
    if option.enum:
        return ", ".join(f"`{name}`" for name, _ in option.enum.values), f"`{option.default}`"
    if option.type == "bool":
        return "", "on" if option.default else "off"
    is_derived = option.derived and option.derived_value is None
    number = str(option.default) if len(str(option.default)) < 10 else f"{option.default:.4g}"
    default = "none" if option.records else "required" if option.required else "derived" if is_derived else number
    return named(option.in_descriptions(), str), default


def page_meaning(option):
    text = named(option.text, str)
    if option.derivation:
        of_c = "" if option.c_default is None else f" (C: {option.c_default})"
        text += f"; {option.also()}{of_c}: {named(option.derivation, str)}"
    if re.match(r"\d+: ", option.more):
        text += "; " + named(option.more.split(". ")[0].rstrip("."), str)
    return text


def page_table(schema):
    """A page's table. Without any range it lacks that column."""
    rows = [("member", "range", "default", "meaning")]
    rows += [(f"`{option.name}`", *page_values(option), page_meaning(option)) for option in schema.options if option.is_in("C++")]
    if not any(row[1] for row in rows[1:]):
        rows = [(row[0], *row[2:]) for row in rows]
    lines = [f"| {' | '.join(row)} |" for row in rows]
    return [lines[0], "|---" * len(rows[0]) + "|", *lines[1:]]


def number_table(schema):
    """A page's table of the numbers that languages without radians have."""
    return ["| property | | range | default |", "|---|---|---|---|"] + [
        f"| `{option.name}` | {named(option.text, str)} | {named(option.in_messages(), str)} | {javascript_number(option.default)} |"
        for option in schema.options if not option.enum and not option.records and option.unit != "rad"]


RENDERERS = {
    "members": cpp_fields, "table": cpp_table, "enumerations": cpp_enums, "flags": flags, "named-flags": named_flags,
    "checks": checks, "record-keys": record_keys, "c-members": c_fields, "c-enumerations": c_enums, "c-make": c_make, "c-struct": c_struct,
    "c-checks": c_checks, "c-reads": c_reads, "c-writes": c_writes, "python-fields": python_fields,
    "python-names": python_names, "python-parameters": python_parameters, "python-arguments": python_arguments,
    "properties": typescript_fields, "property-names": typescript_names, "word-options": word_options,
    "blender-properties": blender_properties, "blender-settings": blender_settings, "table-of-page": page_table,
    "numbers-of-page": number_table,
}
