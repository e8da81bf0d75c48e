// SPDX-License-Identifier: GPL-2.0-or-later
#include "required_properties.h"

#include "host.h"

#include "fix_property_global.h"

#include <cmath>
#include <vector>

namespace cfpm::liggghts {

namespace {

enum class Shape { scalar, per_type, per_type_pair };

struct Property {
  const char *name;
  Shape shape;
};

const char *host_name(Shape shape) {
  switch (shape) {
  case Shape::scalar:
    return "scalar";
  case Shape::per_type:
    return "peratomtype";
  case Shape::per_type_pair:
    break;
  }
  return "peratomtypepair";
}

int value_count(const Property &property, int types) {
  return property.shape == Shape::scalar ? 1 : property.shape == Shape::per_type ? types : types * types;
}

int values_in(const LAMMPS_NS::FixPropertyGlobal &fix) {
  return fix.array_flag ? fix.size_array_rows * fix.size_array_cols : fix.vector_flag ? fix.size_vector : 1;
}

std::string wanted_line(const Property &property, int types) {
  const int values = value_count(property, types);
  const std::string columns = property.shape == Shape::per_type_pair ? " " + std::to_string(types) : "";
  return std::string("fix ID all property/global ") + property.name + " " + host_name(property.shape) + columns +
         (values == 1 ? " <value>" : " <" + std::to_string(values) + " values>");
}

std::vector<Property> properties_of(const ModelNeeds &needs) {
  const std::vector<Property> derived{{"youngsModulus", Shape::per_type},
                                      {"poissonsRatio", Shape::per_type},
                                      {"coefficientRestitution", Shape::per_type_pair}};
  const std::vector<Property> given{{"kn", Shape::per_type_pair},
                                    {"kt", Shape::per_type_pair},
                                    {needs.absolute_damping ? "gamman_abs" : "gamman", Shape::per_type_pair},
                                    {needs.absolute_damping ? "gammat_abs" : "gammat", Shape::per_type_pair}};
  std::vector<Property> list = needs.stiffness_given ? given : derived;
  if (needs.characteristic_velocity) list.push_back({"characteristicVelocity", Shape::scalar});
  if (needs.friction) list.push_back({"coefficientFriction", Shape::per_type_pair});
  return list;
}

} // namespace

void require_properties(LAMMPS_NS::LAMMPS &lmp, const std::string &command, const ModelNeeds &needs) {
  const auto fail = [&](const std::string &what) { lmp.error->all(FLERR, (command + ": " + what).c_str()); };
  const int types = lmp.atom->ntypes;
  for (const Property &property : properties_of(needs)) {
    const std::string expected = "; expected a line '" + wanted_line(property, types) + "'";
    auto *fix = static_cast<LAMMPS_NS::FixPropertyGlobal *>(lmp.modify->find_fix_property(
        property.name, "property/global", host_name(property.shape), 0, 0, command.c_str(), false));
    if (!fix) fail(std::string("missing material property '") + property.name + "'" + expected);
    const int count = value_count(property, types);
    if (values_in(*fix) != count)
      fail(std::string("material property '") + property.name + "' has " + std::to_string(values_in(*fix)) + " values" +
           expected);
    for (int k = 0; k < count; ++k) {
      const double value = fix->get_values()[k];
      if (value >= 0.0 && std::isfinite(value)) continue;
      fail(std::string("material property '") + property.name + "' is " + std::to_string(value) +
           (value < 0.0 ? "; expected no negative value" : "; expected a finite number"));
    }
  }
}

} // namespace cfpm::liggghts
