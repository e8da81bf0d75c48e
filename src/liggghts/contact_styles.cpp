// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_styles.h"

#include "contact_cfpm.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace cfpm::liggghts {

namespace {

// ids in the host's 6-bit table of normal models that it does not use itself
constexpr int first_normal_id = 40;

struct Named {
  const char *name;
  int id;
};

constexpr Named cohesion_models[] = {
    {"off", models::COHESION_OFF},
#define COHESION_MODEL(identifier, name, id) {#name, id},
#include "style_cohesion_model.h"
#undef COHESION_MODEL
};

constexpr Named rolling_models[] = {
    {"off", models::ROLLING_OFF},
#define ROLLING_MODEL(identifier, name, id) {#name, id},
#include "style_rolling_model.h"
#undef ROLLING_MODEL
};

constexpr Named tangential_models[] = {{"off", models::TANGENTIAL_OFF},
                                       {"no_history", models::TANGENTIAL_NO_HISTORY},
                                       {"history", models::TANGENTIAL_HISTORY}};

struct NormalModel {
  const char *name;
  int id;
  LawKind law;
};

template <int id> constexpr NormalModel normal_model(const char *name) { return {name, id, LawOf<id>::type::law_kind}; }

constexpr std::array normal_models{
    normal_model<models::HOOKE>("hooke"), normal_model<models::HOOKE_STIFFNESS>("hooke/stiffness"),
    normal_model<models::HERTZ>("hertz"), normal_model<models::HERTZ_STIFFNESS>("hertz/stiffness")};

template <class Table> std::vector<std::string> names(const Table &models) {
  std::vector<std::string> list(std::size(models));
  std::transform(std::begin(models), std::end(models), list.begin(), [](const auto &model) { return model.name; });
  return list;
}

template <class Contact> LIGGGHTS::PairStyles::IGranularPairStyle *
create_pair(LAMMPS_NS::LAMMPS *lmp, LAMMPS_NS::PairGran *parent, int64_t hash) {
  return new LIGGGHTS::PairStyles::Granular<Contact>(lmp, parent, hash);
}

template <class Contact>
LIGGGHTS::Walls::IGranularWall *create_wall(LAMMPS_NS::LAMMPS *lmp, LAMMPS_NS::FixWallGran *parent, int64_t hash) {
  return new LIGGGHTS::Walls::Granular<Contact>(lmp, parent, hash);
}

template <int Normal, int Tangential> void register_one(int normal_id) {
  using Contact = ContactCfpm<Normal, Tangential>;
  for (const Named &cohesion : cohesion_models)
    for (const Named &rolling : rolling_models) {
      const auto hash = static_cast<int>(LIGGGHTS::Utils::generate_gran_hashcode(normal_id, Tangential, cohesion.id,
                                                                                 rolling.id, models::SURFACE_DEFAULT));
      LIGGGHTS::PairStyles::Factory::instance().addStyle("gran", hash, &create_pair<Contact>);
      LIGGGHTS::Walls::Factory::instance().addStyle("gran", hash, &create_wall<Contact>);
    }
}

template <std::size_t Index> void register_normal() {
  constexpr NormalModel model = normal_models[Index];
  constexpr int id = first_normal_id + static_cast<int>(Index);
  models::Factory::instance().addNormalModel(registered_name(model.name), id);
  register_one<model.id, models::TANGENTIAL_OFF>(id);
  register_one<model.id, models::TANGENTIAL_NO_HISTORY>(id);
  register_one<model.id, models::TANGENTIAL_HISTORY>(id);
}

template <std::size_t... Index> void register_all(std::index_sequence<Index...>) { (register_normal<Index>(), ...); }

} // namespace

void register_contact_styles() { register_all(std::make_index_sequence<normal_models.size()>()); }

LawKind law_kind(const std::string &normal_model) {
  return std::find_if(normal_models.begin(), normal_models.end(),
                      [&](const NormalModel &model) { return model.name == normal_model; })
      ->law;
}

std::vector<std::string> normal_model_names() { return names(normal_models); }
std::vector<std::string> tangential_model_names() { return names(tangential_models); }
std::vector<std::string> cohesion_model_names() { return names(cohesion_models); }
std::vector<std::string> rolling_model_names() { return names(rolling_models); }

std::string registered_name(const std::string &normal_model) { return normal_model + "/cfpm"; }

std::shared_ptr<models::CohesionModelBase> make_cohesion_model(int id, LAMMPS_NS::LAMMPS *lmp,
                                                               LIGGGHTS::IContactHistorySetup *history,
                                                               models::ContactModelBase *contact) {
#define COHESION_MODEL(identifier, name, number)                                                                       \
  if (id == (number)) return std::make_shared<models::CohesionModel<models::identifier>>(lmp, history, contact);
#include "style_cohesion_model.h"
#undef COHESION_MODEL
  return nullptr;
}

std::shared_ptr<models::RollingModelBase> make_rolling_model(int id, LAMMPS_NS::LAMMPS *lmp,
                                                             LIGGGHTS::IContactHistorySetup *history,
                                                             models::ContactModelBase *contact) {
#define ROLLING_MODEL(identifier, name, number)                                                                        \
  if (id == (number)) return std::make_shared<models::RollingModel<models::identifier>>(lmp, history, contact);
#include "style_rolling_model.h"
#undef ROLLING_MODEL
  return nullptr;
}

} // namespace cfpm::liggghts
