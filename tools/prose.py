#!/usr/bin/env python3
"""Plain sentences: lists those of more than 30 words, and turns that prose.txt advises against.

    python3 tools/prose.py [--count] [FILE...]

It reads the pages, the descriptions of the packages, the comments of Rust that become documentation or help, and its strings: messages and help. Code, formulas
and titles in italics count as one word. A source in parentheses, one with a year, does not count. Exits with 1 where it finds something.
"""

import re
import sys
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGES = ["*.md", "docs/*.md", "python/*.md", "paper/*.md", "crates/*/*.md", "crates/*/src/**/*.md"]
MANIFESTS = ["Cargo.toml", "crates/*/Cargo.toml", "python/Cargo.toml", "python/pyproject.toml"]
SOURCES = ["src/**/*.rs", "crates/*/src/**/*.rs", "python/src/**/*.rs", "examples/**/*.rs", "crates/*/examples/**/*.rs"]
MOST_WORDS = 30
SHORT = re.compile(r"(?:\b[A-Z]|\b(?:e\.g|i\.e|cf|Sec|sec|ch|ed|vs|No|Phys|Lett|Math|Comp|Appl|Numer|Comput|Future|Gener|Syst|Sci|Int|J|Proc|resp))\.$")
END = re.compile(r"(?<=[.!?])[)*\"”]*\s+(?=[^a-z\s])")
STRING = re.compile(r'(?<![\w#r\'])"((?:[^"\\]|\\.)*)"', re.S)
ITEM = re.compile(r"^\s*(?:(?:[-*+]|\d+\.)\s+|#+\s+|>\s*)")


def turns():
    """The expressions of prose.txt, with their advice."""
    lines = (ROOT / "tools/prose.txt").read_text(encoding="utf-8").splitlines()
    pairs = (line.split("\t") for line in lines if line and not line.startswith("#"))
    return [(re.compile(pattern, re.I), advice) for pattern, advice in pairs]


def plain(text):
    """A paragraph with code, formulas and titles as one word each, and links as their text."""
    text = re.sub(r"\$\$.*?\$\$|\$[^$]+\$", "ξ", text, flags=re.S)
    text = re.sub(r"``[^`]+``|`[^`]*`", "ξ", text, flags=re.S)
    text = re.sub(r"!?\[([^\]]*)\](?:\([^)]*\))?", r"\1", text)
    return re.sub(r"(?<!\*)\*(?!\*)(?:[^*\s]+\s+){3,}[^*]+\*", "ξ", text)


def sentences(text):
    """The sentences of a paragraph, each with the place where it begins."""
    start = 0
    for end in END.finditer(text):
        if SHORT.search(text[start : end.start()].rstrip(")*\"”")):
            continue
        yield start, text[start : end.start()]
        start = end.end()
    yield start, text[start:]


def words(sentence):
    """How many words, but for sources in parentheses."""
    sentence = re.sub(r"\([^()]*\b(?:18|19|20)\d\d\b[^()]*\)", "", sentence)
    return sum(bool(re.search(r"\w", word)) for word in sentence.split())


def paragraphs(lines):
    """The paragraphs of Markdown, as lists of (line number, text): items of lists, cells of tables and headings are paragraphs of their own."""
    block, fenced, formula = [], False, False
    for number, line in lines:
        stripped = line.strip()
        if re.match(r"(```|~~~)", stripped):
            fenced = not fenced
            stripped = ""
        if stripped == "$$" or formula:
            formula ^= stripped.endswith("$$")
            stripped = ""
        if fenced or not stripped or stripped.startswith(("<!--", "|", "[^", "$$")) or ITEM.match(line):
            if block:
                yield block
            block = []
        if fenced or not stripped:
            continue
        if stripped.startswith("|"):
            yield from ([(number, cell)] for cell in re.split(r"(?<!\\)\|", stripped) if re.search(r"\w", cell))
        elif stripped.startswith("#"):
            yield [(number, stripped.lstrip("# "))]
        elif not stripped.startswith(("<!--", "$$")):
            block.append((number, ITEM.sub("", line, count=1).strip() if not block else stripped))
    if block:
        yield block


def markdown(text):
    text = re.sub(r"\A---\n.*?\n---\n", lambda match: "\n" * match[0].count("\n"), text, flags=re.S)
    yield from paragraphs(enumerate(text.splitlines(), 1))


def descriptions(text):
    for number, line in enumerate(text.splitlines(), 1):
        if match := re.match(r'description = "(.*)"', line):
            yield [(number, match[1])]


def rust(text):
    """The comments that become documentation, and the strings."""
    text = re.split(r"^#\[cfg\(test\)\]\s*\nmod \w+ \{", text, maxsplit=1, flags=re.M)[0]
    block = []
    for number, line in enumerate(text.splitlines(), 1):
        match = re.match(r"\s*//[/!] ?(.*)", line)
        if match:
            block.append((number, match[1]))
        elif block:
            yield from paragraphs(block)
            block = []
    yield from paragraphs(block)
    code = re.sub(r"^(\s*)//.*$", "", text, flags=re.M)
    code = re.sub(r'r(#+)".*?"\1', lambda match: "\n" * match[0].count("\n"), code, flags=re.S)
    for match in STRING.finditer(code):
        said = re.sub(r"\\\n\s*", " ", match[1]).replace("\\n", "\n").replace('\\"', "'")
        number = code.count("\n", 0, match.start()) + 1
        # Columns of help are apart by spaces, and clauses of messages by colons and semicolons.
        for part in re.split(r"\n|\s{2,}|[:;]\s", said):
            if len(part.split()) > 3:
                yield [(number, part)]


def found(kind, path, avoided):
    """What is found in a file: its line, the sentence, and what is wrong with it."""
    for block in kind(path.read_text(encoding="utf-8")):
        text = "\n".join(line for _, line in block)
        marked = plain(text)
        first = block[0][0]
        exact = marked.count("\n") == text.count("\n")
        for place, sentence in sentences(marked):
            number = block[marked.count("\n", 0, place)][0] if exact else first
            said = " ".join(sentence.split())
            count = words(sentence)
            if count > MOST_WORDS:
                yield number, said, f"{count} words"
            for pattern, advice in avoided:
                if pattern.search(said):
                    yield number, said, f"avoid /{pattern.pattern}/: {advice}"


def main(arguments):
    avoided = turns()
    chosen = {Path(name).resolve() for name in arguments if not name.startswith("--")}
    counts = Counter()
    for kind, patterns in ((markdown, PAGES), (descriptions, MANIFESTS), (rust, SOURCES)):
        for path in sorted({path for pattern in patterns for path in ROOT.glob(pattern)}):
            if chosen and path.resolve() not in chosen:
                continue
            name = path.relative_to(ROOT).as_posix()
            for number, said, what in found(kind, path, avoided):
                counts[kind.__name__] += 1
                if "--count" not in arguments:
                    print(f"{name}:{number}: {what}: {said}")
    kinds = ("markdown", "descriptions", "rust")
    print(", ".join(f"{kind}: {counts[kind]}" for kind in kinds))
    return int(bool(counts))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
