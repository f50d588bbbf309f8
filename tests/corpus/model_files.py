#!/usr/bin/env python3
"""Renders model files that people have, lays the pictures side by side, and keeps what a person says of each.

    model_files.py render ANTIPODE FOLDER TABLE PICTURES [--list FILE] [--seconds 280] [--again WORD] -- [OPTIONS OF RENDER]
    model_files.py pages TABLE PICTURES          # PICTURES/page1.html …: 40 pictures a page, with names, notes and verdicts
    model_files.py count TABLE                   # shares by format, in Markdown

TABLE is a CSV file, one row a model file: how the render ended, its seconds, the picture's hash and the program's notes are
written by `render`; `verdict` (right, wrong, refused: rightly, as the file is broken) and `reason` by a person. A verdict
is dropped where a later render gives another picture or ends otherwise. `render` takes up where it was ended; --again
renders those anew whose row has the word, or all with --again ''.
"""
import argparse
import base64
import collections
import csv
import hashlib
import html
import os
import subprocess
import sys
import time

FORMATS = ("gltf", "glb", "obj", "fbx", "dae", "ply", "stl")
COLUMNS = ("file", "end", "seconds", "picture", "verdict", "reason", "notes")
DEFAULTS = ["--technique", "pt", "--iterations", "12", "--height", "128", "--no-error"]

SUMMARIES = tuple("antipode: " + word for word in ("scene: ", "light: ", "technique: "))  # what every render begins with


def format_of(file):
    return file.rsplit(".", 1)[-1].lower()


def read_table(path):
    if not os.path.exists(path):
        return {}
    with open(path, encoding="utf-8", newline="") as file:
        return {row["file"]: row for row in csv.DictReader(file)}


def write_table(path, rows):
    with open(path + ".part", "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows.values())
    os.replace(path + ".part", path)


def models_in(folder):
    found = [os.path.relpath(os.path.join(place, name), folder)
             for place, _, names in os.walk(folder, followlinks=True) for name in names if format_of(name) in FORMATS]
    return sorted(found)


def picture_path(pictures, file):
    return os.path.join(pictures, file.replace("/", "__") + ".png")


def render(antipode, folder, file, pictures, options, limit):
    """The columns that a machine can tell."""
    picture = picture_path(pictures, file)
    exr = picture[:-4] + ".exr"
    for old in (picture, exr):
        if os.path.exists(old):
            os.remove(old)
    begin = time.monotonic()
    try:
        run = subprocess.run([antipode, "render", os.path.join(folder, file), "-o", exr, *DEFAULTS, *options],
                             capture_output=True, timeout=limit)
        end = "exit %d" % run.returncode if run.returncode >= 0 else "signal %d" % -run.returncode
        said = (run.stdout + run.stderr).decode("utf-8", "replace")
    except subprocess.TimeoutExpired:
        end, said = "no end in %g s" % limit, ""
    seconds = "%.1f" % (time.monotonic() - begin)
    if os.path.exists(exr):
        os.remove(exr)
    shown = ""
    if os.path.exists(picture):
        with open(picture, "rb") as image:
            shown = hashlib.sha256(image.read()).hexdigest()[:8]
    notes = [line.removeprefix("antipode: ").removeprefix("note: ").replace(folder.rstrip("/") + "/", "").strip()
             for line in said.splitlines()
             if line.startswith("antipode: ") and not line.startswith(SUMMARIES)]
    exposure = [line[line.index("(at exposure"):].strip("()") for line in said.splitlines() if "(at exposure" in line]
    notes += [e for e in exposure if not e.startswith("at exposure 0,")]
    return {"file": file, "end": end, "seconds": seconds, "picture": shown, "notes": " | ".join(notes)}


def render_all(arguments):
    rows = read_table(arguments.table)
    os.makedirs(arguments.pictures, exist_ok=True)
    if arguments.list:
        with open(arguments.list, encoding="utf-8") as file:
            files = file.read().splitlines()
    else:
        files = models_in(arguments.folder)
    deadline = time.monotonic() + arguments.seconds
    for file in files:
        known = rows.get(file)
        if known and not (arguments.again is not None and arguments.again in ",".join(known.values())):
            continue
        if time.monotonic() > deadline:
            print("time is over before %s; call again to go on" % file)
            return 3
        row = render(arguments.antipode, arguments.folder, file, arguments.pictures, arguments.options, arguments.limit)
        keeps = known and (known["end"], known["picture"]) == (row["end"], row["picture"])
        row["verdict"], row["reason"] = (known["verdict"], known["reason"]) if keeps else ("", "")
        rows[file] = row
        write_table(arguments.table, rows)
    return 0


CELL = """<figure class="{verdict}"><img src="data:image/png;base64,{data}" alt="no picture"><figcaption><b>{name}</b>
{end}, {seconds} s {verdict} {reason}<small>{notes}</small></figcaption></figure>"""
PAGE = """<!doctype html><meta charset="utf-8"><title>{title}</title><style>
body {{ font: 10px sans-serif; margin: 4px; display: flex; flex-wrap: wrap; gap: 4px; align-items: flex-start }}
figure {{ margin: 0; width: 150px; overflow-wrap: anywhere }} img {{ width: 150px; height: 150px; object-fit: contain; background: #fdd }}
b, small {{ display: block }} .wrong b {{ color: #c00 }} small {{ color: #555 }}</style>
{cells}
"""


def lay_pages(arguments, per_page=40):
    rows = [row for row in read_table(arguments.table).values() if arguments.only in ",".join(row.values())]
    for number, begin in enumerate(range(0, len(rows), per_page), 1):
        cells = []
        for index, row in enumerate(rows[begin:begin + per_page], begin + 1):
            data = b""
            if row["picture"]:
                with open(picture_path(arguments.pictures, row["file"]), "rb") as image:
                    data = base64.b64encode(image.read())
            place = row["file"].split("/")
            words = {key: html.escape(value[:300]) for key, value in row.items()}
            words["name"] = html.escape("%d %s: %s" % (index, place[0], place[-1]))
            cells.append(CELL.format(data=data.decode(), **words))
        path = os.path.join(arguments.pictures, "page%d.html" % number)
        with open(path, "w", encoding="utf-8") as page:
            page.write(PAGE.format(title="Model files, page %d" % number, cells="\n".join(cells)))
        print(path)
    return 0


def share(counts):
    """Right and rightly refused ones among all."""
    total = sum(counts.values())
    return 100 * (counts["right"] + counts["refused"]) / total if total else 0


def counted(rows):
    """Lines of a table in Markdown."""
    by_format = collections.defaultdict(collections.Counter)
    for row in rows:
        for key in (format_of(row["file"]), "all"):
            by_format[key][row["verdict"] or "unmarked"] += 1
    lines = ["| format | files | right | rightly refused | wrong | right of all |", "|---|---|---|---|---|---|"]
    for key in [f for f in FORMATS if f in by_format] + ["all"]:
        c = by_format[key]
        if c["unmarked"]:
            raise SystemExit("%d rows of %s have no verdict" % (c["unmarked"], key))
        lines.append("| %s | %d | %d | %d | %d | %.1f %% |" %
                     (key, sum(c.values()), c["right"], c["refused"], c["wrong"], share(c)))
    return lines


def count(arguments):
    print("\n".join(counted(read_table(arguments.table).values())))
    return 0


def main(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    command = commands.add_parser("render")
    for name in ("antipode", "folder", "table", "pictures"):
        command.add_argument(name)
    command.add_argument("--list", help="file with the model files to render, relative to FOLDER, one a line")
    command.add_argument("--seconds", type=float, default=280, help="begin no render later than this")
    command.add_argument("--limit", type=float, default=60, help="seconds that a render may take")
    command.add_argument("--again", metavar="WORD")
    command.add_argument("options", nargs="*", help="for antipode render, after --")
    command.set_defaults(run=render_all)
    command = commands.add_parser("pages")
    command.add_argument("table")
    command.add_argument("pictures")
    command.add_argument("--only", default="", metavar="WORD", help="only rows that have this word")
    command.set_defaults(run=lay_pages)
    command = commands.add_parser("count")
    command.add_argument("table")
    command.set_defaults(run=count)
    arguments = parser.parse_args(words)
    return arguments.run(arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
