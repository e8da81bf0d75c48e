// SPDX-License-Identifier: GPL-2.0-or-later
// The contact model that the host's pair and wall loops are instantiated with: geometry, cohesion
// and rolling friction are the host's, the normal and tangential forces are the step means of the
// contact force prediction method. With "predict verlet" they are the host's as well.
#pragma once

#include "contact_model_interface.h"
#include "host_contact_models.h"
#include "laws_of_sizes.h"
#include "linear_cohesion.h"
#include "mesh_touch.h"
#include "model_arguments.h"
#include "required_properties.h"
#include "resist_rolling.h"

#include "core/contact/parameter_cache.h"
#include "core/law/coulomb.h"
#include "core/law/hertz_mindlin_law.h"
#include "core/law/linear_law.h"
#include "core/method/contact_solver.h"
#include "core/method/conventional/force_of_instant.h"
#include "core/method/conventional/limited_spring.h"
#include "core/method/conventional/normal_of_instant.h"
#include "core/numbers/instruction_set.h"
#include "core/step/act.h"
#include "core/step/add_pair_forces.h"
#include "core/step/add_wall_forces.h"
#include "core/step/contact_energy.h"
#include "core/step/energy_budget.h"
#include "core/step/equivalent_overlaps.h"
#include "core/step/packed_pairs.h"
#include "core/step/touch.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace cfpm::liggghts {

namespace models = LIGGGHTS::ContactModels;

/// Hands history values on to the host and remembers where the tangential spring is kept.
class SpringRecorder : public LIGGGHTS::IContactHistorySetup {
public:
  explicit SpringRecorder(LIGGGHTS::IContactHistorySetup *host) : host_(host) {}
  int add_history_value(std::string name, std::string newton_flag) override {
    const bool is_spring = name == "shearx";
    const int offset = host_->add_history_value(std::move(name), std::move(newton_flag));
    if (is_spring) offset_ = offset;
    return offset;
  }
  int offset() const { return offset_; }

private:
  LIGGGHTS::IContactHistorySetup *host_;
  int offset_ = -1;
};

/// The host's models of that id; null for "off", which then costs nothing.
std::shared_ptr<models::CohesionModelBase>
make_cohesion_model(int id, LAMMPS_NS::LAMMPS *, LIGGGHTS::IContactHistorySetup *, models::ContactModelBase *);
std::shared_ptr<models::RollingModelBase>
make_rolling_model(int id, LAMMPS_NS::LAMMPS *, LIGGGHTS::IContactHistorySetup *, models::ContactModelBase *);

template <int Normal, int Tangential> class ContactCfpm final : public models::ContactModelBase,
                                                                public ContactModelInterface,
                                                                private HostLaw<typename LawOf<Normal>::type> {
public:
  using Settings = ::Settings;
  using Intersect = models::SurfacesIntersectData;
  using Close = models::SurfacesCloseData;
  using Forces = models::ForceData;
  using Law = typename LawOf<Normal>::type;
  using OfInstant = ParametersOfInstant<LimitedSpring<LawOf<Normal>::template Coefficients, double>>;
  static constexpr Friction friction = Tangential == models::TANGENTIAL_OFF          ? Friction::none
                                       : Tangential == models::TANGENTIAL_NO_HISTORY ? Friction::dashpot
                                                                                     : Friction::spring_and_dashpot;

  ContactCfpm(LAMMPS_NS::LAMMPS *lmp, LIGGGHTS::IContactHistorySetup *history, bool is_wall, int64_t hash)
      : ContactModelBase(lmp, is_wall), lmp_(lmp), hash_(hash), history_(history),
        arguments_(ModelArguments::of(history)), spring_recorder_(history), surface_(lmp, history, this),
        normal_(lmp, history, this), cohesion_(make_cohesion_model(cohesion_id(), lmp, history, this)),
        tangential_(lmp, &spring_recorder_, this), rolling_(make_rolling_model(rolling_id(), lmp, history, this)) {
    if (friction != Friction::spring_and_dashpot || !arguments_ || !arguments_->may_want_crowd()) return;
    spring_now_offset_ = history->add_history_value("spring_now_x", "1");
    history->add_history_value("spring_now_y", "1");
    history->add_history_value("spring_now_z", "1");
  }

  int64_t hashcode() { return hash_; }
  double stressStrainExponent() { return normal_.stressStrainExponent(); }

  void registerSettings(Settings &settings) {
    surface_.registerSettings(settings);
    normal_.registerSettings(settings);
    if (cohesion_) cohesion_->registerSettings(settings);
    tangential_.registerSettings(settings);
    if (rolling_) rolling_->registerSettings(settings);
    // second targets of settings that the host's model registered above
    if constexpr (Normal == models::HOOKE_STIFFNESS) settings.registerOnOff("absolute_damping", absolute_damping_);
    settings.registerOnOff("limitForce", limit_force_);
    settings.registerOnOff("tangential_damping", tangential_damping_, true);
    if (!arguments_) return; // of a style of the host, see connectToProperties()
    const auto *wall = dynamic_cast<const LAMMPS_NS::FixWallGran *>(history_);
    arguments_->check_settings(settings, wall ? std::optional<int>(wall->iarg()) : std::nullopt);
  }

  void postSettings(LIGGGHTS::IContactHistorySetup *history) {
    surface_.postSettings(history, this);
    normal_.postSettings(history, this);
    if (cohesion_) cohesion_->postSettings(history, this);
    tangential_.postSettings(history, this);
    if (rolling_) rolling_->postSettings(history, this);
  }

  void connectToProperties(PropertyRegistry &registry) {
    auto *owner = dynamic_cast<ContactModelOwner *>(history_);
    if (!owner)
      lmp_->error->all(FLERR, "this contact model belongs to pair_style gran/cfpm and fix wall/gran/cfpm; "
                              "use it through them");
    require_properties(*lmp_, owner->command(),
                       {Normal == models::HOOKE_STIFFNESS || Normal == models::HERTZ_STIFFNESS, Normal == models::HOOKE,
                        absolute_damping_, Tangential != models::TANGENTIAL_OFF});
    surface_.connectToProperties(registry);
    normal_.connectToProperties(registry);
    if (cohesion_) cohesion_->connectToProperties(registry);
    tangential_.connectToProperties(registry);
    if (rolling_) rolling_->connectToProperties(registry);
    if constexpr (Tangential != models::TANGENTIAL_OFF) {
      registry.registerProperty("coeffFrict", &MODEL_PARAMS::createCoeffFrict);
      registry.connect("coeffFrict", friction_, owner->command());
    }
    if constexpr (Normal == models::HERTZ) {
      registry.registerProperty("Yeff", &MODEL_PARAMS::createYeff);
      registry.registerProperty("Geff", &MODEL_PARAMS::createGeff);
      registry.registerProperty("betaeff", &MODEL_PARAMS::createBetaEff);
      registry.connect("Yeff", young_, owner->command());
      registry.connect("Geff", shear_modulus_, owner->command());
      registry.connect("betaeff", damping_ratio_, owner->command());
    }
    const Method &method = owner->method();
    predicted_ = method.predicted;
    of_instant_.clear();
    step_ = &owner->step();
    onset_ = owner->onset();
    if (onset_) lmp_->neighbor->register_contact_dist_factor(foreseen_distance);
    if (friction == Friction::spring_and_dashpot && method.wants_crowd && spring_now_offset_ < 0)
      lmp_->error->all(FLERR, (std::string(owner->command()) + ": its contact history was made without 'predict " +
                               method.name +
                               "', which needs more; expected 'unfix' and the command again behind the pair style")
                                  .c_str());
    law_of_host_.emplace(LawOfHost<Law>{*this, Normal == models::HOOKE, absolute_damping_});
    solver_.emplace(*law_of_host_);
    solver_->reset(method, lmp_->domain->dimension, onset_);
    warn_of_cohesion(owner->command());
    owner->connect(*this);
  }

  void beginPass(Intersect &data, Forces &i_forces, Forces &j_forces) {
    surface_.beginPass(data, i_forces, j_forces);
    if (cohesion_) cohesion_->beginPass(data, i_forces, j_forces);
    if (rolling_) rolling_->beginPass(data, i_forces, j_forces);
  }

  void endPass(Intersect &data, Forces &i_forces, Forces &j_forces) {
    if (rolling_) rolling_->endPass(data, i_forces, j_forces);
    if (cohesion_) cohesion_->endPass(data, i_forces, j_forces);
    surface_.endPass(data, i_forces, j_forces);
  }

  bool checkSurfaceIntersect(Intersect &data) { return surface_.checkSurfaceIntersect(data); }

  void surfacesIntersect(Intersect &data, Forces &i_forces, Forces &j_forces) {
    surface_.surfacesIntersect(data, i_forces, j_forces);
    if (predicted_) {
      with_method([&](const auto &method) { act_touching(method, data, i_forces, j_forces); });
    } else {
      normal_.surfacesIntersect(data, i_forces, j_forces);
      if (cohesion_) cohesion_->surfacesIntersect(data, i_forces, j_forces);
      const Vec3 without_friction = vec3(i_forces.delta_F);
      tangential_.surfacesIntersect(data, i_forces, j_forces);
      if (data.is_wall && data.computeflag && step_->budget)
        tell_of_wall(data, vec3(i_forces.delta_F) - without_friction);
    }
    if (rolling_ && predicted_)
      resist_rolling(*lmp_, *rolling_, rolling_id(), data, i_forces, j_forces);
    else if (rolling_)
      rolling_->surfacesIntersect(data, i_forces, j_forces);
  }

  void endSurfacesIntersect(Intersect &data, LAMMPS_NS::TriMesh *mesh, Forces &i_forces, Forces &j_forces) {
    surface_.endSurfacesIntersect(data, mesh, i_forces.delta_F);
    if (cohesion_) cohesion_->endSurfacesIntersect(data, i_forces, j_forces);
  }

  /// The host passes what it has filled in for a contact, as far as it goes for bodies that are apart.
  void surfacesClose(Intersect &data, Forces &i_forces, Forces &j_forces) {
    surface_.surfacesClose(data, i_forces, j_forces);
    if (conducts_heat()) data.deltan = 0.0; // else the host's wall takes the root of a negative area
    if (predicted_) {
      with_method([&](const auto &method) { act_approaching(method, data, i_forces, j_forces); });
    } else {
      normal_.surfacesClose(data, i_forces, j_forces);
      tangential_.surfacesClose(data, i_forces, j_forces);
    }
    if (cohesion_) cohesion_->surfacesClose(data, i_forces, j_forces);
    if (rolling_) rolling_->surfacesClose(data, i_forces, j_forces);
  }

  void tally_pp(double value, int i, int j, int index) override { surface_.tally_pp(value, i, j, index); }
  void tally_pw(double value, int i, int j, int index) override { surface_.tally_pw(value, i, j, index); }

  bool contact_match(const std::string &kind, const std::string &name) {
    auto &factory = models::Factory::instance();
    if (kind == "surface") return factory.getSurfaceModelId(name) == models::SURFACE_DEFAULT;
    if (kind == "normal") return factory.getNormalModelId(name) == Normal;
    if (kind == "tangential") return factory.getTangentialModelId(name) == Tangential;
    if (kind == "cohesion") return factory.getCohesionModelId(name) == cohesion_id();
    if (kind == "rolling_friction") return factory.getRollingModelId(name) == rolling_id();
    return false;
  }

  void add_pair_forces(const Particles &particles, const PairList &pairs, bool advance) override {
    if (!predicted_) {
      const double dt = lmp_->update->dt;
      const auto act = [&](const auto &parameters) {
        const ForceOfInstant method(parameters);
        PackedPairs<friction, decltype(method), NoTally>(instruction_set().lanes, particles, pairs, method, no_tally)
            .add_forces();
      };
      if constexpr (Normal == models::HOOKE)
        act([&](const ContactPartners &p) -> const OfInstant & { return parameters_of_instant(p, dt); });
      else
        act(InstantLawOfHost<Normal, ContactCfpm>{*this, absolute_damping_, dt});
      return;
    }
    with_method([&](const auto &method) {
      const StoredSpring spring{nullptr, spring_step(), advance};
      cfpm::add_pair_forces<friction>(particles, pairs, *step_, spring, method, no_tally);
    });
  }

  void collect_wall_contacts(std::vector<WallContact> *collected) override { collected_ = collected; }
  void add_wall_forces(const std::vector<WallContact> &contacts) override {
    with_method([&](const auto &method) { cfpm::add_wall_forces<friction>(contacts, particles(), *step_, method); });
  }

  std::vector<PairOverlap> equivalent_overlaps(const Particles &particles, const PairList &pairs) override {
    std::vector<PairOverlap> overlaps;
    with_method([&](const auto &method) { overlaps = cfpm::equivalent_overlaps(particles, pairs, *step_, method); });
    return overlaps;
  }

  void add_pair_energies(const Particles &particles, const PairList &pairs, EnergyBudget &budget) override {
    const StoredSpring spring{nullptr, lmp_->update->dt, false};
    const auto tell = [&](const auto &method) {
      cfpm::add_pair_energies<friction>(particles, pairs, *step_, spring, method, budget);
    };
    if (predicted_)
      with_method(tell);
    else
      tell(NormalOfInstant(*law_of_host_));
  }

  double contact_time(const ContactPartners &partners, double impact_speed) override {
    const double stiffness = law_of(partners).normal_stiffness;
    return Law::law_kind == LawKind::linear ? cfpm::contact_time(stiffness, partners.reduced_mass)
                                            : hertz_contact_time(stiffness, partners.reduced_mass, impact_speed);
  }

  Restitution restitution(const ContactPartners &partners) override {
    return cfpm::restitution(law_of(partners), partners.reduced_mass);
  }

  LawKind law() const override { return Law::law_kind; }
  int spring_offset() const override { return spring_recorder_.offset(); }
  int spring_now_offset() const override { return spring_now_offset_; }
  void all_evaluated() override { spring_step_ = lmp_->update->dt; }
  bool has_host_models() const override { return cohesion_ || rolling_; }
  std::string reason_for_host_loop() const override {
    if (has_host_models()) return "cohesion or rolling friction acts beside them";
    const bool stiffness_of_pressure = Law::law_kind != LawKind::linear && lmp_->force->nktv2p != 1.0;
    return stiffness_of_pressure ? "stiffness is not made of pressures alone in these units" : "";
  }

private:
  void warn_of_cohesion(const char *command) {
    if (!predicted_ || !cohesion_ || predicts_cohesion() || warned_) return;
    warned_ = true;
    if (lmp_->comm->me != 0) return;
    lmp_->error->warning(FLERR, (std::string(command) +
                                 ": this cohesion is not predicted, but acts over a step as it is in its beginning; "
                                 "collisions in which it matters need about 20 steps per contact time to come out "
                                 "within 2 per cent. Predicted is 'cohesion sjkr' or 'sjkr2' beside a linear law")
                                    .c_str());
  }

  // where the host's Utils::generate_gran_hashcode() puts the ids, six bits each
  int cohesion_id() const { return static_cast<int>(hash_ >> 12 & 63); }
  int rolling_id() const { return static_cast<int>(hash_ >> 18 & 63); }

  template <class Use> void with_method(const Use &use) {
    solver_->with_method(lmp_->update->dt, step_->crowd_dt, use);
  }

  /// The host's own parameters, whatever its settings make of them, asked of its model directly. At an
  /// overlap of 1 every power of the overlap is 1, so that what acts there are the coefficients.
  Law law_of(const ContactPartners &partners) override {
    const Intersect probe = at_unit_overlap(partners, is_wall());
    constexpr bool has_spring = Tangential == models::TANGENTIAL_HISTORY;
    return {probe.kn - cohesive_stiffness(probe), probe.gamman, has_spring ? probe.kt : 0.0, probe.gammat,
            coulomb_coefficient(partners),        least_force()};
  }

  template <int, class> friend struct InstantLawOfHost;

  const OfInstant &parameters_of_instant(const ContactPartners &p, double dt) {
    return of_instant_.get(p, dt, [&]() -> OfInstant { return {{coefficients_of(p), dt}}; });
  }

  /// The coefficients by which the host's model computes a pair.
  auto coefficients_of(const ContactPartners &p) {
    const double radius = reduced_radius(p.radius_i, p.radius_j);
    const double mu = coulomb_coefficient(p);
    if constexpr (Normal == models::HERTZ) {
      const double young = young_[p.type_i][p.type_j];
      const double shear_modulus = shear_modulus_[p.type_i][p.type_j];
      constexpr double root_of_five_sixths = 0.91287092917527685576;
      const double damping = -2.0 * root_of_five_sixths * damping_ratio_[p.type_i][p.type_j];
      return HertzCoefficients<double>{radius,
                                       p.reduced_mass,
                                       4.0 / 3.0 * young,
                                       2.0 * young,
                                       8.0 * shear_modulus,
                                       damping,
                                       tangential_damping_ ? damping : 0.0,
                                       mu,
                                       least_force()};
    } else if constexpr (Normal == models::HERTZ_STIFFNESS) {
      const Intersect unit = at_unit_overlap({p.type_i, p.type_j, 1.0, 1.0, 1.0}, true); // of unit radius
      return HertzStiffnessCoefficients<double>{radius,  p.reduced_mass, unit.kn, unit.gamman,
                                                unit.kt, unit.gammat,    mu,      least_force()};
    } else {
      const Intersect unit = at_unit_overlap(p, false);
      return HookeCoefficients<double>{{unit.kn, unit.gamman, unit.kt, unit.gammat, mu, least_force()}};
    }
  }

  double least_force() const {
    if (limit_force_) return without_tension;
    return with_tension;
  }

  double coulomb_coefficient(const ContactPartners &p) const { return friction_ ? friction_[p.type_i][p.type_j] : 0.0; }

  /// What the host's normal model leaves there.
  Intersect at_unit_overlap(const ContactPartners &partners, bool at_wall) {
    Intersect probe;
    probe.is_wall = at_wall;
    probe.radi = partners.radius_i;
    probe.radj = partners.radius_j;
    probe.meff = partners.reduced_mass;
    probe.itype = partners.type_i;
    probe.jtype = partners.type_j;
    probe.vn = 0.0;
    probe.deltan = 1.0;
    probe.en[0] = probe.en[1] = probe.en[2] = 0.0;
    Forces unused_i;
    Forces unused_j;
    normal_.surfacesIntersect(probe, unused_i, unused_j);
    return probe;
  }

  bool predicts_cohesion() const {
    return Law::law_kind == LawKind::linear && cohesion_ && grows_with_overlap(cohesion_id());
  }

  /// What of the host's cohesion is part of the law [N/m]. data: with what the host's normal model leaves in it.
  double cohesive_stiffness(const Intersect &data) {
    return predicts_cohesion() ? predicted_cohesion(*cohesion_, data, data.kn) : 0.0;
  }

  template <class M> void act_touching(const M &method, Intersect &data, Forces &i_forces, Forces &j_forces) {
    const ContactGeometry geometry = data.is_wall ? at_wall(data) : between_spheres(data);
    const Touch touch{geometry, lmp_->update->dt};
    // nobody asks for the equivalent overlap, which takes a root of third degree for Hertz contacts
    if (!has_host_models() && !conducts_heat())
      return act_and_apply(method, touch, no_cohesion, data, i_forces, j_forces);
    const auto cohesion = [&](double mean_force, double equivalent_overlap) {
      show_equivalent(equivalent_overlap, mean_force, data);
      return cohesion_ ? cohere(data, i_forces, j_forces) : 0.0;
    };
    act_and_apply(method, touch, cohesion, data, i_forces, j_forces);
  }

  /// Leaves in data what the host's normal model would, for those that read the contact beside our force: overlap,
  /// stiffness and damping that belong to the mean force, not to an overlap that is enlarged at rest.
  void show_equivalent(double overlap, double mean_force, Intersect &data) {
    data.deltan = overlap;
    data.r = data.radsum - overlap; // at a wall radsum is the radius
    Forces unused_i;
    Forces unused_j;
    normal_.surfacesIntersect(data, unused_i, unused_j);
    data.Fn = mean_force;
  }

  /// Adds the host's cohesion, less what the law has of it. Returns by how much the force that Coulomb's limit counts
  /// exceeds the mean force [N]: the host leaves the pull out of it, unless the model says tangential_reduce.
  double cohere(Intersect &data, Forces &i_forces, Forces &j_forces) {
    const double mean_force = data.Fn;
    const double predicted = cohesive_stiffness(data) * data.deltan;
    data.Fn += predicted;
    cohesion_->surfacesIntersect(data, i_forces, j_forces);
    const Vec3 again = predicted * vec3(data.en);
    add(again, i_forces.delta_F);
    if (!data.is_wall) add(-again, j_forces.delta_F);
    return data.Fn - mean_force;
  }

  /// Whether the wall takes heat from a particle, through the overlap that it finds in data after its contact.
  bool conducts_heat() { return is_wall() && static_cast<LAMMPS_NS::FixWallGran *>(history_)->heattransfer_flag(); }

  /// Bodies that are apart: the contact may begin inside the step.
  template <class M> void act_approaching(const M &method, Intersect &data, Forces &i_forces, Forces &j_forces) {
    const std::optional<Touch> touch = touch_inside<M>(data);
    if (!touch) return end_contact(data);
    act_and_apply(method, *touch, no_cohesion, data, i_forces, j_forces);
    data.has_force_update = true;
  }

  template <class M> std::optional<Touch> touch_inside(const Intersect &data) const {
    if (!M::wants_onset || !onset_) return std::nullopt;
    const double dt = lmp_->update->dt;
    const Vec3 separation = vec3(data.delta);
    const Motion i{vec3(data.v_i), vec3(lmp_->atom->omega[data.i])};
    const Vec3 velocity_j = vec3(data.v_j);
    if (data.is_wall) {
      const double distance = norm(separation);
      const auto touch = touch_wall((1.0 / distance) * separation, distance, data.radi, i, velocity_j, dt);
      if (!touch || !data.mesh) return touch;
      const Vec3 centre = vec3(lmp_->atom->x[data.i]) + (dt - touch->span) * (i.velocity - velocity_j);
      return passes_by(*data.mesh, data.j, centre, data.radi) ? std::nullopt : touch;
    }
    Meeting meeting{separation, dot(separation, separation), dt};
    if (!move_to_touch(meeting, i.velocity - velocity_j, data.radsum)) return std::nullopt;
    const Motion j{velocity_j, vec3(lmp_->atom->omega[data.j])};
    return Touch{touching_spheres(meeting.separation, data.radsum, data.radi, data.radj, i, j), meeting.span};
  }

  template <class M, class Cohesion> void act_and_apply(const M &method, const Touch &touch, const Cohesion &cohesion,
                                                        Intersect &data, Forces &i_forces, Forces &j_forces) {
    if (data.contact_flags) *data.contact_flags |= contact_flags;
    StoredSpring spring{friction == Friction::spring_and_dashpot ? data.contact_history + spring_recorder_.offset()
                                                                 : nullptr,
                        spring_step(), data.computeflag && data.shearupdate,
                        spring_now_offset_ >= 0 ? data.contact_history + spring_now_offset_ : nullptr};
    double copies[6];
    if (spring.values && !data.computeflag) { // evaluated for output alone: leaves no trace
      std::copy_n(spring.values, 3, copies);
      if (spring.now) std::copy_n(spring.now, 3, copies + 3);
      spring.values = copies;
      spring.now = copies + 3;
    }
    if (!M::wants_crowd && spring.now) std::fill_n(spring.now, 3, 0.0); // of impulses that were given before
    const ContactPartners partners = partners_in<M>(data);
    const Contact contact{touch.geometry, touch.span, M::wants_crowd ? others(data) : 0.0, spring};
    if (data.is_wall && collected_) {
      collected_->push_back({data.i, partners, contact});
      return;
    }
    const auto &parameters = method.parameters(partners);
    const ContactAction action = act<friction>(method, parameters, contact, cohesion);
    add(action.mean.force, i_forces.delta_F);
    add(action.mean.couple(contact.geometry.lever_i), i_forces.delta_torque);
    if (data.is_wall) {
      if (data.computeflag) share_at_wall<M>(*step_, data.i, action);
      if (data.computeflag && step_->budget) tell_of_wall(method, parameters, contact, action, data);
      return;
    }
    if (data.computeflag) share<M>(*step_, data.i, action, 1.0);
    add(-action.mean.force, j_forces.delta_F);
    add(action.mean.couple(contact.geometry.lever_j), j_forces.delta_torque);
    if (data.computeflag && data.j < lmp_->atom->nlocal) share<M>(*step_, data.j, action, -1.0);
  }

  /// A contact with a wall has acted.
  template <class M, class Parameters>
  [[gnu::noinline]] void tell_of_wall(const M &method, const Parameters &parameters, const Contact &acted,
                                      const ContactAction &action, const Intersect &data) {
    const double dt = lmp_->update->dt;
    Contact contact = acted;
    contact.spring.dt = dt;
    tell_of_wall(energy_of<friction>(method, parameters, contact, contact.span == dt), action.mean.force, data);
  }
  /// Likewise by the host's models.
  [[gnu::noinline]] void tell_of_wall(const Intersect &data, const Vec3 &tangential) {
    const Vec3 normal = data.Fn * vec3(data.en);
    ContactEnergy energy{
        normal, law_of({data.itype, data.jtype, data.radi, data.radj, data.meff}).spring_energy(data.deltan), 0.0};
    if constexpr (friction == Friction::spring_and_dashpot) {
      const Vec3 spring = vec3(data.contact_history + spring_recorder_.offset());
      energy.tangential = 0.5 * data.kt * dot(spring, spring);
    }
    tell_of_wall(energy, normal + tangential, data);
  }
  void tell_of_wall(const ContactEnergy &energy, const Vec3 &force, const Intersect &data) {
    EnergyBudget &budget = *step_->budget;
    budget.add_normal_force(data.i, energy.normal_force);
    budget.add_elastic(1.0, energy.normal, energy.tangential);
    budget.add_moving_wall(energy.normal_force, force - energy.normal_force, vec3(data.v_j));
  }

  void end_contact(Close &data) {
    if (data.contact_flags) *data.contact_flags &= ~contact_flags;
    if (friction != Friction::spring_and_dashpot || !data.contact_history) return;
    std::fill_n(data.contact_history + spring_recorder_.offset(), 3, 0.0);
    if (spring_now_offset_ >= 0) std::fill_n(data.contact_history + spring_now_offset_, 3, 0.0);
  }

  /// The step by half of which the stored springs lead, or with impulses lag [s].
  double spring_step() const { return spring_step_ > 0.0 ? spring_step_ : lmp_->update->dt; }

  Particles particles() const {
    return particles_of(*lmp_->atom, static_cast<LAMMPS_NS::PairGran *>(lmp_->force->pair)->freeze_group_bit(), false);
  }

  double others(const Intersect &data) const {
    const Crowd &crowd = step_->crowd;
    const double of_i = particles().others(data.i, crowd);
    return data.is_wall ? of_i : of_i + particles().others(data.j, crowd);
  }

  template <class M> ContactPartners partners_in(const Intersect &data) const {
    const Crowd crowd = M::wants_crowd ? step_->crowd : Crowd{};
    if (data.is_wall) return {data.itype, data.jtype, data.radi, data.radj, crowd.share(data.i, data.meff)};
    return partners(particles().body(data.i, crowd), particles().body(data.j, crowd));
  }

  static ContactGeometry between_spheres(const Intersect &data) {
    return touching_spheres(vec3(data.delta), data.r, data.radi, data.radj, {vec3(data.v_i), vec3(data.omega_i)},
                            {vec3(data.v_j), vec3(data.omega_j)});
  }

  /// At a wall the host's geometry knows the surface.
  static ContactGeometry at_wall(const Intersect &data) {
    return {vec3(data.en), data.deltan, -data.vn, {data.vtr1, data.vtr2, data.vtr3}, data.cri, 0.0};
  }

  /// How near bodies are looked at, in radii: ten per cent is far more than they move in a step.
  static constexpr double foreseen_distance = 1.1;
  static constexpr int contact_flags =
      models::CONTACT_NORMAL_MODEL | (Tangential != models::TANGENTIAL_OFF ? models::CONTACT_TANGENTIAL_MODEL : 0);

  LAMMPS_NS::LAMMPS *lmp_;
  int64_t hash_;
  LIGGGHTS::IContactHistorySetup *history_;
  const ModelArguments *arguments_; ///< null for a style of the host
  SpringRecorder spring_recorder_;
  models::SurfaceModel<models::SURFACE_DEFAULT> surface_;
  models::NormalModel<Normal> normal_;
  std::shared_ptr<models::CohesionModelBase> cohesion_;
  models::TangentialModel<Tangential> tangential_;
  std::shared_ptr<models::RollingModelBase> rolling_;
  bool absolute_damping_ = false;
  bool limit_force_ = false; ///< the normal force never pulls
  bool tangential_damping_ = true;
  double **friction_ = nullptr;
  double **young_ = nullptr;         ///< of the two bodies, see HertzCoefficients [Pa]
  double **shear_modulus_ = nullptr; ///< likewise [Pa]
  double **damping_ratio_ = nullptr; ///< likewise, negative
  bool predicted_ = false;
  bool onset_ = false; ///< contacts begin inside a step
  bool warned_ = false;
  std::vector<WallContact> *collected_ = nullptr; ///< see collect_wall_contacts()
  StepState *step_ = nullptr;                     ///< of the pair style
  int spring_now_offset_ = -1;
  std::optional<LawOfHost<Law>> law_of_host_;
  std::optional<ContactSolver<Law, LawOfHost<Law>>> solver_; ///< with the settings of a run
  ParameterCache<OfInstant> of_instant_;
  double spring_step_ = 0.0; // 0 before the first evaluation: springs of a restart are read with the present step
};

} // namespace cfpm::liggghts
