// The folder that holds the results of a series.
#pragma once
#include <filesystem>

namespace breccia {

/// Makes the folder, or empties one that is there of what breccia made.
/// @param force  false: a folder that holds results is refused
/// @throws BadInput when there are results and no force; WriteError when it cannot be made or emptied
void claim_run_folder(const std::filesystem::path& folder, bool force);

}  // namespace breccia
