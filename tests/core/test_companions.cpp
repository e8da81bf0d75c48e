// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/deck/companions.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace cfpm {
namespace {

using Role = Companion::Role;

const Companion ours{"fix nve/cfpm (id 1)", Role::integrator};

std::string wrong(const std::vector<Companion> &fixes, bool predicted = true, bool shared = false) {
  return wrong_companion(fixes, predicted, [shared](std::size_t, std::size_t) { return shared; });
}

TEST(Companions, OfOneIntegratorAndWallsAreRight) {
  EXPECT_EQ(wrong({ours, {"fix wall/gran/cfpm (id 2)", Role::predicted_wall}, {"fix gravity (id 3)", Role::other}}),
            "");
  EXPECT_EQ(
      wrong({{"fix nve/sphere (id 1)", Role::foreign_integrator}, {"fix wall/gran (id 2)", Role::foreign_wall}}, false),
      "");
}

TEST(Companions, ThatMissTheIntegratorAreTold) {
  EXPECT_NE(wrong({}).find("need the matching integrator"), std::string::npos);
}

TEST(Companions, ThatWouldMistakeForcesAreNamed) {
  for (const auto &[role, says] :
       std::vector<std::pair<Role, const char *>>{{Role::foreign_integrator, "as forces of one instant"},
                                                  {Role::rigid_bodies, "moves bodies of several particles"},
                                                  {Role::changes_time_step, "changes the time step"},
                                                  {Role::foreign_wall, "not predicted"},
                                                  {Role::conventional_wall, "'predict none' at a wall"}}) {
    const std::string what = wrong({ours, {"fix other (id 2)", role}});
    EXPECT_EQ(what.rfind("fix other (id 2): ", 0), 0u) << what;
    EXPECT_NE(what.find(says), std::string::npos) << what;
  }
}

TEST(Companions, OfForcesOfOneInstantMustNotBePredicted) {
  EXPECT_EQ(wrong({ours}, false), ""); // it does the step that the pair style is made for
  EXPECT_NE(wrong({{"fix w", Role::predicted_wall}}, false).find("use the same for both"), std::string::npos);
}

TEST(Companions, ThatMoveAllAreNamed) {
  const Companion bodies{"fix rigid (id 2)", Role::rigid_bodies};
  const Companion driven{"fix move (id 3)", Role::prescribed_motion};
  const Companion gravity{"fix gravity (id 4)", Role::other};
  EXPECT_EQ(sole_mover({gravity, driven, bodies, {"fix nve/limit (id 5)", Role::foreign_integrator}}), bodies.name);
  EXPECT_EQ(sole_mover({{"fix nve/limit (id 5)", Role::foreign_integrator}}), "fix nve/limit (id 5)");
  EXPECT_EQ(sole_mover({bodies, ours}), "");
  EXPECT_EQ(sole_mover({gravity, driven}), "");
}

/// Whoever moves a particle, moves it alone.
TEST(Companions, MoveDisjointGroups) {
  const Companion driven{"fix move (id 2)", Role::prescribed_motion};
  EXPECT_EQ(wrong({ours, driven}), "");
  EXPECT_NE(wrong({ours, driven}, true, true).find("fix move (id 2): integrates particles that fix nve/cfpm (id 1)"),
            std::string::npos);
  EXPECT_NE(wrong({ours, {"fix nve/cfpm (id 2)", Role::integrator}}, true, true).find("disjoint groups"),
            std::string::npos);
  EXPECT_EQ(wrong({ours, {"fix gravity (id 3)", Role::other}}, true, true), "");
}

} // namespace
} // namespace cfpm
