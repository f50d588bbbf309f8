// Files of the build in a program's read-only data.
#pragma once

/// Declares `name` and `name_end`, the bounds of the file's bytes. Outside of all namespaces; `file`: a string literal.
#define ANTIPODE_EMBED(name, file)                                                                    \
    __asm__(".pushsection .rodata\n" #name ":\n.incbin \"" file "\"\n" #name "_end:\n.popsection\n"); \
    extern "C" const char name[], name##_end[]  // NOLINT(bugprone-macro-parentheses): names that are declared
