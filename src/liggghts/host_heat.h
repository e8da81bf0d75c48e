// SPDX-License-Identifier: GPL-2.0-or-later
// The host's heat conduction, without its warnings.
#pragma once

#pragma GCC system_header

#include "host.h"

#include "fix_heat_gran_conduction.h"

#include "compute_pair_gran_local.h"
#include "fix_property_atom.h"
