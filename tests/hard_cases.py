#!/usr/bin/env python3
"""Writes the page of hard cases from the rows that tests recorded: hard_cases.py ROWS PAGE

ROWS holds one JSON object a line, see support/hard_case.h. Where a group has no row, a measured value exceeds its bound
or rows contradict each other, it says so, leaves the page as it is and ends with status 1.
"""
import json
import math
import os
import re
import sys
from collections import defaultdict

GROUPS = ["Closed forms", "MIS", "Near-singular geometry", "Intersection", "Scale", "Sampling", "Long paths", "Merging",
          "Lights", "Shading normals", "Images", "Accumulation", "Precision", "Convergence rates", "Bad input"]

INTRODUCTION = """\
# Hard cases

What could make a render wrong without anyone noticing, measured. Every row is a case that a test of this folder
computes or renders, with the greatest value that passes and what was measured, single precision beside double. A test
that measures the same thing several times, over techniques, scales or parts of an image, shows its worst. Of a
hypothesis test −log₁₀ p is shown; its bound is what a significance of .01 leaves each of the tests that belong
together. Cases link to the tests, which state hypotheses and seeds.

`deploy/hard-cases.sh` makes this page from a run of the tests, and fails where a value exceeds its bound.
"""

FOUND = os.path.join(os.path.dirname(os.path.abspath(__file__)), "hard_cases_found.md")

# Words of code names that people write otherwise.
WORDS = {"mis": "MIS", "bsdf": "BSDF", "bsdfs": "BSDFs", "bvh": "BVH", "ggx": "GGX", "vcm": "VCM", "bpt": "BPT",
         "bpm": "BPM", "ppm": "PPM", "hd": "HD", "gltf": "glTF", "glb": "GLB", "nan": "NaN", "exr": "EXR"}


def load(lines):
    """The rows, numbers as floats, and the lines' faults."""
    rows, faults = [], []
    for line in filter(str.strip, lines):
        row = json.loads(line)
        row["bound"], row["measured"] = float(row["bound"]), float(row["measured"])
        rows.append(row)
        if row["group"] not in GROUPS:
            faults.append(f"{row['case']}: there is no group '{row['group']}'")
        if not row["measured"] <= row["bound"]:
            faults.append("{group}: {case} ({precision} on {device}): {quantity} is {measured:g}, more than {bound:g}"
                          .format(**row))
    return rows, faults


def contradictions(rows):
    bounds = defaultdict(set)
    for row in rows:
        bounds[row["case"], row["quantity"], row["device"], row["precision"]].add(row["bound"])
    return [f"{case} ({precision} on {device}): {quantity} has several bounds: {', '.join(map(str, sorted(several)))}"
            for (case, quantity, device, precision), several in sorted(bounds.items()) if len(several) > 1]


def merged(rows):
    """Table lines: what measurements have in common -> parameters, {precision: (bound, worst measured)}. Parameters of
    a test share a line where they share its words and bounds."""
    cases = defaultdict(dict)
    for row in rows:
        key = tuple(row[name] for name in ("case", "difficulty", "quantity", "device", "source"))
        worst = cases[key].get(row["precision"], (row["bound"], -math.inf))[1]
        cases[key][row["precision"]] = (row["bound"], max(worst, row["measured"]))
    lines = defaultdict(lambda: (set(), {}))
    for (case, *common), values in sorted(cases.items()):
        test, _, parameter = case.partition("/")
        bounds = tuple(sorted((precision, bound) for precision, (bound, _) in values.items()))
        parameters, worst = lines[(test, *common, bounds)]
        parameters.add(parameter)
        for precision, (bound, measured) in values.items():
            worst[precision] = (bound, max(measured, worst.get(precision, (0, -math.inf))[1]))
    return lines


def words(name):
    """'HugeRadiusLeavesMergingOnly' -> 'huge radius leaves merging only'."""
    parts = re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+", name)
    return " ".join(part if re.fullmatch("[A-Z]{2,}", part) else WORDS.get(part.lower(), part.lower())
                    for part in parts)


def title(test, parameters):
    """'EngineScale.PowersOfTwoGiveTheSameBytes', {'Area'} -> 'Scale: powers of two give the same bytes (area)'."""
    suite, _, name = test.partition(".")
    subject = words(re.sub(r"^Engine(?=.)|(?<=.)Test$", "", suite))
    several = sorted(words(parameter) for parameter in parameters if parameter)
    variants = ", ".join(several) if len(several) <= 4 else f"{len(several)} variants"
    return f"{subject[:1].upper()}{subject[1:]}: {words(name)}" + (f" ({variants})" if several else "")


def number(value):
    """Three significant digits: '0.123', '1.2e-7'."""
    text = f"{value:.3g}" if value == 0 or abs(value) >= 1e-3 else re.sub(r"\.?0+e", "e", f"{value:.2e}")
    return re.sub(r"e([+-])0*(\d+)", lambda m: "e" + m[1].strip("+") + m[2], text)


def cell(text):
    return text.replace("|", "\\|")


def bound_of(values):
    bounds = {precision: number(bound) for precision, (bound, _) in values.items()}
    if len(set(bounds.values())) == 1:
        return next(iter(bounds.values()))
    return f"{bounds['float']} (double {bounds['double']})"


def short_names(devices):
    """Devices without the driver's details in brackets, where that leaves them apart."""
    short = {device: re.sub(r" *\(.*\)", "", device) for device in devices}
    return short if len(set(short.values())) == len(devices) else {device: device for device in devices}


def table(lines, devices):
    """Cases and difficulties that repeat the line above are left out."""
    yield "| Case | What is hard | Quantity | Bound | float | double | Device |"
    yield "|---|---|---|--:|--:|--:|---|"
    titled = [((title(key[0], parameters), *key[1:]), values) for key, (parameters, values) in lines.items()]
    above = ("", "")
    for (case, difficulty, quantity, device, source, _), values in sorted(titled, key=lambda line: line[0]):
        shown = ("" if case == above[0] else f"[{case}]({source})", "" if (case, difficulty) == above else difficulty)
        above = (case, difficulty)
        measured = (number(values[p][1]) if p in values else "–" for p in ("float", "double"))
        cells = (*shown, quantity, bound_of(values), *measured, devices[device])
        yield "| " + " | ".join(cell(text) for text in cells) + " |"


def cases_of(rows, group):
    return {row["case"] for row in rows if row["group"] == group}


def page(rows):
    by_group = {group: merged(row for row in rows if row["group"] == group) for group in GROUPS}
    devices = sorted({row["device"] for row in rows})
    yield INTRODUCTION
    kernels = [device for device in devices if device != "host"]
    cases, quantities = sum(len(cases_of(rows, group)) for group in GROUPS), sum(map(len, by_group.values()))
    yield (f"{cases} cases in {len(GROUPS)} groups, {quantities} quantities. The kernels ran on "
           f"{' and on '.join(kernels) or 'no device'}; *host* is arithmetic on the processor, without kernels.\n")
    yield "| Group | Cases | Quantities |"
    yield "|---|--:|--:|"
    for group, lines in by_group.items():
        anchor = group.lower().replace(" ", "-")
        yield f"| [{group}](#{anchor}) | {len(cases_of(rows, group))} | {len(lines)} |"
    for group, lines in by_group.items():
        yield f"\n## {group}\n"
        yield from table(lines, short_names(devices))
    yield "\n## What failed at first\n"
    with open(FOUND, encoding="utf-8") as file:
        yield file.read().rstrip("\n")


def main(rows_path, page_path):
    with open(rows_path, encoding="utf-8") as file:
        rows, faults = load(file)
    faults += contradictions(rows)
    present = {row["group"] for row in rows}
    faults += [f"{group}: no test recorded a row" for group in GROUPS if group not in present]
    if faults:
        sys.exit("\n".join(faults))
    with open(page_path + ".part", "w", encoding="utf-8") as file:
        file.write("\n".join(page(rows)) + "\n")
    os.replace(page_path + ".part", page_path)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: hard_cases.py ROWS PAGE")
    main(*sys.argv[1:])
