// A world in single precision: the loop's records and sums, and the particles in doubles, follow
// each other. Nothing here does anything in double precision. docs/model.md, "Single precision".
#pragma once
#include <functional>
#include <optional>

#include "core/world/world.hpp"

namespace breccia {

/// The shortest bond, where it is shorter than single precision can tell: the scene runs in double.
std::optional<std::size_t> bond_too_short_for_single(const BondTable& bonds);

/// Chooses the quanta from the whole specimen, and fills the store.
void start_single(World& world);

/// From tables that are up to date: those of a checkpoint, or a rank's part.
void fill_single(World& world);

/// What only a rank that runs bonds needs.
void forget_blocks(SingleStore& store);

/// Passes over bonds; for_bonds(pass) calls pass(first, last, notes).
using SingleRange = std::function<void(std::size_t, std::size_t, BreakNotes*)>;
void pass_in_single(World& world, const std::function<void(const SingleRange&)>& for_bonds);

/// Sums that several threads have of the same particle become one. (B129)
void add_slots(SingleStore& store, const ScatterPlan& plan);

/// The sums become forces of those particles that somebody looks at before they move, which are
/// held or under pressure; of the others they stay sums until then.
void collect_single(World& world);

/// The same for more of them. Nothing in double precision.
/// @param rows  rising
void collect_rows(World& world, std::span<const Row> rows);

/// After the particles of this rank have moved; those of others, once they have come.
/// @param events  SingleEvent bits of all ranks, of this step
void record_motion(World& world, unsigned events);
void record_ghosts(World& world);

/// Anchors of particles that have moved far, before the next pass over their bonds.
void renew_far(World& world);

}  // namespace breccia
