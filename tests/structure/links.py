#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

"""links.py [--targets] FOLDER PAGE...: checks the relative links of Markdown and HTML pages.

A page is a file or a folder below FOLDER; of a folder, all *.md and *.html in it are checked. A link is dead if its file
does not exist, if it leaves FOLDER, or if its page has no such heading or anchor. Headings of Markdown have the names that
GitHub gives them. Addresses with a scheme (https:) are not looked at. Prints `page:line: dead link: target` for each dead
link. With --targets it prints the files and folders that the pages link to instead, sorted, relative to FOLDER.
Exit status: 1 if a link is dead, 2 if there is no page.
"""

import functools
import html.parser
import os
import pathlib
import re
import sys
import urllib.parse


class HtmlPage(html.parser.HTMLParser):
    """Links, as (line, target), and anchors of a page."""

    def __init__(self, text):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if not value:
                continue
            if name == "id" or (name == "name" and tag == "a"):
                self.anchors.add(value)
            elif name in ("href", "src"):
                self.links.append((self.getpos()[0], value))


# The text may have brackets of its own, as that of a badge has; the target may have a title behind it.
LINK = re.compile(r"\]\(\s*<?([^()\s<>]+)>?(?:\s+[\"'][^)]*)?\)")
DEFINITION = re.compile(r"^ {0,3}\[[^\]]+\]:\s*<?([^\s>]+)", re.MULTILINE)
CODE_SPAN = re.compile(r"(?<!`)(`+)(?!`).+?(?<!`)\1(?!`)", re.DOTALL)
FENCE = re.compile(r"^\s*(```+|~~~+)")


def without_code(text):
    """Code has no links; lines keep their numbers."""
    fence, lines = None, []
    for line in text.split("\n"):
        found = FENCE.match(line)
        if fence:
            if found and found[1].startswith(fence) and line.strip() == found[1]:
                fence = None
            line = ""
        elif found:
            fence, line = found[1], ""
        lines.append(line)
    return "\n".join(lines)


def blank(found):
    return re.sub(r"[^\n]", " ", found[0])


def github_anchor(heading):
    heading = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", heading.replace("`", "")).replace(" ", "-")


class MarkdownPage:
    """Links, as (line, target), and anchors of a page."""

    def __init__(self, text):
        text = without_code(text)
        self.anchors, seen = set(), {}
        for heading in re.findall(r"^ {0,3}#{1,6}\s+(.*?)\s*#*\s*$", text, re.MULTILINE):
            anchor = github_anchor(heading)
            seen[anchor] = seen.get(anchor, -1) + 1
            self.anchors.add(f"{anchor}-{seen[anchor]}" if seen[anchor] else anchor)
        text = CODE_SPAN.sub(blank, text)
        inline = HtmlPage(text)
        self.anchors |= inline.anchors
        self.links = inline.links + [
            (text.count("\n", 0, found.start(1)) + 1, found[1])
            for pattern in (LINK, DEFINITION) for found in pattern.finditer(text)]
        self.links.sort()


@functools.lru_cache(maxsize=None)
def read(path):
    text = path.read_text(encoding="utf-8", errors="replace")
    return MarkdownPage(text) if path.suffix == ".md" else HtmlPage(text)


def target_of(page, link):
    """Path and anchor; None for an address with a scheme or a host."""
    parts = urllib.parse.urlsplit(link)
    if parts.scheme or parts.netloc:
        return None
    path = urllib.parse.unquote(parts.path)
    file = pathlib.Path(os.path.normpath(page.parent / path)) if path else page
    if page.suffix == ".html" and file.is_dir() and (file / "index.html").is_file():
        file = file / "index.html"
    return file, urllib.parse.unquote(parts.fragment)


def is_dead(root, file, anchor):
    if not file.is_relative_to(root) or not file.exists():
        return True
    has_anchors = file.is_file() and file.suffix in (".md", ".html")
    return bool(anchor) and has_anchors and anchor not in read(file).anchors | {"top"}


def main(arguments):
    only_targets = arguments[:1] == ["--targets"]
    arguments = arguments[only_targets:]
    if len(arguments) < 2:
        print(__doc__.splitlines()[0], file=sys.stderr)
        return 2
    root = pathlib.Path(os.path.normpath(pathlib.Path.cwd() / arguments[0]))
    pages = []
    for name in arguments[1:]:
        path = root / name
        pages += [path] if path.is_file() else sorted(p for p in path.rglob("*") if p.suffix in (".md", ".html"))
    if not pages:
        print("links.py: no page was found", file=sys.stderr)
        return 2
    targets, dead = set(), 0
    for page in pages:
        for line, link in read(page).links:
            target = target_of(page, link)
            if target is None:
                continue
            if is_dead(root, *target):
                dead += 1
                print(f"{page.relative_to(root)}:{line}: dead link: {link}", file=sys.stderr if only_targets else sys.stdout)
            else:
                targets.add(str(target[0].relative_to(root)))
    if only_targets:
        print("\n".join(sorted(targets)))
    return 1 if dead else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
