"""Writes the table of functions in docs/api.md."""
BEGIN, END = "<!-- generated: functions -->", "<!-- /generated -->"


def thread_rule(function):
    """The first word or two of the rule in the function's comment."""
    at = function.doc.find("Threads: ")
    if at < 0:
        raise ValueError(f"{function.name}: no rule for threads")
    return "any" if function.doc[at:].startswith("Threads: any") else "one"


def names_of(functions):
    return ", ".join(f"`{f.name.removeprefix('pelagic_')}`{' *' if f.is_experimental else ''}" for f in functions)


def table(header):
    lines = ["| section of `pelagic.h` | from any thread | from one thread at a time |", "|---|---|---|"]
    for section in dict.fromkeys(function.section for function in header.functions):
        here = [function for function in header.functions if function.section == section]
        any_, one = ([f for f in here if thread_rule(f) == rule] for rule in ("any", "one"))
        lines.append(f"| {section} | {names_of(any_)} | {names_of(one)} |")
    return "\n".join(lines)


def write(header, page):
    begin = page.index(BEGIN) + len(BEGIN)
    end = page.index(END, begin)
    return f"{page[:begin]}\n{table(header)}\n{page[end:]}"
