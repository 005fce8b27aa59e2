"""Writes the table of functions in docs/api.md."""
BEGIN, END = "<!-- generated: functions -->", "<!-- /generated -->"


def thread_rule(header, function):
    """The first word of the rule in the function's comment, or of the rule that the header states for
    all functions: a first argument that is a handle belongs to one thread at a time."""
    if (at := function.doc.find("Threads: ")) >= 0:
        return "any" if function.doc.startswith("any", at + len("Threads: ")) else "one"
    first = function.parameters[0].type if function.parameters else None
    return "one" if first and header.is_handle(first.base) and len(first.pointers) == 1 else "any"


def names_of(functions):
    return ", ".join(f"`{f.name.removeprefix('pelagic_')}`{' *' if f.is_experimental else ''}" for f in functions)


def table(header):
    lines = ["| section of `pelagic.h` | from any thread | from one thread at a time |", "|---|---|---|"]
    for section in dict.fromkeys(function.section for function in header.functions):
        here = [function for function in header.functions if function.section == section]
        any_, one = ([f for f in here if thread_rule(header, f) == rule] for rule in ("any", "one"))
        lines.append(f"| {section} | {names_of(any_)} | {names_of(one)} |")
    return "\n".join(lines)


def write(header, page):
    begin = page.index(BEGIN) + len(BEGIN)
    end = page.index(END, begin)
    return f"{page[:begin]}\n{table(header)}\n{page[end:]}"
