#include "core/bonding/several_materials.hpp"

#include <algorithm>
#include <utility>

namespace breccia {
namespace {

double mean(double a, double b) { return 0.5 * (a + b); }

double harmonic_mean(double a, double b) { return a + b > 0.0 ? 2.0 * a * b / (a + b) : 0.0; }

std::optional<double> mean(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::optional(mean(*a, *b)) : std::nullopt;
}

std::array<double, 3> mean(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {mean(a[0], b[0]), mean(a[1], b[1]), mean(a[2], b[2])};
}

/// k_s/k_n at the harmonic mean of both Poisson ratios: a straight line over 1/(1 + nu) is exact
/// for 1/(2(1 + nu)) and for (1 - 4 nu)/(1 + nu).
double shear_ratio_between(const BondMaterial& a, const BondMaterial& b, double nu) {
  const double at_a = 1.0 / (1.0 + a.material.poisson_ratio), at_b = 1.0 / (1.0 + b.material.poisson_ratio);
  if (at_a == at_b) return mean(a.shear_ratio, b.shear_ratio);
  const double part = (1.0 / (1.0 + nu) - at_a) / (at_b - at_a);
  return a.shear_ratio + part * (b.shear_ratio - a.shear_ratio);
}

bool is_stiffness(std::string_view key) { return key.ends_with("_stiffness"); }

}  // namespace

BondMaterial between(const BondMaterial& one, const BondMaterial& other) {
  const Material &a = one.material, &b = other.material;
  BondMaterial m = one;  // law, criterion and the like are the scene's
  Material& c = m.material;
  c.density = mean(a.density, b.density);
  c.young_modulus = harmonic_mean(a.young_modulus, b.young_modulus);
  c.poisson_ratio = harmonic_mean(a.poisson_ratio, b.poisson_ratio);
  for (double Material::*number :
       {&Material::friction_static, &Material::friction_dynamic, &Material::tensile_strength,
        &Material::shear_strength, &Material::damage_normal, &Material::damage_shear})
    c.*number = mean(a.*number, b.*number);
  for (std::array<double, 3> Material::*numbers :
       {&Material::limit_compressive_stress, &Material::stiffness_reduction})
    c.*numbers = mean(a.*numbers, b.*numbers);
  for (std::optional<double> Material::*number :
       {&Material::fracture_energy_normal, &Material::fracture_energy_shear, &Material::failure_strain_normal,
        &Material::failure_strain_shear})
    c.*number = mean(a.*number, b.*number);
  // what one of the two leaves to the other keys is what these stand for
  if (a.unloading_modulus || b.unloading_modulus)
    c.unloading_modulus = std::max(c.young_modulus, mean(a.unloading_modulus.value_or(a.young_modulus),
                                                         b.unloading_modulus.value_or(b.young_modulus)));
  if (a.yield_stress || b.yield_stress)
    c.yield_stress = mean(a.yield_stress.value_or(a.limit_compressive_stress[0]),
                          b.yield_stress.value_or(b.limit_compressive_stress[0]));
  for (auto& [key, number] : c.own)
    number =
        is_stiffness(key) ? harmonic_mean(a.own.at(key), b.own.at(key)) : mean(a.own.at(key), b.own.at(key));
  m.shear_ratio = shear_ratio_between(one, other, c.poisson_ratio);
  return m;
}

LawIndex law_between(LawIndex one, LawIndex other, std::size_t materials) {
  const std::size_t a = std::min(one, other), b = std::max(one, other);
  return static_cast<LawIndex>(a * materials - a * (a + 1) / 2 + b);
}

std::string_view unmatched(const Material& a, const Material& b) {
  const std::pair<std::string_view, std::optional<double> Material::*> keys[] = {
      {"fracture_energy_normal", &Material::fracture_energy_normal},
      {"fracture_energy_shear", &Material::fracture_energy_shear},
      {"failure_strain_normal", &Material::failure_strain_normal},
      {"failure_strain_shear", &Material::failure_strain_shear}};
  for (const auto& [key, number] : keys)
    if ((a.*number).has_value() != (b.*number).has_value()) return key;
  return {};
}

}  // namespace breccia
