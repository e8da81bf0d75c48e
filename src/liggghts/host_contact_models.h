// SPDX-License-Identifier: GPL-2.0-or-later
// The host's contact models and the templates that loop over pairs and walls with one of them.
#pragma once

#pragma GCC system_header

#include "host.h"

#include "fix_insert_stream.h" // pair_gran_base.h needs it and does not include it
#include "granular_styles.h"

#include "fix_wall_gran.h"
#include "pair_gran_proxy.h"
