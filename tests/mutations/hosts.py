# SPDX-License-Identifier: GPL-2.0-or-later
"""Mutations of the plugins, each with the host's test that must notice it and what it must say; see mutate.py."""

from mutate import Mutation

DROPPED_IN_CORE = {
    "name": "drop_history_of_predicted_pairs",
    "file": "src/core/step/pair_list.h",
    "original": "flag |= touching",
    "mutated": "flag &= ~touching",
    "breaks": "the mark by which the host keeps a contact's history where the list of pairs is rebuilt",
}

LAMMPS = [
    Mutation(
        name="drop_history_of_host_style",
        file="src/lammps/pair_gran_cfpm.cpp",
        original="host_style_->compute(eflag, vflag);",
        mutated="host_style_->compute(eflag, vflag);"
        " for (int i = 0; i < atom->nlocal; ++i) std::fill_n(history_->flags[i], list->numneigh[i], 0);",
        breaks="the same of contacts whose forces the host's own style gives",
        noticed_by="test_stock_equality_in_use.py::test_beside_a_rigid_body",
        message="thermo output differs from stock",
    ),
    Mutation(
        **DROPPED_IN_CORE,
        noticed_by="test_rebuilds.py::test_rebuilds_change_nothing[hooke-off]",
        message="rebuilds changed the run",
    ),
]

LIGGGHTS = [
    Mutation(
        name="drop_history_at_rebuild",
        file="src/liggghts/contact_cfpm.h",
        original="rolling_->surfacesIntersect(data, i_forces, j_forces);",
        mutated="rolling_->surfacesIntersect(data, i_forces, j_forces);"
        " if (data.contact_flags) *data.contact_flags = 0;",
        breaks="the same of contacts of the host's own loops",
        noticed_by="test_stock_equality.py::test_equals_stock[rolling-plane-1]",
        message="bed.dump differs from stock, first in line",
    ),
    Mutation(
        **DROPPED_IN_CORE,
        noticed_by="test_passive_output.py::test_output_is_passive[exact-1]",
        message="output changed the run, first in line",
    ),
]
