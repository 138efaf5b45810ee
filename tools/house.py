#!/usr/bin/env python3
"""Counts of the house: lines, files, what a user meets, and cycles between modules.

    python3 tools/house.py [--json] [ROOT]

Lines are those of source without tests, blank lines and comments included. Public items are those that are `pub` for all; type parameters
are those of public types and traits. A module uses another where it names an item of it, through whatever re-export. Exits with 1 where there is a cycle.
"""

import json
import re
import sys
from pathlib import Path

ITEM = re.compile(r"^\s*pub (?:const fn|unsafe fn|fn|struct|enum|trait|type|const|static|mod|use)\b", re.M)
GENERIC = re.compile(r"^\s*pub (?:struct|enum|trait|type) \w+<([^>{;=]*)", re.M)
USE = re.compile(r"^\s*(pub(?:\([^)]*\))? )?use ([^;]+);", re.M)
PATH = re.compile(r"(?<![\w:])(?:crate|super)(?:::\w+)+")


def without_tests(text):
    """The source up to its unit tests, without comments."""
    text = re.split(r"^#\[cfg\(test\)\]\s*\nmod \w+ \{", text, maxsplit=1, flags=re.M)[0]
    return re.sub(r"//.*", "", text)


def expand(tree):
    """The paths of a `use` tree: `a::{b, c::d}` is `a::b` and `a::c::d`."""
    tree = tree.strip()
    brace = tree.find("{")
    if brace < 0:
        return [re.sub(r"\s+as\s+\w+$", "", tree)]
    head, inner, parts, depth, start = tree[:brace], tree[brace + 1 : tree.rindex("}")], [], 0, 0
    for i, c in enumerate(inner + ","):
        depth += (c == "{") - (c == "}")
        if c == "," and depth == 0:
            parts.append(inner[start:i])
            start = i + 1
    return [head + path for part in parts if part.strip() for path in expand(part)]


def module_of(file, src):
    parts = list(file.relative_to(src).with_suffix("").parts)
    if parts[-1] in ("mod", "lib", "main"):
        parts.pop()
    return tuple(parts)


def absolute(path, module):
    """A path from the crate's root; None where it leads out of the crate."""
    parts = [p.strip() for p in path.split("::")]
    if parts[0] == "crate":
        return parts[1:]
    if parts[0] == "self":
        return list(module) + parts[1:]
    at = list(module)
    while parts and parts[0] == "super":
        if at:
            at.pop()
        parts.pop(0)
    return at + parts if path.startswith("super") else None


class Crate:
    def __init__(self, src):
        self.files = {module_of(f, src): f for f in sorted(src.rglob("*.rs"))}
        self.text = {m: without_tests(f.read_text()) for m, f in self.files.items()}
        self.exports = {m: self.reexports(m) for m in self.files}

    def reexports(self, module):
        out = {}
        for visible, tree in USE.findall(self.text[module]):
            for path in expand(tree) if visible else []:
                first = path.split("::")[0]
                child = module + (first,)
                full = list(module) + path.split("::") if child in self.files else absolute(path, module)
                if full:
                    out[full[-1]] = full
        return out

    def resolve(self, path, seen=()):
        """The module that defines the item at an absolute path."""
        for cut in range(len(path), -1, -1):
            module = tuple(path[:cut])
            if module not in self.files:
                continue
            item = path[cut] if cut < len(path) else None
            target = self.exports[module].get(item)
            if target and tuple(target) not in seen:
                return self.resolve(target, seen + (tuple(target),))
            return module
        return ()

    def uses(self, module):
        """The modules whose items a module names; re-exports for others are no use."""
        text, out = self.text[module], set()
        paths = [p for visible, tree in USE.findall(text) if not visible for p in expand(tree)]
        paths += PATH.findall(USE.sub("", text))
        for path in paths:
            first = path.split("::")[0]
            full = list(module) + path.split("::") if module + (first,) in self.files else absolute(path, module)
            if full:
                out.add(self.resolve(full))
        return out - {module}

    def cycles(self):
        """The strongly connected components of more than one module (R. Tarjan)."""
        graph = {m: sorted(self.uses(m)) for m in self.files}
        index, low, stack, found = {}, {}, [], []

        def visit(m):
            index[m] = low[m] = len(index)
            stack.append(m)
            for n in graph[m]:
                if n not in index:
                    visit(n)
                    low[m] = min(low[m], low[n])
                elif n in stack:
                    low[m] = min(low[m], index[n])
            if low[m] == index[m]:
                component = []
                while not component or component[-1] != m:
                    component.append(stack.pop())
                if len(component) > 1:
                    found.append(sorted("::".join(c) or "lib" for c in component))

        for m in graph:
            if m not in index:
                visit(m)
        return found


def parameters(text):
    lists = [re.sub(r"\([^)]*\)", "", g) for g in GENERIC.findall(text)]
    names = [p.strip() for g in lists for p in g.split(",")]
    return sum(1 for p in names if p and not p.startswith("'"))


def count(name, src):
    crate = Crate(src)
    raw = [f.read_text() for f in crate.files.values()]
    text = "\n".join(crate.text.values())
    return {
        "crate": name,
        "lines": sum(t.count("\n") for t in raw),
        "files": len(raw),
        "longest": max(t.count("\n") for t in raw),
        "public": len(ITEM.findall(text)),
        "parameters": parameters(text),
        "cycles": crate.cycles(),
    }


def main():
    arguments = [a for a in sys.argv[1:] if a != "--json"]
    root = Path(arguments[0] if arguments else Path(__file__).parent.parent)
    sources = {p.parent.name: p for p in sorted(root.glob("crates/*/src"))} | {"lgvi": root / "src"}
    rows = [count(name, src) for name, src in sources.items()]
    if "--json" in sys.argv:
        print(json.dumps(rows))
    else:
        keys = ["lines", "files", "longest", "public", "parameters"]
        print(f"{'crate':20}" + "".join(f"{k:>12}" for k in keys) + f"{'cycles':>12}")
        for r in rows:
            print(f"{r['crate']:20}" + "".join(f"{r[k]:12}" for k in keys) + f"{len(r['cycles']):12}")
        total = [sum(r[k] for r in rows) for k in keys]
        total[2] = max(r["longest"] for r in rows)
        print(f"{'all':20}" + "".join(f"{t:12}" for t in total) + f"{sum(len(r['cycles']) for r in rows):12}")
        extra = [p for d in ("examples", "benches") for p in root.rglob(f"{d}/**/*.rs") if "target" not in p.parts]
        print(f"examples and benches: {sum(p.read_text().count(chr(10)) for p in extra)} lines in {len(extra)} files")
        for r in rows:
            for cycle in r["cycles"]:
                print(f"cycle in {r['crate']}: {' <-> '.join(cycle)}")
    sys.exit(any(r["cycles"] for r in rows))


main()
