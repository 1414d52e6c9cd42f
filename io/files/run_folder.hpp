// The folder that holds the results of a series.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "io/files/folder_lock.hpp"

namespace breccia {

/// What a run does with its folder and around it.
struct FolderUse {
  /// Files that it writes, seen from the folder; a * stands for digits
  /// ("frames/run-0/bonds-*.vtp").
  std::vector<std::string> writes;
  /// Files that it reads, wherever they are (the case, its preset, its specimen): never removed,
  /// never overwritten.
  std::vector<std::filesystem::path> reads;
};

/// What to do with results that are there.
enum class Old { refuse, replace, keep };

/// Makes the folder, or one that is there ready: locks it, removes what breccia wrote in it before,
/// and notes what will be written. Files that breccia did not write are left alone.
/// @param held  the lock, where the caller has it already
/// @return      to be held as long as anything is written
/// @throws BadInput: another run is at work there; results and Old::refuse; a file in the way that
///         is the user's, or that the run itself reads; WriteError when the folder cannot be made
///         or emptied
FolderLock claim_run_folder(const std::filesystem::path& folder, Old old, const FolderUse& use,
                            FolderLock held = {});

/// True where a resolved case is run again out of its own folder of results: DIR/case.toml is the
/// case, and holds what would be written to it.
bool is_resolved_already(const std::filesystem::path& folder, const std::filesystem::path& case_file,
                         const std::string& resolved);

}  // namespace breccia
