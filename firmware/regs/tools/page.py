"""One page which opens from a disk. In: the Markdown of the map. Out: HTML without scripts, fonts or links to elsewhere."""
import pathlib
import sys

import markdown

STYLE = """
body { font: 15px/1.5 sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; color: #222; background: #fff }
h2 { border-bottom: 2px solid #888; margin-top: 3rem } h3 { border-bottom: 1px solid #ccc; margin-top: 2rem }
h4 { margin-bottom: 0 } h4 + p { margin-top: 0 }
table { border-collapse: collapse } td, th { border: 1px solid #bbb; padding: .2rem .6rem; text-align: left }
th { background: #eee } nav { columns: 3 } nav > .toc > ul > li > ul ul ul { display: none }
"""


def main():
    source, page = map(pathlib.Path, sys.argv[1:3])
    converter = markdown.Markdown(extensions=["tables", "toc"], extension_configs={"toc": {"toc_depth": "2-3"}})
    body = converter.convert(source.read_text(encoding="utf-8"))
    page.write_text(
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<title>Lucerna registers</title>\n'
        f"<style>{STYLE}</style>\n</head>\n<body>\n<h1>Lucerna registers</h1>\n<nav>\n{converter.toc}</nav>\n{body}\n</body>\n</html>\n",
        encoding="utf-8")


if __name__ == "__main__":
    main()
