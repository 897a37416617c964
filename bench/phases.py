#!/usr/bin/env python3
"""What parts of windows take the time: the samples of perf, by the function in which they fell, added up.

    perf record -e cpu-clock -F 2000 -o perf.data build/bench/bench/speed advance STATE.h5 --stepping windows --steps 60000
    bench/phases.py perf.data
    perf report --stdio --no-children -F overhead,sym -i perf.data | bench/phases.py -

Prints per cent of the samples in the engine's functions; what fell elsewhere (reading the state, the system) is told
last. Ends with status 1 if functions of the engine that it does not know have more than a hundredth of them.
"""

import argparse
import re
import subprocess
import sys

# In a call of std::visit the name of whoever is called stands among its arguments.
VISITED = r"std::__detail::__variant::.*riesel::\(anonymous namespace\)::(\w+)<"

# Names without templates, arguments and namespaces; the first that matches counts.
PHASES = [
    ("forces of contacts, and their book-keeping",
     r"StepLoop|LiveContacts::\w+|step_tiles|follow_bodies|FlightRegion::(step_contacts|take_up|change_contacts|let_go|take_up_contacts)|"
     r"meeting_\w+|begin_contact|note_(over|lasting)|add_last_loss|\w*Tally::\w+|ExactSum\w*::\w+|"
     r"count_work_of_walls|see_from_the_other"),
    ("sorting, listing, sifting, linking",
     r"Candidates::\w+|Cells::\w+|sift\w*|find_close\w*|pair_in|earlier|SieveLoop|Appointments::(link|start_over|make_all)|"
     r"Border::list_\w+|Courses::start_over|FlightRegion::(land|start_over|set_out|make_all_appointments)|Flights::(land|renew|begin)|candidate_in"),
    ("foresight and entering of appointments", r"foresee|gather|FlightRegion::(foresee|fetch)|fetch|ForesightLoop|Appointments::\w+|Calendar::\w+|flight_of|steps_\w+"),
    ("looking at what is due",
     r"FlightRegion::(look_\w+|keep_appointments|collide|position)|WatchLoop|CloseWatch::\w+|Border::foreign_motion"),
    ("moving deflected grains, and their courses",
     r"move_lanes|find_off_course|DeflectedGrains::\w+|SkinGuard::\w+|Border::\w+|"
     r"FlightRegion::(move|correct_courses|set_course|deflect|invite|release|suffer|announce|settle|set_out_again|watch_strays)|"
     r"Flights::\w+"),
]
ENGINE = "riesel::"
LOOP = r"riesel::run_(converting|adding)_loop<"  # and which loop that is
ELSEWHERE = r"riesel::(io|bench|scenarios|app)::|riesel::state_hash|riesel::Simulation::|riesel::observe|riesel::energies"


def plain_name(symbol):
    """The name of a function without its templates, arguments and namespaces."""
    name, depth = "", 0
    for letter in re.sub(LOOP, "", symbol).removeprefix(ENGINE).removeprefix("(anonymous namespace)::"):
        depth += (letter in "<(") - (letter in ">)")
        name += letter if depth == 0 and letter not in ">)" else ""
    return name.split(",")[0]


def samples(report):
    """Pairs of per cent and symbol of perf's report."""
    for line in report.splitlines():
        found = re.match(r"\s*([0-9.]+)%\s+\[[.k]\]\s+(.*?)\s*$", line)
        if found:
            yield float(found[1]), found[2]


def phase_of(symbol):
    """The phase of a function of the engine, "" if it is not known, None if it is not of the engine."""
    symbol = re.sub(VISITED + ".*", ENGINE + r"\1", symbol)
    if not symbol.startswith(ENGINE) or re.match(ELSEWHERE, symbol):
        return None
    name = plain_name(symbol)
    return next((phase for phase, pattern in PHASES if re.fullmatch(pattern, name)), "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data", help="what perf recorded, or - for its report on the standard input")
    data = parser.parse_args().data
    try:
        report = sys.stdin.read() if data == "-" else subprocess.run(
            ["perf", "report", "--stdio", "--no-children", "-F", "overhead,sym", "-i", data], check=True, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE).stdout
    except FileNotFoundError:
        sys.exit("phases.py: perf is not installed")
    except subprocess.CalledProcessError as failed:
        sys.exit(f"phases.py: perf cannot read {data}: {failed.stderr.strip()}")

    shares = dict.fromkeys([phase for phase, _ in PHASES], 0.0)
    elsewhere, unknown = 0.0, {}
    for share, symbol in samples(report):
        phase = phase_of(symbol)
        if phase is None:
            elsewhere += share
        elif phase:
            shares[phase] += share
        else:
            unknown[plain_name(symbol)] = unknown.get(plain_name(symbol), 0.0) + share
    total = sum(shares.values()) + sum(unknown.values())
    if total == 0.0:
        print("phases.py: no samples in the engine", file=sys.stderr)
        return 2
    for phase, share in shares.items():
        print(f"{100.0 * share / total:5.1f}  {phase}")
    for name, share in unknown.items():
        print(f"{100.0 * share / total:5.1f}  {name}: of no phase")
    print(f"{elsewhere:5.1f}  elsewhere, of all samples")
    return 1 if sum(unknown.values()) > 0.01 * total else 0


if __name__ == "__main__":
    sys.exit(main())
