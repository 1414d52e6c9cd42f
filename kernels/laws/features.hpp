// What a scene asks of the bond loop, fixed at compile time: a feature that is off costs no
// instruction.
#pragma once
#include <string_view>

namespace breccia {

/// How tension and shear share the strength of a bond: uncoupled, the paper's, is the default.
/// docs/model.md, "Dempack law, shear".
enum class Criterion : unsigned char { uncoupled, coupled, mohr_coulomb };

/// What the loop over bonds computes in: doubles, or floats between integers that keep the
/// particles' motion and their sums (docs/model.md, "Single precision").
enum class Precision : unsigned char { full, single };

/// As `run.precision` has it.
constexpr std::string_view name_of(Precision p) { return p == Precision::single ? "single" : "double"; }

/// What a loop does beside the law.
struct LoopKind {
  Precision precision = Precision::full;
  bool ledger = false;  ///< books where the energy of each bond goes

  constexpr bool operator==(const LoopKind&) const = default;
};

/// A structural type, so that a kernel can take it as a template parameter.
struct Features {
  bool rotation = true;         ///< particles spin; bonds pass torques
  bool contact_damping = true;  ///< viscous force along the bond
  bool plasticity = true;       ///< three-slope envelope in compression
  bool breakage = true;         ///< damage, failure, Coulomb friction afterwards
  Criterion criterion = Criterion::uncoupled;
  bool unloading = false;  ///< bonds that have yielded go back on another line than k_n (B118)
  bool several = false;    ///< bonds of several materials, each under a law of its own (B125)

  constexpr bool operator==(const Features&) const = default;

  /// True when a kernel built for `this` also computes the scene `other`: a superset whose surplus
  /// can be switched off by constants (infinite strengths and limits, no dashpot, a Mohr-Coulomb
  /// line that is flat in tension) or by spins that stay zero.
  constexpr bool covers(const Features& other) const {
    const bool coupled = criterion == Criterion::coupled,
               asks_coupled = other.criterion == Criterion::coupled;
    return (rotation || !other.rotation) && (contact_damping || !other.contact_damping) &&
           (plasticity || !other.plasticity) && (breakage || !other.breakage) &&
           (unloading || !other.unloading) && several == other.several &&
           (!other.breakage || coupled == asks_coupled);
  }
};

}  // namespace breccia
