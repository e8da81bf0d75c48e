// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace cfpm {

/// Versions of LAMMPS whose pair_style granular has the same physics in another order of operations, so that results
/// differ by roundings: named after the first year that is known to have it.
enum class GranularOrder { of_2021, of_2025, of_2026 };

} // namespace cfpm
