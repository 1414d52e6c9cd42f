// A stiff or extreme scene of the stability study, declared as data: what it is, what it stresses,
// and how it differs from the plain one.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/loading/load_test.hpp"
#include "core/packing/packing.hpp"

namespace breccia {

/// What is run of a scene. network: its bonds, unbreakable and without any loss, shaken and left
/// alone: energy is kept below the limit of the step and grows without bound above it. damped: the
/// same with the scene's contact damping. law: the whole law under the scene's loading, where
/// "stable" and "limit" mean less (see StabilityRun).
enum class StabilityPart { network, damped, law };
inline constexpr std::string_view name_of(StabilityPart part) {
  constexpr std::string_view names[] = {"network", "damped", "law"};
  return names[static_cast<int>(part)];
}

/// All that a scene can change of the plain one.
struct StabilitySetup {
  Specimen specimen;  ///< packed once, loaded along z, middle at the origin
  Body body;
  Material material;
  WorldOptions options;                ///< of the damped network and the law
  std::function<void(World&)> change;  ///< of columns of the world before its step is found; may be empty
  Vec3 offset;                         ///< m, that the whole scene is moved by
  LoadTest load;
  double blast = 0;  ///< m/s at the lateral surface, outwards, all bonds broken: instead of a test
  std::uint64_t rest_steps = 0;  ///< pressed a little, then left alone for so long: instead of a test
};

struct StabilityScene {
  std::string_view name;      ///< a word for --only
  std::string_view stresses;  ///< what it is hard on
  std::vector<StabilityPart> parts;
  std::function<void(StabilitySetup&)> differ;
  bool is_long = false;  ///< only when asked for
};

/// Every scene, the plain one first.
const std::vector<StabilityScene>& stability_scenes();

/// The plain scene: 100 spheres of the material in a cylinder 50 x 100 mm, pressed to failure.
StabilitySetup plain_setup(const Material& material);

}  // namespace breccia
