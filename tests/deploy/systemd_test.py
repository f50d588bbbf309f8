"""The unit of antipode-server, held to systemd's own checks."""
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

UNIT = pathlib.Path(__file__).resolve().parents[2] / "deploy/systemd/antipode-server.service"
PROGRAM = "/usr/bin/antipode-server"


def analyze(*arguments, text):
    with tempfile.TemporaryDirectory() as folder:
        unit = pathlib.Path(folder) / UNIT.name
        # The program need not be installed here.
        unit.write_text(text.replace(PROGRAM, "/bin/true"))
        return subprocess.run(["systemd-analyze", *arguments, str(unit)], capture_output=True, text=True, timeout=60)


@unittest.skipUnless(shutil.which("systemd-analyze"), "there is no systemd-analyze here")
class Unit(unittest.TestCase):
    def setUp(self):
        self.text = UNIT.read_text()

    def found(self, text):
        answer = analyze("verify", "--man=no", text=text)
        return answer.stdout + answer.stderr

    def test_systemd_knows_every_key(self):
        self.assertEqual(self.found(self.text), "")
        self.assertIn("Unknown key", self.found(self.text.replace("NoNewPrivileges", "NoNewPrivilege")))

    def test_exposure_is_two_at_most(self):
        def passes(text):
            return analyze("security", "--offline=true", "--threshold=20", "--no-pager", text=text).returncode == 0
        self.assertTrue(passes(self.text))
        self.assertFalse(passes(self.text.replace("CapabilityBoundingSet=\n", "").replace("DynamicUser=yes\n", "")))


class Settings(unittest.TestCase):
    def test_lost_devices_are_started_again_and_wrong_command_lines_are_not(self):
        text = UNIT.read_text()
        codes = (UNIT.parents[2] / "terminal/exit_codes.h").read_text()
        usage = re.search(r"exitUsage = (\d+)", codes).group(1)
        self.assertIn("Restart=on-failure\n", text)
        self.assertIn(f"RestartPreventExitStatus={usage}\n", text)


if __name__ == "__main__":
    unittest.main()
