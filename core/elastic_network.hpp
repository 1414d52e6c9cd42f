// Bonds and contacts as a linear elastic network: the stiffness that the probe for alpha solves with, and
// that bounds the time step.
#pragma once
#include <Eigen/Core>
#include <functional>
#include <span>

#include "core/assembly.hpp"
#include "core/contact_table.hpp"
#include "kernels/bond_laws.hpp"

namespace breccia {

/// Per bond, then per contact: unit normal, stiffnesses, arms. Six unknowns a particle: displacement, then
/// rotation.
struct ElasticNetwork {
  struct Spring {
    Row lo, hi;
    double k_n, k_s;  ///< N/m
  };
  struct Branch {
    Vec3 normal;
    double arm_ratio;  ///< the arm at either end is this times its radius
  };
  std::vector<Spring> springs;
  std::vector<Branch> branches;
  std::vector<double> radius;                       ///< m, per particle
  std::vector<std::uint32_t> first_entry, entries;  ///< per particle: spring << 1 | particle is hi
  std::size_t particles = 0;
  int threads = 1;
};

struct SpringConstants {
  double normal, shear;  ///< N/m
};

/// Springs lie where the particles are now.
/// @param rotation   false: no arms, particles pass no torque
/// @param constants  called with the row of each bond, then with bonds.size + the row of each contact
ElasticNetwork elastic_network(const ParticleTable& particles, const BondTable& bonds,
                               const ContactTable& contacts, bool rotation, int threads,
                               const std::function<SpringConstants(std::size_t)>& constants);

/// The same network with other stiffnesses.
void set_constants(ElasticNetwork& network, const std::function<SpringConstants(std::size_t)>& constants);

/// What a spring passes on: N, what it pulls its lower end with, and that times its branch's normal and arm over
/// radius, on both ends alike. One line of the cache.
struct alignas(64) SpringLoad {
  Vec3 pull, moment;
};

/// forces = K displacements; both of 6 * particles. Each spring is stretched once; particles then add up what
/// theirs pass on, in the same order for any number of threads.
/// @param loads  of each spring: room that is kept between calls
void apply_stiffness(const ElasticNetwork& network, const Eigen::VectorXd& displacements,
                     std::vector<SpringLoad>& loads, Eigen::VectorXd& forces);

/// What the assembly does when its layers are pushed together: the answer of a static linear solve.
struct ElasticResponse {
  double young_modulus = 0;  ///< Pa, mean platen stress over gauge strain
  double poisson_ratio = 0;  ///< radial gauge over axial gauge
  long iterations = 0;       ///< of conjugate gradients
};

/// k_n of every bond that is not padding, N/m, with the areas that the table has now.
std::vector<double> bond_stiffness(const BondLaw& law, const ParticleTable& particles,
                                   const BondTable& bonds);

/// @param stiffness    N/m, k_n per bond
/// @param shear_ratio  k_s/k_n
/// @param rough  lateral motion of the layers fixed
/// @throws BadInput when the specimen is not connected from end to end
ElasticResponse probe(const Assembly& assembly, std::span<const double> stiffness, double shear_ratio,
                      bool rough, int threads);

}  // namespace breccia
