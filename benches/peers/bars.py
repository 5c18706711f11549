"""Bars of times beside ours, for light pages and dark ones."""

COLOURS = {
    "dalembert": "#2f7fd6",
    "each rounded": "#7fb0e6",
    "CasADi, gcc": "#d9822b",
    "CasADi, clang": "#b5651d",
    "dynibo": "#8a63b8",
    "phyz": "#5b9a68",
}
WIDTH, LABEL, ROW, LEFT = 860, 150, 17, 12


def bars(rows, libraries):
    """A group a function and robot; lengths are times beside the longest of its function."""
    parts, y = [], 14
    title = None
    for row in rows:
        if row["function"] != title:
            title = row["function"]
            y += 12
            parts.append(f'<text x="{LEFT}" y="{y + 4}" class="t">{title}</text>')
            y += 16
        longest = max(
            time for r in rows if r["function"] == title for time in r["ns"].values()
        )
        here = [x for x in libraries if x in row["ns"]]
        middle = y + ROW * len(here) / 2
        parts.append(f'<text x="{LEFT}" y="{middle:.0f}" class="r">{row["robot"]}</text>')
        for library in here:
            time = row["ns"][library]
            length = max(2, (WIDTH - LABEL - 210) * time / longest)
            parts.append(
                f'<rect x="{LABEL}" y="{y}" width="{length:.1f}" height="{ROW - 4}"'
                f' fill="{COLOURS.get(library, "#888")}"/>'
            )
            is_ours = library in ("dalembert", "each rounded")
            note = "" if is_ours else f", {row['ratio'][library]:.1f} × ours"
            parts.append(
                f'<text x="{LABEL + length + 6:.1f}" y="{y + ROW - 7}">{library} {time:.0f} ns{note}</text>'
            )
            y += ROW
        y += 8
    style = (
        "text{font:12px sans-serif;fill:#1f2328}.t{font-weight:bold}.r{font-size:13px}"
        "@media(prefers-color-scheme:dark){text{fill:#e6edf3}}"
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {y + 8}" width="{WIDTH}">'
        f"<title>Nanoseconds a call, beside other libraries</title><style>{style}</style>"
        + "\n".join(parts)
        + "</svg>\n"
    )
