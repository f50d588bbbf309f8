"""Pages of the manual and completion of shells, as they are installed. The first argument is the folder share/."""
import pathlib
import shutil
import subprocess
import sys
import unittest

SHARE = pathlib.Path(sys.argv.pop(1))
PAGES = sorted((SHARE / "man/man1").glob("*.1"))
BASH = SHARE / "bash-completion/completions"


def run(*command, **options):
    return subprocess.run(command, capture_output=True, text=True, timeout=60, **options)


def tool(name):
    return unittest.skipUnless(shutil.which(name), f"there is no {name} here")


def completed(program, *words):
    """What bash offers for the last of the words that follow the program's name."""
    line = [program, *words]
    script = (f"source {BASH / program}; COMP_WORDS=({' '.join(repr(w) for w in line)}); COMP_CWORD={len(words)}; "
              f"COMPREPLY=(); _{program.replace('-', '_')}; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
    answer = run("bash", "-c", script)
    if answer.returncode or answer.stderr:
        raise AssertionError(answer.stderr)
    return answer.stdout.split()


class Pages(unittest.TestCase):
    def test_there_is_one_for_each_program_and_command(self):
        names = {page.stem for page in PAGES}
        self.assertLessEqual({"antipode", "antipode-server", "antipode-render", "antipode-devices"}, names)
        overview = (SHARE / "man/man1/antipode.1").read_text().replace("\\-", "-")
        for name in names - {"antipode", "antipode-server"}:
            self.assertIn(f"{name}\\fR(1)", overview)

    @tool("mandoc")
    def test_mandoc_finds_nothing(self):
        for page in PAGES:
            # That the page has no date is no fault: builds are to be alike.
            found = [line for line in run("mandoc", "-T", "lint", "-W", "warning", str(page)).stdout.splitlines()
                     if "missing date" not in line]
            self.assertEqual(found, [], page)

    @tool("groff")
    def test_groff_finds_nothing(self):
        for page in PAGES:
            answer = run("groff", "-man", "-ww", "-T", "utf8", "-z", str(page))
            self.assertEqual(answer.stderr, "", page)

    def test_name_variables_and_exit_codes(self):
        page = (SHARE / "man/man1/antipode-server.1").read_text().replace("\\-", "-")
        self.assertIn("ANTIPODE_SERVER_PSK_FILE", page)
        self.assertIn("\\fB75\\fR", page)
        self.assertNotIn("ANTIPODE_SERVER_CLIENT_SECRET", page)


class Completion(unittest.TestCase):
    def test_bash_reads_it(self):
        for script in BASH.iterdir():
            answer = run("bash", "-n", str(script))
            self.assertEqual((answer.returncode, answer.stderr), (0, ""), script)

    def test_bash_offers_what_fits(self):
        self.assertEqual(completed("antipode", "rend"), ["render"])
        self.assertEqual(completed("antipode", "render", "--light-p"), ["--light-paths"])
        self.assertEqual(completed("antipode", "render", "--studio", "s"), ["soft", "sun"])
        self.assertEqual(completed("antipode", "render", "--studio", "=", "s"), ["soft", "sun"])
        self.assertEqual(completed("antipode", "render", "--up", ""), ["y", "z"])
        self.assertEqual(completed("antipode", "render", "--without", "merging,next"), ["merging,next-event"])
        self.assertEqual(completed("antipode", "render", "--exposure", ""), ["auto"], "stops are any number")
        self.assertEqual(completed("antipode", "render", "--width", "-"), [], "a value, not an option")
        self.assertEqual(completed("antipode", "render", ""), [], "names of files")
        self.assertEqual(completed("antipode", "nonsense", ""), [])
        self.assertEqual(completed("antipode-server", "--log-f"), ["--log-format"])
        self.assertEqual(completed("antipode-server", "--log-format", ""), ["text", "json"])

    @tool("zsh")
    def test_zsh_reads_it(self):
        for script in (SHARE / "zsh/site-functions").iterdir():
            answer = run("zsh", "-n", str(script))
            self.assertEqual((answer.returncode, answer.stderr), (0, ""), script)

    @tool("zsh")
    def test_zsh_offers_what_fits(self):
        # zsh completes in a terminal only: zpty is one. Two tabs list what there is.
        script = """zmodload zsh/zpty
zpty -b z zsh -f -i
zpty -w z "PS1=; fpath=($1 \\$fpath); autoload -U compinit; compinit -D -u; antipode() {}; bindkey '^I' complete-word"
zpty -w z "zstyle ':completion:*' list-prompt ''; LISTMAX=999; TERM=dumb; print rea''dy"
while zpty -r z line; do [[ $line == *ready* && $line != *print* ]] && break; done
zpty -n -w z $2$'\\t\\t'
sleep 1
while zpty -rt z line; do print -r -- $line; done
zpty -d z
"""
        def offered(line):
            return run("zsh", "-f", "-c", script, "zsh", str(SHARE / "zsh/site-functions"), line).stdout
        self.assertIn("--light-paths", offered("antipode render --light-p"))
        studio = offered("antipode render --studio s")
        self.assertIn("soft", studio)
        self.assertIn("sun", studio)


if __name__ == "__main__":
    unittest.main()
