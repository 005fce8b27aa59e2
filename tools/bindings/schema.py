"""Reads and checks the descriptions of options, schema/*.toml. schema/README.md describes their keys."""
import dataclasses
import math
import re
import tomllib

# Unit of an option: the end of its name, and the word for it.
UNITS = {"m": ("_m", "metres"), "s": ("_s", "seconds"), "rad": ("_rad", "radians"), "m/s": ("_mps", "metres per second"),
         "m2": ("_m2", "square metres"), "m2/s": ("_m2ps", "square metres per second"), "mm": ("_mm", "millimetres"),
         "kg": ("_kg", "kilograms"), "kg/m3": ("_kgpm3", "kilograms per cubic metre"), "1/s": ("_per_s", "per second"),
         "1/(m2 s)": ("_per_m2_s", "per square metre and second")}
TYPES = {"double", "float", "int", "uint32", "bool"}
LANGUAGES = {"C++", "C", "Python", "TypeScript"}
CONDITIONS = {"", "a power of two", "an even number"}
OPTION_KEYS = {"name", "unit", "type", "enum", "default", "c_default", "range", "accepted", "shown", "must_be", "derived",
               "derived_value", "derivation", "text", "more", "only", "needs", "group", "flag_help",
               "flag_default", "flag_accepted", "blender", "required", "records", "max", "key",
               "types", "defaults", "texts"}
SCHEMA_KEYS = {"struct", "c", "enum", "option"}


class SchemaError(ValueError):
    """One line: the file, the option, what is wrong and what is accepted."""


class Number(float):
    """A number that keeps its digits: 100e3."""
    def __new__(cls, text):
        number = super().__new__(cls, text)
        number.text = text
        return number

    def __str__(self):
        return self.text


@dataclasses.dataclass
class Enum:
    name: str       # C++: "Disturbance::Mode"
    values: list    # of (name as users write it, text)
    c: str = ""     # prefix of the constants
    text: str = ""

    def cpp_values(self):
        return [name.replace("-", "_") for name, _ in self.values]

    def c_values(self):
        return [self.c + name.replace("-", "_").upper() for name, _ in self.values]


@dataclasses.dataclass
class Option:
    name: str
    text: str
    type: str = "double"
    unit: str = ""
    enum: Enum = None
    default: object = 0
    c_default: object = None    # the value of C for "derived", if it is another
    range: str = ""
    accepted: str = ""          # the range in messages
    shown: str = ""             # the range in descriptions
    must_be: str = ""
    derived: str = ""           # what messages call the default that stands for a derived value
    derived_value: object = None
    derivation: str = ""
    more: str = ""
    only: list = None           # languages that have it; None: all
    needs: str = ""
    group: str = "sea"
    flag_help: str = ""
    flag_default: str = ""
    flag_accepted: str = ""
    blender: dict = None
    required: bool = False      # the default is not an accepted value
    records: "Schema" = None    # of a list: the schema of its elements, whose largest number is `max`
    max: int = 0
    types: dict = None          # types of languages that have another; without a type or an enum, the only languages that have it
    defaults: dict = None       # defaults of languages that have another
    texts: dict = None          # descriptions of languages that have another
    key: str = ""               # the name in texts of records, where it is not the member's without its unit

    def is_in(self, language):
        return language in self.types if self.type == "own" else self.only is None or language in self.only

    def own_type(self, language):
        """The type of a language that has another than the schema's, or None."""
        return (self.types or {}).get(language)

    def own_default(self, language):
        return (self.defaults or {}).get(language)

    @property
    def element(self):
        """What an element of a list is called: "system" of systems."""
        return self.name.removesuffix("s")

    def count(self):
        """The member of C that holds the number of elements."""
        return Option(f"{self.element}_count", f"number of {self.name}", "int", range=f"[0, {self.max}]")

    def limits(self):
        """Minimum and maximum as texts, and whether the minimum is left out. None: any finite number."""
        if self.range == "any":
            return None
        match = re.fullmatch(r"([\[(])(.+), (.+)\]", self.range)
        return match[2], match[3], match[1] == "("

    def also(self):
        """The accepted value that stands for a derived one, or None."""
        return (self.default if self.derived_value is None else self.derived_value) if self.derived else None

    def in_messages(self):
        return self.range_text(self.accepted) + (f", or {self.also()}: {self.derived}" if self.derived else "")

    def in_descriptions(self):
        return self.range_text(self.shown or self.accepted)

    def range_text(self, given):
        """A range, in which {names} of other options stand in braces."""
        if given:
            return given
        if self.records:
            return f"at most {self.max}"
        if self.type == "uint32":
            return "a whole number from 0 to 4294967295"
        if self.range == "any":
            return "a finite number"
        low, high, _ = self.limits()
        if self.must_be:
            return f"{self.must_be} from {low} to {high}"
        return f"{low} to {high}" if self.type == "int" else self.range


@dataclasses.dataclass
class Schema:
    file: str
    struct: str
    options: list
    enums: list
    c: str = ""
    is_record: bool = False     # an element of a list


def number_of(text):
    """The value of a limit: "-2 pi", "pi/180", "1e-6"."""
    match = re.fullmatch(r"(-?)(\d*) ?pi(?:/(\d+))?", text)
    if match:
        return (-1 if match[1] else 1) * float(match[2] or 1) * math.pi / float(match[3] or 1)
    return float(text)


def read_enums(file, table):
    for name, entry in table.items():
        values = [(v, "") if isinstance(v, str) else (v["name"], " ".join(v.get("text", "").split())) for v in entry["values"]]
        yield Enum(name, values, entry.get("c", ""), " ".join(entry.get("text", "").split()))


def read_option(file, entry, enums):
    name = entry.get("name", "an option without a name")
    where = f"{file}: {name}"
    if unknown := entry.keys() - OPTION_KEYS:
        raise SchemaError(f"{where} has the unknown key {min(unknown)}, accepted: {', '.join(sorted(OPTION_KEYS))}")
    for key in ("only", "types", "defaults", "texts"):
        if unknown := set(entry.get(key, ())) - LANGUAGES:
            raise SchemaError(f"{where} has {key} of the unknown language {min(unknown)}, accepted: {', '.join(sorted(LANGUAGES))}")
    is_own = "types" in entry and not {"type", "enum"} & entry.keys()
    for needed in ("name", *(["max"] if "records" in entry else [] if is_own else ["default"]), "text"):
        if needed not in entry:
            raise SchemaError(f"{where} has no {needed}")
    option = Option(**{**entry, "text": " ".join(entry["text"].split()), "more": " ".join(entry.get("more", "").split()),
                       "derivation": " ".join(entry.get("derivation", "").split())})
    if is_own:
        option.type = "own"
        return option
    if option.unit and option.unit not in UNITS:
        raise SchemaError(f"{where} has the unknown unit {option.unit}, accepted: {', '.join(UNITS)}")
    if option.unit and not name.endswith(UNITS[option.unit][0]):
        raise SchemaError(f"{where} has the unit {option.unit}, expected a name that ends in {UNITS[option.unit][0]}")
    if option.enum:
        option.enum = next((e for e in enums if e.name == option.enum), None)
        if not option.enum:
            raise SchemaError(f"{where} has the unknown enumeration {entry['enum']}, accepted: {', '.join(e.name for e in enums) or 'none'}")
        option.type = "enum"
        if option.default not in [value for value, _ in option.enum.values]:
            raise SchemaError(f"{where} has the default {option.default}, expected one of {', '.join(v for v, _ in option.enum.values)}")
        return option
    if option.records:
        if not name.endswith("s"):
            raise SchemaError(f"{where} is a list, expected a name that ends in s")
        option.type = "records"
        return option
    if option.type not in TYPES:
        raise SchemaError(f"{where} has the unknown type {option.type}, accepted: {', '.join(sorted(TYPES))}")
    if option.must_be not in CONDITIONS:
        raise SchemaError(f"{where} must be {option.must_be}, accepted: {', '.join(sorted(CONDITIONS - {''}))}")
    if option.type in ("bool", "uint32"):
        return option
    if option.range != "any" and not re.fullmatch(r"[\[(].+, .+\]", option.range):
        raise SchemaError(f"{where} has the range {option.range or 'none'}, expected [min, max], (min, max] or any")
    if option.limits() and option.default != option.also():
        low, high, is_above = option.limits()
        value = float(option.default)
        is_accepted = number_of(low) <= value <= number_of(high) and not (is_above and value == number_of(low))
        if is_accepted == option.required:
            raise SchemaError(f"{where} has the default {option.default}, " +
                              ("which is in its range though it is required" if is_accepted else f"which is out of its range {option.range}"))
    return option


def read_table(path):
    try:
        table = tomllib.loads(path.read_text(), parse_float=Number)
    except tomllib.TOMLDecodeError as error:
        raise SchemaError(f"{path.name}: {error}")
    if unknown := table.keys() - SCHEMA_KEYS:
        raise SchemaError(f"{path.name} has the unknown key {min(unknown)}, accepted: {', '.join(sorted(SCHEMA_KEYS))}")
    return table


def read_schema(file, table, enums):
    """A schema whose options may have enumerations of all files."""
    options = [read_option(file, entry, sum(enums.values(), [])) for entry in table["option"]]
    names = [option.name for option in options]
    if twice := [name for name in names if names.count(name) > 1]:
        raise SchemaError(f"{file} has {twice[0]} twice")
    return Schema(file, table["struct"], options, enums[file], table.get("c", ""))


def link_records(schemas):
    """Gives lists the schemas of their elements, which have no lists themselves."""
    for schema in schemas.values():
        for option in [option for option in schema.options if option.records]:
            element = schemas.get(option.records)
            if not element or any(inner.records for inner in element.options):
                raise SchemaError(f"{schema.file}: {option.name} is a list of {option.records}, expected a file of schema/ without lists")
            option.records, element.is_record = element, True


def read_schemas(folder):
    """The schemas of a folder by the names of their files."""
    tables = {path.name: read_table(path) for path in sorted(folder.glob("*.toml"))}
    enums = {file: list(read_enums(file, table.get("enum", {}))) for file, table in tables.items()}
    schemas = {file: read_schema(file, table, enums) for file, table in tables.items()}
    link_records(schemas)
    return schemas
