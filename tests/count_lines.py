#!/usr/bin/env python3
"""Prints how large the tree is: lines and files of code by directory, without generated files and regions, images and data.

    tests/count_lines.py [REVISION]     the working tree's tracked files, or those of a revision

A line is any line of a source, blank or not. "include edges" are the directories right of the colon in the lines of
sim in tests/include_edges.txt; "cascade cases" are lines outside docs that distinguish one from several cascades.
"""
import collections
import re
import subprocess
import sys

CODE = re.compile(r'\.(cpp|hpp|c|h|h\.in|hpp\.in|cpp\.in|py|sh|cs|js|mjs|ts|gd|glsl|hlsl|shader|cmake|html)$'
                  r'|(^|/)CMakeLists\.txt$')
GENERATED = re.compile(r'\.g\.cs$|\.g\.hpp$|\.g\.cpp$|(^|/)_native\.py$|(^|/)_generated[^/]*$')

GENERATED_REGION = re.compile(r'(?<=\n)[^\n]*generated from schema/.*?end of generated[^\n]*\n', re.S)


def git(*arguments):
    return subprocess.run(['git', *arguments], check=True, stdout=subprocess.PIPE).stdout.decode(errors='replace')


def main():
    revision = sys.argv[1] if len(sys.argv) > 1 else None
    names = (git('ls-tree', '-r', '--name-only', revision) if revision else git('ls-files')).splitlines()

    def text_of(name):
        if revision:
            return git('show', f'{revision}:{name}')
        try:
            with open(name, errors='replace') as file:
                return file.read()
        except OSError:  # deleted or a link to nothing
            return ''

    lines, files = collections.Counter(), collections.Counter()
    for name in names:
        if not CODE.search(name) or GENERATED.search(name):
            continue
        directory = name.split('/')[0] if '/' in name else '(top)'
        lines[directory] += len(GENERATED_REGION.sub('', text_of(name)).splitlines())
        files[directory] += 1
    for directory in sorted(lines):
        print(f'{directory:14} {files[directory]:5} files {lines[directory]:7} lines')
    tests = lines['tests']
    print(f'{"but tests":14} {sum(files.values()) - files["tests"]:5} files {sum(lines.values()) - tests:7} lines')
    readmes = sum(1 for name in names if name.split('/')[-1] == 'README.md')
    edges = sum(len(line.split(':')[1].split()) for line in text_of('tests/include_edges.txt').splitlines()
                if re.match(r'sim(/\w+)?:', line))
    grep = ['git', 'grep', '-IiE', '(one|several|single) cascades?', *([revision] if revision else []), '--', ':!docs']
    cases = len(subprocess.run(grep, stdout=subprocess.PIPE).stdout.splitlines())
    print(f'READMEs {readmes}, include edges of sim {edges}, cascade cases {cases}')


if __name__ == '__main__':
    main()
