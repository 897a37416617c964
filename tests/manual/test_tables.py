"""Tables of the README and of the manual are tables: a heading, a rule, and rows of as many cells."""

import itertools
import re
import unittest

from manual import HOME

RULE = re.compile(r"\|(\s*:?-+:?\s*\|)+")


def cells(row):
    return len(re.findall(r"(?<!\\)\|", re.sub(r"`[^`]*`", "", row))) - 1


def flaws(text):
    """What is wrong with lines that have cells, as (line, what)."""
    found = []
    lines = [line.strip() for line in re.sub(r"^```.*?^```", "", text, flags=re.M | re.S).splitlines()]
    for is_table, block in itertools.groupby(lines, lambda line: line.startswith("|")):
        rows = list(block)
        if not is_table:
            found += [(line, "the end of a row") for line in rows if re.search(r" \|$", line)]
        elif len(rows) < 3 or not RULE.fullmatch(rows[1]):
            found.append((rows[0], "no heading, rule and row"))
        else:
            found += [(row, f"{cells(row)} cells") for row in rows
                      if cells(row) != cells(rows[0]) or not row.endswith("|")]
    return found


class Tables(unittest.TestCase):

    def test_those_of_the_manual(self):
        pages = [HOME / "README.md", *(HOME / "docs").glob("*.md")]
        texts = {page.name: page.read_text(encoding="utf-8") for page in pages}
        self.assertGreater(sum(len(RULE.findall(text)) for text in texts.values()), 50)
        for name, text in texts.items():
            self.assertEqual(flaws(text), [], name)

    def test_flaws_are_found(self):
        for flawed in ("| a | b |\n|---|---| | 1 | 2 |\n", "| a | b |\n|---|---|\n| 1 |\n", "| a | b |\n| 1 | 2 |\n",
                       "| a |\n|---|\n| 1\n", "| a |\n|---|\n| 1 |\nmore |\n"):
            self.assertNotEqual(flaws(flawed), [], flawed)


if __name__ == "__main__":
    unittest.main()
