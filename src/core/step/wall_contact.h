// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/parameter_cache.h"

namespace cfpm {

/// A particle and a wall.
struct WallContact {
  int i;
  ContactPartners partners;
  Contact contact;
};

} // namespace cfpm
