// summary.json, and the table that a program ends with.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/loading/findings.hpp"

namespace breccia {

/// Writes the summary; keys are the names of the fields, what is absent or not finite is null.
/// @throws WriteError
void write_summary(const std::filesystem::path& file, const SeriesSummary& series);

/// The runs as JSON, and back: what a checkpoint keeps of the runs before it.
std::string runs_text(const std::vector<RunSummary>& runs);
/// @throws BadInput when another version wrote them
std::vector<RunSummary> read_runs(const std::string& text);

/// What a summary.json says of the runs that came to their end.
struct FinishedRuns {
  std::size_t count = 0;                                   ///< 0 where there is no such file
  std::vector<std::pair<std::string, std::string>> files;  ///< of all of them: name and SHA-256
};
/// @throws BadInput when the file is damaged
FinishedRuns finished_runs(const std::filesystem::path& file);

/// For the terminal: a table with one line per run, the line of peaks if there is one, warnings,
/// where the time went, where the files are. Columns without a value in any run are left out. Lines
/// end with '\n'.
std::string format_summary_table(const SeriesSummary& series, const std::filesystem::path& folder);

}  // namespace breccia
