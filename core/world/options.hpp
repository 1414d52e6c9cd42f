// How a scene is run: what it asks for beyond its specimen and its material.
#pragma once
#include "core/base/scene_options.hpp"
#include "core/bonding/assembly.hpp"
#include "core/boundary/tool.hpp"
#include "kernels/loops/bond_pass.hpp"
#include "kernels/loops/integrate.hpp"
#include "kernels/loops/scatter.hpp"
#include "kernels/math/instruction_set.hpp"

namespace breccia {

struct WorldOptions {
  Features features;  ///< that the scene asks for
  bool new_contacts = true;
  int search_every = 0;  ///< steps between searches for contacts; 0: when the skin is used up
  bool rough_platens = true;
  Cutting cutting;           ///< of a tool, where there is one
  bool rigid_sides = false;  ///< the lateral surface cannot move sideways
  SkinWeights skin_weights = SkinWeights::radius;
  bool current_surface = false;  ///< pressure acts on the lateral surface as it is, not as it was
  bool cracks = true;            ///< keep a record of broken bonds
  bool orientation = false;      ///< keep how particles have turned
  double contact_damping = 0.9;  ///< xi
  bool paper_form = false;       ///< damping times pi alpha r_c/d0 (P30)
  DampingScheme damping_scheme = DampingScheme::explicit_;
  double damping_step =
      0;  ///< s, at which the scheme is evaluated; 0: the run's own, which converges elsewhere
  GlobalDamping global_damping{0.1, 0.1};
  double safety = 0.8;     ///< of the critical step, at most 1
  double mass_factor = 1;  ///< of the total mass, by which small particles may be made heavier; 1: none
  ScatterKind scatter = ScatterKind::private_sums;
  Precision precision = Precision::full;
  bool ledger = false;  ///< books where the energy goes
  int threads = 1;
  InstructionSet instruction_set = best_instruction_set();
};

}  // namespace breccia
