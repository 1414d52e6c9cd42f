// The part of a scene around some contacts, to look at the step there alone. docs/model.md, (B130).
#pragma once
#include "core/elastic/critical_step.hpp"

namespace breccia {

/// Spheres within some bonds of the contacts, free; those that these touch, fixed; and all that
/// acts between them.
struct StepBlock {
  ParticleTable particles;
  BondTable bonds;
  ContactTable contacts;
  Dashpots dashpots;
  std::vector<std::uint8_t> fixed;  ///< by row

  /// The block as a scene; what it refers to must live on.
  StepScene scene(const StepScene& whole) const;
};

/// @param contacts  rows of whole.contacts
/// @param bonds     how far from them, in bonds and contacts
StepBlock block_around(const StepScene& whole, std::span<const std::size_t> contacts, int bonds);

}  // namespace breccia
