// SPDX-License-Identifier: GPL-2.0-or-later
// The cache never gives out the parameters of another kind of contact, whatever shares its place in the table.
#include "core/contact/parameter_cache.h"

#include <gtest/gtest.h>

namespace cfpm::testing {
namespace {

/// Stands for a contact: remembers what it was made for.
struct Made {
  ContactPartners partners;
  double step;
  double dt() const { return step; }
};

class Cache {
public:
  explicit Cache(int log2_entries) : cache_(log2_entries) {}
  const Made &get(const ContactPartners &p, double dt) {
    return cache_.get(p, dt, [&] {
      ++made;
      return Made{p, dt};
    });
  }
  void clear() { cache_.clear(); }
  int made = 0;

private:
  ParameterCache<Made> cache_;
};

constexpr ContactPartners kind{1, 2, 0.01, 0.02, 0.005};

/// The smallest table has two places. Of twenty kinds that differ from one in the same thing only, about half share its
/// place, and take turns in it.
TEST(ParameterCache, TellsKindsApartByEveryPartOfTheKey) {
  Cache cache(1);
  for (int part = 0; part < 5; ++part)
    for (int k = 1; k <= 20; ++k) {
      ContactPartners other = kind;
      if (part == 0) other.type_i += k;
      if (part == 1) other.type_j += k;
      if (part == 2) other.radius_i *= 1.0 + 0.1 * k;
      if (part == 3) other.radius_j *= 1.0 + 0.1 * k;
      if (part == 4) other.reduced_mass *= 1.0 + 0.1 * k;
      for (const ContactPartners &p : {kind, other, kind}) {
        const ContactPartners &found = cache.get(p, 1e-4).partners;
        EXPECT_EQ(found.type_i, p.type_i);
        EXPECT_EQ(found.type_j, p.type_j);
        EXPECT_EQ(found.radius_i, p.radius_i);
        EXPECT_EQ(found.radius_j, p.radius_j);
        EXPECT_EQ(found.reduced_mass, p.reduced_mass);
      }
    }
  EXPECT_GT(cache.made, 5 * 20); // some had to be made again
}

TEST(ParameterCache, MakesAKindOnceForAStep) {
  Cache cache(6);
  for (int k = 0; k < 10; ++k) cache.get(kind, 1e-4);
  EXPECT_EQ(cache.made, 1);
  EXPECT_EQ(cache.get(kind, 2e-4).step, 2e-4);
  EXPECT_EQ(cache.get(kind, 1e-4).step, 1e-4);
  EXPECT_EQ(cache.made, 3);
}

TEST(ParameterCache, ForgetsWhenItIsCleared) { // the law may have changed
  Cache cache(6);
  cache.get(kind, 1e-4);
  cache.clear();
  cache.get(kind, 1e-4);
  EXPECT_EQ(cache.made, 2);
}

} // namespace
} // namespace cfpm::testing
