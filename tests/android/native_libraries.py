"""Small shared libraries, as applications get them: for tests of packages."""
import pathlib
import subprocess

SOURCE = pathlib.Path(__file__).resolve().parents[2]
FUNCTIONS = (SOURCE / "tests/abi/pelagic.symbols").read_text().split()
# What the NDK's crtbegin_so.o has: the API level, the NDK's name and its build.
NOTE = '.section .note.android.ident, "a", %note; .p2align 2; .long 8, 132, 1; .asciz "Android"; .long {}; .zero 128; .text'


def build(compiler, file, functions=FUNCTIONS, machine=None, needed="", page_bytes=4096, api_level=None, code="", options=()):
    """A library that exports the functions and needs nothing, or one other library. `machine` replaces the
    number of the processor in the file."""
    source = file.with_suffix(".c")
    note = f"__asm__({as_c_text(NOTE.format(api_level))});\n" if api_level else ""
    source.write_text(note + "".join(f"void {name}(void) {{}}\n" for name in functions) + code)
    other = []
    if needed:
        other = [file.parent / needed]
        subprocess.run([compiler, "-shared", "-fPIC", "-nostdlib", f"-Wl,-soname,{needed}", "-xc", "/dev/null", "-o", *other], check=True)
    subprocess.run([compiler, "-shared", "-fPIC", "-nostdlib", "-Wl,--no-as-needed", f"-Wl,-z,max-page-size={page_bytes}", *options, source, *other,
                    "-o", file], check=True)
    if machine:
        data = bytearray(file.read_bytes())
        data[18:20] = machine.to_bytes(2, "little")
        file.write_bytes(data)
    return file


def as_c_text(text):
    return '"' + text.replace('"', '\\"').replace("; ", "\\n") + '"'


def for_android(compiler, file, **options):
    return build(compiler, file, **{"page_bytes": 16384, "api_level": 29, **options})
