#!/bin/sed -f
# Doxygen reads the plain comments of pelagic.h: those after a declaration describe it, others what follows.
s|\([;,{]\) *\/\*\([^*<]\)|\1 /**<\2|
s|^\( *\)\/\*\([^*]\)|\1/**\2|
