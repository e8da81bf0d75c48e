# SPDX-License-Identifier: GPL-2.0-or-later
"""The same run to the last bit whether contacts are computed one by one or several at a time."""

import pytest
from harness.instruction_sets import IMPULSES, OTHER_PREDICTOR, OWN_STEP, check_refusal, check_same_bits, of_any_size

CASES = {
    "default": {},
    "no_history": {"tangential history": "tangential no_history"},
    "without_tension": {"\npair_coeff": " limitForce on\npair_coeff"},
}


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("law", ["linear", "hertz"])
def test_same_bits(tmp_path, law, case):
    check_same_bits("liggghts", tmp_path, law, CASES[case])


@pytest.mark.parametrize("law", OTHER_PREDICTOR)
def test_same_bits_of_another_predictor(tmp_path, law):
    check_same_bits("liggghts", tmp_path, law, OTHER_PREDICTOR[law])


@pytest.mark.parametrize("law", OWN_STEP)
def test_same_bits_of_the_hosts_own_step(tmp_path, law):
    check_same_bits("liggghts", tmp_path, law, OWN_STEP[law])


def of_materials(change):
    """With the properties that the models hertz and hooke ask for."""
    material = {"youngsModulus peratomtype": 1e7, "poissonsRatio peratomtype": 0.3}
    material |= {"coefficientRestitution peratomtypepair 1": 0.5, "characteristicVelocity scalar": 1.0}
    properties = [f"fix material{k} all property/global {words} {material[words]}" for k, words in enumerate(material)]
    return {**change, "\npair_style": "\n".join(["", *properties, "pair_style"])}


@pytest.mark.parametrize("predict", ["exact", "impulse"])
def test_same_bits_of_the_exact_hertz_contact(tmp_path, predict):
    change = of_materials({"hertz/stiffness": "hertz", "predict rk4": f"predict {predict}"})
    check_same_bits("liggghts", tmp_path, "hertz", change)


@pytest.mark.parametrize("predict", ["exact", "impulse", "verlet"])
@pytest.mark.parametrize("model", ["hooke", "hertz"])
def test_same_bits_of_materials_of_any_size(tmp_path, model, predict):
    change = of_materials({"hertz/stiffness": model, "predict rk4": f"predict {predict}"})
    check_same_bits("liggghts", tmp_path, "hertz", change, of_any_size())


@pytest.mark.parametrize("law", IMPULSES)
def test_same_bits_of_impulses(tmp_path, law):
    check_same_bits("liggghts", tmp_path, law, {})


@pytest.mark.parametrize("law", ["linear", "hertz", "impulse", "split"])
def test_same_bits_of_any_size(tmp_path, law):
    check_same_bits("liggghts", tmp_path, law, {}, of_any_size())


@pytest.mark.parametrize("law", OWN_STEP)
def test_same_bits_of_the_hosts_own_step_of_any_size(tmp_path, law):
    check_same_bits("liggghts", tmp_path, law, OWN_STEP[law], of_any_size())


def test_refuses_what_it_does_not_know(tmp_path):
    check_refusal("liggghts", tmp_path)
