# SPDX-License-Identifier: BSD-3-Clause
"""Links and pictures of the documents lead somewhere."""
import glob
import os
import re


def headings(path):
    """The anchors that GitHub makes of a document's headings."""
    with open(path, encoding="utf-8") as file:
        titles = re.findall(r"^#+ (.*)$", file.read(), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def broken(root):
    """What leads nowhere in the Markdown files below `root`: (file, link), those to other sites left out."""
    found = []
    for path in glob.glob(os.path.join(root, "**", "*.md"), recursive=True):
        if os.path.relpath(path, root).startswith("build"):
            continue
        with open(path, encoding="utf-8") as file:
            text = re.sub(r"```.*?```", "", file.read(), flags=re.DOTALL)
        for link in re.findall(r"\]\(([^)\s]+)\)", text):
            target, _, anchor = link.partition("#")
            if re.match(r"\w+:", target):
                continue
            file = os.path.join(os.path.dirname(path), target) if target else path
            if not os.path.exists(file) or (anchor and anchor not in headings(file)):
                found.append((os.path.relpath(path, root), link))
    return found
