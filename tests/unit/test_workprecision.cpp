// Errors, fronts, sampling and the journal of the work-precision study, on curves and numbers made
// by hand.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "core/base/error.hpp"
#include "core/studies/workprecision/analysis.hpp"
#include "core/studies/workprecision/pareto.hpp"
#include "drivers/studies/workprecision/journal.hpp"
#include "drivers/studies/workprecision/runs.hpp"
#include "scratch_folder.hpp"

using namespace breccia;

namespace {

CurveRow row(double strain, double stress, double confinement = 0) {
  CurveRow r;
  r.axial_strain = strain;
  r.axial_stress_Pa = stress + confinement;
  r.confining_stress_Pa = confinement;
  return r;
}

/// Straight up to the peak at strain 0.002 and down again.
Readings roof(double peak, double strain_at_peak = 0.002) {
  return {peak,
          peak / strain_at_peak,
          strain_at_peak,
          {{0, strain_at_peak, 1.5 * strain_at_peak}, {0, peak, 0.5 * peak}}};
}

Finished finished(Purpose purpose, const Readings& readings, double run_time = 1) {
  Finished one;
  one.trial.purpose = purpose;
  one.outcome.readings = readings;
  one.outcome.peak_reached = true;
  one.outcome.run_time = run_time;
  return one;
}

std::size_t at(Measure m) { return static_cast<std::size_t>(m); }

std::string what_of(const auto& body) {
  try {
    body();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("work precision: a curve keeps rows of rising strain, less the confinement, from the origin") {
  const std::vector<CurveRow> rows{row(-1e-5, -1, 5), row(0.001, 10, 5), row(0.0009, 99, 5),
                                   row(0.001, 98, 5), row(0.002, 20, 5)};
  const StressStrain curve = rising_curve(rows);
  CHECK(curve.strain == std::vector<double>{0, 0.001, 0.002});
  CHECK(curve.stress == std::vector<double>{0, 10, 20});
}

TEST_CASE("work precision: the stress between points is straight, beyond the last it is held") {
  const StressStrain curve{{0, 1, 3}, {0, 4, 2}};
  CHECK(stress_at(curve, 0.25) == doctest::Approx(1));
  CHECK(stress_at(curve, 1) == doctest::Approx(4));
  CHECK(stress_at(curve, 2) == doctest::Approx(3));
  CHECK(stress_at(curve, 7) == doctest::Approx(2));
  const StressStrain late{{1, 2}, {4, 6}};  // does not begin at the origin
  CHECK(stress_at(late, 0.5) == doctest::Approx(2));
  CHECK(stress_at({}, 1) == 0);
}

TEST_CASE("work precision: a thinned curve runs from 0 to the last strain and keeps straight pieces") {
  StressStrain curve;
  for (int k = 0; k <= 1000; ++k) curve.strain.push_back(1e-5 * k), curve.stress.push_back(3e5 * k);
  const StressStrain thin = thinned(curve, 11);
  REQUIRE(thin.strain.size() == 11);
  CHECK(thin.strain.back() == doctest::Approx(0.01));
  for (std::size_t k = 0; k < 11; ++k) CHECK(thin.stress[k] == doctest::Approx(3e7 * double(k)));
  CHECK(thinned(thin, 50).strain == thin.strain);
}

TEST_CASE("work precision: errors against closed forms") {
  const Readings reference = roof(40e6);
  const Errors same = errors_of(reference, reference);
  for (const double e : same) CHECK(e == doctest::Approx(0));
  // the same strain, 5 % more stress: the difference rises evenly to 5 % of the peak, its rms is
  // 0.05/sqrt(3)
  const Errors higher = errors_of(roof(42e6), reference);
  CHECK(higher[at(Measure::peak)] == doctest::Approx(0.05));
  CHECK(higher[at(Measure::young)] == doctest::Approx(0.05));
  CHECK(higher[at(Measure::strain_at_peak)] == doctest::Approx(0));
  CHECK(higher[at(Measure::curve)] == doctest::Approx(0.05 / std::sqrt(3.0)).epsilon(1e-5));
  // half the peak at half the strain, then down to a quarter at 0.75, where the curve ends and is
  // held
  const Errors lower = errors_of(roof(20e6, 0.001), reference);
  CHECK(lower[at(Measure::peak)] == doctest::Approx(-0.5));
  CHECK(lower[at(Measure::young)] == doctest::Approx(0));
  CHECK(lower[at(Measure::strain_at_peak)] == doctest::Approx(-0.5));
  // x = strain over 0.002: the difference is 0 to 0.5, 2 (x - 0.5) to 0.75, then x - 0.25
  const double square = 4.0 * std::pow(0.25, 3) / 3.0 + (std::pow(0.75, 3) - std::pow(0.5, 3)) / 3.0;
  CHECK(lower[at(Measure::curve)] == doctest::Approx(std::sqrt(square)).epsilon(1e-4));
  CHECK(std::isnan(errors_of(Readings{}, reference)[at(Measure::curve)]));
  CHECK(std::isnan(errors_of(Readings{}, reference)[at(Measure::peak)]));
}

TEST_CASE("work precision: mean and spread of runs that differ by noise") {
  const std::vector<Readings> runs{roof(39e6), roof(40e6), roof(41e6)};
  const Readings mean = mean_of(runs);
  CHECK(mean.peak == doctest::Approx(40e6));
  CHECK(stress_at(mean.curve, 0.001) == doctest::Approx(20e6));
  const Errors spread = spread_about(mean, runs);
  CHECK(spread[at(Measure::peak)] == doctest::Approx(0.025));  // sqrt((1 + 0 + 1)/2)/40
  CHECK(spread[at(Measure::strain_at_peak)] == doctest::Approx(0));
  CHECK(spread[at(Measure::curve)] == doctest::Approx(0.025 / std::sqrt(3.0)).epsilon(1e-4));
}

TEST_CASE("work precision: the front leaves out what another beats, and what has no number") {
  const double nan = Readings::none;
  const std::vector<Choice> choices{{4, 1},   {1, 5},     {2, 3}, {3, 3}, {2, 4},
                                    {nan, 0}, {0.5, nan}, {5, 1}, {1, 5}};
  CHECK(pareto_front(choices) == std::vector<std::size_t>{1, 2, 0});
  CHECK(pareto_front({}).empty());
  CHECK(cheapest_within(choices, 5) == 1);
  CHECK(cheapest_within(choices, 3.5) == 2);
  CHECK(cheapest_within(choices, 1) == 0);
  CHECK_FALSE(cheapest_within(choices, 0.5).has_value());
}

TEST_CASE("work precision: spread over the number of spheres, by a law put in") {
  const auto group = [](double n, double spread) {
    return SampleGroup{n, {1 - spread, 1, 1 + spread}};  // standard deviation: spread
  };
  const auto fit = [&](double exponent) {
    const std::vector<SampleGroup> groups{group(100, 2 * std::pow(100, exponent)),
                                          {300, {0.7}},
                                          group(1000, 2 * std::pow(1000, exponent)),
                                          group(13000, 2 * std::pow(13000, exponent))};
    return *fit_spread(groups);
  };
  CHECK(fit(-0.5).exponent == doctest::Approx(-0.5));
  CHECK(fit(-0.5).factor == doctest::Approx(2));
  CHECK(fit(-0.5).factor_half == doctest::Approx(2));
  CHECK(fit(-0.8).exponent == doctest::Approx(-0.8));
  CHECK(fit(-0.8).factor == doctest::Approx(2));
  CHECK_FALSE(fit_spread(std::vector<SampleGroup>{group(100, 0.1), {200, {0.7}}}).has_value());
  CHECK_FALSE(fit_spread({}).has_value());
}

TEST_CASE("work precision: the plan has every run once, the reference first and as the grid says") {
  for (const GridSize size : {GridSize::small, GridSize::full}) {
    PlanOptions options{grid_of(size), Recipe{}, {all_families().begin(), all_families().end()}, 2, true};
    const std::vector<Trial> trials = plan_trials(options);
    std::set<std::string> keys;
    int references = 0;
    for (const Trial& t : trials) {
      CHECK(keys.insert(key_of(t)).second);
      if (t.purpose == Purpose::reference) {
        CHECK(t.recipe.safety == options.grid.reference_safety);
        CHECK(t.recipe.platen_speed == options.grid.reference_speed);
        CHECK(t.shake == references++);
      }
      CHECK((t.purpose == Purpose::recipe) <= t.timed);
      CHECK(t.threads == (t.timed ? 2 : 1));
    }
    CHECK(references == options.grid.shakes);
    CHECK(trials[0].recipe.platen_speed == 0.5 * options.grid.reference_speed);
    CHECK(trials[1].recipe.safety == 0.5 * options.grid.reference_safety);
    options.single = false;
    for (const Trial& t : plan_trials(options)) CHECK(t.recipe.precision == Precision::full);
    options.families = {Family::speed};
    for (const Trial& t : plan_trials(options))
      CHECK((t.purpose != Purpose::recipe || t.family == Family::base || t.recipe.safety == 0.8));
  }
}

TEST_CASE(
    "work precision: a recipe is told by its line, and its reference has neither scheme nor scaled masses") {
  Recipe base;
  base.scheme = DampingScheme::summed;
  base.mass_factor = 2;
  base.damping = {0.2, 0.1};
  CHECK(describe(base) == "step 0.8, 0.1 m/s, summed, mass 2, damping 0.2/0.1, double, private");
  CHECK(case_lines(base).find("mass_scaling = true\nmass_factor = 2\n") != std::string::npos);
  const Recipe reference = reference_recipe(grid_of(GridSize::full), base);
  CHECK(describe(reference) == "step 0.2, 0.02 m/s, explicit, mass 1, damping 0.2/0.1, double, private");
  CHECK(case_lines(reference).find("mass_scaling = false\n") != std::string::npos);
  CHECK(steps_over(reference, base) == doctest::Approx(20));
}

TEST_CASE("work precision: floor, error bar, fronts and the cheapest recipe of a study") {
  std::vector<Finished> runs{finished(Purpose::half_speed, roof(39.9e6)),
                             finished(Purpose::half_step, roof(40.16e6)),
                             finished(Purpose::reference, roof(40.2e6))};
  CHECK_FALSE(analyse(runs).has_value());  // one run has no spread
  runs.push_back(finished(Purpose::reference, roof(39.8e6)));
  runs.push_back(finished(Purpose::recipe, roof(40.04e6), 8));  // 4: below the floor
  runs.push_back(finished(Purpose::recipe, roof(40.01e6), 9));  // 5: better by luck alone
  runs.push_back(finished(Purpose::recipe, roof(41.4e6), 2));   // 6: 3.5 %
  runs.push_back(finished(Purpose::recipe, roof(41.92e6), 1));  // 7: 4.8 %, with the floor beyond 5 %
  runs.push_back(finished(Purpose::recipe, roof(48e6), 3));     // 8: 20 %
  runs.push_back(finished(Purpose::recipe, {}, 0.1));           // 9: broke
  runs.back().outcome.failure = "not a number";
  const Analysis a = *analyse(runs);
  const std::size_t peak = at(Measure::peak);
  const double floor = std::sqrt(2.0) * 0.2 / 40;
  CHECK(a.reference.mean.peak == doctest::Approx(40e6));
  CHECK(a.reference.floor[peak] == doctest::Approx(floor));
  CHECK(a.reference.half_step[peak] == doctest::Approx(0.004));
  CHECK(a.reference.half_speed[peak] == doctest::Approx(-0.0025));
  CHECK(a.reference.bar[peak] == doctest::Approx(floor / std::sqrt(2.0)));
  CHECK(a.reference.resolution[peak] == doctest::Approx(floor));
  CHECK(a.fronts[peak].runs == std::vector<std::size_t>{7, 6, 4});
  CHECK(std::isnan(a.errors[9][peak]));
  const auto cheapest = [&](double tolerance) {
    for (const Cheapest& c : a.cheapest)
      if (c.measure == Measure::peak && c.tolerance == tolerance) return c.run;
    return std::optional<std::size_t>(1000);
  };
  CHECK(cheapest(0.05) == 6);
  CHECK(cheapest(0.02) == 4);
  CHECK(cheapest(0.01) == 4);
  CHECK(a.warnings.empty());
  runs[1].outcome.readings = roof(42e6);
  CHECK(analyse(runs)->reference.resolution[peak] == doctest::Approx(0.05));
  REQUIRE(analyse(runs)->warnings.size() == 1);
  CHECK(analyse(runs)->warnings.front().find("half the step changes its peak by +5.00 %") !=
        std::string::npos);
  runs[2].outcome.failure = "not a number";
  CHECK(what_of([&] { analyse(runs); }).find("the reference") != std::string::npos);
}

TEST_CASE(
    "work precision: a perturbation is small, its own for each number, and the reference moves with it") {
  Assembly a;
  a.particles.resize(3, Features{});
  a.particles.position.fill(std::vector<Vec3>{{0.1, -0.2, 0.3}, {0, 0, 0}, {1, 1, 1}});
  const Assembly one = shaken(a, 1, 1e-12), two = shaken(a, 2, 1e-12);
  CHECK(one.particles.position[0].x != a.particles.position[0].x);
  CHECK(one.particles.position[0].x != two.particles.position[0].x);
  CHECK(one.particles.position[0].x == shaken(a, 1, 1e-12).particles.position[0].x);
  CHECK(shaken(a, 0, 1e-12).particles.position[0].x == a.particles.position[0].x);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 moved = one.particles.position[k] - a.particles.position[k];
    CHECK(std::abs(moved.z) <= 1e-12 * std::abs(a.particles.position[k].z) * (1 + 1e-3));
    CHECK(norm(one.particles.position[k] - one.particles.reference_position[k]) == 0);
  }
}

TEST_CASE(
    "work precision: the journal gives back what it was given, bit for bit, and passes over a torn line") {
  const ScratchFolder scratch;
  const auto file = scratch.path / "runs.jsonl";
  const JournalHead head{{"case", "0123"}, {"cpu", "some \"processor\""}};
  Outcome o;
  o.readings = {1.0 / 3.0 * 1e8, Readings::none, 0.1 + 0.2, {{0, 0.1}, {0, 1e7 / 3}}};
  o.peak_reached = true;
  o.run_time = 0.123;
  o.steps = 12345;
  o.time_step = 1e-7 / 3;
  o.spheres = 300;
  Outcome broken;
  broken.failure = "at 1 s particle 3\nis lost";
  {
    Journal journal(file, head, false);
    journal.add("a", o);
    journal.add("b", broken);
  }
  std::ofstream(file, std::ios::app) << R"({"key":"c","fail)";
  {
    Journal journal(file, head, true);
    REQUIRE(journal.find("a"));
    const Outcome& back = *journal.find("a");
    CHECK(back.readings.peak == o.readings.peak);
    CHECK(std::isnan(back.readings.young));
    CHECK(back.readings.strain_at_peak == o.readings.strain_at_peak);
    CHECK(back.readings.curve.stress == o.readings.curve.stress);
    CHECK(back.time_step == o.time_step);
    CHECK(back.steps == o.steps);
    CHECK(back.peak_reached);
    CHECK(journal.find("b")->failure == broken.failure);
    CHECK_FALSE(journal.find("c"));
    journal.add("c", o);
  }
  CHECK(Journal(file, head, true).find("c"));
  JournalHead other = head;
  other[0].second = "4567";
  CHECK(what_of([&] { Journal(file, other, true); }).find("another case (0123, now 4567)") !=
        std::string::npos);
  CHECK(Journal(file, head, true).find("a"));  // the refusal left it as it was
  CHECK_FALSE(Journal(file, other, false).find("a"));
  std::ofstream(file, std::ios::app) << "nonsense\n";
  CHECK(what_of([&] { Journal(file, other, true); }).find("runs.jsonl:2") != std::string::npos);
}

TEST_CASE("work precision: tasks run side by side, each once, and the first trouble is thrown") {
  std::vector<int> counts(20, 0);
  run_side_by_side(
      20, 3, [] { return false; }, [&](std::size_t k) { ++counts[k]; });
  CHECK(counts == std::vector<int>(20, 1));
  int done = 0;
  run_side_by_side(
      20, 1, [&] { return done == 4; }, [&](std::size_t) { ++done; });
  CHECK(done == 4);
  CHECK(what_of([] {
          run_side_by_side(
              9, 2, [] { return false; },
              [](std::size_t k) {
                if (k == 3) fail<BadInput>("three");
              });
        }) == "three");
}
