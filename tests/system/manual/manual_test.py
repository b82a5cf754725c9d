"""Man pages and completion say what the programs themselves say: manual_test.py BUILD SOURCE CMAKE."""

import functools
import os
import pathlib
import pty
import re
import select
import subprocess
import sys
import tempfile
import time
import unittest

BUILD, SOURCE, CMAKE = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
PROGRAMS = ["lifeline-agent", "lifeline-coordinator", "lifeline-demo"]


def run(*command, status=0, **more):
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, **more)
    assert done.returncode == status, (command, done.returncode, done.stdout, done.stderr)
    return done.stdout


@functools.cache
def help_of(program, *command):
    return run(BUILD / "bin" / program, *command, "--help")


def commands_of(program):
    _, _, listed = help_of(program).partition("Subcommands:")
    return re.findall(r"^  (\w+)", listed, re.MULTILINE)


def options_of(program, *command):
    found = set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", help_of(program, *command), re.MULTILINE))
    return found - {"--help"}


def sections_of(program):
    """The man page's sections that name options, as {command: {option}}; a program of one command has "description"."""
    page = (SOURCE / "docs/man" / f"{program}.1.scd").read_text()
    sections = re.split(r"^# (.+)$", page, flags=re.MULTILINE)
    named = {}
    for name, text in zip(sections[1::2], sections[2::2]):
        terms = [line for line in text.splitlines() if line.startswith("*--")]
        named[name.lower()] = {option for line in terms for option in re.findall(r"\*(--[\w-]+)\*", line)}
    return named


class Manual(unittest.TestCase):
    def test_man_pages_name_every_option_and_no_other(self):
        for program in PROGRAMS:
            sections = sections_of(program)
            commands = commands_of(program)
            self.assertEqual(program == "lifeline-demo", not commands)
            for command in commands or [None]:
                with self.subTest(program=program, command=command):
                    options = options_of(program, *([command] if command else []))
                    self.assertEqual(sections[command or "description"], options)
            described = {name for name, options in sections.items() if options}
            self.assertEqual(described, set(commands or ["description"]))

    def test_what_is_installed_is_where_tools_look_for_it(self):
        with tempfile.TemporaryDirectory() as prefix:
            run(CMAKE, "--install", BUILD, "--prefix", prefix)
            for program in PROGRAMS:
                self.assertTrue(os.access(f"{prefix}/bin/{program}", os.X_OK))
                page = pathlib.Path(prefix, "share/man/man1", program + ".1").read_text()
                self.assertIn(f'.TH "{program}" "1"', page)
                share = f"{prefix}/share"
                run("bash", "-n", f"{share}/bash-completion/completions/{program}")
                run("zsh", "-f", "-n", f"{share}/zsh/site-functions/_{program}")
                run("fish", "--no-config", "--no-execute", f"{share}/fish/vendor_completions.d/{program}.fish")


def each_command():
    for program in PROGRAMS:
        for command in commands_of(program) or [None]:
            yield program, command, [command] if command else []


class Terminal:
    """A shell that a person sits at."""

    def __init__(self, test, *command):
        self.test, self.shown = test, ""
        self.child, self.terminal = pty.fork()
        if self.child == 0:
            os.environ.update(PS1="ready> ", TERM="dumb", INPUTRC="/dev/null", PATH=f"{BUILD}/bin:{os.environ['PATH']}")
            os.execvp(command[0], command)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self.terminal)
        os.kill(self.child, 9)
        os.waitpid(self.child, 0)

    def types(self, text):
        os.write(self.terminal, text)

    def wait_for(self, text):
        end = time.monotonic() + 120
        while text not in self.shown:
            self.test.assertLess(time.monotonic(), end, self.shown)
            if select.select([self.terminal], [], [], 0.1)[0]:
                self.shown += os.read(self.terminal, 4096).decode(errors="replace")


class Completion(unittest.TestCase):
    def complete(self, program, *words, folder=None):
        """What bash's own completion function answers for these words, the last one unfinished."""
        quoted = " ".join(f"'{word}'" for word in (program, *words))
        function = "_" + program.replace("-", "_")
        script = (f"source <('{BUILD}/bin/{program}' completion bash); COMP_WORDS=({quoted}); COMP_CWORD={len(words)}; "
                  f"{function} {program}; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
        return set(run("bash", "--norc", "-c", script, cwd=folder).split())

    def test_every_command_and_option_is_completed(self):
        for program in PROGRAMS:
            commands = commands_of(program)
            if commands:
                self.assertEqual(self.complete(program, ""), {*commands, "--help"})
            for command in commands or [None]:
                given = [command] if command else []
                with self.subTest(program=program, command=command):
                    self.assertEqual(self.complete(program, *given, "--") - {"--help"}, options_of(program, *given))

    def test_values_are_completed(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "helmet 1.yaml").touch()
            pathlib.Path(folder, "state").mkdir()
            self.assertEqual(self.complete("lifeline-agent", "run", "--matcher", ""), {"conventional", "advanced", "direct"})
            self.assertEqual(self.complete("lifeline-agent", "run", "--matcher", "=", "ad"), {"advanced"})
            self.assertEqual(self.complete("lifeline-agent", "run", "--state", "", folder=folder), {"state"})
            self.assertEqual(self.complete("lifeline-agent", "run", "--config", "helm", folder=folder), {"helmet", "1.yaml"})
            self.assertEqual(self.complete("lifeline-agent", "run", "--id", "", folder=folder), set())
            self.assertEqual(self.complete("lifeline-coordinator", "match", "st", folder=folder), {"state"})

    def test_a_person_presses_tab(self):
        with Terminal(self, "bash", "--norc", "--noprofile", "-i") as terminal:
            terminal.wait_for("ready> ")
            terminal.types(b"source <(lifeline-coordinator completion bash); echo is\"\"sourced\n")
            terminal.wait_for("issourced")
            terminal.types(b"lifeline-coordinator doc\t--dash\toff --js\t")
            terminal.wait_for("lifeline-coordinator doctor --dashboard off --json")

    def test_another_shell_is_refused_in_one_line(self):
        done = subprocess.run([BUILD / "bin/lifeline-agent", "completion", "tcsh"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1))


class ZshCompletion(unittest.TestCase):
    # What the function asks zsh's own completion for, one a line.
    STUBS = r"""
        compdef() { :; }
        _arguments() { print -rl -- "$@"; }
        _describe() { print -rl -- "${(@P)2}"; }
    """

    def asked_for(self, program, *words):
        quoted = " ".join(f"'{word}'" for word in (program, *words))
        function = "_" + program.replace("-", "_")
        script = f"{self.STUBS}\nsource <('{BUILD}/bin/{program}' completion zsh); words=({quoted}); CURRENT={len(words) + 1}; {function}"
        return run("zsh", "-f", "-c", script).splitlines()

    def test_every_command_and_option_is_completed(self):
        for program in PROGRAMS:
            commands = commands_of(program)
            if commands:
                asked = self.asked_for(program, "")
                self.assertEqual({line.partition(":")[0] for line in asked if not line.startswith("(")}, set(commands))
        for program, command, given in each_command():
            with self.subTest(program=program, command=command):
                asked = self.asked_for(program, *given, "--")
                named = {option for line in asked for option in re.findall(r"^(?:\*|\([^)]*\))(--[\w-]+)=?\[", line)}
                self.assertEqual(named - {"--help"}, options_of(program, *given))

    def test_a_person_presses_tab(self):
        with tempfile.TemporaryDirectory() as folder, Terminal(self, "zsh", "-f", "-i") as terminal:
            pathlib.Path(folder, "unique-folder").mkdir()
            pathlib.Path(folder, "unique-file").touch()
            terminal.types(f"cd '{folder}'; autoload -Uz compinit; compinit -D -u; ".encode())
            terminal.types(b"source <(lifeline-coordinator completion zsh); source <(lifeline-agent completion zsh); echo is\"\"sourced\n")
            terminal.wait_for("issourced")
            # What a terminal shows while it is typed is redrawn: what the command is given counts.
            terminal.types(b"lifeline-agent lifeline-coordinator() { print -r -- \"given: $*\" }\n")
            terminal.types(b"lifeline-coordinator doc\t--dash\toff --js\t\n")
            terminal.wait_for("given: doctor --dashboard=off --json")
            terminal.types(b"lifeline-agent run --mat\tadv\t--state=uniq\t\n")
            terminal.wait_for("given: run --matcher=advanced --state=unique-folder")


class FishCompletion(unittest.TestCase):
    def complete(self, program, *words, folder=None):
        line = " ".join((program, *words))
        script = f"'{BUILD}/bin/{program}' completion fish | source; complete -C '{line}'"
        done = run("fish", "--no-config", "-c", script, cwd=folder)
        return {suggested.partition("\t")[0] for suggested in done.splitlines()}

    def test_every_command_and_option_is_completed(self):
        for program in PROGRAMS:
            if commands := commands_of(program):
                self.assertEqual(self.complete(program, ""), set(commands))
        for program, command, given in each_command():
            with self.subTest(program=program, command=command):
                self.assertEqual(self.complete(program, *given, "--") - {"--help"}, options_of(program, *given))

    def test_values_are_completed(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "helmet.yaml").touch()
            pathlib.Path(folder, "state").mkdir()
            self.assertEqual(self.complete("lifeline-agent", "run", "--matcher", ""), {"conventional", "advanced", "direct"})
            self.assertEqual(self.complete("lifeline-agent", "run", "--state", "", folder=folder), {"state/"})
            self.assertEqual(self.complete("lifeline-agent", "run", "--config", "helm", folder=folder), {"helmet.yaml"})
            self.assertEqual(self.complete("lifeline-agent", "run", "--id", "", folder=folder), set())
            self.assertEqual(self.complete("lifeline-coordinator", "match", "st", folder=folder), {"state/"})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
