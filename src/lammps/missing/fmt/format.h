// SPDX-License-Identifier: GPL-2.0-or-later
// The host's headers name a formatting library that is not shipped with them. Nothing here calls it: as
// much as the declarations need.
#pragma once

namespace fmt {
class string_view;
class format_args;
template <class... Args> format_args make_args_checked(...);
} // namespace fmt
