#!/usr/bin/env python3
"""Checks the project's Markdown pages, and prints each finding with its file and line.

usage: docs_check.py SOURCE_FOLDER CHECK [PELAGIC]

links      relative links, anchors and images exist
options    options and subcommands of `pelagic` in code exist in PELAGIC's help texts
figures    facts of tests/docs_figures.txt have one value on all pages, or roundings of it; the
           number of golden hashes is right
platforms  README's table of platforms has the rows of docs/platforms.md
words      README, CHANGELOG and all pages stay within their numbers of words; generated tables are
           not counted
"""
import pathlib
import re
import subprocess
import sys

MAX_WORDS = {"README.md": 900, "CHANGELOG.md": 500, "docs/integrations/engine.md": 900}
MAX_WORDS_OF_ALL = 28000 + MAX_WORDS["docs/integrations/engine.md"]
SHELLS = {"", "sh", "bash", "console", "shell"}  # languages of code blocks that may have commands
FENCE = re.compile(r"^\s*(```+|~~~+)\s*(\w*)")
GENERATED = re.compile(r"<!-- generated.*?<!-- /generated -->", re.S)
INLINE_CODE = re.compile(r"(`+)([^`]+)\1(?!`)")
COMMAND = re.compile(r"(?:[^#]*?[\s/$\"']|)pelagic\s+([a-z][a-z-]*|(?=-))(?![\w.:=])")
# Inline options of pelagic-compare, bench/instructions, sbatch, parallel, the OpenXR example,
# unity/pack.py and release.sh.
OTHER_OPTIONS = {"--windows", "--android", "--ndk", "--quick", "--bytes", "--array", "--cpus-per-task", "--mem", "--sshlogin", "--hashes"}


class Page:
    """A file's lines by kind: prose, code (with its language), or a row of a table."""

    def __init__(self, path, name):
        self.path, self.name, self.lines = path, name, path.read_text(encoding="utf-8").splitlines()
        self.kinds = list(self.kinds_of_lines())
        self.prose = "\n".join(line if kind in ("prose", "table") else "" for line, kind in zip(self.lines, self.kinds))

    def kinds_of_lines(self):
        fence, language, blank, code = None, "", True, False
        for line in self.lines:
            match = FENCE.match(line)
            if fence:
                yield f"code {language}"
                if match and match[1].startswith(fence) and not match[2]:
                    fence = None
            elif match:
                fence, language = match[1], match[2]
                yield f"code {language}"
            elif line.startswith("    ") and (blank or code):
                code = True
                yield "code "
                continue
            else:
                yield "table" if line.startswith("|") else "prose"
            code, blank = code and not line.strip(), not line.strip()

    def anchors(self):
        """The anchors that GitHub gives to headings, and those of HTML."""
        seen, anchors = {}, set(re.findall(r'<a (?:id|name)="([^"]+)"', self.prose))
        for line, kind in zip(self.lines, self.kinds):
            if kind == "prose" and (match := re.match(r"#{1,6}\s+(.*?)\s*#*$", line)):
                text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", match[1])
                anchor = re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")
                count = seen[anchor] = seen.get(anchor, -1) + 1
                anchors.add(f"{anchor}-{count}" if count else anchor)
        return anchors

    def line_of(self, position):
        return self.prose.count("\n", 0, position) + 1

    def inline_code(self):
        for match in INLINE_CODE.finditer(self.prose):
            yield self.line_of(match.start()), match[2].replace("\n", " ")

    def commands(self):
        """Lines of code blocks for shells, joined where they end with a backslash."""
        joined, first = "", None
        for number, (line, kind) in enumerate(zip(self.lines, self.kinds), 1):
            if not (kind.startswith("code") and kind.split(" ")[1] in SHELLS):
                continue
            joined, first = joined + line.removesuffix("\\"), first or number
            if not line.endswith("\\"):
                yield first, joined
                joined, first = "", None


def pages_of(source):
    for path in sorted(source.rglob("*.md")):
        inside = path.relative_to(source)
        if not any(part.startswith(".") or part in ("build", "node_modules", "out") for part in inside.parts):
            yield Page(path, inside.as_posix())


def is_documentation(page):
    return page.name.startswith("docs/") or page.name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md")


def check_links(pages, source, _):
    anchors = {page.path.resolve(): page.anchors() for page in pages}
    for page in pages:
        text = INLINE_CODE.sub(lambda code: re.sub(".", " ", code[0]), page.prose)
        for match in re.finditer(r"\]\(<?([^)\s>]+)|^\[[^\]]+\]:\s*(\S+)|(?:src|href)=\"([^\"]+)\"", text, flags=re.M):
            link = match[1] or match[2] or match[3]
            if re.match(r"[a-z]+:", link):
                continue
            path, _, anchor = link.partition("#")
            target = (page.path.parent / path).resolve() if path else page.path.resolve()
            if not target.exists() or not target.is_relative_to(source):
                yield f"{page.name}:{page.line_of(match.start())}: {link}: no such file"
            elif anchor and target in anchors and anchor not in anchors[target]:
                yield f"{page.name}:{page.line_of(match.start())}: {link}: no such heading"


def options_of(pelagic, *words):
    text = subprocess.run([pelagic, *words, "--help"], capture_output=True, text=True, check=True).stdout
    names = re.findall(r"^\s+((?:-\w\b,\s*)?--[\w,-]+|-\w\b)", text, flags=re.M)
    return text, {option.strip() for name in names for option in name.split(",")}


def check_options(pages, _, pelagic):
    text, common = options_of(pelagic)
    names = re.findall(r"^  ([a-z]+) ", text.partition("Commands:")[2].partition("\n\n")[0], flags=re.M)
    accepted = {"": common} | {name: options_of(pelagic, name)[1] for name in names}
    known = set().union(*accepted.values(), OTHER_OPTIONS)
    commands = 0
    for page in pages:
        for number, code in [*page.commands(), *page.inline_code()]:
            for command in re.split(r"[|;&()]|\s#", code):
                match = COMMAND.match(command)
                if not match or re.search(r"\b(import|from|install|target|package)\b", command[:match.start(1)]):
                    continue
                commands += 1
                if match[1] not in accepted:
                    yield f"{page.name}:{number}: pelagic {match[1]}: no such subcommand"
                    continue
                for option in re.findall(r"(?<![\w./-])(--[a-z][\w-]*|-[a-z]\b)", command[match.end(1):]):
                    if option not in accepted[match[1]]:
                        yield f"{page.name}:{number}: pelagic {match[1]} {option}: no such option"
        for number, code in page.inline_code():
            if (match := re.match(r"(--[a-z][\w-]*)", code)) and match[1] not in known:
                yield f"{page.name}:{number}: {match[1]}: no subcommand has this option"
    if len(known) < 50 or commands < 50:
        yield f"{len(known)} options and {commands} commands were read, expected more"


def rounded(values):
    """The numbers with the decimals of the least precise one, which has two significant digits at
    least; other texts as they are."""
    if not all(re.fullmatch(r"\d+\.\d+", value) and len(value.replace(".", "").lstrip("0")) > 1 for value in values):
        return set(values)
    decimals = min(len(value.partition(".")[2]) for value in values)
    return {f"{float(value):.{decimals}f}" for value in values}


def check_figures(pages, source, _):
    for line in (source / "tests/docs_figures.txt").read_text(encoding="utf-8").splitlines():
        if not line or line.startswith("#"):
            continue
        fact, pattern = line.split(": ", 1)
        found = {}
        for page in pages:
            for match in re.finditer(pattern.replace(" ", r"\s+"), "\n".join(page.lines)):
                number = "\n".join(page.lines).count("\n", 0, match.start()) + 1
                found.setdefault(match[1], []).append(f"{page.name}:{number}")
        if len(rounded(found)) != 1 or sum(map(len, found.values())) < 2:
            values = [f"{value} in {', '.join(places)}" for value, places in found.items()]
            yield f"{fact}: {'; '.join(values) or 'on no page'}"
    names = [line.split()[0] for line in (source / "tests/golden/hashes.txt").read_text(encoding="utf-8").splitlines()]
    frames, foam, queries = (sum(part in name for name in names) for part in ("@", "foam-", "queries-"))
    text = f"{frames} frames ({frames // 2} seas at 0 s and 12.34 s), {foam} foam maps, {queries} batches of queries"
    if not any(text in line for page in pages for line in page.lines):
        yield f"tests/golden/hashes.txt has {text}, on no page"


def check_platforms(pages, *_):
    def rows(name):
        page = next(page for page in pages if page.name == name)
        table = "\n".join(page.lines).partition("| platform |")[2].partition("\n\n")[0]
        return [[cell.strip() for cell in row.split("|")[1:4]] for row in table.splitlines()[2:]]

    expected = [[re.sub(r"\]\((?!http)", "](docs/", row[0]), *row[1:]] for row in rows("docs/platforms.md")]
    if len(expected) < 9:
        yield f"docs/platforms.md: {len(expected)} rows were read, expected more"
    for row, other in zip(expected, rows("README.md") + [None] * len(expected)):
        if row != other:
            yield f"README.md: a row of the table of platforms is {other}, expected {row}"


def check_words(pages, *_):
    words = {page.name: len(GENERATED.sub("", page.path.read_text(encoding="utf-8")).split()) for page in filter(is_documentation, pages)}
    total = sum(words.values())
    print(f"{total} words on {len(words)} pages; limit {MAX_WORDS_OF_ALL}")
    if total > MAX_WORDS_OF_ALL:
        yield f"all pages: {total} words, limit {MAX_WORDS_OF_ALL}"
        yield from (f"    {count} {name}" for name, count in sorted(words.items(), key=lambda item: -item[1])[:10])
    for name, limit in MAX_WORDS.items():
        if words[name] > limit:
            yield f"{name}: {words[name]} words, limit {limit}"


def main():
    source, check = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
    pages = list(pages_of(source))
    if sum(map(is_documentation, pages)) < 20:
        sys.exit(f"{len(pages)} pages were read, expected the whole tree")
    findings = list(globals()[f"check_{check}"](pages, source, sys.argv[3] if len(sys.argv) > 3 else None))
    print("\n".join(findings))
    sys.exit(1 if findings else 0)


main()
