// SPDX-License-Identifier: GPL-2.0-or-later
// What a host says of the time step, and its numbers.
#include "core/deck/time_step_report.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace cfpm::testing {
namespace {

ContactTimes times(double shortest, double longest) {
  ContactTimes t;
  t.add(longest);
  t.add(shortest);
  return t;
}

const Method &named(const char *name) { return *find_method(name); }

TEST(TimeStepReport, OfLinearContacts) {
  TimeStepReport report(named("exact"), LawKind::linear, false, 1e-5, 1.0);
  report.add("pairs", times(2e-4, 3e-4), named("exact"), LawKind::linear, false);
  EXPECT_EQ(report.text(), "gran/cfpm: predict exact, dt = 1e-05; one contact is stable for nt > 1\n"
                           "  pairs              tc = 0.0002 to 0.0003, nt = tc/dt = 20 to 30\n"
                           "  dense beds at rest come out right up to dt = 3.333e-05, nt = 6\n"
                           "  flows are right up to dt = 3.333e-05, nt = 6\n");
  ASSERT_EQ(report.warnings().size(), 1u);
  EXPECT_EQ(report.warnings()[0], "agitated grains are right up to dt = 6.667e-06, nt = 30; found dt = 1e-05, nt = 20");
  EXPECT_TRUE(report.has_particles());
  EXPECT_FALSE(report.too_large());
}

TEST(TimeStepReport, SaysWhereLimitedForcesRaiseTheRestitution) {
  TimeStepReport report(named("exact"), LawKind::linear, false, 1e-5, 1.0);
  ContactTimes met;
  met.add(3e-4, {0.25314, 0.1});
  met.add(4e-4); // one that is not known
  report.add("types 1-1:", met, named("exact"), LawKind::linear, false);
  EXPECT_NE(report.text().find("nt = tc/dt = 30 to 40; restitution 0.253, as the force never pulls (else 0.1)\n"),
            std::string::npos)
      << report.text();
  TimeStepReport silent(named("exact"), LawKind::linear, false, 1e-5, 1.0);
  met.add(3e-4, {0.1, 0.1});
  silent.add("types 1-1:", met, named("exact"), LawKind::linear, false);
  EXPECT_EQ(silent.text().find("restitution"), std::string::npos);
}

TEST(TimeStepReport, WarnsOfEnergyWhereImpactsMeet) {
  const auto warned = [](const char *predictor, double nt, double restitution) {
    TimeStepReport report(named(predictor), LawKind::linear, false, 1.0, 1.0);
    ContactTimes met;
    met.add(nt, {restitution, restitution});
    met.add(2.0 * nt, {0.3, 0.3}); // the liveliest counts
    report.add("pairs", met, named(predictor), LawKind::linear, false);
    const std::vector<std::string> texts = report.warnings();
    return texts.empty() || texts.back().rfind("a blow", 0) != 0 ? "" : texts.back();
  };
  EXPECT_EQ(warned("impulse", 1.0, 0.5),
            "a blow on spheres that touch may gain energy below nt = 4 with a restitution of 0.5; found nt = 1");
  EXPECT_EQ(warned("impulse", 8.0, 0.98),
            "a blow on spheres that touch may gain energy below nt = 10 with a restitution of 0.98; found nt = 8");
  EXPECT_EQ(warned("impulse", 30.0, 1.0),
            "a blow on spheres that touch may gain energy at any nt with a restitution of 1; found nt = 30");
  EXPECT_EQ(warned("impulse", 4.0, 0.5), "");
  EXPECT_EQ(warned("impulse", 10.0, 0.98), "");
  EXPECT_EQ(warned("exact", 1.5, 1.0), "");
}

TEST(TimeStepReport, WarnsWhereOverlapsAtRestChange) {
  const auto warned = [](const char *before, double dt_before, const char *now, double dt) {
    TimeStepReport report(named(now), LawKind::linear, named(now).wants_crowd, dt, 1.0);
    report.add("pairs", times(6e-4, 8e-4), named(now), LawKind::linear, named(now).wants_crowd);
    report.set_before({&named(before), dt_before});
    const std::vector<std::string> texts = report.warnings();
    return !texts.empty() && texts.back().rfind("a bed at rest will move", 0) == 0 ? texts.back() : "";
  };
  EXPECT_EQ(warned("impulse", 2e-4, "exact", 2e-5),
            "a bed at rest will move, as below nt = 6 with predict impulse its overlaps are those of the step: the run "
            "before had predict impulse, nt = 3, this one has predict exact, nt = 30");
  EXPECT_NE(warned("verlet", 2e-5, "impulse", 1.1e-4), "");
  EXPECT_NE(warned("impulse", 2e-4, "impulse", 3e-4), "");
  EXPECT_EQ(warned("impulse", 2e-4, "impulse", 2e-4), "");
  EXPECT_EQ(warned("impulse", 2e-4, "impulse", 2e-5), ""); // goes over by and by
  EXPECT_EQ(warned("impulse", 2e-5, "impulse", 1e-4), ""); // nt = 30 and 6
  EXPECT_EQ(warned("exact", 2e-4, "exact", 2e-5), "");
}

TEST(TimeStepReport, WithoutParticles) {
  const TimeStepReport report(named("impulse"), LawKind::linear, true, 1e-5, 1.0);
  EXPECT_FALSE(report.has_particles());
  EXPECT_EQ(report.text(),
            "gran/cfpm: predict impulse, dt = 1e-05; no stability limit on one contact\n  no particles yet\n");
}

/// The row of a predictor or limit other than the pair style's says so; the advice is the shortest step of all rows.
TEST(TimeStepReport, NamesAnotherPredictorOfAWall) {
  TimeStepReport report(named("impulse"), LawKind::linear, true, 1e-5, 1.0);
  report.add("pairs", times(3e-4, 3e-4), named("impulse"), LawKind::linear, true);
  report.add("wall", times(4.8e-4, 4.8e-4), named("rk2"), LawKind::linear, false);
  EXPECT_EQ(report.text(), "gran/cfpm: predict impulse, dt = 1e-05; no stability limit on one contact\n"
                           "  pairs              tc = 0.0003 to 0.0003, nt = tc/dt = 30 to 30\n"
                           "  wall               tc = 0.00048 to 0.00048, nt = tc/dt = 48 to 48"
                           "; predict rk2, one contact is stable for nt > 1.571\n"
                           "  dense beds at rest come out right up to dt = 0.0003, nt = 1\n"
                           "  flows are right up to dt = 0.00015, nt = 2\n"
                           "  agitated grains are right up to dt = 1.6e-05, nt = 30\n");
  EXPECT_TRUE(report.warnings().empty());
}

TEST(TimeStepReport, SaysHowManyContactsAreComputedAtATime) {
  const InstructionSet wide{"wide", 8};
  const InstructionSet none{"none", 1};
  const auto said = [](const char *predictor, LawKind law, bool begins_inside, const InstructionSet &set) {
    TimeStepReport report(named(predictor), law, begins_inside, 1e-5, 1.0);
    report.set_instructions(set);
    return report.text().find("\n  contacts of pairs are computed 8 at a time (wide)\n") != std::string::npos;
  };
  EXPECT_TRUE(said("exact", LawKind::linear, false, wide));
  EXPECT_TRUE(said("rk2", LawKind::linear, false, wide));
  EXPECT_FALSE(said("exact", LawKind::linear, false, none));
  EXPECT_FALSE(said("exact", LawKind::linear, true, wide));
  EXPECT_TRUE(said("impulse", LawKind::linear, false, wide));
  EXPECT_TRUE(said("impulse", LawKind::self_similar, true, wide));
  EXPECT_TRUE(said("impulse", LawKind::viscoelastic, true, wide));
  EXPECT_TRUE(said("verlet", LawKind::linear, false, wide));
  EXPECT_TRUE(said("rk2", LawKind::self_similar, false, wide));
  EXPECT_TRUE(said("rk4", LawKind::any, false, wide));
  EXPECT_TRUE(said("exact", LawKind::self_similar, false, wide)); // known from its one trajectory
  EXPECT_FALSE(said("exact", LawKind::any, false, wide));         // not known
}

TEST(TimeStepReport, SaysWhatIsLeftToTheHost) {
  const auto text = [](const char *method) {
    TimeStepReport report(named(method), LawKind::linear, false, 1e-5, 1.0);
    const InstructionSet wide{"wide", 8};
    report.set_instructions(wide);
    report.set_left_to_host("it rains");
    return report.text();
  };
  const std::string left = "\n  contacts of pairs are left to the host's own style, as it rains\n";
  EXPECT_NE(text("verlet").find(left), std::string::npos);
  EXPECT_EQ(text("verlet").find("at a time"), std::string::npos);
  EXPECT_EQ(text("exact").find(left), std::string::npos); // predicted, whatever else there is
}

TEST(TimeStepReport, OfHertzContacts) {
  TimeStepReport report(named("exact"), LawKind::self_similar, false, 1e-5, 0.5);
  report.add("pairs", times(6e-4, 6e-4), named("exact"), LawKind::self_similar, false);
  report.set_rayleigh_time(2.5e-5);
  EXPECT_EQ(report.text(), "gran/cfpm: predict exact, dt = 1e-05; one contact is stable for nt > 1.283"
                           "; Hertz: tc of an impact at speed 0.5, tc ~ speed^(-1/5)\n"
                           "  pairs              tc = 0.0006 to 0.0006, nt = tc/dt = 60 to 60\n"
                           "  dense beds at rest come out right up to dt = 0.0001, nt = 6, as measured with linear "
                           "contacts\n"
                           "  flows are right up to dt = 0.0001, nt = 6, as measured with linear contacts\n"
                           "  agitated grains are right up to dt = 2e-05, nt = 30, as measured with linear contacts\n"
                           "  Rayleigh time of the smallest particle 2.5e-05\n");
}

/// Each use has its own step; the shortest contact limits it, and at the limit itself a result is right.
TEST(TimeStepReport, WarnsOfEveryUseThatTheStepIsTooLargeFor) {
  const auto warnings = [](const char *predictor, double nt) {
    TimeStepReport report(named(predictor), LawKind::linear, false, 1.0, 1.0);
    report.add("pairs", times(nt, 1000.0), named(predictor), LawKind::linear, false);
    report.add("wall", times(1000.0, 1000.0), named(predictor), LawKind::linear, false);
    return report.warnings();
  };
  EXPECT_EQ(warnings("exact", 30.0).size(), 0u);
  EXPECT_EQ(warnings("exact", 29.0).size(), 1u);
  EXPECT_EQ(warnings("exact", 6.0).size(), 1u);
  EXPECT_EQ(warnings("exact", 5.9).size(), 3u);
  EXPECT_EQ(warnings("impulse", 4.0).size(), 0u);
  EXPECT_EQ(warnings("impulse", 2.0).size(), 2u) << "with that of energy";
  EXPECT_EQ(warnings("impulse", 1.0).size(), 3u);
  EXPECT_EQ(warnings("verlet", 5.9).size(), 3u);
  EXPECT_EQ(warnings("trapezoid", 2.0).size(), 1u); // of the others nothing has been measured
}

/// Contacts of the paper's predictors that begin inside the step need fewer steps; the report's first line names them.
TEST(TimeStepReport, KnowsWhatOnsetSpares) {
  const auto report_of = [](const char *predictor, bool begins_inside) {
    TimeStepReport report(named(predictor), LawKind::linear, begins_inside, 1.0, 1.0);
    report.add("pairs", times(6.0, 6.0), named(predictor), LawKind::linear, begins_inside);
    return report;
  };
  EXPECT_EQ(report_of("exact", false).warnings().size(), 1u); // of agitated grains
  EXPECT_EQ(report_of("exact", true).warnings().size(), 0u);
  EXPECT_EQ(report_of("exact", false).text().find("gran/cfpm: predict exact, "), 0u);
  EXPECT_EQ(report_of("exact", true).text().find("gran/cfpm: predict exact onset on, "), 0u);
  EXPECT_EQ(report_of("impulse", true).text().find("gran/cfpm: predict impulse, "), 0u);
  EXPECT_EQ(report_of("impulse", false).text().find("gran/cfpm: predict impulse onset off, "), 0u);
}

/// A dashpot in friction that Coulomb's limit holds costs the host's own step more steps, and no predictor.
TEST(TimeStepReport, KnowsWhatADashpotInFrictionAsksFor) {
  for (const auto &[predictor, count] : {std::pair{"verlet", 2u}, std::pair{"impulse", 0u}}) {
    TimeStepReport report(named(predictor), LawKind::linear, false, 1.0, 1.0);
    report.add("pairs", times(9.0, 9.0), named(predictor), LawKind::linear, false, true);
    EXPECT_EQ(report.warnings().size(), count) << predictor;
  }
}

TEST(TimeStepReport, SaysWhatAutoHasChosenAndWhy) {
  AutoMethod choice(LawKind::linear, false);
  choice.choose(3e-4, 1e-5);
  TimeStepReport report(choice.method(), LawKind::linear, false, 1e-5, 1.0);
  report.set_auto(choice);
  report.add("pairs", times(3e-4, 3e-4), choice.method(), LawKind::linear, false);
  EXPECT_EQ(report.text(), "gran/cfpm: predict auto (verlet), dt = 1e-05; one contact is stable for nt > 1.571\n"
                           "  pairs              tc = 0.0003 to 0.0003, nt = tc/dt = 30 to 30\n"
                           "  auto: verlet, the host's own step, is right for any use and cheapest up to dt = 5e-05, "
                           "nt = 6; impulse at fewer steps\n"
                           "  dense beds at rest come out right up to dt = 5e-05, nt = 6\n"
                           "  flows are right up to dt = 5e-05, nt = 6\n"
                           "  agitated grains are right up to dt = 5e-05, nt = 6\n");
}

/// At the limit itself and beyond, by the shortest contact of any row; a Hertz contact is stiffest inside.
TEST(TimeStepReport, SaysWhenTheStepIsTooLarge) {
  const auto too_large = [](const char *predictor, LawKind law, double tc) {
    TimeStepReport report(named("exact"), LawKind::linear, false, 1.0, 1.0);
    report.add("pairs", times(tc, 100.0), named(predictor), law, false);
    report.add("wall", times(100.0, 100.0), named("exact"), LawKind::linear, false);
    return report.too_large();
  };
  EXPECT_TRUE(too_large("exact", LawKind::linear, 1.0));
  EXPECT_FALSE(too_large("exact", LawKind::linear, 1.001));
  EXPECT_TRUE(too_large("rk4", LawKind::linear, 1.57));
  EXPECT_FALSE(too_large("rk4", LawKind::linear, 1.58));
  EXPECT_TRUE(too_large("exact", LawKind::self_similar, 1.28));
  EXPECT_FALSE(too_large("exact", LawKind::self_similar, 1.29));
  EXPECT_FALSE(too_large("impulse", LawKind::linear, 1e-6));
}

/// pi r sqrt(rho/G)/(0.1631 nu + 0.8766) with rho = 1000, G = 1e9 and nu = 0.25: 1e-3 sqrt of density over modulus.
TEST(RayleighTime, OfASphere) {
  const double radius = 0.01;
  const ParticleSize size{radius, 1000.0 * 4.0 / 3.0 * pi * radius * radius * radius};
  EXPECT_NEAR(rayleigh_time(size, 2.5e9, 0.25) / (pi * radius * 1e-3 / 0.917375), 1.0, 1e-14);
}

TEST(SizeRange, IsPresentWithAParticle) {
  EXPECT_FALSE((SizeRange{{0.0, 0.0}, {0.0, 0.0}}.present()));
  EXPECT_TRUE((SizeRange{{1.0, 1.0}, {2.0, 2.0}}.present()));
}

} // namespace
} // namespace cfpm::testing
