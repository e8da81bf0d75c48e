// SPDX-License-Identifier: GPL-2.0-or-later
#include "gran_wall_law.h"

#include "contact_arguments.h"

#include <utility>

namespace cfpm::lammps {

namespace {

class GranWallLaw : public WallLaw {
public:
  explicit GranWallLaw(ContactArguments contact) : contact_(std::move(contact)) {}

  LawKind kind() const override { return contact_.law(); }
  bool damped_friction() const override { return contact_.damped_friction(); }
  std::vector<Collision> collisions(const ContactPartners &partners, double impact_speed) const override {
    return {collision(contact_, partners, impact_speed)};
  }
  int law_history() const override { return contact_.law_history(); }
  std::string reason_against(const Method &) const override { return ""; }
  std::string reason_against_energy(const Method &method) const override {
    return contact_.reason_against_energy(method);
  }
  std::unique_ptr<PredictedContacts> predicted_contacts(const Method &method) const override {
    ContactArguments solved = contact_;
    solved.method = &method;
    return make_predicted_contacts(solved);
  }
  std::vector<std::string> for_host_wall() const override {
    std::vector<std::string> words = {contact_.host_model(false)};
    words.insert(words.end(), contact_.for_host_style.begin(), contact_.for_host_style.end());
    return words;
  }

private:
  ContactArguments contact_;
};

} // namespace

WallArguments read_gran_wall(LAMMPS_NS::LAMMPS &lmp, const std::string &command,
                             const std::vector<std::string> &words) {
  const ContactArguments contact = read_contact_arguments(lmp, command, ContactOwner::wall, words);
  return {contact, std::make_shared<GranWallLaw>(contact), contact.rest};
}

} // namespace cfpm::lammps
