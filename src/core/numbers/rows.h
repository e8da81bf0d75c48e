// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/numbers/pack.h"
#include "core/numbers/two_packs.h"
#include "core/numbers/vec3.h"

namespace cfpm {

/// Between vectors as hosts keep them, three numbers in a row, and packs of them, component by component. row(lane):
/// where the vector of a lane is.
template <class P> struct Rows;

template <int lanes> struct Rows<Pack<lanes>> {
  using P = Pack<lanes>;
  using Values = typename P::Values;

  template <class Row> [[gnu::always_inline]] static BasicVec3<P> gather(const Row &row) {
    return {Lanes<P>::fill([&](int lane) CFPM_INLINED { return row(lane)[0]; }),
            Lanes<P>::fill([&](int lane) CFPM_INLINED { return row(lane)[1]; }),
            Lanes<P>::fill([&](int lane) CFPM_INLINED { return row(lane)[2]; })};
  }

  template <class Row> [[gnu::always_inline]] static void scatter(const BasicVec3<P> &vectors, const Row &row) {
    const Values x = vectors.x.values;
    const Values y = vectors.y.values;
    const Values z = vectors.z.values;
    for (int lane = 0; lane < lanes; ++lane) set({x[lane], y[lane], z[lane]}, row(lane));
  }
};

template <class Part> struct Rows<TwoPacks<Part>> {
  template <class Row> [[gnu::always_inline]] static BasicVec3<TwoPacks<Part>> gather(const Row &row) {
    const BasicVec3<Part> first = Rows<Part>::gather(row);
    const BasicVec3<Part> second = Rows<Part>::gather([&](int lane) CFPM_INLINED { return row(lane + Part::width); });
    return {{first.x, second.x}, {first.y, second.y}, {first.z, second.z}};
  }
  template <class Row>
  [[gnu::always_inline]] static void scatter(const BasicVec3<TwoPacks<Part>> &vectors, const Row &row) {
    Rows<Part>::scatter({vectors.x.first, vectors.y.first, vectors.z.first}, row);
    Rows<Part>::scatter({vectors.x.second, vectors.y.second, vectors.z.second},
                        [&](int lane) CFPM_INLINED { return row(lane + Part::width); });
  }
};

} // namespace cfpm
