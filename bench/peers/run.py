#!/usr/bin/env python3
"""riesel and other codes side by side on the same states: python3 bench/peers/run.py

For each case all start from the same riesel checkpoints, with the same contact law and the same time step. First it is
checked that they do the same physics over a short time. Then the others' neighbour lists are tuned. Then all are timed in
turns, each time from the state of another seed. docs/suite.md says more. Without --peer it takes those that are installed.
Exit status: 1 if the physics does not agree or a program fails.
"""

import argparse
import datetime
import json
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from compare import FORMAT_VERSION, PEERS, paired_ratio  # noqa: E402
from lammps import Lammps, Liggghts  # noqa: E402
from peer import Failed, NotInstalled, pinned, riesel_name  # noqa: E402
from states import read_state  # noqa: E402
from yade import Yade  # noqa: E402

CODES = {code.name: code for code in (Lammps, Liggghts, Yade)}

# case of the suite -> k_N (N/m) and gamma_t (1/s) of its viscous slip law
CASES = {"tube_start": (2e3, 2e5), "tube_slow": (2e3, 2e5), "tube_stiff": (2e5, 2e6), "dense_sheared": (2e3, 2e5)}
SIZES = ("1.4k", "10k", "100k", "1M")

# Contact laws that riesel shares with others: its settings.
LAWS = {"viscous": lambda k_n, gamma_t: ["contact.slip=viscous", f"contact.slip_damping={gamma_t!r}"],
        "spring": lambda k_n, gamma_t: ["contact.slip=spring", f"contact.slip_stiffness={2.0 / 7.0 * k_n!r} N/m",
                                        "contact.attraction=clip"]}

CORES = (1, 2)
RIESEL = {"plain 1": ("plain", 1, "together"), "plain 2": ("plain", 2, "together"), "plain 2 apart": ("plain", 2, "apart"),
          "windows 1": ("windows", 1, "together"), "windows 2": ("windows", 2, "together"),
          "windows 2 apart": ("windows", 2, "apart")}
LEAST_SPEED = 4e7  # particle-steps/s: riesel does no fewer steps than a code of that speed in the time of a repetition
LEAST_TIME = 0.2  # s, that riesel is timed for, by a first try


class Riesel:
    """The program of the suite, build/bench/bench/speed."""

    def __init__(self, program):
        self.program = str(program)

    def ask(self, *arguments, pin=False):
        command = [self.program, *map(str, arguments)]
        return json.loads(subprocess.run(pinned(command) if pin else command, check=True,
                                         stdout=subprocess.PIPE).stdout)

    def start(self, case, size, seed, law):
        settings = [f"seed={seed}", *LAWS[law](*CASES[case])]
        start = self.ask("state", case, size, *(word for setting in settings for word in ("--set", setting)))
        return start | {"grains_state": read_state(start["checkpoint"])}

    def advance(self, start, variant, warm_up, steps):
        stepping, threads, sharing = RIESEL[variant]
        return self.ask("advance", start["checkpoint"], "--stepping", stepping, "--threads", threads, "--sharing", sharing,
                        "--warm-up", warm_up, "--steps", steps, pin=threads == 1)


def agreement(riesel, peer, start, settings, cores, steps):
    """What both codes make of a state, and whether that is the same, the peer with these settings on so many cores. Over this
    short time the grains keep to their courses, so that the numbers agree to the errors of the time step; later only
    statistics would. The others' errors are of first order: they do ten times as many steps of a tenth. Energy tells of
    forces between grains, momentum of those of walls."""
    finer = start | {"time_step": start["time_step"] / 10, "files": {peer.name: start["files"][peer.name] + "-finer"}}
    peer.write(finer)
    ours = riesel.advance(start, "plain 1", 0, steps)["state"]
    theirs = peer.advance(finer, settings, cores=cores, warm_up=0, steps=10 * steps)["state"]

    def change(state, quantity):
        return state[quantity] - start["state"][quantity]

    def difference(quantity):
        return theirs[quantity] - ours[quantity]

    fallen, energy = start["gravity"] * steps * start["time_step"], start["state"]["kinetic_energy"]
    agree = (abs(difference("mean_vy")) < 0.01 * fallen
             and abs(difference("kinetic_energy")) < 0.01 * max(abs(change(ours, "kinetic_energy")), 1e-3 * energy)
             and abs(difference("contacts_of_grains")) <= max(4, 0.03 * ours["contacts_of_grains"]))
    print(f"  {peer.name} {cores} after {steps} steps, beside riesel: mean v_y {change(theirs, 'mean_vy'):.3g} and "
          f"{change(ours, 'mean_vy'):.3g} m/s more (difference {difference('mean_vy'):.1g}), kinetic energy "
          f"{change(theirs, 'kinetic_energy'):.4g} and {change(ours, 'kinetic_energy'):.4g} J, contacts of grains "
          f"{theirs['contacts_of_grains']:.0f} and {ours['contacts_of_grains']:.0f}{'' if agree else '  DO NOT AGREE'}",
          flush=True)
    return {"steps": steps, "start": start["state"], "riesel": ours, "peer": theirs, "agree": agree}


def tuned(peer, start, steps):
    """The settings with which a peer is fastest without ever looking too late, and its speed then (particle-steps/s): one
    setting after the other, until no other value of any of them is better. The better of two tries counts."""
    speeds, failures = {}, []

    def safe_speed(settings):
        """0 if it looks too late, which may make it lose grains and fail."""
        try:
            answers = [peer.advance(start, settings, cores=1, warm_up=steps // 4, steps=steps) for _ in range(2)]
        except Failed as failure:
            failures.append(failure)
            return 0.0
        safe = all(answer["too_late"] == 0 for answer in answers)
        return start["grains"] * steps / min(answer["seconds"] for answer in answers) if safe else 0.0

    def speed_of(settings):
        key = tuple(settings.items())
        if key not in speeds:
            speeds[key] = safe_speed(settings)
        return speeds[key]

    best, before = peer.usual, None
    while best != before:
        before = best
        for name, values in peer.choices.items():
            best = max([best, *(best | {name: value} for value in values)], key=speed_of)
    if speed_of(best) == 0.0:
        raise RuntimeError("\n".join([f"no settings are safe for {peer.name}", *map(str, failures[-1:])]))
    print(f"  {peer.name} at its best: {', '.join(f'{name} {value:g}' for name, value in best.items())} "
          f"({speed_of(best) * 1e-6:.1f} M/s while tuning)", flush=True)
    return best, speed_of(best)


class Contender(NamedTuple):
    """One way to step a state."""
    advance: Callable  # of start, warm_up, steps
    steps: int


def warm_up_of(steps):
    return max(20, steps // 10)


def timed(contenders, starts):
    """{name: answers of all repetitions}, in turns, their seconds for as many grains as the first start has. Each repetition
    has a start of its own: a state of few grains has by chance half or twice as many contacts as the mean."""
    answers = {name: [] for name in contenders}
    for start in starts:
        for name, (advance, steps) in contenders.items():
            answer = advance(start, warm_up=warm_up_of(steps), steps=steps)
            if answer.get("too_late", 0) > 0:
                print(f"  {name} looked for neighbours too late", flush=True)
            answers[name].append(answer | {"seconds": answer["seconds"] * starts[0]["grains"] / start["grains"]})
    return answers


def row_of(case, size, variant, grains, steps, answers):
    """As a row of the suite's results."""
    seconds = [answer["seconds"] for answer in answers]
    median = statistics.median(seconds)
    return {"case": case, "size": size, "variant": variant, "grains": grains, "unit": "particle-steps",
            "work": grains * steps, "steps": steps, "too_late": [answer.get("too_late", 0) for answer in answers],
            "seconds": {"min": min(seconds), "median": median, "all": seconds},
            "per_second": {"median": grains * steps / median, "max": grains * steps / min(seconds)}}


def ratios_of(rows, peers, law):
    """riesel over each peer on as many cores."""
    pairs = [(riesel_name(variant, law), f"{peer.name} {threads}") for peer in peers
             for variant, (_, threads, _) in RIESEL.items()]
    return [{"over": over, "under": under, **paired_ratio(rows[over], rows[under])._asdict()} for over, under in pairs]


def ways_of_riesel(riesel, law, start, steps):
    """{name: contender}; at least so many steps each, by a first try."""
    ways = {}
    for variant in RIESEL:
        advance = partial(riesel.advance, variant=variant)
        first_try = advance(start, warm_up=warm_up_of(steps), steps=steps)["seconds"]
        ways[riesel_name(variant, law)] = Contender(advance, int(steps * max(1.0, LEAST_TIME / first_try)))
    return ways


def race(riesel, peers, law, starts, seconds):
    """The agreements of all peers, their best settings, and contenders and answers of a repetition of so many seconds."""
    start = starts[0]

    def steps_at(speed, least=1):
        return max(least, int(seconds * speed / start["grains"]))

    def agreements_with(settings, cores):
        return {f"{peer.name} {cores}": agreement(riesel, peer, start, settings(peer), cores, steps=100) for peer in peers}

    agreements = agreements_with(lambda peer: peer.usual, 1)
    best = {peer.name: tuned(peer, start, steps_at(0.5 * peer.about, peer.least_steps)) for peer in peers}
    agreements |= agreements_with(lambda peer: best[peer.name][0], 2)
    fastest = max(LEAST_SPEED, *(speed for _, speed in best.values()))
    contenders = ways_of_riesel(riesel, law, start, steps_at(fastest, max(peer.least_steps for peer in peers)))
    for peer in peers:
        settings, speed = best[peer.name]
        for cores in CORES:
            contenders[f"{peer.name} {cores}"] = Contender(partial(peer.advance, settings=settings, cores=cores),
                                                           steps_at(speed, peer.least_steps))
    return agreements, {name: settings for name, (settings, _) in best.items()}, contenders, timed(contenders, starts)


def tell(rows, ratios):
    for name, row in rows.items():
        print(f"  {name:24} {row['per_second']['median'] * 1e-6:9.1f} M/s, best {row['per_second']['max'] * 1e-6:9.1f}")
    for ratio in ratios:
        print(f"  {ratio['over']} / {ratio['under']}: {ratio['value']:.2f}  [{ratio['least']:.2f} {ratio['most']:.2f}]",
              flush=True)


def compare_case(riesel, peers, law, case, size, options):
    """All of one case in one size with one law."""
    starts = [riesel.start(case, size, seed, law) for seed in range(1, options.repetitions + 1)]
    start, grains = starts[0], starts[0]["grains"]
    print(f"\n{case}, {grains} grains, slip law {law}, k_n = {start['k_n']:g} N/m, gamma_n = {start['gamma_n']:.4g} 1/s, "
          f"time step {start['time_step']:.4g} s", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for seed, one in enumerate(starts):
            one["files"] = {peer.name: str(Path(folder) / f"{peer.name}-{seed}") for peer in peers}
            for peer in peers:
                peer.write(one)
        agreements, settings, contenders, answers = race(riesel, peers, law, starts, options.seconds)
    rows = {name: row_of(case, size, name, grains, contender.steps, answers[name]) for name, contender in contenders.items()}
    ratios = ratios_of(rows, peers, law)
    tell(rows, ratios)
    return {"case": case, "size": size, "law": law, "grains": grains, "agreements": agreements, "settings": settings,
            "ratios": ratios, "rows": list(rows.values())}


def installed(names):
    """The codes of these names; without names all that are there, and there must be one."""
    if names:
        return [CODES[name]() for name in dict.fromkeys(names)]
    found = []
    for code in CODES.values():
        try:
            found.append(code())
        except NotInstalled as problem:
            print(f"without {code.name}: {problem}")
    if not found:
        raise NotInstalled("none of the codes is installed")
    return found


def at_least_one(text):
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError("has to be 1 at least")
    return number


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--speed", type=Path, default=HERE.parents[1] / "build/bench/bench/speed",
                        help="the suite's program")
    parser.add_argument("--peer", action="append", choices=list(CODES), help="default: all that are installed")
    parser.add_argument("--case", action="append", choices=list(CASES))
    parser.add_argument("--size", action="append", choices=SIZES, help="default: 1.4k and 10k")
    parser.add_argument("--repetitions", type=at_least_one, default=7, help="each from the state of another seed")
    parser.add_argument("--seconds", type=float, default=2.0, help="that a repetition takes the others on one core")
    parser.add_argument("--out", type=Path, help="default: bench/results/peers-<machine>-<commit>.json, with -part if not "
                        "all is asked for, and with a number if that is there; written after each case")
    return parser.parse_args()


def usual_place(origin, part):
    """Of a file that was not there yet, and is now."""
    build = origin["build"]
    name = (f"peers-{origin['machine']['name']}-{build['commit'][:7]}{'-changed' if build['changed'] else ''}"
            f"{'-part' if part else ''}")
    folder, number = HERE.parent / "results", 1
    while True:
        path = folder / f"{name}{f'-{number}' if number > 1 else ''}.json"
        try:
            path.touch(exist_ok=False)
            return path
        except FileExistsError:
            number += 1


def keep(results, path):
    """The cases so far: whoever ends it in the middle has the whole file of before."""
    path.parent.mkdir(parents=True, exist_ok=True)
    beside = path.with_name(path.name + ".new")
    beside.write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")
    beside.replace(path)


def main():
    options = parse()
    riesel, peers = Riesel(options.speed), installed(options.peer)
    origin = riesel.ask("origin")
    out = options.out or usual_place(origin, part=bool(options.peer or options.case or options.size))
    results = {"format": PEERS, "format_version": FORMAT_VERSION,
               "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
               **origin, "peers": {peer.name: peer.version for peer in peers}, "complete": False,
               "cases": []}
    print(f"riesel {origin['build']['commit'][:7]}, {', '.join(f'{peer.name} {peer.version}' for peer in peers)}\n"
          f"{origin['machine']['cpu']}, {origin['machine']['cores']} cores, load {origin['machine']['load_average'][0]:.2f}")
    keep(results, out)  # where that cannot be done is told now
    for case in options.case or CASES:
        for size in options.size or SIZES[:2]:
            for law in LAWS:
                if sharing := [peer for peer in peers if peer.law == law]:
                    results["cases"].append(compare_case(riesel, sharing, law, case, size, options))
                    keep(results, out)
    results["complete"] = True
    keep(results, out)
    print(f"\nkept in {out}")
    return 0 if all(one["agree"] for case in results["cases"] for one in case["agreements"].values()) else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (NotInstalled, RuntimeError, OSError, subprocess.CalledProcessError) as problem:
        print(f"run.py: {problem}", file=sys.stderr)
        sys.exit(1)
