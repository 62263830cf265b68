"""Runs the code cells of a notebook in order, as Jupyter does, in the current folder.

Usage: run_notebook.py FILE.ipynb           fails where a cell prints other text than its outputs,
                                            in a notebook that has some
       run_notebook.py --write FILE.ipynb   stores what the cells print and draw
"""
import ast
import base64
import contextlib
import io
import json
import sys


def run(source, number, names):
    """What a cell prints, the value of its last line, and its pictures, as a notebook has them."""
    tree = ast.parse(source, f"cell {number}")
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed, value = io.StringIO(), None
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, f"cell {number}", "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), f"cell {number}", "eval"), names)
    outputs = []
    if printed.getvalue():
        outputs.append({"output_type": "stream", "name": "stdout",
                        "text": lines(printed.getvalue())})
    pictures = list(drawn())
    if value is not None and not pictures:
        data = {"text/plain": lines(repr(value))}
        if hasattr(value, "_repr_html_"):
            data["text/html"] = lines(value._repr_html_())
        outputs.append({"output_type": "execute_result", "execution_count": number, "metadata": {},
                        "data": data})
    return outputs + [{"output_type": "display_data", "metadata": {}, "data": {"image/png": p}}
                      for p in pictures]


def drawn():
    pyplot = sys.modules.get("matplotlib.pyplot")
    for figure in map(pyplot.figure, pyplot.get_fignums()) if pyplot else ():
        png = io.BytesIO()
        figure.savefig(png, dpi=65, metadata={"Software": None})
        yield base64.b64encode(png.getvalue()).decode()
    if pyplot:
        pyplot.close("all")


def lines(text):
    return text.splitlines(keepends=True)


def texts(outputs):
    """All but pictures, which differ by the version of matplotlib."""
    return [o for o in outputs if o["output_type"] != "display_data"]


def main():
    write = "--write" in sys.argv
    file = sys.argv[-1]
    with open(file, encoding="utf-8") as opened:
        notebook = json.load(opened)
    cells = [c for c in notebook["cells"] if c["cell_type"] == "code"]
    names, differ = {"__name__": "__main__"}, []
    compares = not write and any(cell["outputs"] for cell in cells)
    for number, cell in enumerate(cells, 1):
        outputs = run("".join(cell["source"]), number, names)
        for one in texts(outputs):
            print("".join(one.get("text") or one["data"]["text/plain"]), end="\n")
        if compares and texts(outputs) != texts(cell["outputs"]):
            differ.append(number)
        cell["outputs"], cell["execution_count"] = outputs, number
    if write:
        with open(file, "w", encoding="utf-8") as opened:
            json.dump(notebook, opened, indent=1, ensure_ascii=False)
            opened.write("\n")
    print(f"ran {len(cells)} cells")
    if differ:
        sys.exit(f"cells {differ} print other text than their outputs: see what changed, then "
                 f"run_notebook.py --write {file}")


main()
