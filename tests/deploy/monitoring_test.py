"""Alerts and board ask for what is told: each of their metrics is one of a program, and Prometheus takes the alerts."""
import json
import pathlib
import re
import shutil
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "deploy/monitoring"
SOURCES = ["server/server.cpp", "client/farm_metrics.cpp"]


def told():
    return set(re.findall(r'"(antipode_[a-z_]+)"', "".join((ROOT / name).read_text() for name in SOURCES)))


def asked(text):
    return set(re.findall(r"\bantipode_[a-z_]+", text))


class Metrics(unittest.TestCase):
    def test_alerts_ask_for_what_is_told(self):
        expressions = re.findall(r"expr: (.*)", (FOLDER / "rules.yaml").read_text())
        names = asked("\n".join(expressions))
        self.assertGreater(len(names), 4)
        self.assertLessEqual(names, told())

    def test_the_board_asks_for_what_is_told(self):
        board = json.loads((FOLDER / "grafana-farm.json").read_text())
        expressions = [target["expr"] for panel in board["panels"] for target in panel["targets"]]
        names = asked("\n".join(expressions))
        self.assertGreater(len(names), 10)
        self.assertLessEqual(names, told())
        for panel in board["panels"]:
            self.assertTrue(panel["title"] and panel["gridPos"]["x"] + panel["gridPos"]["w"] <= 24, panel["id"])
        self.assertEqual(len({panel["id"] for panel in board["panels"]}), len(board["panels"]))


@unittest.skipUnless(shutil.which("promtool"), "there is no promtool here")
class Rules(unittest.TestCase):
    def promtool(self, *arguments):
        answer = subprocess.run(["promtool", *arguments], cwd=FOLDER, capture_output=True, text=True, timeout=120)
        self.assertEqual(answer.returncode, 0, answer.stdout + answer.stderr)

    def test_prometheus_reads_them(self):
        self.promtool("check", "rules", "rules.yaml")

    def test_alerts_come_when_they_should_and_only_then(self):
        self.promtool("test", "rules", "rules_test.yaml")


if __name__ == "__main__":
    unittest.main()
