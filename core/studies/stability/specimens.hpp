// The small specimens of the stability study, and what is done to their columns.
#pragma once
#include "core/studies/stability/scene.hpp"

namespace breccia {

inline constexpr Body stability_body{Shape::cylinder, 0.05, 0, 0.1};

/// Packed once for each number of spheres.
const Specimen& stability_packing(std::size_t spheres);

/// Adds `count` spheres `ratio` times smaller than the mean, each in the notch between two that
/// touch, where it overlaps no third.
void add_dust(Specimen& specimen, double ratio, std::size_t count);

/// Puts into each of the `count` first spheres a smaller one, half as large, whose centre lies
/// `distance` radii of the host from the host's.
void add_nested(Specimen& specimen, double distance, std::size_t count);

/// `count` equal spheres one upon the other that touch and fill the height of the body.
Specimen stack_of(std::size_t count, const Body& body);

/// Bonds below the middle are of a material `factor` times as stiff and as strong, those across it
/// of the harmonic mean: strains at failure are the same.
void soften_lower_half(World& world, double factor);

/// Masses spread evenly, on a scale of decades, over so many of them, in random order; the middle
/// one is that of the plain scene.
void spread_masses(World& world, double decades);

}  // namespace breccia
