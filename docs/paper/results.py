"""What the figures share: the table of a sweep, tables in Markdown, pictures as SVG."""
import csv


class Missing(Exception):
    """A result that is not there."""


def rows_of(table):
    """All points of a sweep, done or not."""
    try:
        with open(table, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))
    except OSError as error:
        raise Missing(f"{table}: cannot be read ({error.strerror}); run docs/paper/reproduce.sh") from error


def print_table(title, head, rows):
    """A table in Markdown, numbers to the right."""
    print(f"\n{title}\n\n| {' | '.join(head)} |\n|{'--:|' * len(head)}")
    for row in rows:
        print("| " + " | ".join(cell if isinstance(cell, str) else f"{cell:.4g}" for cell in row) + " |")


def save(figure, path):
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
    print(f"\ndrawn: {path}")
