"""model_files.py with a program in antipode's place that needs no device."""
import contextlib
import csv
import io
import os
import stat
import tempfile
import unittest

import model_files

# Writes a picture that is the model's own bytes; broken files are refused, and one never ends.
PROGRAM = """#!/bin/sh
case "$2" in
*broken*) echo "antipode: cannot import '$2': no surface" >&2; exit 1 ;;
*endless*) exec sleep 60 ;;
*crashes*) kill -SEGV $$ ;;
esac
echo "antipode: note: The file has no camera." >&2
echo "antipode: scene: 2 triangles" >&2
cp "$2" "${4%.exr}.png"; cp "$2" "$4"
"""


class ModelFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.models, self.pictures = (os.path.join(folder.name, name) for name in ("models", "pictures"))
        self.table, self.program = (os.path.join(folder.name, name) for name in ("table.csv", "program"))
        os.makedirs(os.path.join(self.models, "sub"))
        self.put("sub/a.obj", "a")
        self.put("broken.PLY", "b")
        self.put("readme.txt", "no model")
        with open(self.program, "w", encoding="utf-8") as program:
            program.write(PROGRAM)
        os.chmod(self.program, stat.S_IRWXU)

    def put(self, name, content):
        with open(os.path.join(self.models, name), "w", encoding="utf-8") as file:
            file.write(content)

    def call(self, *words):
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            code = model_files.main(list(words))
        return code, said.getvalue()

    def render(self, *words):
        self.assertEqual(self.call("render", self.program, self.models, self.table, self.pictures, *words)[0], 0)
        return self.rows()

    def rows(self):
        with open(self.table, encoding="utf-8", newline="") as file:
            return {row["file"]: row for row in csv.DictReader(file)}

    def judge(self, file, verdict):
        rows = model_files.read_table(self.table)
        rows[file]["verdict"] = verdict
        model_files.write_table(self.table, rows)

    def test_tells_how_each_ended(self):
        self.put("crashes.stl", "c")
        self.put("endless.dae", "d")
        rows = self.render("--limit", "0.5")
        self.assertEqual({file: row["end"] for file, row in rows.items()},
                         {"sub/a.obj": "exit 0", "broken.PLY": "exit 1", "crashes.stl": "signal 11",
                          "endless.dae": "no end in 0.5 s"})
        self.assertEqual(rows["sub/a.obj"]["notes"], "The file has no camera.")
        self.assertEqual(rows["broken.PLY"]["notes"], "cannot import 'broken.PLY': no surface")

    def test_verdicts_last_as_long_as_their_picture(self):
        self.render()
        self.judge("sub/a.obj", "right")
        self.judge("broken.PLY", "refused")
        self.assertEqual(self.render("--again", "")["sub/a.obj"]["verdict"], "right")
        self.put("sub/a.obj", "another")
        rows = self.render("--again", "")
        self.assertEqual((rows["sub/a.obj"]["verdict"], rows["broken.PLY"]["verdict"]), ("", "refused"))

    def test_takes_up_where_it_was_ended(self):
        self.assertEqual(self.call("render", self.program, self.models, self.table, self.pictures, "--seconds", "-1")[0], 3)
        self.assertFalse(os.path.exists(self.table))
        self.assertEqual(len(self.render()), 2)

    def test_lays_pages(self):
        self.render()
        code, said = self.call("pages", self.table, self.pictures)
        self.assertEqual(code, 0)
        with open(said.strip(), encoding="utf-8") as page:
            text = page.read()
        self.assertEqual(text.count("<figure"), 2)
        self.assertIn("a.obj", text)

    def test_counts_no_table_with_open_verdicts(self):
        self.render()
        self.judge("sub/a.obj", "wrong")
        with self.assertRaises(SystemExit):
            self.call("count", self.table)
        self.judge("broken.PLY", "refused")
        said = self.call("count", self.table)[1]
        self.assertIn("| all | 2 | 0 | 1 | 1 | 50.0 % |", said)


if __name__ == "__main__":
    unittest.main()
