// One layout of a scene, ready to be run.
#pragma once
#include "core/studies/layouts/colours.hpp"
#include "core/studies/layouts/layout.hpp"
#include "core/studies/layouts/stored_pass.hpp"
#include "core/world/world.hpp"

namespace breccia {

/// What a pass leaves, particle by particle and bond by bond of the scene.
struct PassResult {
  std::vector<Vec3> force, torque;  ///< N, N m
  std::vector<Vec3> shear;          ///< N
  std::vector<double> plastic_stretch, damage_normal, damage_shear;
};

class LayoutRun {
public:
  /// @param scene  at rest between two steps, with all features; copied
  LayoutRun(const World& scene, const Layout& layout, int threads);

  /// Force of each bond, added to its ends; advances the history by `dt`, s. Nothing moves.
  void pass(double dt);

  void clear_sums();
  PassResult result();
  std::size_t colours() const { return first_of_colour_.empty() ? 0 : first_of_colour_.size() - 1; }

private:
  void pass_over(const BondPassIn& in, std::size_t first, std::size_t last, const Scatter& to);
  bool in_columns() const { return !columns_.position.empty(); }
  void collect_columns();

  bool in_single() const { return layout_.precision == Precision::single; }
  void start_in_single();
  void move_by(double dt);
  void pass_in_single();
  /// Calls go(rows of sums) for the sums that the layout has.
  template <class Go>
  void with_sums(const Go& go);

  Layout layout_;
  int threads_;
  World world_;
  StoredBonds stored_;
  StoredPass stored_pass_ = nullptr;
  struct {
    Column<Vec3> position, velocity, spin;
    Column<Vec3> force, torque;       ///< of the particles, and the ranges' own
  } columns_;                         ///< empty where particles lie in their records
  std::vector<Index> to_lo_, to_hi_;  ///< rows to add to, where they are not production's
  SumsPass sums_pass_ = nullptr;
  std::vector<LongSums> long_sums_;
  std::vector<FloatSums> float_sums_;
  double moved_by_ = -1;  ///< s, the step of single precision's records
  std::vector<std::size_t> first_of_colour_;
  std::vector<Row> source_;  ///< of each coloured bond in the scene's table
  std::size_t scene_bonds_;
};

/// Largest difference of two results, each column over its own largest value.
double largest_difference(const PassResult& a, const PassResult& b);

}  // namespace breccia
