// Bonds and contacts as a linear elastic network: the stiffness that the probe for alpha solves
// with, and that bounds the time step.
#pragma once
#include <Eigen/Core>
#include <functional>
#include <span>

#include "core/bonding/assembly.hpp"
#include "core/elastic/touching.hpp"
#include "core/tables/contact_table.hpp"
#include "kernels/laws/bond_laws.hpp"

namespace breccia {

template <class Real>
using VectorOf = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/// Per bond, then per contact: unit normal, stiffnesses, arms. Six unknowns a particle:
/// displacement, then rotation. In floats, for estimates, it takes half the memory and time.
template <class Real>
struct Network {
  struct Spring {
    Row lo, hi;
    Real k_n, k_s;  ///< N/m
  };
  struct Branch {
    Vec<Real> normal;
    Real arm_ratio;  ///< the arm at either end is this times its radius
  };
  std::vector<Spring> springs;
  std::vector<Branch> branches;
  struct Turning {
    Real bend, twist;  ///< N m per rad
  };
  std::vector<Turning> turnings;                    ///< beside the springs; empty where none passes moments
  std::vector<Real> radius;                         ///< m, per particle
  std::vector<std::uint32_t> first_entry, entries;  ///< per particle: spring << 1 | particle is hi
  std::size_t particles = 0;
  int threads = 1;
};
using ElasticNetwork = Network<double>;

struct SpringConstants {
  double normal, shear;        ///< N/m
  double bend = 0, twist = 0;  ///< N m per rad
};

/// Springs lie where the particles are now.
/// @param rotation   false: no arms, particles pass no torque
/// @param constants  called with the row of each bond, then with bonds.size + the row of each
///         contact
template <class Real = double>
Network<Real> elastic_network(const ParticleTable& particles, const BondTable& bonds,
                              const ContactTable& contacts, bool rotation, int threads,
                              const std::function<SpringConstants(std::size_t)>& constants);

/// The same network with other stiffnesses.
template <class Real>
void set_constants(Network<Real>& network, const std::function<SpringConstants(std::size_t)>& constants);

/// What a spring passes on: N, what it pulls its lower end with, and that times its branch's normal
/// and arm over radius, on both ends alike. One line of the cache, or half of one.
template <class Real>
struct alignas(8 * sizeof(Real)) SpringLoad {
  Vec<Real> pull, moment;
};

/// forces = K displacements; both of 6 * particles. Each spring is stretched once; particles then
/// add up what theirs pass on, in the same order for any number of threads.
/// @param loads  of each spring: room that is kept between calls
template <class Real>
void apply_stiffness(const Network<Real>& network, const VectorOf<Real>& displacements,
                     std::vector<SpringLoad<Real>>& loads, VectorOf<Real>& forces);

/// What the assembly does when its layers are pushed together: the answer of a static linear solve.
/// (B15)
struct ElasticResponse {
  double young_modulus = 0;  ///< Pa, mean platen stress over gauge strain
  double poisson_ratio = 0;  ///< radial gauge over axial gauge
  long iterations = 0;       ///< of conjugate gradients
};

/// k_n of every bond that is not padding, N/m, with the areas that the table has now.
/// @param laws  one, or one for each pair of materials
std::vector<double> bond_stiffness(std::span<const BondLaw> laws, const ParticleTable& particles,
                                   const BondTable& bonds);

/// @param stiffness    N/m, k_n per bond
/// @param shear_ratio  k_s/k_n: one, or by law
/// @param rough  lateral motion of the layers fixed
/// @param touching  pairs without a bond: they press where the specimen brings them nearer, and
///                  slide where friction does not hold them
/// @throws BadInput when the specimen is not connected from end to end
ElasticResponse probe(const Assembly& assembly, std::span<const double> stiffness,
                      std::span<const double> shear_ratio, bool rough, int threads,
                      const Touching& touching = {});

}  // namespace breccia
