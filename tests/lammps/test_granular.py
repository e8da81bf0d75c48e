# SPDX-License-Identifier: GPL-2.0-or-later
"""pair_style granular under "-suffix cfpm": its sub-models are the host's, to the last digit."""

import re
from pathlib import Path

import drum
import pytest
from granular_bed import IS_NEWER, LEFT_TO_HOST, MODELS, ROLLING, TSUJI, WALL, granular_bed
from harness import decks
from harness.instruction_sets import SETS
from harness.lammps import LAUNCHER, STOCK, run
from harness.output import first_error, read_dump
from stock_words import in_stock_words
from test_bad_input import DECK, particles

SUFFIX = ("-suffix", "cfpm")
STEPS = 2000
RUN = f"run {STEPS}"
STATE = "id x y z vx vy vz fx fy fz modify sort id format float %.17g"


def fall(folder, program, deck, options=(), ranks=1, env=None):
    """Every digit of the particles, and the thermo table; and what computes the contacts, see left_to_host()."""
    folder.mkdir()
    output = run(deck, folder, program=program, options=options, np=ranks, env=env).stdout
    table = re.findall(r"^ +(\d+ +\S+ +\S+) *$", output, re.MULTILINE)
    assert len(table) == STEPS // 500 + 1
    return ((folder / "bed.dump").read_text(), table), left_to_host(output)


def left_to_host(output):
    """Why contacts of pairs are left to the host's style, or None if they are not."""
    reason = re.search(r"left to the host's own style, as (.*)", output)
    computed = re.search(r"contacts of pairs are computed \d at a time", output)
    assert not (reason and computed)
    return reason[1] if reason else None


@pytest.mark.parametrize("newton, ranks", [("off", 1), ("on", 2)])
@pytest.mark.parametrize("models", MODELS)
def test_equals_stock(tmp_path, models, newton, ranks):
    deck = granular_bed(models, newton, after=RUN)
    stock, _ = fall(tmp_path / "stock", STOCK, deck, ranks=ranks)
    for instructions in SETS if ranks == 1 and models not in LEFT_TO_HOST else SETS[-1:]:
        cfpm, left = fall(tmp_path / instructions, LAUNCHER, deck, SUFFIX, ranks, {"CFPM_SIMD": instructions})
        assert left == LEFT_TO_HOST.get(models)
        assert stock[1] == cfpm[1], f"thermo output differs from stock with {instructions}"
        same = stock[0] == cfpm[0]
        assert same, f"particles differ from stock with {instructions}"
    start, *_, end = read_dump(tmp_path / "stock" / "bed.dump")
    assert abs(start[1]["z"] - end[1]["z"]).max() > 1e-3 and abs(end[1]["fz"]).max() > 0.01, "nothing happened"


def drum_deck(start, models, pair=True):
    """The drum of drum.py in the words of the host, and its walls as well."""
    models, _, beside = models.partition(" in hybrid/overlay")
    deck = in_stock_words(drum.deck(several_types(start, models), "hooke", pair))
    style, name = ("hybrid/overlay granular lj/cut 0.011", "granular ") if beside else ("granular", "")
    coefficients = [f"pair_coeff {types} {name}{words}" for types, words in MODELS[models].items()]
    if beside:
        coefficients.append("pair_coeff * * lj/cut 1e-7 0.0095")
    contact = drum.CONTACT["hooke"].replace("hooke", "hooke/history")
    deck = deck.replace(f"gran/{contact}\npair_coeff * *", "\n".join([style, *coefficients]))
    return deck.replace(contact, WALL.split("wall/gran ")[1])


def several_types(start, models):
    """As many as there are models for, at random among the particles of a start that makes them."""
    types = max(int(kind) for pair in ["1 1", *MODELS[models]] for kind in pair.split() if kind != "*")
    more = "".join(f"set group all type/fraction {k} {1 / k} {8000 + k}\n" for k in range(2, types + 1))
    return start.replace("create_box 1", f"create_box {types}").replace("set group all dia", f"{more}set group all dia")


def continued(folder, program, models, options=(), pair=True):
    folder.mkdir()
    first = drum_deck(drum.FRESH, models) + f"run {drum.HALF}\nwrite_restart bed.restart\n"
    run(first, folder, program=program, options=options)
    again = drum_deck("read_restart bed.restart", models, pair) + drum.half("again")
    output = run(again, folder, program=program, options=options).stdout
    assert program == STOCK or left_to_host(output) == LEFT_TO_HOST.get(models.partition(" in ")[0])
    return folder / "again.dump"


# "types" has jkr, mindlin/force and mindlin_rescale/force, twisting sds and limit_damping, "material" twisting marshall
CONTINUED = [
    (models, pair)
    for models in ("material", "tsuji", "rolling", "types", "all with springs", "some rolling")
    for pair in (True, False)
]
CONTINUED.append(("types in hybrid/overlay", True))  # of a hybrid no host stores the coefficients


@pytest.mark.parametrize(
    "models, pair",
    CONTINUED,
    ids=[f"{models}-{'pair_style' if pair else 'no_pair_style'}" for models, pair in CONTINUED],
)
def test_continues_as_stock(tmp_path, models, pair):
    """Without new lines of the pair style too, where the host of 2021 would not know that there is friction. Stock does
    not continue as a run that goes on, to the last digit."""
    stock = continued(tmp_path / "stock", STOCK, models)
    same = stock.read_text() == continued(tmp_path / "cfpm", LAUNCHER, models, SUFFIX, pair).read_text()
    assert same
    snapshots = read_dump(stock)
    moved = abs(snapshots[-1][1]["z"] - snapshots[0][1]["z"]).max()
    assert moved > 1e-3, "nothing happened after the restart"


GRANULAR = {
    "pair": "pair_style granular",
    "coefficients": "pair_coeff * * hooke 1e5 0.5 tangential linear_history 1e5 0.5 0.1 damping mass_velocity",
    "integrator": "fix i all nve/sphere",
    "particles": particles((-0.02, 0.02)),
}
WALL_HERE = "fix w all wall/gran granular hooke 1e5 0.5 tangential linear_history 1e5 0.5 0.1 damping mass_velocity"


def small(folder, options=SUFFIX, check=True, np=1, **changes):
    deck = "units si\nboundary f f f\nnewton off\n" + "\n".join({**DECK, **GRANULAR, **changes}.values()) + "\n"
    return run(deck, folder, options=options, check=check, np=np)


REFUSED = {
    "onset": ({"pair": "pair_style granular onset on"}, ["'onset' and 'split' go with predicted contacts"]),
    "unknown predictor": ({"pair": "pair_style granular predict euler"}, ["unknown predictor 'euler'", "verlet, auto"]),
    "argument": ({"pair": "pair_style granular 0.1 2"}, ["granular/cfpm: unknown argument '2'; expected [cutoff]"]),
    "word": ({"pair": "pair_style granular hooke"}, ["granular/cfpm: unknown argument 'hooke'; expected [cutoff]"]),
    "predictor at a wall": (
        {"extra": f"{WALL_HERE} zplane -1 NULL predict rk4"},
        ["(id w): predicted beside a pair style with 'predict none'"],
    ),
    "host's": (
        {"coefficients": "pair_coeff * * hooke 1e5"},
        ["Insufficient arguments provided for hooke model" if IS_NEWER else "pair_coeff"],
    ),
}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("case", REFUSED)
def test_is_refused(tmp_path, case, ranks):
    changes, fragments = REFUSED[case]
    error = first_error(small(tmp_path, check=False, np=ranks, **changes))
    for fragment in fragments:
        assert fragment in error, error


RUNS = {
    "plain": {},
    "cutoff": {"pair": "pair_style granular 0.1 predict none"},
    "hybrid": {
        "pair": "pair_style hybrid/overlay granular lj/cut 0.1",
        "coefficients": GRANULAR["coefficients"].replace("* *", "* * granular") + "\npair_coeff * * lj/cut 1e-9 0.05",
    },
    "wall": {"extra": f"{WALL_HERE} zplane -1 NULL"},
    "wall of a region": {
        "extra": f"region r sphere 0 0 0 0.5\n{WALL_HERE.replace('wall/gran', 'wall/gran/region')} region r"
    },
    "given again": {"run": "run 2\npair_style granular\nrun 2\npair_style granular predict verlet\nrun 2"},
    "local output": {
        "extra": "compute p all pair/local force p1 p4 p12\ndump p all local 1 p.dump c_p[1] c_p[2] c_p[3] c_p[4]"
    },
}


@pytest.mark.parametrize("case", RUNS)
def test_forces_are_those_of_stock(tmp_path, case):
    """Of two spheres that overlap."""
    forces = "\nwrite_dump all custom forces.dump id fx fy fz tqx tqy tqz modify format float %.17g"
    changes = {**RUNS[case], "run": "velocity all set 0.1 0.2 0.3\n" + RUNS[case].get("run", "run 4") + forces}
    output = small(tmp_path, **changes).stdout
    found = (tmp_path / "forces.dump").read_text()
    assert "gran/cfpm: predict auto (verlet)" in output or "gran/cfpm: predict verlet" in output
    assert left_to_host(output) == LEFT_TO_HOST.get("hooke")
    local = (tmp_path / "p.dump").read_text() if case == "local output" else ""
    changes = {key: re.sub(" predict (none|verlet)", "", words) for key, words in changes.items()}
    small(tmp_path, options=(), **changes)
    assert found == (tmp_path / "forces.dump").read_text()
    assert not local or local == (tmp_path / "p.dump").read_text()


def test_goes_to_the_hosts_style_and_back(tmp_path):
    """For the run in which two of three spheres that slip on each other are a rigid body."""
    runs = """velocity two set 0.1 0.5 0.3
run 2
group body union two three
fix r body rigid single
run 2
unfix r
run 2"""
    forces = "\nwrite_dump all custom forces.dump id fx fy fz tqx tqy tqz modify format float %.17g"
    found = []
    for options in (SUFFIX, ()):
        changes = {"particles": particles((-0.04, 0.0, 0.04)), "coefficients": f"pair_coeff * * {ROLLING}"}
        output = small(tmp_path, options, run=runs + forces, **changes).stdout
        found.append((tmp_path / "forces.dump").read_text())
        if options and not LEFT_TO_HOST.get("rolling"):
            said = re.findall("computed (?=. at a time)|left to the host's own style, as fix rigid", output)
            assert said == ["computed ", "left to the host's own style, as fix rigid", "computed "]
    assert found[0] == found[1]


@pytest.mark.parametrize("name", ["pour.drum", "pour.flatwall"])
def test_runs_examples_as_stock(tmp_path, name):
    """The beginning of decks of Debian's lammps-examples, which pour particles; in the drum walls turn at the end."""
    deck = Path(f"/usr/share/lammps/examples/granular/in.{name}").read_text()
    deck = re.sub(r"^run\s.*", "run 700", deck, flags=re.MULTILINE)
    deck += f"\nwrite_dump all custom last.dump {STATE}\n"
    found = []
    for program, options in ((STOCK, ()), (LAUNCHER, SUFFIX)):
        output = run(deck, tmp_path, program=program, options=options).stdout
        found.append(((tmp_path / "last.dump").read_text(), re.findall(r"^ +\d+ +\d+ .*$", output, re.MULTILINE)))
    assert found[0][1] == found[1][1], "thermo output differs from stock"
    same = found[0][0] == found[1][0]
    assert same, "particles differ from stock"
    assert len(found[0][1]) >= 8 and read_dump(tmp_path / "last.dump")[0][1]["fz"].max() > 0.0


@pytest.mark.parametrize("ranks", [1, 2])
def test_drum_turns_as_in_stock(tmp_path, ranks):
    """inputs/lammps/in.granular.drum, rolling friction and a region that turns: falls, and is taken along."""
    found = []
    for program, suffix in ((STOCK, ()), (LAUNCHER, SUFFIX)):
        options = (*decks.options({"duration": 0.02, "dump": 1}), *suffix)
        output = run(decks.deck("lammps", "granular.drum"), tmp_path, program=program, options=options, np=ranks)
        assert not suffix or left_to_host(output.stdout) is None
        found.append((tmp_path / "drum.dump").read_text())
    same = found[0] == found[1]
    assert same, "grains differ from stock"
    start, *_, end = read_dump(tmp_path / "drum.dump")
    assert abs(start[1]["z"] - end[1]["z"]).max() > 1e-3 and abs(end[1]["omegay"]).max() > 1.0, "nothing happened"


@pytest.mark.skipif(not IS_NEWER, reason="this LAMMPS conducts no heat")
@pytest.mark.parametrize("ranks", [1, 2])
def test_heat_of_a_wall_is_that_of_stock(tmp_path, ranks):
    """What conducts it is the host's own: pairs because of their sub-model, a wall with a temperature."""
    deck = granular_bed("tsuji", "off", after=RUN).replace(TSUJI, f"{TSUJI} heat area 5e3")
    deck = deck.replace(" zplane 0.0 NULL", " zplane 0.0 NULL temperature 350")
    particles = "fix t all property/atom temperature heatflow\nset group all temperature 300\n"
    told = "fix c all heat/flow constant 1.0\ncompute t all property/atom temperature\n"
    deck = deck.replace("pair_style", f"{particles}pair_style", 1).replace("thermo_style", f"{told}thermo_style", 1)
    deck = deck.replace(" omegax", " c_t omegax")
    found = []
    for program, options in ((STOCK, ()), (LAUNCHER, SUFFIX)):
        run(deck, tmp_path, program=program, options=options, np=ranks)
        found.append((tmp_path / "bed.dump").read_text())
    same = found[0] == found[1]
    assert same, "temperatures or particles differ from stock"
    assert read_dump(tmp_path / "bed.dump")[-1][1]["c_t"].max() > 300.1
    predicted = deck.replace("pair_style granular", "pair_style granular/cfpm predict rk2")
    predicted = re.sub(r"(pair_coeff.*) heat area 5e3", r"\1", predicted)
    predicted = predicted.replace("nve/sphere", "nve/cfpm").replace("wall/gran ", "wall/gran/cfpm ")
    error = first_error(run(predicted, tmp_path, check=False, np=ranks))
    assert "'heat' has no predicted form; expected" in error, error


@pytest.mark.skipif(not IS_NEWER, reason="this LAMMPS has no mdr")
def test_mdr_is_refused(tmp_path):
    """Its fix of the host looks for the host's pair style by name and class."""
    coefficients = "pair_coeff * * mdr 5e6 0.4 2e5 0 0.9 0.5 damping none tangential linear_nohistory 0 0"
    error = first_error(small(tmp_path, coefficients=coefficients, check=False))
    assert "'mdr' has a fix of the host that looks for the host's own pair_style granular; expected" in error, error
