// The runs of a study as they end, one a line, so that an interrupted study goes on where it was.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/studies/workprecision/trial.hpp"
#include "io/cases/case.hpp"

namespace breccia {

/// What makes runs comparable: names and values, "case" = hash, "cpu" = model name, ...
using JournalHead = std::vector<std::pair<std::string, std::string>>;

class Journal {
public:
  /// @param resume  true: what the file holds is kept, but for a last line that a kill has cut
  ///         short
  /// @throws BadInput when the file was made with another head, or is none; WriteError
  Journal(std::filesystem::path file, const JournalHead& head, bool resume);

  /// The outcome of a trial that has been run.
  const Outcome* find(const std::string& key) const;
  /// Writes a line and waits until it is on the disk. @throws WriteError
  void add(const std::string& key, const Outcome& outcome);

private:
  std::filesystem::path file_;
  std::map<std::string, Outcome> done_;
};

/// 16 hex digits over the resolved case, the bytes of its specimen's file and the version of
/// breccia.
std::string hash_of_case(const Case& c);

}  // namespace breccia
