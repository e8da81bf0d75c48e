# SPDX-License-Identifier: GPL-2.0-or-later
"""Every wrong input stops with one error line that names the command, the argument and what was expected."""

import pytest
from harness.lammps import run
from harness.output import first_error


def particles(places, types=None):
    """Spheres at rest at these x, of type 1 or of the types given; the groups one, two, three have one each."""
    types = types or len(places) * (1,)
    lines = ["region box block -1 1 -1 1 -1 1 units box", f"create_box {max(types)} box"]
    lines += [f"create_atoms {kind} single {x} 0 0 units box" for kind, x in zip(types, places)]
    lines += ["set group all diameter 0.05 density 800"]
    lines += [f"group {name} id {k}" for k, name in zip(range(1, len(places) + 1), ("one", "two", "three"))]
    return "\n".join(lines)


DECK = {
    "style": "atom_style sphere",
    "velocity": "comm_modify vel yes",
    "particles": particles((-0.3, 0.3)),
    "pair": "pair_style gran/cfpm hooke 1e5 NULL 100 NULL 0.3 1",
    "coefficients": "pair_coeff * *",
    "integrator": "fix integrate all nve/cfpm",
    "extra": "",
    "run": "run 2",
}


def attempt(folder, ranks, changes):
    assert set(changes) <= set(DECK)
    deck = "units si\nboundary f f f\nnewton off\n" + "\n".join({**DECK, **changes}.values()) + "\n"
    return run(deck, folder, np=ranks, check=False, timeout=20)


def pair(arguments):
    return {"pair": "pair_style gran/cfpm " + arguments}


def wall(arguments):
    return {"extra": "fix w all wall/gran/cfpm hooke 1e5 NULL 100 NULL 0.3 1 " + arguments}


SYNTAX = "expected hooke|hooke/nohistory|hertz Kn Kt gamma_n gamma_t xmu dampflag"
HOOKE = "hooke 1e5 NULL 100 NULL 0.3 1"
IMPULSE = f"{HOOKE} predict impulse"
BAD = {
    "no_arguments": (pair(""), ["pair_style gran/cfpm: no contact model", SYNTAX]),
    "model": (pair("jkr 1 2 3 4 5 1"), ["unknown contact model 'jkr'", SYNTAX]),
    "too_few": (pair("hooke 1e5 NULL 100"), ["found 4 arguments of 7", SYNTAX]),
    "too_many": (pair("hooke 1e5 NULL 100 NULL 0.3 1 limit_damping 5"), ["unknown argument '5'", SYNTAX]),
    "keyword": (pair("hooke 1e5 NULL 100 NULL 0.3 1 xyz"), ["unknown argument 'xyz'", SYNTAX]),
    "number": (pair("hooke 1e5x NULL 100 NULL 0.3 1"), ["Kn is '1e5x'", "expected a number that is not negative"]),
    "negative": (pair("hooke 1e5 NULL -100 NULL 0.3 1"), ["gamma_n is '-100'", "not negative"]),
    "null": (pair("hooke NULL NULL 100 NULL 0.3 1"), ["Kn is 'NULL'", "expected a number that is not negative"]),
    "dampflag": (pair("hooke 1e5 NULL 100 NULL 0.3 2"), ["dampflag is '2'", "expected 0 or 1"]),
    "predictor": (
        pair("hooke 1e5 NULL 100 NULL 0.3 1 predict euler"),
        ["unknown predictor 'euler'", "exact", "verlet, auto"],
    ),
    "predictor_value": (
        pair("hooke 1e5 NULL 100 NULL 0.3 1 predict"),
        ["missing value after 'predict'", "verlet, auto"],
    ),
    "predictor_twice": (pair("predict rk2 hooke 1e5 NULL 100 NULL 0.3 1"), ["unknown contact model 'predict'"]),
    "predictor_of_linear_laws": (
        pair("hertz 1e5 NULL 100 NULL 0.3 1 predict exact"),
        ["predictor 'exact' has no form for hertz", "expected one of rk2, rk4, impulse, verlet"],
    ),
    "predictor_given_twice": (pair(f"{HOOKE} predict rk2 predict rk4"), ["'predict' given twice; expected it once"]),
    "split_of_forces": (pair(f"{HOOKE} split 0.5"), ["gran/cfpm: 'split' goes with 'predict impulse' only"]),
    "onset_of_instants": (
        pair(f"{HOOKE} onset on predict verlet"),
        ["'onset' goes with predicted contacts, not with 'predict verlet'"],
    ),
    "split_value": (pair(f"{IMPULSE} split"), ["missing value after 'split'; expected a number from 0 to 1"]),
    "split_word": (pair(f"{IMPULSE} split half"), ["split is 'half'; expected a number from 0 to 1"]),
    "split_range": (pair(f"{IMPULSE} split 1.5"), ["split is '1.5'; expected a number from 0 to 1"]),
    "onset_value": (pair(f"{IMPULSE} onset 1"), ["onset is '1'; expected on or off"]),
    "onset_twice": (pair(f"{IMPULSE} onset on onset off"), ["'onset' given twice; expected it once"]),
    "onset_of_wall": (
        wall("predict impulse onset on zplane -1 NULL"),
        ["fix wall/gran/cfpm (id w): 'onset' belongs to the pair style, which walls follow"],
    ),
    "box_changes": (
        {**pair(IMPULSE), "extra": "fix d all deform 1 x erate 0.1"},
        ["fix deform (id d): changes the box", "expected 'onset off' in pair_style gran/cfpm"],
    ),
    "no_integrator": ({"integrator": ""}, ["pair_style gran/cfpm:", "expected 'fix ID group nve/cfpm'"]),
    "stock_integrator": (
        {"integrator": "fix integrate all nve/sphere"},
        ["fix nve/sphere (id integrate)", "expected fix nve/cfpm"],
    ),
    "two_integrators": ({"extra": "fix other all nve/sphere"}, ["fix nve/sphere (id other)", "expected fix nve/cfpm"]),
    "move_too": ({"extra": "fix other two move linear 0 0 1"}, ["fix move (id other)", "expected disjoint groups"]),
    "wall": (
        {"extra": "fix w all wall/gran hooke/history 1e5 NULL 100 NULL 0.3 1 zplane -1 NULL"},
        ["fix wall/gran (id w)", "not predicted", "expected fix wall/gran/cfpm"],
    ),
    "wall_shape": (wall("wplane 0 NULL"), ["fix wall/gran/cfpm (id w): unknown wall", "expected xplane lo hi"]),
    "wall_missing": (wall(""), ["fix wall/gran/cfpm (id w): missing value", "expected xplane lo hi"]),
    "wall_number": (wall("zplane 0 high"), ["found 'high'", "expected an upper position or NULL"]),
    "wall_region": (wall("region nowhere"), ["region 'nowhere' does not exist"]),
    "wall_motion": (wall("zplane 0 NULL swing z 1 1"), ["unknown argument 'swing'", "expected 'wiggle dim amplitude"]),
    "wall_two_motions": (wall("zplane 0 NULL wiggle z 1 1 shear x 1"), ["a second motion 'shear'", "once"]),
    "wall_shear": (wall("zplane 0 NULL shear z 1"), ["shear along the normal", "expected another dimension"]),
    "wall_none": (wall("zplane -1 NULL predict none"), ["fix wall/gran (id w): not predicted", "with a predictor"]),
    "wall_of_another_law": (
        {"extra": "suffix cfpm\nfix w all wall/gran hertz 1e5 NULL 100 NULL 0.3 1 zplane -1 NULL"},
        ["fix wall/gran with 'hertz' cannot be predicted", "expected hooke, hooke/history, hertz/history or granular"],
    ),
    "wall_predictor": (wall("zplane -1 NULL predict euler"), ["(id w): unknown predictor 'euler'", "exact"]),
    "wall_without_pair": (
        {**wall("zplane -1 NULL"), "pair": "pair_style gran/hooke/history 1e5 NULL 1 NULL 0.3 1", "integrator": ""},
        ["fix wall/gran/cfpm (id w): needs 'pair_style gran/cfpm'"],
    ),
    "other_pair": (
        {"pair": "pair_style gran/hooke/history 1e5 NULL 100 NULL 0.3 1"},
        ["fix nve/cfpm: needs 'pair_style gran/cfpm'", "gran/hooke/history"],
    ),
    "dt_reset": ({"extra": "fix dt all dt/reset 1 NULL NULL 0.1"}, ["fix dt/reset (id dt)", "changes the time step"]),
    "units": ({"style": "units real\natom_style sphere"}, ["units real", "expected lj, si, cgs, micro or nano"]),
    "respa": ({"extra": "run_style respa 2 2 pair 1"}, ["run_style respa", "expected 'run_style verlet'"]),
    "integrator_argument": ({"integrator": "fix i all nve/cfpm xyz"}, ["fix nve/cfpm: unknown argument 'xyz'"]),
    "integrator_disc": ({"integrator": "fix i all nve/cfpm disc"}, ["fix nve/cfpm: disc", "expected 'dimension 2'"]),
    "discs_and_spheres": (
        {
            "style": "dimension 2\nboundary f f p\natom_style sphere",
            "integrator": "fix i one nve/cfpm disc\nfix j two nve/cfpm",
        },
        ["fix nve/cfpm (id j): some", "expected disc for all or none"],
    ),
    "time_step_between": (
        {"run": "run 2\ntimestep 1e-6\nrun 2 pre no"},
        ["fix nve/cfpm: the time step or the pair style changed", "change them only between runs"],
    ),
    "pair_style_between": (
        {"run": "run 2\npair_style zero 0.1\npair_coeff * *\nrun 2 pre no"},
        ["fix nve/cfpm: the time step or the pair style changed", "let 'run' do its setup"],
    ),
    "settings_between": (
        {"run": "run 2\npair_style gran/cfpm hooke 2e5 NULL 100 NULL 0.3 1\npair_coeff * *\nrun 2 pre no"},
        ["fix nve/cfpm: the time step or the pair style changed", "let 'run' do its setup"],
    ),
    "wall_between": (
        {**wall("zplane -1 NULL"), "run": "run 2\n" + wall("zplane -0.5 NULL")["extra"] + "\nrun 2 pre no"},
        ["fix wall/gran/cfpm (id w): given again", "expected a 'run' that does its setup"],
    ),
    "particles_between": (
        {"run": "run 2\ndelete_atoms group one\nrun 2 pre no"},
        ["fix nve/cfpm: particles were added or removed", "let 'run' do its setup"],
    ),
    "region_between": (
        {
            "extra": f"region r plane 0 0 -1 0 0 1\nfix w all wall/gran/cfpm {HOOKE} region r",
            "run": "run 2\nregion r delete\nrun 2 pre no",
        },
        ["fix wall/gran/cfpm (id w): region 'r' does not exist"],
    ),
    "counts_between": (
        {**pair(IMPULSE), "run": "run 2\nunfix CFPM_CONTACTS\nrun 2 pre no"},
        ["pair_style gran/cfpm: fix CFPM_CONTACTS is gone", "expected a 'run' that does its setup"],
    ),
    "ghost_velocity": ({"velocity": ""}, ["ghost atoms store velocity"]),
}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("case", BAD)
def test_is_refused(tmp_path, case, ranks):
    changes, fragments = BAD[case]
    process = attempt(tmp_path, ranks, changes)
    error = first_error(process)
    assert "Signal:" not in process.stdout, process.stdout[-2000:]
    for fragment in fragments:
        assert fragment in error, error


GOOD = {
    "plain": {},
    "move": {"integrator": "fix integrate one nve/cfpm", "extra": "fix other two move linear 0 0 1"},
    "freeze": {"extra": "fix other two freeze"},
    "hertz": pair("hertz 1e7 NULL 100 NULL 0.3 1 limit_damping"),
    "balance_before_the_integrator": {"coefficients": "pair_coeff * *\nbalance 1.1 shift x 5 1.1"},
    "other_settings_between_runs": {
        "run": "run 2\npair_style gran/cfpm hertz 1e7 NULL 100 NULL 0.3 1 predict rk2\npair_coeff * *\nrun 2"
    },
    "another_law_between_runs_with_the_same_coefficients": {
        "run": "\n".join(
            f"run 2\npair_style gran/cfpm {contact}" for contact in ("hertz 1e7 NULL 100 NULL 0.3 1", HOOKE, IMPULSE)
        )
        + "\nrun 2"
    },
    "counts_taken_away_between_runs": {**pair(IMPULSE), "run": "run 2\nunfix CFPM_CONTACTS\nrun 2"},
    "none_between_runs": {
        "run": "run 2\nunfix integrate\nfix integrate all nve/sphere\n"
        "pair_style gran/cfpm hooke 1e5 NULL 100 NULL 0.3 1 predict none\npair_coeff * *\nrun 2"
    },
    "onset": pair(f"{HOOKE} onset on predict rk2"),
    "onset_of_the_default": pair(f"{HOOKE} onset on"),
    "impulse": pair(f"{IMPULSE} onset on split 1"),
    "impulse_in_front": pair("hooke predict impulse split 0 onset off 1e5 NULL 100 NULL 0.3 1"),
    "impulse_too_far_without_onset": {
        **pair(f"{IMPULSE} onset off"),
        "run": "timestep 1e-5\nvelocity two set 500 0 0 units box\nrun 2",
    },
    "impulse_in_a_hybrid": {
        "pair": f"pair_style hybrid/overlay gran/cfpm {IMPULSE} split 0.5 lj/cut 0.1",
        "coefficients": "pair_coeff * * gran/cfpm\npair_coeff * * lj/cut 1e-9 0.05",
    },
    "impulse_at_the_wall_alone": wall("predict impulse zplane -1 NULL"),
    "impulse_at_a_wall_that_follows": {**wall("zplane -1 NULL"), **pair(f"{IMPULSE} split 0.5")},
    "hertz_wall_beside_impulses": {
        **pair(IMPULSE),
        "extra": "fix w all wall/gran/cfpm hertz 1e7 NULL 100 NULL 0.3 1 zplane -1 NULL",
    },
    "impulse_of_hertz": {
        **pair("hertz 1e7 NULL 100 NULL 0.3 1 predict impulse split 0.5"),
        "extra": "fix w all wall/gran/cfpm hertz 1e7 NULL 100 NULL 0.3 1 zplane -1 NULL",
    },
    "impulse_and_none_between_runs": {
        **wall("zplane -1 NULL"),
        "run": "\n".join(
            f"run 2\npair_style gran/cfpm {HOOKE} predict {p}\npair_coeff * *"
            for p in ("impulse split 0.5", "rk2", "impulse", "impulse split 1")
        )
        + "\nrun 2\nunfix w\nunfix integrate\nfix integrate all nve/sphere\n"
        + f"pair_style gran/cfpm {HOOKE} predict none\npair_coeff * *\nrun 2",
    },
    "hybrid": {
        "pair": "pair_style hybrid/overlay gran/cfpm hooke 1e5 NULL 100 NULL 0.3 1 lj/cut 0.1",
        "coefficients": "pair_coeff * * gran/cfpm\npair_coeff * * lj/cut 1e-9 0.05",
    },
    "stress": {
        "extra": "compute s all stress/atom NULL\ncompute total all reduce sum c_s[1]\nthermo_style custom c_total"
    },
    "wall": wall("zplane -1 NULL predict rk2"),
    "hertz_wall": {"extra": "fix w all wall/gran/cfpm hertz 1e7 NULL 100 NULL 0.3 1 zplane -1 NULL"},
}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("case", GOOD)
def test_runs(tmp_path, case, ranks):
    process = attempt(tmp_path, ranks, GOOD[case])
    assert process.returncode == 0, process.stdout[-2000:]
