#!/usr/bin/python3
"""README.md has the tables of a run: compares each block between `<!-- run: TRUTH -->` and
`<!-- end -->` with OUT/TRUTH/table.md, or writes it there. Ends with 1 where they differ.

Usage: check_tables.py OUT [--run] [--write]; --run first calls `run OUT` (77: no GetFEM)."""
import difflib
import re
import subprocess
import sys
from pathlib import Path

README = Path(__file__).with_name("README.md")


def block(out, truth):
    return f"<!-- run: {truth} -->\n{(out / truth / 'table.md').read_text().strip()}\n<!-- end -->"


def main():
    if len(sys.argv) < 2 or not set(sys.argv[2:]) <= {"--run", "--write"}:
        sys.exit(__doc__)
    if "--run" in sys.argv:
        code = subprocess.run([README.with_name("run"), sys.argv[1]]).returncode
        if code:
            sys.exit(code)
    out, text = Path(sys.argv[1]), README.read_text()
    blocks = re.compile(r"<!-- run: (\w+) -->.*?<!-- end -->", re.S)
    made = blocks.sub(lambda found: block(out, found[1]), text)
    if "--write" in sys.argv:
        README.write_text(made)
        return
    differences = list(difflib.unified_diff(text.splitlines(), made.splitlines(), "README.md",
                                            "this run", lineterm="", n=0))
    print("\n".join(differences) or f"{len(blocks.findall(text))} tables agree with this run")
    sys.exit(bool(differences))


if __name__ == "__main__":
    main()
