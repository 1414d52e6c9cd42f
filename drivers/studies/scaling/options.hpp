// The command line of breccia-scaling, checked.
#pragma once
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/scatter_name.hpp"
#include "core/studies/scaling/scaling.hpp"

namespace breccia {

struct ScalingOptions {
  std::vector<std::size_t> spheres{13000, 70000};  ///< of strong scaling: those of the published tables
  std::size_t spheres_per_thread = 35000;          ///< of weak scaling
  std::vector<int> threads;                        ///< rising
  std::vector<ScatterKind> scatter{ScatterKind::private_sums};
  std::vector<Precision> precision{Precision::single};
  std::optional<ScalingStudy> only;  ///< nothing: both
  ScalingBlocks blocks;
  std::filesystem::path out = "out/scaling";
  bool force = false, quiet = false;
};

/// @param options  filled with what the command line says
/// @returns nothing when the study is to run; else the exit code
std::optional<int> read_scaling_options(int argc, char** argv, ScalingOptions& options);

/// In the order in which they are measured; points of the same specimen follow each other.
/// @throws BadInput: more steps than a test has, more spheres than can be packed, or sums that no
/// precision has
/// @param ranks  of the job, each with the threads of a point
std::vector<ScalingPoint> scaling_points(const ScalingOptions& options, int ranks = 1);

std::string_view name_of(ScalingStudy study);

}  // namespace breccia
