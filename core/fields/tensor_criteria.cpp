#include "core/fields/tensor_criteria.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace breccia {
namespace {

/// Beyond the tip of a cone or pyramid no shear is left to compare with.
double ratio(double size, double strength) {
  if (strength > 0.0) return size / strength;
  return size > 0.0 || strength < 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
}

}  // namespace

std::array<double, 3> principal_stresses(const Stress& s) {
  Eigen::Matrix3d m;
  m << s.normal.x, s.shear.z, s.shear.y, s.shear.z, s.normal.y, s.shear.x, s.shear.y, s.shear.x, s.normal.z;
  const Eigen::Vector3d rising =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m, Eigen::EigenvaluesOnly).eigenvalues();
  return {rising[2], rising[1], rising[0]};
}

double rankine_state(const std::array<double, 3>& p, const TensorStrengths& s) {
  return ratio(std::max(0.0, p[0]), s.tension);
}

double mohr_coulomb_state(const std::array<double, 3>& p, const TensorStrengths& s) {
  const double cosine = 1.0 / std::sqrt(1.0 + s.friction * s.friction), sine = s.friction * cosine;
  return ratio(0.5 * (p[0] - p[2]), s.cohesion * cosine - 0.5 * (p[0] + p[2]) * sine);
}

double drucker_prager_state(const std::array<double, 3>& p, const TensorStrengths& s) {
  const double cosine = 1.0 / std::sqrt(1.0 + s.friction * s.friction), sine = s.friction * cosine;
  const double by = 2.0 / (std::sqrt(3.0) * (3.0 - sine));
  const auto square = [](double x) { return x * x; };
  const double j2 = (square(p[0] - p[1]) + square(p[1] - p[2]) + square(p[2] - p[0])) / 6.0;
  return ratio(std::sqrt(j2), by * (3.0 * s.cohesion * cosine - sine * (p[0] + p[1] + p[2])));
}

}  // namespace breccia
