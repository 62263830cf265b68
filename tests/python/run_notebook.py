"""Runs the code cells of a notebook in order, as Jupyter does. Usage: run_notebook.py FILE.ipynb"""
import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    cells = [c for c in json.load(file)["cells"] if c["cell_type"] == "code"]
names = {"__name__": "__main__"}
for number, cell in enumerate(cells, 1):
    exec(compile("".join(cell["source"]), f"cell {number}", "exec"), names)
print(f"ran {len(cells)} cells")
