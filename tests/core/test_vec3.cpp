// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/numbers/vec3.h"

#include <gtest/gtest.h>

namespace cfpm {
namespace {

TEST(Cross, IsRightHanded) {
  EXPECT_TRUE(cross(Vec3{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}) == (Vec3{0.0, 0.0, 1.0}));
  EXPECT_TRUE(cross(Vec3{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}) == (Vec3{1.0, 0.0, 0.0}));
  EXPECT_TRUE(cross(Vec3{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}) == (Vec3{0.0, 1.0, 0.0}));
}

TEST(TangentialPart, DropsTheNormalComponentOnly) {
  EXPECT_TRUE(tangential_part(Vec3{5.0, -7.0, 2.0}, {0.0, 0.0, 1.0}) == (Vec3{5.0, -7.0, 0.0}));
  const Vec3 n{0.6, 0.0, -0.8};
  const Vec3 t = tangential_part(Vec3{5.0, -7.0, 2.0}, n); // a.n = 1.4
  EXPECT_DOUBLE_EQ(t.x, 5.0 - 0.84);
  EXPECT_DOUBLE_EQ(t.y, -7.0);
  EXPECT_DOUBLE_EQ(t.z, 2.0 + 1.12);
}

} // namespace
} // namespace cfpm
