"""phases.py on a report of perf made up."""

import pathlib
import subprocess
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
REPORT = """
# Overhead  Symbol
    30.00%  [.] riesel::run_converting_loop<riesel::(anonymous namespace)::StepLoop<(riesel::Partner)0, riesel::NoTurning>, rie
     8.00%  [.] riesel::LiveContacts::step(riesel::Bodies const&)
     2.00%  [.] std::__detail::__variant::__gen_vtable_impl<void (*)(riesel::(anonymous namespace)::step_tiles<(riesel::Partner)0>(std
    20.00%  [.] riesel::Appointments::make
    15.00%  [.] riesel::Appointments::link
     5.00%  [.] riesel::run_adding_loop<riesel::(anonymous namespace)::WatchLoop, unsigned long>
    12.00%  [k] exc_page_fault
     8.00%  [.] riesel::io::(anonymous namespace)::seal_text
"""


def phases(report):
    return subprocess.run([sys.executable, "-B", HERE.parent / "phases.py", "-"], input=report, check=False, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)


class Phases(unittest.TestCase):

    def test_samples_of_the_engine_are_shared_out_and_others_told(self):
        done = phases(REPORT)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([line.split(maxsplit=1) for line in done.stdout.splitlines()],
                         [["50.0", "forces of contacts, and their book-keeping"],
                          ["18.8", "sorting, listing, sifting, linking"],
                          ["25.0", "foresight and entering of appointments"],
                          ["6.2", "looking at what is due"],
                          ["0.0", "moving deflected grains, and their courses"],
                          ["20.0", "elsewhere, of all samples"]])

    def test_functions_of_no_phase_are_named(self):
        done = phases(REPORT + "     4.00%  [.] riesel::Novelty::work<int>\n")
        self.assertEqual(done.returncode, 1)
        self.assertIn("4.8  Novelty::work: of no phase", done.stdout)

    def test_a_report_without_samples(self):
        self.assertEqual(phases("# nothing\n").returncode, 2)


if __name__ == "__main__":
    unittest.main()
