#!/usr/bin/env python3
"""The checks of the docs can fail: each is given a small tree with one fault, and the same tree without it.

    checks_test.py --cc CC --cxx CXX
"""
import argparse
import os
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import check_code
import check_commands
import check_figures
import check_scripts
import check_links
import check_words
import make_bindings
import make_decisions
import make_error_cases
import make_results
import tutorial
from commands import help_texts
from markdown import Page

ROOT = Path(__file__).resolve().parents[2]
COMPILERS = ("cc", "c++")

HELP = """#!/bin/sh
case "$1" in
  build) printf 'Usage: spherecloud build [OPTIONS]\\n  -r,--recording PATH  A folder\\n  -h,--help  This\\n' ;;
  *) printf 'Usage: spherecloud\\n\\nSubcommands:\\n  build    Make a map.\\n\\nExit status: 0\\n' ;;
esac
"""


class Checks(unittest.TestCase):
    def setUp(self):
        self.root = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)
        (self.root / "sdk" / "runtime" / "base").mkdir(parents=True)
        (self.root / "sdk" / "include").symlink_to(ROOT / "sdk" / "include")
        self.write("tests/layers/layers.txt", "sdk/runtime/base | |\n")
        self.write("README.md", "# Project\n\n[index](docs/README.md)\n")
        self.write("docs/README.md", "# Index\n\n[one](one.md) [architecture](architecture.md) [decisions](decisions/README.md)\n")
        self.write("docs/architecture.md", "# Folders\n\n`sdk/runtime/base`\n")
        self.write("docs/decisions/README.md", "# Decisions\n\n[0001](0001-first.md)\n")
        self.write("docs/decisions/0001-first.md", "# 0001: First\n\nDate: 2026-01-02. Status: accepted.\n")
        self.page("# One\n\n## A heading\n\nWords.\n")

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def page(self, text):
        self.write("docs/one.md", text)

    def command(self):
        path = self.write("spherecloud", HELP)
        path.chmod(0o755)
        return path

    def links(self):
        return check_links.all_faults(self.root)

    def code(self):
        return check_code.faults_of(self.root, COMPILERS)

    def commands(self):
        return check_commands.all_faults(self.root, [self.command()])

    def scripts(self, text):
        self.write("tests/pipeline/figures.py", text)
        return check_scripts.all_faults(self.root, [self.command()])

    def words(self):
        return check_words.all_faults(self.root, [self.command()])

    def assert_fault(self, faults, words):
        self.assertTrue(any(words in fault for fault in faults), faults)

    def test_a_good_tree_has_no_fault(self):
        self.page("# One\n\n## A heading\n\n[here](#a-heading) [there](architecture.md#folders)\n\n"
                  "```c\n#include <spherecloud/spherecloud.h>\nint f(void);\nint f(void) { return SPHC_OK; }\n```\n\n"
                  "<!-- before:\nint x = 0;\n-->\n```c fragment\nx = SPHC_AGAIN;\n```\n\n`spherecloud build --recording walk`\n")
        self.assertEqual(self.links() + self.code() + self.commands() + self.words(), [])

    def test_a_dead_link(self):
        self.page("[gone](gone.md)\n")
        self.assert_fault(self.links(), "no file gone.md")

    def test_a_dead_anchor(self):
        self.page("# One\n\n[there](architecture.md#gone) [here](#nowhere)\n")
        self.assert_fault(self.links(), "no heading #gone")
        self.assert_fault(self.links(), "no heading #nowhere")

    def test_a_heading_in_a_code_block_is_no_anchor(self):
        self.page("# One\n\n```sh\n# shell comment\n```\n\n[here](#shell-comment)\n")
        self.assert_fault(self.links(), "no heading #shell-comment")

    def test_a_path_that_moved(self):
        self.page("The file `sdk/gone/file.h`.\n")
        self.assert_fault(self.links(), "no file or folder sdk/gone/file.h")

    def test_a_page_that_nothing_leads_to(self):
        self.write("docs/lost.md", "# Lost\n")
        self.assert_fault(self.links(), "lost.md: not reachable")
        self.assert_fault(self.links(), "lost.md is not listed")

    def test_a_page_that_is_listed_twice(self):
        self.write("docs/README.md", (self.root / "docs/README.md").read_text() + "[again](one.md)\n")
        self.assert_fault(self.links(), "one.md is listed 2 times")

    def test_a_folder_without_a_row(self):
        self.write("tests/layers/layers.txt", "sdk/runtime/map | |\n")
        self.assert_fault(self.links(), "no row for sdk/runtime/map")

    def test_code_that_does_not_compile(self):
        self.page("```c\nint f(void);\nint f(void) { return sphc_gone(); }\n```\n")
        self.assert_fault(self.code(), "does not compile")

    def test_a_fragment_that_does_not_compile(self):
        self.page("```c fragment\nsphc_localizer_process(1);\n```\n")
        self.assert_fault(self.code(), "does not compile")

    def test_cpp_that_does_not_compile(self):
        self.page("```cpp fragment\nsphc::Gone gone;\n```\n")
        self.assert_fault(self.code(), "does not compile")

    def test_memory_that_lies_anywhere(self):
        memory = "uint8_t memory[SPHC_MAP_BYTES_MAX];\n```\n"
        self.page("```c fragment\nstatic " + memory)
        self.assert_fault(self.code(), "memory for the library is not aligned")
        self.page("```c fragment\nstatic __attribute__((aligned(64))) " + memory)
        self.assertEqual(self.code(), [])

    def test_an_option_that_is_gone(self):
        self.page("```\nspherecloud build --gone walk\n```\n")
        self.assert_fault(self.commands(), "has no option --gone")

    def test_an_option_in_a_line_that_goes_on(self):
        self.page("```sh\nspherecloud build --recording walk \\\n    --gone\n```\n")
        self.assert_fault(self.commands(), "has no option --gone")

    def test_a_subcommand_that_is_gone(self):
        self.page("`spherecloud bend --recording walk`\n")
        self.assert_fault(self.commands(), "has no subcommand bend")

    def test_an_option_in_prose_that_is_gone(self):
        """Only where both commands are known: an option of the prose may be either's."""
        lab = self.write("spherecloud-lab", HELP)
        lab.chmod(0o755)
        self.page("Say `--recording walk`, or `--gone=1`.\n")
        faults = check_commands.all_faults(self.root, [self.command(), lab])
        self.assertEqual(faults, ["docs/one.md:1: no command has the option --gone"])

    def test_a_script_calls_what_is_gone(self):
        self.assertEqual(self.scripts('run([tool, "build", "--recording", walk])\n'), [])
        self.assertEqual(self.scripts('run([lab.tool, "build", *["--gone", walk]])\n'),
                         ["tests/pipeline/figures.py:1: build has no option --gone"])
        self.assertEqual(self.scripts('run([tool, "bend"])\n'),
                         ["tests/pipeline/figures.py:1: no command has the subcommand bend"])

    def test_a_script_names_an_option_that_is_gone(self):
        script = 'parser.add_argument("--own")\nx = ["--own", "--recording", f"--{name}"]\ny = {"a": "--gone"}\n'
        self.assertEqual(self.scripts(script), ["tests/pipeline/figures.py:3: no command has the option --gone"])

    def test_a_target_that_is_gone(self):
        self.write("tests/CMakeLists.txt", "add_custom_target(kept_results)\nsphc_label(unit some_test)\n")
        self.page("`ninja kept_results gone_results tests_unit tests_gone`\n")
        self.assertEqual(self.commands(), ["docs/one.md:1: the build has no target " + name
                                           for name in ("gone_results", "tests_gone")])

    def test_a_private_word(self):
        self.page("What goes through the\ndoor is checked.\n")
        self.assert_fault(self.words(), "the door")

    def test_a_private_word_of_a_command(self):
        command = self.command()
        command.write_text(HELP.replace("A folder", "A second look"), encoding="utf-8")
        self.assert_fault(check_words.all_faults(self.root, [command]), "spherecloud build --help")

    def test_a_private_word_of_a_source(self):
        source = self.write("sdk/a.cpp", "int twins;  // a name\nint x = 0; // for each\n// look at it, a second\n// look\n")
        self.assertEqual(["sdk/a.cpp:3"], [fault.split(": ")[0] for fault in self.words()])
        source.write_text('char c = \'"\'; const char *s = "its \\"twins\\"";\n', encoding="utf-8")
        self.assert_fault(self.words(), "twins")
        self.write("tests/b.py", "x = 'fates'\ncaps = 1\n")
        self.write("tests/CMakeLists.txt", "set(cap 1) # the door\n")
        self.assertEqual(["sdk/a.cpp:1", "tests/CMakeLists.txt:1", "tests/b.py:1"],
                         [fault.split(": ")[0] for fault in self.words()])

    def test_a_private_word_that_may_stand(self):
        self.write("sdk/a.cpp", 'const char *kKey = "fates of place";\n')
        allowed = [("sdk/a.cpp", "fates of place", "derives a key")]
        self.assertEqual(check_words.all_faults(self.root, [self.command()], allowed), [])
        needless = allowed + [("sdk/a.cpp", "twins", "none there")]
        self.assert_fault(check_words.all_faults(self.root, [self.command()], needless), "needs no \"twins\"")

    def test_the_help_of_every_subcommand_is_read(self):
        self.assertEqual(list(help_texts(self.command())), ["spherecloud", "spherecloud build"])

    def test_a_command_without_subcommands_is_an_error(self):
        silent = self.write("spherecloud", "#!/bin/sh\necho nothing\n")
        silent.chmod(0o755)
        with self.assertRaises(ValueError):
            help_texts(silent)

    def test_the_heads_of_decisions(self):
        folder = self.root / "docs" / "decisions"
        self.assertIn("| [0001](0001-first.md) | First | accepted | 2026-01-02 |", make_decisions.index(folder))
        for text in ("# 1. First\n\nDate: 2026-01-02. Status: accepted.\n", "# 0001: First\n\nAccepted.\n"):
            self.write("docs/decisions/0001-first.md", text)
            with self.assertRaises(ValueError):
                make_decisions.index(folder)

    def test_a_figure_that_moved_changes_the_page(self):
        for folder in ("pipeline", "memory"):
            shutil.copytree(ROOT / "tests" / folder, self.root / "tests" / folder, ignore=shutil.ignore_patterns("*.cpp"))
        self.write("tests/portability/size.csv", (ROOT / "tests" / "portability" / "size.csv").read_text())
        self.assertEqual(make_results.page(self.root), make_results.page(ROOT))
        stack = self.root / "tests" / "memory" / "stack.csv"
        stack.write_text(stack.read_text().replace("sphc_map_init,", "sphc_map_init,9"), encoding="utf-8")
        self.assertNotEqual(make_results.page(self.root), make_results.page(ROOT))

    def test_a_quoted_figure_that_moved(self):
        for page, quotes in check_figures.QUOTES.items():
            for name in (f"docs/{page}", *(f"tests/pipeline/{quote.__name__}.csv" for quote in quotes)):
                self.write(name, (ROOT / name).read_text(encoding="utf-8"))
        self.assertEqual(check_figures.faults_of(self.root), [])
        ledger = self.root / "tests" / "pipeline" / "late_depth.csv"
        ledger.write_text(ledger.read_text(encoding="utf-8").replace(",240,233,", ",240,234,"), encoding="utf-8")
        self.assert_fault(check_figures.faults_of(self.root), 'capture.md: no row "33 ms | none (single) | 234 | 228 |')

    def bindings(self):
        """What the table of the README is made of, and a README that has a place for it."""
        for _, _, program in make_bindings.LANGUAGES:
            self.write(program, (ROOT / program).read_text(encoding="utf-8"))
        for ledger in ("bindings/overhead.csv", "tests/portability/size.csv"):
            self.write(ledger, (ROOT / ledger).read_text(encoding="utf-8"))
        self.write("README.md", f"# Project\n\n{make_bindings.BEGIN}{make_bindings.END}\nMore.\n")

    def test_what_the_table_of_bindings_is_made_of(self):
        self.bindings()
        self.assertEqual(make_bindings.main([str(self.root)]), 0)
        self.assertEqual(make_bindings.main([str(self.root), "--check"]), 0)
        made = (self.root / "README.md").read_text(encoding="utf-8")
        self.assertTrue(made.endswith(f"{make_bindings.END}\nMore.\n"))
        self.assertIn(make_bindings.table(ROOT), made)
        for path, old, new in (("bindings/overhead.csv", ",1.", ",2."), ("tests/portability/size.csv", "-O2,", "-O2,7"),
                               ("bindings/python/examples/first_pose.py", "import sys\n", "import sys\nimport os\n")):
            whole = (self.root / path).read_text(encoding="utf-8")
            self.write(path, whole.replace(old, new))
            self.assertEqual(make_bindings.main([str(self.root), "--check"]), 1, path)
            self.write(path, whole)
        self.write("bindings/overhead.csv", "language\nc\n")
        self.assertEqual(make_bindings.main([str(self.root)]), 1)

    def test_what_a_line_of_code_is(self):
        for name, text in (("a.py", '#!/usr/bin/env python3\n"""A page\nof words.\n"""\nimport a  # one\n\n  # none\nb = """c"""\n'),
                           ("a.c", "/* A page\n   of words. */\nint a; // one\n\n  // none\nint b; /* c */\n")):
            self.assertEqual(make_bindings.lines_of_code(self.write(name, text)), 2, name)

    def test_an_error_case_that_is_lost_or_new(self):
        self.write("sdk/runtime/a.cpp", 'MessageWriter(message) << name << " is null; give one";\nthrow Failure("never " "said; wait");\n')
        text = "A.Case\tsphc_a\tSPHC_E_ARGUMENT\tmap is null; give one\n"
        records = [self.write("refusals/a_test.tsv", text)]
        made = make_error_cases.page(self.root, records)
        self.assertIn("| `A.Case` | `sphc_a` | SPHC_E_ARGUMENT | map is null | give one |", made)
        self.assertIn("1 of the 2 statements", made)
        self.write("docs/error_cases.md", made)
        self.assertEqual(make_error_cases.check(self.root, records), 0)
        for other in ("", text.replace("give one", "give two"), text + text.replace("map", "file")):
            self.write("refusals/a_test.tsv", other)
            self.assertEqual(make_error_cases.check(self.root, records), 1, other)
        self.assertEqual(make_error_cases.check(self.root, [self.root / "none.tsv"]), make_error_cases.SKIPPED)

    def test_of_a_failure_thrown_again_the_last_counts(self):
        inner, outer = ["A.B", "", "exit 1", "is cut; copy it"], ["A.B", "", "exit 1", "a.bin: is cut; copy it"]
        self.assertEqual(make_error_cases.outermost([inner, outer]), [outer])
        self.assertEqual(make_error_cases.outermost([inner, ["A.C", *outer[1:]]]), [inner, ["A.C", *outer[1:]]])

    def test_every_row_of_a_file_is_in_its_table(self):
        text = make_results.flat([{"place": "a", "value": "1"}, {"place": "b", "value": "2"}], ["place"])
        self.assertEqual(text, "### a\n\n| value |\n| --- |\n| 1 |\n\n### b\n\n| value |\n| --- |\n| 2 |\n")

    def test_the_tutorial_prints_something_else(self):
        shown = ["state 1 KiB", "frame 0 at 1.00 0.00 0.00 m, confidence 1.0"]
        self.assertEqual(tutorial.differs(["state 2 KiB", "frame 0 at 1.01 0.00 0.00 m, confidence 0.9"], shown), "")
        self.assertIn("within", tutorial.differs(["state 1 KiB", "frame 0 at 1.10 0.00 0.00 m, confidence 1.0"], shown))
        self.assertIn("instead", tutorial.differs(["state 1 KiB", "frame 0 has no pose: dark"], shown))
        self.assertIn("lines", tutorial.differs(shown[:1], shown))

    def test_indented_blocks_are_code(self):
        self.page("Words:\n\n    spherecloud build --gone\n\nMore.\n")
        self.assertEqual([block.text for block in Page(self.root / "docs/one.md").blocks], ["spherecloud build --gone\n"])
        self.assert_fault(self.commands(), "has no option --gone")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--cc", default="cc")
    parser.add_argument("--cxx", default="c++")
    options = parser.parse_args()
    COMPILERS = (options.cc, options.cxx)
    os.environ["LC_ALL"] = "C"
    unittest.main(argv=sys.argv[:1])
