"""Draws the table of RESULTS.md as bars, in the style of the other charts: results.svg.

python3 benches/peers/bars.py
"""

import re
from pathlib import Path

HERE = Path(__file__).resolve().parent
# A library's class of colour, and how strongly it is filled.
COLOURS = {
    "dalembert": ("k0", 1),
    "each rounded": ("k0", 0.6),
    "CasADi, gcc": ("k1", 1),
    "CasADi, clang": ("k1", 0.6),
    "dynibo": ("k3", 1),
    "phyz": ("k2", 1),
}
WIDTH, LEFT, BARS, ROW = 720, 16, 96, 15


def table(text):
    """Return the rows of the table: function, robot, and the cell of each library that has one."""
    cells = [line.strip("| ").split(" | ") for line in text.splitlines() if line.startswith("| ")]
    head = cells[0][2:]
    for function, robot, *times in cells[1:]:
        here = {library: cell for library, cell in zip(head, times) if cell != "–"}
        yield function.strip("`"), robot, here


def drawn(text, style):
    """A group of bars for a function and robot; lengths are beside the longest of the function."""
    rows = list(table(text))
    parts, y, title = [], 8, None
    for function, robot, cells in rows:
        if function != title:
            title = function
            longest = max(time(cell) for f, _, c in rows if f == title for cell in c.values())
            y += 26
            parts.append(f'<text class="i t" x="{LEFT}" y="{y - 8}">{title}, ns a call</text>')
        parts.append(f'<text class="i" x="{LEFT}" y="{y + ROW - 4}">{robot}</text>')
        for library, cell in cells.items():
            colour, opacity = COLOURS[library]
            length = max(2, (WIDTH - BARS - 196) * time(cell) / longest)
            ratio = re.sub(r" \((.*)\)", r", \1 × ours", cell)
            parts.append(
                f'<rect class="{colour} f" opacity="{opacity}" x="{BARS}" y="{y}"'
                f' width="{length:.1f}" height="{ROW - 3}"/>'
                f'<text class="i" x="{BARS + length + 6:.1f}" y="{y + ROW - 4}">{library} {ratio}</text>'
            )
            y += ROW
        y += 6
    size = f'width="{WIDTH}" height="{y + 8}"'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {y + 8}" role="img">\n'
        f"<title>Nanoseconds a call, beside other libraries</title>\n{style}\n"
        f'<rect class="p" {size}/>\n' + "\n".join(parts) + "\n</svg>\n"
    )


def time(cell):
    return float(cell.split()[0])


def main():
    chart = (HERE / "../../generated/tradeoff/puma560.svg").read_text()
    style = re.search("<style>.*</style>", chart)[0]
    (HERE / "results.svg").write_text(drawn((HERE / "RESULTS.md").read_text(), style))


if __name__ == "__main__":
    main()
