"""Sphinx builds the pages of this folder as a site: docs/build DIRECTORY."""
import json
import os
import pathlib
import re
import shutil
import subprocess

HOUSE = pathlib.Path(__file__).resolve().parent.parent

project = "frictab"
extensions = ["myst_parser"]
myst_heading_anchors = 4
smartquotes = False  # --option is no dash
html_theme = "furo"
pygments_style = "xcode"  # the theme's own has too little contrast
html_title = "frictab"
html_copy_source = False
html_use_index = False
html_show_copyright = False


def keys_of_the_job(page):
    """The keys as the program documents them, by section; without a program the page as it is."""
    program = shutil.which(os.environ.get("FRICTAB", "frictab"))
    if not program:
        return page
    asked = subprocess.run([program, "explain", "job", "--json"], check=True, capture_output=True)
    sections = {}
    for key in json.loads(asked.stdout)["keys"]:
        line = f"* **`{key['name']}`** ({verbatim(key['value'])}): {verbatim(key['meaning'])}"
        if "absent" in key:
            line += f"; absent: {verbatim(key['absent'])}"
        for note in ("default", "example"):
            line += f"; {note}: `` {key[note]} ``" if note in key else ""
        sections.setdefault(key["name"].split(".")[0], []).append(line)
    return page + "".join(f"\n## {name}\n" + "\n".join(lines) + "\n"
                          for name, lines in sections.items())


def verbatim(text):
    """Signs of Markdown stand for themselves, but for code."""
    return re.sub(r"`[^`]*`|[\\*_<>\[\]|]", lambda m: m[0] if m[0][0] == "`" else "\\" + m[0], text)


def prepare(_app, name, source):
    """Before a page is parsed. Files of the repository that are no pages are named, not linked."""
    if name == "examples":
        source[0] = (HOUSE / "examples/README.md").read_text(encoding="utf-8")
    if name == "reference":
        source[0] = keys_of_the_job(source[0])
    source[0] = source[0].replace("(../examples/README.md)", "(examples.md)")
    source[0] = re.sub(r"\[([^\]]*)\]\(\.\./([^)]*)\)", r"\1 (`\2`)", source[0])


def setup(app):
    app.connect("source-read", prepare)
