#!/usr/bin/env bash
# Prints the version of the sources.
sed -nE 's/^#define PELAGIC_VERSION_(MAJOR|MINOR|PATCH) ([0-9]+)$/\2/p' "$(dirname "$0")/../capi/pelagic.h" | paste -sd.
