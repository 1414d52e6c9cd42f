// cracks-K.csv: a line for every bond that broke, written as it breaks.
#pragma once
#include <filesystem>
#include <fstream>
#include <span>

#include "core/world/crack_record.hpp"

namespace breccia {

/// Columns: time_s, axial_strain (of the row in which it broke), gid_lo, gid_hi, x_m, y_m, z_m
/// (middle of the bond), nx, ny, nz (unit, from lo to hi), mode (1 tension, 2 shear),
/// normal_force_N (tension positive), shear_force_N, area_m2, energy_J.
class CrackFile {
public:
  /// @throws WriteError
  explicit CrackFile(const std::filesystem::path& file);
  /// Adds lines and hands them to the system. @throws WriteError
  void add(std::span<const Crack> cracks);
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
  std::ofstream out_;
};

}  // namespace breccia
