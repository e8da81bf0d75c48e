# SPDX-License-Identifier: GPL-2.0-or-later
"""What may stand beside gran/cfpm in a hybrid: the force of another style at the start of a step is integrated as if it
were the mean over the step. Granular contacts are refused, others are warned of, and what has no force is let be.
"""

import math
import re

import pytest
from granular_bed import TSUJI
from harness.lammps import LAUNCHER, run
from harness.lammps import STOCK as HOST
from harness.output import first_error, read_dump
from kicked_bed import LAWS, bed
from test_bad_input import DECK, HOOKE, attempt, particles

CFPM = f"gran/cfpm {HOOKE}"
STOCK = HOOKE.replace("hooke ", "gran/hooke/history ")
PAIRS = "pair_coeff * * "


def hybrid(*styles, kind="hybrid/overlay", coefficients=None):
    names = [style.split()[0] for style in styles]
    return {
        "pair": f"pair_style {kind} {' '.join(styles)}",
        "coefficients": coefficients or "\n".join(PAIRS + name for name in names),
    }


def coefficients(*given):
    return "\n".join([PAIRS + "gran/cfpm", *given])


TWO = {
    "style": "atom_style sphere",
    "particles": particles((-0.3, 0.3), types=(1, 2)),
}
GRANULAR = "hooke 1e5 20 tangential linear_history 3e4 1.0 0.5"
NOT_PREDICTED = "not predicted, beside pair_style gran/cfpm in pair_style {}; "
NOT_PREDICTED += "expected gran/cfpm for all granular contacts"
REFUSED = {
    "gran/hooke/history": hybrid(CFPM, STOCK),
    "gran/hertz/history": hybrid("gran/hertz/history 1e7 NULL 100 NULL 0.3 1", CFPM),
    "granular": hybrid(CFPM, "granular", coefficients=coefficients(f"pair_coeff * * granular {GRANULAR}")),
    # of other types of particle
    "gran/hooke": {
        **TWO,
        **hybrid(
            CFPM,
            "gran/hooke 1e5 NULL 100 NULL 0.3 1",
            kind="hybrid",
            coefficients="pair_coeff 1 * gran/cfpm\npair_coeff 2 2 gran/hooke",
        ),
    },
}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("style", REFUSED)
def test_other_granular_contacts_are_refused(tmp_path, style, ranks):
    error = first_error(attempt(tmp_path, ranks, REFUSED[style]))
    kind = REFUSED[style]["pair"].split()[1]
    assert f"ERROR: pair_style {style}: {NOT_PREDICTED.format(kind)}" in error, error


LATER = "run 2\n" + "\n".join(hybrid(CFPM, STOCK)[k] for k in ("pair", "coefficients")) + "\nrun 2"


def test_also_in_a_later_run(tmp_path):
    error = first_error(attempt(tmp_path, 1, {"run": LATER}))
    assert "pair_style gran/hooke/history: not predicted" in error, error


TWICE = {
    "gran/cfpm, gran/cfpm": {
        **TWO,
        **hybrid(CFPM, CFPM, kind="hybrid", coefficients="pair_coeff 1 * gran/cfpm 1\npair_coeff 2 2 gran/cfpm 2"),
    },
    "gran/cfpm, gran/hertz/history": {
        **hybrid("gran/hertz/history 1e7 NULL 100 NULL 0.3 1", CFPM),
        "style": "suffix cfpm\natom_style sphere",
    },
}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("names", TWICE)
@pytest.mark.parametrize("wall", [False, True], ids=["alone", "with_a_wall"])
def test_twice_is_refused(tmp_path, names, wall, ranks):
    changes = dict(TWICE[names])
    if wall:
        changes["extra"] = f"fix w all wall/gran/cfpm {HOOKE} zplane -1 NULL"
    error = first_error(attempt(tmp_path, ranks, changes))
    assert "pair_style gran/cfpm: found 2 times in pair_style hybrid" in error, error
    assert f"({names}); expected it once" in error, error


@pytest.mark.parametrize("other, kind", [("gran/hooke", "hybrid"), ("gran/hooke/history", "hybrid/overlay")])
def test_two_of_the_hosts_run_in_its_own_step(tmp_path, other, kind):
    """Both are taken by -suffix cfpm, so that it stops and says which option lets the unmodified deck run as stock."""
    deck = bed(f"{kind} granular {other} {LAWS['hooke']}", "off", after="run 1000")
    deck = deck.replace("pair_coeff * *", f"pair_coeff 1 * granular {TSUJI}\npair_coeff 2 2 {other}")
    error = first_error(run(deck, tmp_path, options=("-suffix", "cfpm"), check=False))
    assert f"found 2 times in pair_style {kind} ({other}, granular); expected it once" in error, error
    advice = re.search("in an unmodified deck by '(-predict verlet -suffix cfpm)'", error)
    assert advice, error
    found = []
    for program, options in ((HOST, ()), (LAUNCHER, advice[1].split())):
        run(deck, tmp_path, program=program, options=options)
        found.append((tmp_path / "bed.dump").read_text())
    same = found[0] == found[1]
    assert same, "particles differ from stock"
    end = read_dump(tmp_path / "bed.dump")[-1][1]
    assert abs(end["fz"][end["type"] == 2]).max() > 0.01, "nothing happened"


ALONE = {
    "gran/hooke": hybrid("gran/hooke 1e5 NULL 100 NULL 0.3 1", kind="hybrid"),
    "lj/cut, zero": hybrid(
        "lj/cut 0.1", "zero 0.1", coefficients="pair_coeff * * lj/cut 1e-9 0.05\npair_coeff * * zero"
    ),
}


@pytest.mark.parametrize("names", ALONE)
def test_a_hybrid_without_it_is_told_what_it_lacks(tmp_path, names):
    """Whose styles do not come with -suffix cfpm."""
    error = first_error(attempt(tmp_path, 1, ALONE[names]))
    kind = ALONE[names]["pair"].split()[1]
    assert f"fix nve/cfpm: needs 'pair_style gran/cfpm', found pair_style {kind} of {names}" in error, error
    assert f"expected gran/cfpm among these, as in 'pair_style {kind} gran/cfpm hooke ...'" in error, error


LJ = hybrid(CFPM, "lj/cut 0.1", coefficients=coefficients("pair_coeff * * lj/cut 1e-9 0.05"))
BONDS = "create_box 1 box bond/types 1 extra/bond/per/atom 1 extra/special/per/atom 2"
BONDED = {
    "style": "atom_style hybrid sphere bond",
    "particles": DECK["particles"].replace("create_box 1 box", BONDS),
    "extra": "bond_style harmonic\nbond_coeff 1 1e-9 0.6\ncomm_modify cutoff 1.0\ncreate_bonds single/bond 1 1 2",
}
# how they are written, and the styles that are warned of
OTHERS = {
    "lj/cut": (LJ, ["pair_style lj/cut"]),
    "lj/cut_zero": (
        hybrid(
            CFPM,
            "zero 0.1",
            "lj/cut 0.1",
            coefficients=coefficients("pair_coeff * * zero", "pair_coeff * * lj/cut 1e-9 0.05"),
        ),
        ["pair_style lj/cut"],
    ),
    "twice_lj/cut": (
        hybrid(
            CFPM,
            "lj/cut 0.1",
            "lj/cut 0.2",
            coefficients=coefficients("pair_coeff * * lj/cut 1 1e-9 0.05", "pair_coeff * * lj/cut 2 1e-9 0.05"),
        ),
        ["pair_style lj/cut", "pair_style lj/cut"],
    ),
    "soft_and_yukawa": (
        hybrid(
            CFPM,
            "soft 0.1",
            "yukawa 2 0.1",
            coefficients=coefficients("pair_coeff * * soft 1e-9", "pair_coeff * * yukawa 1e-9"),
        ),
        ["pair_style soft", "pair_style yukawa"],
    ),
    "zero": (hybrid(CFPM, "zero 0.1", coefficients=coefficients("pair_coeff * * zero")), []),
    "none": ({**TWO, **hybrid(CFPM, kind="hybrid", coefficients="pair_coeff 1 * gran/cfpm\npair_coeff 2 2 none")}, []),
    "alone": (hybrid(CFPM, kind="hybrid"), []),
    "not_in_a_hybrid": ({}, []),
    "bonds": (BONDED, ["bond_style harmonic"]),
    "spring": ({"extra": "fix s all spring/self 1e-9"}, ["fix spring/self (id s)"]),
    "wall": ({"extra": "fix s all wall/harmonic zlo EDGE 1e-9 0 0.1"}, ["fix wall/harmonic (id s)"]),
    "wall_that_reflects": ({"extra": "fix s all wall/reflect zlo EDGE"}, []),
    "gravity": ({"extra": "fix s all gravity 9.81 vector 0 0 -1"}, []),
}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("case", OTHERS)
def test_forces_of_one_instant_are_warned_of(tmp_path, case, ranks):
    changes, warned = OTHERS[case]
    process = attempt(tmp_path, ranks, changes)
    assert process.returncode == 0, process.stdout[-2000:]
    warnings = re.findall(r"^WARNING: (.+): its force at the start of a step", process.stdout, re.MULTILINE)
    assert sorted(warnings) == sorted(warned), process.stdout[-2000:]


def test_how_much_energy_an_undamped_spring_gains(tmp_path):
    """As the warning and the documentation say: a factor of 1 + (w dt)^2/2 in every step, here with w dt = 0.1.

    The energy also swings within a period, by w dt/2.
    """
    mass = 800 * math.pi / 6 * 0.05**3
    changes = {
        "style": "atom_style sphere\natom_modify map array",
        "extra": f"fix s one spring/self {mass * 100**2}\ntimestep 1e-3\nvelocity one set 0 0 1e-3 units box",
        "run": "variable e equal vz[1]^2+(100*z[1])^2\nvariable a equal $e\nrun 200\nvariable b equal $e\n"
        "print 'GAIN $(v_b/v_a)'",
    }
    output = attempt(tmp_path, 1, changes).stdout
    gain = [float(line.split()[1]) for line in output.splitlines() if line.startswith("GAIN")]
    assert gain == [pytest.approx((1 + 0.1**2 / 2) ** 200, rel=0.05)], output[-2000:]


def test_forces_that_are_scaled_afterwards_are_refused(tmp_path):
    changes = {**hybrid("0.5 gran/cfpm " + HOOKE, kind="hybrid/scaled", coefficients=coefficients())}
    error = first_error(attempt(tmp_path, 1, changes))
    assert "pair_style hybrid/scaled: scales forces that were predicted unscaled" in error, error


@pytest.mark.parametrize("other", ["stock", "lj/cut"])
def test_predict_none_is_the_hosts_and_may_stand_beside_all(tmp_path, other):
    none = f"{CFPM} predict none"
    changes = {
        "stock": hybrid(none, STOCK),
        "lj/cut": hybrid(none, "lj/cut 0.1", coefficients=LJ["coefficients"]),
    }[other]
    process = attempt(tmp_path, 1, {**changes, "integrator": "fix integrate all nve/sphere"})
    assert process.returncode == 0 and "its force at the start" not in process.stdout, process.stdout[-2000:]
