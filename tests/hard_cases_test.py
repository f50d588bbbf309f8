"""hard_cases.py on rows made up here."""
import json
import os
import tempfile
import unittest

import hard_cases


def row(**changes):
    return {"group": "Scale", "case": "EngineScale.PowersOfTen/Area", "source": "techniques/scale_test.cpp",
            "difficulty": "a scene | of 10^5", "quantity": "largest |t|", "bound": 1, "measured": 0.5,
            "precision": "float", "device": "llvmpipe (LLVM 15)", **changes}


def complete():
    return [row(group=group) for group in hard_cases.GROUPS if group != "Scale"]


class Page(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.rows, self.page = os.path.join(folder.name, "rows"), os.path.join(folder.name, "page.md")

    def write(self, rows):
        with open(self.rows, "w", encoding="utf-8") as file:
            file.writelines(json.dumps(r) + "\n" for r in rows)
        hard_cases.main(self.rows, self.page)
        with open(self.page, encoding="utf-8") as file:
            return file.read()

    def section(self, rows):
        return self.write(complete() + rows).split("\n## Scale\n")[1].split("\n## ")[0].strip().splitlines()[2:]

    def refusal(self, rows):
        with open(self.page, "w", encoding="utf-8") as file:
            file.write("before")
        with self.assertRaises(SystemExit) as refused:
            self.write(rows)
        with open(self.page, encoding="utf-8") as file:
            self.assertEqual(file.read(), "before")
        self.assertEqual(len(os.listdir(os.path.dirname(self.page))), 2)
        return refused.exception.code

    def test_float_and_double_share_a_line(self):
        lines = self.section([row(precision="double", measured=1.23456e-9), row(measured=0.12345)])
        self.assertEqual(lines, ["| [Scale: powers of ten (area)](techniques/scale_test.cpp) | a scene \\| of 10^5 | "
                                 "largest \\|t\\| | 1 | 0.123 | 1.23e-9 | llvmpipe |"])

    def test_other_devices_and_quantities_have_lines_of_their_own(self):
        lines = self.section([row(), row(device="host"), row(quantity="differing bytes", bound=0, measured=0)])
        self.assertEqual(len(lines), 3)
        self.assertTrue(all(line.startswith("|  |  | largest") for line in lines[1:]))
        self.assertIn("| 0 | 0 | – |", lines[0])

    def test_the_worst_of_repetitions_is_shown(self):
        lines = self.section([row(measured=m) for m in (0.25, 0.75, 0.5)])
        self.assertEqual(len(lines), 1)
        self.assertIn("| 0.75 |", lines[0])

    def test_bounds_may_differ_between_float_and_double(self):
        lines = self.section([row(), row(precision="double", bound=1e-9, measured=0)])
        self.assertIn("| 1 (double 1e-9) |", lines[0])

    def test_order_of_rows_does_not_matter(self):
        rows = complete() + [row(case=f"A.B/{i}", measured=i / 10) for i in range(10)]
        self.assertEqual(self.write(rows), self.write(rows[::-1]))

    def test_parameters_share_a_line_where_words_and_bounds_agree(self):
        lines = self.section([row(case=f"A.B/{i}", measured=i / 10) for i in range(6)] + [row(case="A.B/6", bound=7)])
        self.assertEqual(len(lines), 2)
        self.assertIn("[A: b (6 variants)]", lines[0])
        self.assertIn("| 1 | 0.5 |", lines[0])
        self.assertIn("[A: b (6)]", lines[1])

    def test_totals(self):
        text = self.write(complete() + [row(), row(quantity="another"), row(case="A.B")])
        groups = len(hard_cases.GROUPS)
        self.assertIn(f"{groups + 1} cases in {groups} groups, {groups + 2} quantities", text)
        self.assertIn("| [Scale](#scale) | 2 | 3 |", text)

    def test_a_group_without_rows_is_named(self):
        self.assertEqual(self.refusal(complete()), "Scale: no test recorded a row")

    def test_what_exceeds_its_bound_is_named(self):
        for measured in (1.01, "nan", "inf"):
            message = self.refusal(complete() + [row(measured=measured)])
            self.assertIn("Scale: EngineScale.PowersOfTen/Area (float on llvmpipe (LLVM 15)): largest |t| is", message)

    def test_several_bounds_of_one_quantity_are_refused(self):
        self.assertIn("largest |t| has several bounds: 1.0, 2.0", self.refusal(complete() + [row(), row(bound=2)]))

    def test_unknown_groups_are_refused(self):
        self.assertIn("no group 'Scales'", self.refusal(complete() + [row(), row(group="Scales")]))

    def test_names(self):
        self.assertEqual(hard_cases.title("BsdfValuesTest.GgxAlbedosAreTheClosedForms", {""}),
                         "BSDF values: GGX albedos are the closed forms")
        self.assertEqual(hard_cases.title("Engine.IsXYZ", {"Point", "AreaLight20"}),
                         "Engine: is XYZ (area light 20, point)")

    def test_numbers(self):
        shown = [hard_cases.number(v) for v in (0, 1, 1e-4, 1.2e-4, 1.2345e-10, -1.5e-9, 10.0 / 3, 0.001, 100, 1234567)]
        self.assertEqual(shown, ["0", "1", "1e-4", "1.2e-4", "1.23e-10", "-1.5e-9", "3.33", "0.001", "100", "1.23e6"])


if __name__ == "__main__":
    unittest.main()
