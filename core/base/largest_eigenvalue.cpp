#include "core/base/largest_eigenvalue.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/random.hpp"
#include "core/base/threads.hpp"

namespace breccia {
namespace {

/// Normal deviates (Box and Muller): their direction is uniform on the sphere.
template <class Real>
Eigen::VectorX<Real> random_direction(Eigen::Index size) {
  Random random(1);
  Eigen::VectorX<Real> x(size);
  for (Eigen::Index k = 0; k < size; k += 2) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform01(random)));
    const double angle = 2.0 * std::numbers::pi * uniform01(random);
    x[k] = static_cast<Real>(radius * std::cos(angle));
    if (k + 1 < size) x[k + 1] = static_cast<Real>(radius * std::sin(angle));
  }
  return x;
}

/// The matrix as Lanczos vectors see it: tridiagonal.
struct Tridiagonal {
  std::vector<double> diagonal, beside;

  /// Largest eigenvalue; `last` becomes the last component of its vector.
  double largest(double& last) const {
    const auto n = static_cast<Eigen::Index>(diagonal.size());
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
    solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), n),
                                  Eigen::Map<const Eigen::VectorXd>(beside.data(), n - 1));
    last = solver.eigenvectors()(n - 1, n - 1);
    return solver.eigenvalues()[n - 1];
  }
};

}  // namespace

template <class Real>
LargestEigenvalue largest_eigenvalue(
    Eigen::Index size, const std::function<void(const Eigen::VectorX<Real>&, Eigen::VectorX<Real>&)>& apply,
    const LanczosEffort& effort, int threads) {
  using Vector = Eigen::VectorX<Real>;
  const auto rows = static_cast<std::size_t>(size);
  std::vector<double> blocks;
  const auto product = [&](const Vector& a, const Vector& b) {
    return sum_rows<double>(rows, threads, blocks, [&](std::size_t k) {
      return static_cast<double>(a[static_cast<Eigen::Index>(k)]) * b[static_cast<Eigen::Index>(k)];
    });
  };
  const auto each = [&](auto&& change) {
    for_rows(rows, threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) change(static_cast<Eigen::Index>(k));
    });
  };
  Vector now = random_direction<Real>(size), before = Vector::Zero(size), image(size);
  now /= static_cast<Real>(std::sqrt(product(now, now)));
  Tridiagonal t;
  LargestEigenvalue found;
  double beta = 0.0, scale = 0.0;
  while (true) {
    apply(now, image);
    ++found.applications;
    const double alpha = product(now, image);
    const auto a = static_cast<Real>(alpha), b = static_cast<Real>(beta);
    each([&](Eigen::Index k) { image[k] -= a * now[k] + b * before[k]; });
    beta = std::sqrt(product(image, image));
    t.diagonal.push_back(alpha);
    scale = std::max(scale, alpha);
    // all that the start vector holds has been seen
    const bool complete = beta <= (std::is_same_v<Real, float> ? 1e-6 : 1e-12) * scale;
    const bool last = complete || found.applications >= effort.applications;
    const bool early = found.applications == effort.early || (last && found.applications < effort.early);
    const bool look = effort.tolerance > 0.0 && found.applications % 8 == 0;
    if (last || early || look) {
      double end = 0.0;
      found.value = t.largest(end);
      if (early) found.early = found.value;
      if (last || (look && std::abs(beta * end) <= effort.tolerance * found.value)) return found;
    }
    t.beside.push_back(beta);
    const auto next = static_cast<Real>(beta);
    each([&](Eigen::Index k) {
      before[k] = now[k];
      now[k] = image[k] / next;
    });
  }
}

template LargestEigenvalue largest_eigenvalue<double>(
    Eigen::Index, const std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>&, const LanczosEffort&,
    int);
template LargestEigenvalue largest_eigenvalue<float>(
    Eigen::Index, const std::function<void(const Eigen::VectorXf&, Eigen::VectorXf&)>&, const LanczosEffort&,
    int);

double largest_eigenvalue(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[matrix.rows() - 1];
}

int applications_for(Eigen::Index size, double error, double chance) {
  const double needed = std::log(1.648 * std::sqrt(static_cast<double>(size)) / chance);
  return static_cast<int>(std::ceil(0.5 * (needed / std::sqrt(error) + 1.0)));
}

}  // namespace breccia
