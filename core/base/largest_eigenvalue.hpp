// The largest eigenvalue of a symmetric matrix that is only ever applied to vectors.
#pragma once
#include <Eigen/Core>
#include <functional>

namespace breccia {

struct LargestEigenvalue {
  double value = 0;  ///< from below
  double early = 0;  ///< what it was after few applications, for differences between similar matrices
  int applications = 0;
};

struct LanczosEffort {
  int applications = 0;
  double tolerance = 0;  ///< of the residual over the value at which it may end sooner; 0: never
  int early = 8;         ///< applications after which `early` is taken
};

/// Lanczos iteration from a random vector, three vectors in all: nothing is orthogonalised again,
/// which makes copies of eigenvalues but moves none (Paige 1976).
/// @tparam Real  of the vectors, double or float; sums are doubles always
/// @param size   rows; of those that `apply` leaves at zero nothing is seen
/// @param apply  image = A x, A symmetric, no eigenvalue below zero
template <class Real>
LargestEigenvalue largest_eigenvalue(
    Eigen::Index size,
    const std::function<void(const Eigen::VectorX<Real>& x, Eigen::VectorX<Real>& image)>& apply,
    const LanczosEffort& effort, int threads);

/// Of a small symmetric matrix, all of it given.
double largest_eigenvalue(const Eigen::MatrixXd& matrix);

/// Applications after which the value is short by more than the fraction `error` with a probability
/// below `chance`, whatever the spectrum is, of a random vector: 1.648 sqrt(n) exp(-sqrt(error) (2
/// k - 1)) (Kuczynski and Wozniakowski, SIAM J. Matrix Anal. Appl. 13 (1992) 1094). A mode of one
/// light particle, or of one cluster apart from the others, is no exception. (B43)
int applications_for(Eigen::Index size, double error, double chance);

}  // namespace breccia
