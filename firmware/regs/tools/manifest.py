"""Digests of what the map is made from and of what was made. In: two folders of the same layout. Out: generated.manifest.

`cargo test` compares them without any Python: a source edited without regenerating, or an output edited by hand, is found.
"""
import pathlib
import sys


def fnv1a64(data):
    digest = 0xCBF29CE484222325
    for byte in data:
        digest = ((digest ^ byte) * 0x100000001B3) & 0xFFFFFFFFFFFFFFFF
    return digest


def lines(kind, root, files):
    for file in sorted(files):
        yield f"{kind} {fnv1a64(file.read_bytes()):016x} {file.relative_to(root).as_posix()}\n"


def main():
    repository, made, manifest = map(pathlib.Path, sys.argv[1:4])
    regs = repository / "firmware/regs"
    sources = [*regs.glob("rdl/*.rdl"), *regs.glob("tools/**/*"), regs / "regenerate"]
    sources = [file for file in sources if file.is_file() and file.suffix != ".pyc"]
    results = [file for file in made.rglob("*") if file.is_file()]
    text = "# kind, FNV-1a-64, path from the repository's root; written by firmware/regs/regenerate\n"
    text += "".join([*lines("source", repository, sources), *lines("output", made, results)])
    manifest.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
