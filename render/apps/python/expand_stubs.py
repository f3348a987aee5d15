"""Writes the stubs of the package: `expand_stubs.py SOURCE TARGET`.

The source names each key once, as an attribute of a class that derives from _Keys. Such a class gets
an __init__ with its attributes as keywords, and `**name: Class` becomes those keywords of the class
that the function does not name itself. Private classes of keys serve that only, and are left out.
"""

import ast
import pathlib
import sys


def argument(attribute):
    """The argument that sets an attribute. An array may be given as anything that becomes one."""
    kind = ast.unparse(attribute.annotation).replace("NDArray[Any] | None", "ArrayLike | None")
    return ast.arg(attribute.target.id, ast.Name(kind))


class Stubs:
    """Stubs, whose classes of keys are expanded."""

    def __init__(self, text):
        self.tree = ast.parse(text)
        self.classes = {}  # of keys; a base stands before what derives from it
        for one in self.tree.body:
            if isinstance(one, ast.ClassDef) and (one.name == "_Keys" or self.bases(one)):
                self.classes[one.name] = one

    def bases(self, one):
        return [base.id for base in one.bases if getattr(base, "id", None) in self.classes]

    def keys(self, name):
        one = self.classes[name]
        own = [argument(part) for part in one.body if isinstance(part, ast.AnnAssign)]
        return [key for base in self.bases(one) for key in self.keys(base)] + own

    def expand(self, function):
        """Names the keywords of `**name: Class`."""
        taken = function.args
        kind = taken.kwarg and ast.unparse(taken.kwarg.annotation)
        if kind not in self.classes:
            return
        named = {one.arg for one in taken.args + taken.kwonlyargs}
        more = [key for key in self.keys(kind) if key.arg not in named]
        taken.kwonlyargs += more
        taken.kw_defaults += [ast.Constant(...)] * len(more)
        taken.kwarg = None

    def text(self):
        for name, one in self.classes.items():
            init = f"def __init__(self, **keys: {name}) -> None: ..."
            one.body += ast.parse(init).body
        for one in ast.walk(self.tree):
            if isinstance(one, ast.FunctionDef):
                self.expand(one)
        for one in self.classes.values():
            one.bases = []
        private = [one for name, one in self.classes.items() if name.startswith("_")]
        self.tree.body = [one for one in self.tree.body if one not in private]
        return ast.unparse(self.tree) + "\n"


source, target = map(pathlib.Path, sys.argv[1:])
target.write_text(Stubs(source.read_text(encoding="utf-8")).text(), encoding="utf-8")
