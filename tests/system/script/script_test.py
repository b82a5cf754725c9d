"""Runs ./lifeline as a user does, as far as it neither installs nor builds: script_test.py CHECKOUT"""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

CHECKOUT = pathlib.Path(sys.argv[1]).resolve()


def lifeline(*arguments, folder=CHECKOUT):
    return subprocess.run([CHECKOUT / "lifeline", *arguments], cwd=folder, capture_output=True, text=True, timeout=60)


class Script(unittest.TestCase):
    def test_help_names_every_command(self):
        for ask in (["help"], ["--help"], []):
            done = lifeline(*ask)
            self.assertEqual(done.returncode, 0)
            for command in ("demo", "test", "build", "bench", "setup", "help"):
                self.assertIn(f"\n  {command} ", done.stdout)

    def test_works_from_any_folder_and_through_a_link(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(lifeline("help", folder=folder).returncode, 0)
            link = pathlib.Path(folder) / "ll"
            link.symlink_to(CHECKOUT / "lifeline")
            done = subprocess.run([link, "setup"], cwd=folder, capture_output=True, text=True, timeout=60)
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_setup_says_nothing_when_nothing_is_missing(self):
        done = lifeline("setup")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_wrong_use_is_told_in_one_line_with_status_2(self):
        for wrong in (["dance"], ["test", "--shallow"], ["build", "everything"], ["bench", "no-such-benchmark"]):
            done = lifeline(*wrong)
            self.assertEqual(done.returncode, 2, wrong)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertEqual(done.stdout, "")

    def test_every_package_has_its_reason(self):
        for line in (CHECKOUT / "deploy/packages.txt").read_text().splitlines():
            if line and not line.startswith("#"):
                self.assertRegex(line, r"^[a-z0-9][a-z0-9+.-]+ +# \S", line)

    def test_every_link_in_the_documents_leads_somewhere(self):
        for document in [*CHECKOUT.glob("*.md"), *CHECKOUT.glob("docs/**/*.md")]:
            for target in re.findall(r"\]\(([^)#:]+)[^):]*\)", document.read_text()):
                self.assertTrue((document.parent / target).exists(), f"{document}: {target}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
