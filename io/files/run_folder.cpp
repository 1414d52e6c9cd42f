#include "io/files/run_folder.hpp"

#include <algorithm>
#include <regex>
#include <vector>

#include "core/base/error.hpp"
#include "io/files/atomic_write.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// True for a path, relative to the folder, that only breccia or scripts/plot gives.
bool is_ours(const std::string& relative) {
  static const std::regex ours(
      R"((case\.toml|specimen\.csv|summary\.json|(curve|cracks|events)-\d+\.csv|results\.h5|checkpoint(-before)?\.h5|(scaling|layouts|stability|workprecision)\.(csv|json|png)|runs\.jsonl|(curves|envelope|specimen|energy|cracks-\d+)\.png)"
      R"(|frames/run-\d+\.pvd|frames/run-\d+/(particles|bonds)-\d+\.vtp)(\.part)?)");
  return std::regex_match(relative, ours);
}

}  // namespace

void claim_run_folder(const fs::path& folder, bool force) {
  std::error_code trouble;
  if (fs::exists(folder, trouble) && !fs::is_directory(folder, trouble))
    fail<WriteError>("{}: is not a folder; choose another with --out", folder.string());
  std::vector<fs::path> old;
  if (fs::is_directory(folder, trouble))
    for (const auto& entry : fs::recursive_directory_iterator(folder, trouble))
      if (entry.is_regular_file(trouble) && is_ours(entry.path().lexically_relative(folder).generic_string()))
        old.push_back(entry.path());
  if (!old.empty() && !force)
    fail<BadInput>("{}: holds results already; --force replaces them, --out names another folder",
                   folder.string());
  for (const auto& file : old)
    if (!fs::remove(file, trouble))
      fail<WriteError>("{}: cannot be removed: {}", file.string(), trouble.message());
  make_folder(folder);
}

}  // namespace breccia
