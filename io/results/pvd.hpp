// run-K.pvd: the list of frames that ParaView opens as one animation.
#pragma once
#include <filesystem>
#include <string>

namespace breccia {

struct PvdEntry {
  int frame = 0;
  double time_s = 0;
  std::string particles, bonds;  ///< files, relative to the .pvd
};

/// Adds a frame: the file is rewritten with the frames below `entry.frame` that it has, and this
/// one.
/// @throws WriteError
void add_to_pvd(const std::filesystem::path& file, const PvdEntry& entry);

}  // namespace breccia
