#include "io/files/run_folder.hpp"

#include <algorithm>
#include <set>

#include "core/base/error.hpp"
#include "io/files/atomic_write.hpp"
#include "io/text/input_file.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// Looks at the name itself: a link that leads nowhere is there.
bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

bool matches(const std::string& name, const std::string& pattern, std::size_t star) {
  const std::string_view head = std::string_view(pattern).substr(0, star),
                         tail = std::string_view(pattern).substr(star + 1);
  if (name.size() <= head.size() + tail.size() || !name.starts_with(head) || !name.ends_with(tail))
    return false;
  return name.find_first_not_of("0123456789", head.size()) >= name.size() - tail.size();
}

/// The files of a folder that a name of the list stands for, and what a run that was killed left
/// beside them.
std::vector<fs::path> files_of(const fs::path& folder, const std::string& listed) {
  std::vector<fs::path> files;
  const fs::path path(listed);
  const std::string pattern = path.filename().string();
  if (const std::size_t star = pattern.find('*'); star != std::string::npos) {
    const fs::path parent = folder / path.parent_path();
    std::error_code trouble;
    for (fs::directory_iterator at(parent, trouble), end; !trouble && at != end; at.increment(trouble)) {
      const std::string name = at->path().filename().string();
      if (matches(name, pattern, star) || matches(name, pattern + ".part", star))
        files.push_back(parent / name);
    }
    std::sort(files.begin(), files.end());
    return files;
  }
  for (const fs::path& file : {folder / path, name_aside(folder / path)})
    if (is_there(file)) files.push_back(file);
  return files;
}

/// The same file, by whatever name or link.
bool is_one_of(const fs::path& file, const std::vector<fs::path>& others) {
  return std::any_of(others.begin(), others.end(), [&](const fs::path& other) {
    std::error_code ignored;
    return fs::equivalent(file, other, ignored);
  });
}

/// @param ours  the list
void check_in_the_way(const fs::path& folder, const std::vector<std::string>& ours, const FolderUse& use) {
  std::set<std::string> known;
  for (const std::string& listed : ours)
    for (const fs::path& file : files_of(folder, listed)) known.insert(file.string());
  for (const std::string& name : use.writes)
    for (const fs::path& file : files_of(folder, name)) {
      if (is_one_of(file, use.reads))
        fail<BadInput>(
            "{}: this run reads it, and would write its results over it; choose another folder with --out",
            file.string());
      if (!known.contains(file.string()))
        fail<BadInput>(
            "{}: is there, and breccia did not write it; move it away, or choose another folder with --out",
            file.string());
    }
}

/// The list. A folder of a version that kept none is known by its resolved case: what will be
/// written again is breccia's there.
std::vector<std::string> listed_names(const fs::path& folder, const FolderLock& held, const FolderUse& use) {
  if (std::vector<std::string> names = held.names(); !names.empty()) return names;
  const fs::path resolved = folder / "case.toml";
  const bool old = why_no_file(resolved).empty() && !is_one_of(resolved, use.reads) &&
                   read_bytes(resolved).starts_with("# breccia-");
  return old ? use.writes : std::vector<std::string>{};
}

}  // namespace

bool is_resolved_already(const fs::path& folder, const fs::path& case_file, const std::string& resolved) {
  return is_one_of(case_file, {folder / "case.toml"}) && read_bytes(case_file) == resolved;
}

FolderLock claim_run_folder(const fs::path& folder, Old old, const FolderUse& use, FolderLock held) {
  std::error_code trouble;
  if (fs::exists(folder, trouble) && !fs::is_directory(folder, trouble))
    fail<WriteError>("{}: is not a folder; choose another with --out", folder.string());
  if (!held) held = lock_folder_if_used(folder);
  std::vector<std::string> ours = listed_names(folder, held, use);
  check_in_the_way(folder, ours, use);
  if (!held) {  // only now, so that a folder that is refused stays as it was
    make_folder(folder);
    held = lock_folder(folder);
    ours = listed_names(folder, held, use);  // another run may have come first, and have ended
    check_in_the_way(folder, ours, use);
  }
  std::vector<std::string> listed_now = use.writes;
  for (const std::string& listed : ours) {
    bool kept = old == Old::keep;
    for (const fs::path& file : files_of(folder, listed)) {
      if (old == Old::keep) break;
      if (is_one_of(file, use.reads)) {
        kept = true;
        continue;
      }
      if (old == Old::refuse)
        fail<BadInput>("{}: holds results already; --force replaces them, --out names another folder",
                       folder.string());
      fs::remove(file, trouble);
      if (trouble) fail<WriteError>("{}: cannot be removed: {}", file.string(), trouble.message());
    }
    if (kept && std::find(listed_now.begin(), listed_now.end(), listed) == listed_now.end())
      listed_now.push_back(listed);
  }
  held.write(listed_now);
  return held;
}

}  // namespace breccia
