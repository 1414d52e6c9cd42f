#include "core/studies/workprecision/grid.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace breccia {
namespace {

constexpr DampingScheme expl = DampingScheme::explicit_, summed = DampingScheme::summed,
                        capped = DampingScheme::capped;

// --- the table

const Grid small_grid{.reference_safety = 0.4,
                      .reference_speed = 0.05,
                      .shakes = 3,
                      .shake_size = 1e-12,
                      .steps = {0.4, 0.8, 0.95},
                      .speeds = {0.05, 0.1, 0.2, 0.5},
                      .masses = {2},
                      .dampings = {0, 0.2},
                      .schemes = {summed},
                      .precisions = {Precision::full},
                      .scatters = {},
                      .combinations = {{0.95, 0.2, expl, 1},
                                       {0.95, 0.5, expl, 1},
                                       {0.95, 0.2, summed, 1},
                                       {0.95, 0.2, summed, 2}},
                      .spheres = {250, 500, 1000},
                      .seeds = 3,
                      .large = 0,
                      .large_speeds = {}};

const Grid full_grid{
    .reference_safety = 0.2,
    .reference_speed = 0.02,
    .shakes = 5,
    .shake_size = 1e-12,
    .steps = {0.2, 0.4, 0.8, 0.95},
    .speeds = {0.02, 0.05, 0.1, 0.2, 0.3, 0.5},
    .masses = {1.1, 1.5, 2, 4},
    .dampings = {0, 0.1, 0.2},
    .schemes = {summed, capped},
    .precisions = {Precision::full, Precision::single},
    .scatters = {ScatterKind::private_sums, ScatterKind::gather, ScatterKind::atomic},
    .combinations = {{0.4, 0.05, expl, 1},     {0.4, 0.2, expl, 1},       {0.95, 0.05, expl, 1},
                     {0.95, 0.2, expl, 1},     {0.95, 0.3, expl, 1},      {0.95, 0.5, expl, 1},
                     {0.95, 0.05, summed, 1},  {0.95, 0.1, summed, 1},    {0.95, 0.2, summed, 1},
                     {0.95, 0.5, summed, 1},   {0.95, 0.05, capped, 1},   {0.95, 0.1, capped, 1},
                     {0.95, 0.2, capped, 1},   {0.95, 0.5, capped, 1},    {0.95, 0.1, expl, 2},
                     {0.95, 0.2, expl, 2},     {0.95, 0.1, summed, 1.1},  {0.95, 0.15, summed, 1.1},
                     {0.95, 0.1, summed, 1.5}, {0.95, 0.15, summed, 1.5}, {0.95, 0.2, summed, 1.5},
                     {0.95, 0.1, summed, 2},   {0.95, 0.2, summed, 2},    {0.95, 0.5, summed, 2},
                     {0.95, 0.1, summed, 4},   {0.95, 0.2, summed, 4},    {0.95, 0.5, summed, 4},
                     {0.95, 0.1, capped, 2},   {0.95, 0.2, capped, 2},    {0.95, 0.2, capped, 4}},
    .spheres = {100, 250, 500, 1000, 5000, 13000},
    .seeds = 5,
    .large = 70000,
    .large_speeds = {0.1, 0.2, 0.5}};

// --- what is made of it

constexpr std::array<Family, 10> families{
    Family::base,    Family::step,      Family::speed,   Family::mass,         Family::scheme,
    Family::damping, Family::precision, Family::scatter, Family::combinations, Family::sizes};
constexpr std::array<std::string_view, 10> family_names{
    "base", "step", "speed", "mass", "scheme", "damping", "precision", "scatter", "combinations", "sizes"};

/// Adds the base with one value replaced, for each of the values.
template <class Values, class Set>
void vary(std::vector<GridRecipe>& all, Family family, const Recipe& base, const Values& values,
          const Set& set) {
  for (const auto& value : values) {
    all.push_back({family, base});
    set(all.back().recipe, value);
  }
}

}  // namespace

std::string_view name_of(Family family) { return family_names[static_cast<std::size_t>(family)]; }
std::span<const Family> all_families() { return families; }

const Grid& grid_of(GridSize size) { return size == GridSize::small ? small_grid : full_grid; }

std::vector<GridRecipe> grid_recipes(const Grid& g, const Recipe& base, const std::vector<Family>& asked) {
  std::vector<GridRecipe> all{{Family::base, base}}, different;
  vary(all, Family::step, base, g.steps, [](Recipe& r, double v) { r.safety = v; });
  vary(all, Family::speed, base, g.speeds, [](Recipe& r, double v) { r.platen_speed = v; });
  vary(all, Family::mass, base, g.masses, [](Recipe& r, double v) { r.mass_factor = v; });
  vary(all, Family::scheme, base, g.schemes, [](Recipe& r, DampingScheme v) { r.scheme = v; });
  vary(all, Family::damping, base, g.dampings, [](Recipe& r, double v) { r.damping = {v, v}; });
  vary(all, Family::precision, base, g.precisions, [](Recipe& r, Precision v) { r.precision = v; });
  vary(all, Family::scatter, base, g.scatters, [](Recipe& r, ScatterKind v) { r.scatter = v; });
  vary(all, Family::combinations, base, g.combinations, [](Recipe& r, const Combination& v) {
    r.safety = v.safety;
    r.platen_speed = v.platen_speed;
    r.scheme = v.scheme;
    r.mass_factor = v.mass_factor;
  });
  for (const GridRecipe& one : all) {
    const bool wanted =
        one.family == Family::base || std::find(asked.begin(), asked.end(), one.family) != asked.end();
    const bool known = std::any_of(different.begin(), different.end(), [&](const GridRecipe& other) {
      return describe(other.recipe) == describe(one.recipe);
    });
    if (wanted && !known) different.push_back(one);
  }
  return different;
}

}  // namespace breccia
