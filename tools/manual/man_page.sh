#!/bin/sh
# Prints the manual page of `pelagic` in the man macros of troff, from its help texts.
# usage: man_page.sh PELAGIC
set -eu
pelagic=$1

# Escapes what troff would read as an escape, a hyphen or a request.
escaped() { sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^[.']/\\\\\\&&/"; }

# Makes a tagged paragraph of each option: its name ends at two blanks or with the line.
paragraphs() {
  awk '/^$/ { next }
    /^Usage: / { print ".SS \"" substr($0, 8) "\""; print description "."; next }
    NR == 1 { description = $0; next }
    /^  [^ ]/ { sub(/^  /, ""); name = $0; sub(/  .*/, "", name); text = substr($0, length(name) + 1)
                sub(/^ */, "", text); print ".TP"; print ".B " name; if (text != "") print text; next }
    /^   / { sub(/^ */, ""); print; next }
    { print ".PP"; print }'
}

printf '.TH PELAGIC 1 "" "%s" "User Commands"\n' "$("$pelagic" --version)"
cat <<'TEXT'
.SH NAME
pelagic \- simulate ocean waves and export them as maps, meshes and images
.SH SYNOPSIS
.B pelagic
.I COMMAND
[\fIOPTIONS\fR]
.SH DESCRIPTION
TEXT
"$pelagic" --help | sed -n 1p | escaped
echo .SH COMMANDS
for command in $("$pelagic" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
  "$pelagic" "$command" --help | escaped | paragraphs
done
cat <<'TEXT'
.SH EXIT STATUS
.TP
0
Success.
.TP
1
A file cannot be read or written.
.TP
2
An option, a value or an input file is invalid.
.TP
128 + signal
A signal stopped the command.
.SH ENVIRONMENT
.TP
.B PELAGIC_ISA
Instruction set without \fB\-\-isa\fR.
.SH EXAMPLES
.nf
TEXT
"$pelagic" --help | sed '1,/^Examples:/d' | escaped
echo .fi
