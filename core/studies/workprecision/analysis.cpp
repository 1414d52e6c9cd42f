#include "core/studies/workprecision/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/error.hpp"
#include "core/studies/workprecision/pareto.hpp"

namespace breccia {
namespace {

constexpr double tolerances[] = {0.05, 0.02, 0.01};
constexpr double none = Readings::none;

Errors no_errors() {
  Errors e;
  e.fill(none);
  return e;
}

std::string percent(double fraction) { return fmt::format("{:+.2f} %", 100.0 * fraction); }

Errors errors_of_purpose(const std::vector<Finished>& finished, Purpose purpose, const Readings& reference) {
  for (const Finished& one : finished)
    if (one.trial.purpose == purpose && one.outcome.failure.empty())
      return errors_of(one.outcome.readings, reference);
  return no_errors();
}

std::optional<Reference> reference_of(const std::vector<Finished>& finished) {
  Reference r;
  r.peak_reached = true;
  std::vector<Readings> runs;
  for (const Finished& one : finished) {
    if (one.trial.purpose != Purpose::reference) continue;
    const Readings& x = one.outcome.readings;
    if (!one.outcome.failure.empty())
      fail<SimulationBroke>("the reference ({}) broke: {}", describe(one.trial.recipe), one.outcome.failure);
    if (!(x.peak > 0 && x.strain_at_peak > 0 && std::isfinite(x.young)))
      fail<SimulationBroke>(
          "the reference ({}) has no peak or no modulus to compare with; let it run on with a larger "
          "test.stop_strain",
          describe(one.trial.recipe));
    r.recipe = one.trial.recipe;
    r.peak_reached = r.peak_reached && one.outcome.peak_reached;
    runs.push_back(x);
  }
  if (runs.size() < 2) return std::nullopt;
  r.runs = runs.size();
  r.mean = mean_of(runs);
  r.floor = spread_about(r.mean, runs);
  r.half_step = errors_of_purpose(finished, Purpose::half_step, r.mean);
  r.half_speed = errors_of_purpose(finished, Purpose::half_speed, r.mean);
  for (std::size_t m = 0; m < r.bar.size(); ++m)  // fmax passes over what is not yet there
    r.bar[m] = std::fmax(r.floor[m] / std::sqrt(static_cast<double>(r.runs)),
                         std::fmax(std::abs(r.half_step[m]), std::abs(r.half_speed[m])));
  for (std::size_t m = 0; m < r.bar.size(); ++m) r.resolution[m] = std::max(r.floor[m], r.bar[m]);
  return r;
}

/// A run that a user could choose: timed alone, on the case's specimen.
bool is_choice(const Finished& one) {
  return one.trial.purpose == Purpose::recipe && one.outcome.failure.empty();
}

/// Error of a run that counts for a choice. @param of  error, resolution -> what is compared
template <class Of>
std::vector<Choice> choices_by(const std::vector<Finished>& finished, const Analysis& a,
                               std::optional<Measure> measure, const Of& of) {
  std::vector<Choice> choices;
  for (std::size_t k = 0; k < finished.size(); ++k) {
    double worst = is_choice(finished[k]) ? 0.0 : none;
    for (const Measure m : all_measures) {
      if (measure && m != *measure) continue;
      const auto at = static_cast<std::size_t>(m);
      const double error = of(std::abs(a.errors[k][at]), a.reference.resolution[at]);
      worst = std::isnan(error) || std::isnan(worst) ? none : std::max(worst, error);
    }
    choices.push_back({finished[k].outcome.run_time, worst});
  }
  return choices;
}

void find_fronts(const std::vector<Finished>& finished, Analysis& a) {
  for (const Measure m : all_measures) {
    const std::vector<Choice> choices = choices_by(
        finished, a, m, [](double error, double limit) { return std::max(error, limit); });  // NaN stays
    a.fronts.push_back({m, pareto_front(choices)});
  }
}

void find_cheapest(const std::vector<Finished>& finished, Analysis& a) {
  std::vector<std::optional<Measure>> asked{std::nullopt};
  asked.insert(asked.begin(), all_measures.begin(), all_measures.end());
  for (const auto& measure : asked) {
    const std::vector<Choice> choices =
        choices_by(finished, a, measure, [](double error, double limit) { return error + limit; });
    for (const double tolerance : tolerances)
      a.cheapest.push_back({tolerance, measure, cheapest_within(choices, tolerance)});
  }
}

void group_sizes(const std::vector<Finished>& finished, Analysis& a) {
  std::map<std::size_t, std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < finished.size(); ++k)
    if (finished[k].trial.purpose == Purpose::size && finished[k].outcome.failure.empty() &&
        !finished[k].trial.timed)
      groups[finished[k].trial.spheres].push_back(k);
  std::array<std::vector<SampleGroup>, all_measures.size()> samples;
  for (const auto& [spheres, runs] : groups) {
    SizeGroup group;
    group.spheres = spheres;
    group.seeds = runs.size();
    for (const std::size_t k : runs)
      group.run_time += finished[k].outcome.run_time / static_cast<double>(runs.size());
    for (std::size_t m = 0; m < all_measures.size(); ++m) {
      std::vector<double> values;
      for (const std::size_t k : runs) values.push_back(a.errors[k][m]);
      group.mean[m] = mean_value(values);
      group.spread[m] = values.size() > 1 ? standard_deviation(values) : none;
      samples[m].push_back({static_cast<double>(spheres), values});
    }
    a.sizes.push_back(group);
  }
  for (std::size_t m = 0; m < all_measures.size(); ++m) a.fits[m] = fit_spread(samples[m]);
}

/// A difference that noise alone would not make: twice the standard deviation of one run less a
/// mean.
void check_convergence(Analysis& a) {
  const Reference& r = a.reference;
  const auto peak = static_cast<std::size_t>(Measure::peak);
  const double noise = 2.0 * r.floor[peak] * std::sqrt(1.0 + 1.0 / static_cast<double>(r.runs));
  const auto check = [&](const Errors& half, const char* what, const char* cure) {
    if (std::abs(half[peak]) > std::max(noise, 0.005))
      a.warnings.push_back(
          fmt::format("the reference is not converged: half the {} changes its peak by {}; "
                      "lower --reference-{}",
                      what, percent(half[peak]), cure));
  };
  check(r.half_step, "step", "step");
  check(r.half_speed, "platen speed", "speed");
  if (!r.peak_reached)
    a.warnings.emplace_back(
        "the reference's stress has not come down: its peak is the largest stress up to test.stop_strain");
}

}  // namespace

std::optional<Analysis> analyse(const std::vector<Finished>& finished) {
  const auto reference = reference_of(finished);
  if (!reference) return std::nullopt;
  Analysis a;
  a.reference = *reference;
  for (const Finished& one : finished)
    a.errors.push_back(one.outcome.failure.empty() ? errors_of(one.outcome.readings, reference->mean)
                                                   : no_errors());
  find_fronts(finished, a);
  find_cheapest(finished, a);
  group_sizes(finished, a);
  check_convergence(a);
  return a;
}

}  // namespace breccia
