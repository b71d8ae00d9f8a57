# SPDX-License-Identifier: MIT
"""What a cell of a notebook shows as HTML."""
import html.parser

NOT_CLOSED = ("br", "hr", "img", "meta")


class Read(html.parser.HTMLParser):
    """Rows of the tables as lists of cells, and the sentence in bold. Raises if an element is not closed."""

    def __init__(self, text):
        super().__init__()
        self.rows, self.bold, self.open = [], "", []
        self.feed(text)
        self.close()
        if self.open:
            raise AssertionError(f"not closed: {self.open}")

    def handle_starttag(self, tag, attributes):
        self.open += [] if tag in NOT_CLOSED else [tag]
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_endtag(self, tag):
        if self.open.pop() != tag:
            raise AssertionError(f"{tag} is closed inside of another element")

    def handle_data(self, text):
        if self.open and self.open[-1] in ("td", "th"):
            self.rows[-1][-1] += text
        if "b" in self.open:
            self.bold += text
