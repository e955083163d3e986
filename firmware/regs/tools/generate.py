"""What PeakRDL does not write, or not as needed. In: rdl/lucerna.rdl. Out: Rust, CMSIS-SVD, encodings in C and Markdown.

PeakRDL-rust is not used for the Rust: its register types can be made of a word only by `unsafe`, have no setters for what a
driver may only read (a device must build those), and reach the bus through raw pointers, while `Bus` is fallible and may be SPI.
PeakRDL's C header and Markdown leave out the values of encoded fields, so these are added.
"""
import argparse
import pathlib
import re
import textwrap

import jinja2
from systemrdl import RDLCompiler
from systemrdl.node import RegNode
from systemrdl.rdltypes import OnWriteType

HERE = pathlib.Path(__file__).parent


def paragraphs(text):
    return [" ".join(p.split()) for p in re.split(r"\n\s*\n", text or "") if p.strip()]


def rust_doc(text, indent=0, mark="///"):
    lead = " " * indent + mark
    text = re.sub(r"\[(\d+)\]", r"\\[\1\\]", text or "")  # a reference of a paper is no link
    blocks = [textwrap.wrap(p, 110 - len(lead) - 1, break_long_words=False) for p in paragraphs(text)]
    lines = []
    for number, block in enumerate(blocks):
        lines += ([lead] if number else []) + [f"{lead} {line}" for line in block]
    return "\n".join(lines)


def camel(name):
    return "".join(word.capitalize() for word in name.split("_"))


def mask(fields):
    return sum(((1 << f.width) - 1) << f.low for f in fields)


class Enum:
    def __init__(self, encode, owner):
        self.name, self.type = encode.type_name, camel(encode.type_name)
        self.title = owner.get_property("name")
        self.members = [
            dict(
                ident=camel(member.name),
                value=member.value,
                name=member.rdl_name or member.name.lower(),
                desc=" ".join((member.rdl_desc or "").split()),
                rdl=member.name,
            )
            for member in encode
        ]


class Field:
    def __init__(self, node):
        self.node, self.name = node, node.inst_name
        self.low, self.width = node.low, node.width
        self.title, self.desc = node.get_property("name"), " ".join(node.get_property("desc").split())
        self.reset_known = node.get_property("reset") is not None
        self.reset, self.mask = node.get_property("reset") or 0, ((1 << node.width) - 1) << node.low
        self.readable, self.writable = node.is_sw_readable, node.is_sw_writable
        self.pulse = bool(node.get_property("singlepulse"))
        self.clears = node.get_property("onwrite") == OnWriteType.woclr
        encode = node.get_property("encode")
        self.enum = Enum(encode, node) if encode else None
        self.exhaustive = bool(self.enum) and len(self.enum.members) == 1 << self.width

    @property
    def access(self):
        if self.clears:
            return "write 1 to clear"
        if self.pulse:
            return "write-only pulse"
        return {(1, 1): "read-write", (1, 0): "read-only", (0, 1): "write-only"}[self.readable, self.writable]


class Register:
    def __init__(self, node, block, prefix=""):
        self.node, self.name = node, prefix + node.inst_name
        self.type, self.full = camel(self.name), f"{block}.{self.name}"
        self.title, self.desc = node.get_property("name"), node.get_property("desc")
        self.offset = node.absolute_address
        self.fields = sorted((Field(f) for f in node.fields()), key=lambda f: f.low)
        self.reset = sum(f.reset << f.low for f in self.fields)
        self.readable = mask(f for f in self.fields if f.readable)
        self.writable = mask(f for f in self.fields if f.writable)
        self.pulses = mask(f for f in self.fields if f.pulse)
        self.clears = mask(f for f in self.fields if f.clears)
        # A register which is one number has no type of its own: its value is a plain u32.
        self.plain = len(self.fields) == 1 and self.fields[0].width == 32 and not self.fields[0].enum
        assert node.get_property("regwidth") == 32 and self.fields


class Counter:
    def __init__(self, node, block):
        self.name, self.type = node.inst_name, camel(node.inst_name)
        self.title, self.desc = node.get_property("name"), " ".join(node.get_property("desc").split())
        self.registers = [Register(r, block, f"{node.inst_name}.") for r in node.children()]
        for register in self.registers:
            register.desc = f"{self.desc} {register.desc}"
        self.low, self.high = (r.offset for r in self.registers)
        assert [r.inst_name for r in node.children()] == ["LO", "HI"] and self.high == self.low + 4


class Block:
    def __init__(self, nodes):
        first = nodes[0]
        self.name, self.title = first.inst_name, first.get_property("name")
        self.desc = first.get_property("desc")
        self.base, self.count = first.absolute_address, len(nodes)
        self.array = first.is_array
        self.stride = first.array_stride if self.array else first.size
        self.registers = [Register(r, self.name) for r in first.children() if isinstance(r, RegNode)]
        self.counters = [Counter(c, self.name) for c in first.children() if not isinstance(c, RegNode)]
        self.rows = []
        for index, node in enumerate(nodes):
            label = f"{self.name}[{index}]" if self.array else self.name
            self.rows += [Register(r, label) for r in node.children() if isinstance(r, RegNode)]
        self.rows += [r for c in self.counters for r in c.registers]
        seen, self.enums = set(), []
        for field in (f for r in self.registers for f in r.fields if f.enum):
            if field.enum.name not in seen:
                seen.add(field.enum.name)
                self.enums.append(field.enum)
        assert all(r.plain for r in self.registers) or not self.array, "an array block holds plain registers only"


def blocks(top):
    by_name = {}
    for node in top.children(unroll=True):
        by_name.setdefault(node.inst_name, []).append(node)
    return [Block(nodes) for nodes in by_name.values()]


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("rdl")
    arguments.add_argument("--rust", type=pathlib.Path, required=True, help="directory")
    arguments.add_argument("--svd", type=pathlib.Path, required=True, help="file")
    arguments.add_argument("--header", type=pathlib.Path, required=True, help="file, of the encodings")
    arguments.add_argument("--markdown", type=pathlib.Path, required=True, help="file, of the encodings")
    options = arguments.parse_args()

    compiler = RDLCompiler()
    compiler.compile_file(options.rdl)
    top = compiler.elaborate().top
    model = blocks(top)

    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(HERE / "templates"),
        undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True, keep_trailing_newline=True)
    environment.filters.update(
        doc=rust_doc, inner=lambda text: rust_doc(text, mark="//!"),
        snake=str.lower, hex=lambda value: f"0x{value:_X}", hex3=lambda value: f"0x{value:03X}")

    options.rust.mkdir(parents=True, exist_ok=True)
    for block in model:
        text = environment.get_template("block.rs.jinja").render(block=block)
        (options.rust / f"{block.name}.rs").write_text(text, encoding="utf-8")
    for name, file in [
        ("mod.rs.jinja", options.rust / "mod.rs"),
        ("svd.xml.jinja", options.svd),
        ("encodings.h.jinja", options.header),
        ("encodings.md.jinja", options.markdown),
    ]:
        text = environment.get_template(name).render(blocks=model, top=top, xml=xml)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")


def xml(text):
    return " ".join(str(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").split())


if __name__ == "__main__":
    main()
