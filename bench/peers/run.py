#!/usr/bin/env python3
"""riesel and LAMMPS side by side on the same states: python3 bench/peers/run.py

For each case both start from the same riesel checkpoints, with the same contact law and the same time step. First it is
checked that they do the same physics over a short time. Then LAMMPS's neighbour list is tuned. Then all are timed in turns
over the same steps, each time from the state of another seed. docs/suite.md says more. Exit status: 1 if the physics does
not agree or a program fails.
"""

import argparse
import datetime
import json
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from compare import FORMAT_VERSION, PEERS, paired_ratio  # noqa: E402
from lammps import Lammps, NotInstalled  # noqa: E402
from lammps_data import read_state, write_lammps_data  # noqa: E402

# case of the suite -> gamma_t (1/s) of the viscous slip law, which both codes have
CASES = {"tube_start": 2e5, "tube_slow": 2e5, "tube_stiff": 2e6, "dense_sheared": 2e5}
SIZES = ("1.4k", "10k", "100k", "1M")

RIESEL = {"riesel plain 1": ("plain", 1, "together"), "riesel plain 2": ("plain", 2, "together"),
          "riesel plain 2 apart": ("plain", 2, "apart"), "riesel windows 1": ("windows", 1, "together"),
          "riesel windows 2": ("windows", 2, "together"), "riesel windows 2 apart": ("windows", 2, "apart")}
LAMMPS_RANKS = {"lammps 1": 1, "lammps 2": 2}
RATIOS = [("riesel plain 1", "lammps 1"), ("riesel plain 2", "lammps 2"), ("riesel plain 2 apart", "lammps 2"),
          ("riesel windows 1", "lammps 1"), ("riesel windows 2", "lammps 2"), ("riesel windows 2 apart", "lammps 2")]

SKINS = (0.1e-3, 0.2e-3, 0.3e-3, 0.45e-3)  # m
LOOKS = (1, 5, 10)  # steps between two looks at the neighbour list


def pinned(command):
    """On one core, so that nothing moves it about."""
    return ["taskset", "-c", "0", *command]


class Riesel:
    """The program of the suite, build/bench/bench/speed."""

    def __init__(self, program):
        self.program = str(program)

    def ask(self, *arguments, pin=False):
        command = [self.program, *map(str, arguments)]
        return json.loads(subprocess.run(pinned(command) if pin else command, check=True,
                                         stdout=subprocess.PIPE).stdout)

    def state(self, case, size, seed):
        return self.ask("state", case, size, "--set", f"seed={seed}", "--set", "contact.slip=viscous",
                        "--set", f"contact.slip_damping={CASES[case]!r}")

    def advance(self, start, variant, warm_up, steps):
        stepping, threads, sharing = RIESEL[variant]
        return self.ask("advance", start["checkpoint"], "--stepping", stepping, "--threads", threads, "--sharing", sharing,
                        "--warm-up", warm_up, "--steps", steps, pin=threads == 1)


def physics(riesel, lammps, start, steps):
    """What both codes make of a state, and whether that is the same. Over this short time the grains keep to their courses,
    so that the numbers agree to the errors of the time step; later only statistics would."""
    ours = riesel.advance(start, "riesel plain 1", 0, steps)["state"]
    theirs = lammps.advance(start, ranks=1, warm_up=0, steps=steps)["state"]
    before = start["state"]["mean_vy"]
    gain, scale = ours["mean_vy"] - before, start["gravity"] * steps * start["time_step"]
    difference = theirs["mean_vy"] - ours["mean_vy"]
    contacts = ours["contacts_of_grains"], theirs["contacts_of_grains"]
    agree = abs(difference) < 0.01 * scale and abs(contacts[0] - contacts[1]) <= max(4, 0.03 * contacts[0])
    print(f"  after {steps} steps: mean v_y riesel {ours['mean_vy']:.7g} m/s, LAMMPS {theirs['mean_vy']:.7g} m/s "
          f"(change {gain:.3g}, difference {difference:.2g}); contacts of grains {contacts[0]:.0f}, {contacts[1]:.0f}; "
          f"kinetic energy {ours['kinetic_energy']:.7g} J, {theirs['kinetic_energy']:.7g} J"
          f"{'' if agree else '  DO NOT AGREE'}")
    return {"steps": steps, "riesel": ours, "lammps": theirs, "agree": agree}


def tuned(lammps, start, steps):
    """The skin and the steps between two looks with which LAMMPS is fastest without ever looking too late."""
    tried = []

    def speed(skin, every):
        lammps.skin, lammps.every = skin, every
        answer = lammps.advance(start, ranks=1, warm_up=steps // 4, steps=steps)
        if answer["dangerous_builds"] == 0:
            tried.append((answer["particle_steps_per_second"], skin, every))

    for skin in SKINS:
        speed(skin, 5)
    if not tried:
        raise RuntimeError("no skin is safe for LAMMPS")
    skin = max(tried)[1]
    for every in LOOKS:
        speed(skin, every)
    best, lammps.skin, lammps.every = max(tried)
    print(f"  LAMMPS at its best: skin {lammps.skin * 1e3:g} mm, look every {lammps.every} steps "
          f"({best * 1e-6:.1f} M/s while tuning)")
    return best


def timed(riesel, lammps, starts, steps):
    """{variant: seconds of each repetition, for as many grains as the first start has}, in turns. Each repetition has a
    start of its own: a state of few grains has by chance half or twice as many contacts as the mean."""
    warm_up = max(20, steps // 10)
    contenders = {name: lambda start, name=name: riesel.advance(start, name, warm_up, steps) for name in RIESEL}
    contenders |= {name: lambda start, ranks=ranks: lammps.advance(start, ranks, warm_up, steps)
                   for name, ranks in LAMMPS_RANKS.items()}
    seconds = {name: [] for name in contenders}
    for start in starts:
        for name, measure in contenders.items():
            seconds[name].append(measure(start)["seconds"] * starts[0]["grains"] / start["grains"])
    return seconds


def row_of(case, size, variant, grains, steps, seconds):
    """As a row of the suite's results."""
    median = sorted(seconds)[len(seconds) // 2]
    return {"case": case, "size": size, "variant": variant, "grains": grains, "unit": "particle-steps",
            "work": grains * steps, "steps": steps,
            "seconds": {"min": min(seconds), "median": median, "all": seconds},
            "per_second": {"median": grains * steps / median, "max": grains * steps / min(seconds)}}


def compare_case(riesel, lammps, case, size, options):
    """All of one case in one size."""
    starts = [riesel.state(case, size, seed) for seed in range(1, options.repetitions + 1)]
    start = starts[0]
    grains = start["grains"]
    print(f"\n{case}, {grains} grains, k_n = {start['k_n']:g} N/m, gamma_n = {start['gamma_n']:.4g} 1/s, "
          f"gamma_t = {start['gamma_t']:g} 1/s, time step {start['time_step']:.4g} s", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for seed, one in enumerate(starts, 1):
            one["data"] = str(Path(folder) / f"{seed}.data")
            write_lammps_data(read_state(one["checkpoint"]), one["data"])
        agreement = physics(riesel, lammps, start, steps=200)
        scan_steps = max(200, int(0.5 * options.seconds * 4e7 / grains))
        best = tuned(lammps, start, scan_steps)
        steps = max(200, int(options.seconds * best / grains))
        seconds = timed(riesel, lammps, starts, steps)

    rows = {name: row_of(case, size, name, grains, steps, times) for name, times in seconds.items()}
    for name, row in rows.items():
        print(f"  {name:18} {row['per_second']['median'] * 1e-6:9.1f} M/s, best {row['per_second']['max'] * 1e-6:9.1f}")
    for name in LAMMPS_RANKS:
        rows[name] |= {"skin": lammps.skin, "every": lammps.every}
    ratios = [{"over": over, "under": under, **paired_ratio(rows[over], rows[under])._asdict()} for over, under in RATIOS]
    for ratio in ratios:
        print(f"  {ratio['over']} / {ratio['under']}: {ratio['value']:.2f}  [{ratio['least']:.2f} {ratio['most']:.2f}]",
              flush=True)
    return {"case": case, "size": size, "grains": grains, "agreement": agreement, "ratios": ratios,
            "rows": list(rows.values())}


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--speed", type=Path, default=HERE.parents[1] / "build/bench/bench/speed",
                        help="the suite's program")
    parser.add_argument("--case", action="append", choices=list(CASES))
    parser.add_argument("--size", action="append", choices=SIZES, help="default: 1.4k and 10k")
    parser.add_argument("--repetitions", type=int, default=7, help="each from the state of another seed")
    parser.add_argument("--seconds", type=float, default=2.0, help="that a repetition takes LAMMPS on one core")
    parser.add_argument("--out", type=Path, help="default: bench/results/peers-<machine>-<commit>.json")
    return parser.parse_args()


def usual_place(origin):
    build = origin["build"]
    name = f"peers-{origin['machine']['name']}-{build['commit'][:7]}{'-changed' if build['changed'] else ''}.json"
    return HERE.parent / "results" / name


def main():
    options = parse()
    riesel, lammps = Riesel(options.speed), Lammps(pinned)
    origin = riesel.ask("origin")
    results = {"format": PEERS, "format_version": FORMAT_VERSION,
               "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
               **origin, "lammps": lammps.version, "cases": []}
    print(f"riesel {origin['build']['commit'][:7]}, LAMMPS {lammps.version}\n{origin['machine']['cpu']}, "
          f"{origin['machine']['cores']} cores, load {origin['machine']['load_average'][0]:.2f}")
    for case in options.case or CASES:
        for size in options.size or SIZES[:2]:
            results["cases"].append(compare_case(riesel, lammps, case, size, options))
    out = options.out or usual_place(origin)
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")
    print(f"\nkept in {out}")
    return 0 if all(case["agreement"]["agree"] for case in results["cases"]) else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (NotInstalled, RuntimeError, OSError, subprocess.CalledProcessError) as problem:
        print(f"run.py: {problem}", file=sys.stderr)
        sys.exit(1)
