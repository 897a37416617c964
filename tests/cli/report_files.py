"""What riesel report leaves, read back: pages and figures."""

import html.parser
import xml.etree.ElementTree

from riesel_command import CommandTest

VOID_ELEMENTS = {"meta", "br", "hr", "img", "link", "input"}
SVG = "{http://www.w3.org/2000/svg}"


class Page(html.parser.HTMLParser):
    """Elements and text of a page; an element that is not closed in its place is a mistake."""

    def __init__(self, text):
        super().__init__()
        self.elements, self.open, self.text, self.mistakes = [], [], "", []
        self.shapes = {}  # class of the group: number of shapes
        self.feed(text)
        self.close()
        self.mistakes += [f"<{name}> is left open" for name, _ in self.open]

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.elements.append((tag, attributes))
        groups = [given.get("class") for name, given in self.open if name == "g"]
        if groups and tag in ("circle", "line"):
            self.shapes[groups[-1]] = self.shapes.get(groups[-1], 0) + 1
        if tag not in VOID_ELEMENTS:
            self.open.append((tag, attributes))

    def handle_endtag(self, tag):
        if not self.open or self.open[-1][0] != tag:
            self.mistakes.append(f"</{tag}> closes nothing")
        else:
            self.open.pop()

    def handle_data(self, data):
        self.text += data


class Report(CommandTest):

    def page_of(self, directory):
        return Page((directory / "report.html").read_text(encoding="utf-8"))

    def report_on(self, directory):
        self.assert_done(self.riesel("report", directory))
        return self.page_of(directory)

    def figure(self, directory, name):
        return xml.etree.ElementTree.parse(directory / "figures" / f"{name}.svg").getroot()
