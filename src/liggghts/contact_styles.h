// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/law_kind.h"

#include <string>
#include <vector>

namespace cfpm::liggghts {

/// Adds the contact models of this plugin to the host's factories for pairs and walls. They live as
/// long as the process, so this is called once in it.
void register_contact_styles();

/// What a deck may write after model, tangential, cohesion and rolling_friction.
std::vector<std::string> normal_model_names();
std::vector<std::string> tangential_model_names();
std::vector<std::string> cohesion_model_names();
std::vector<std::string> rolling_model_names();

/// The kind of law of one of them.
LawKind law_kind(const std::string &normal_model);

/// The name under which the host's factory knows the predicted form of a normal model.
std::string registered_name(const std::string &normal_model);

} // namespace cfpm::liggghts
