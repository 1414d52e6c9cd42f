// What breccia-impact leaves behind: the curve and the summary.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/impact/impact.hpp"

namespace breccia {

/// curve-0.csv: one line per row, names as in ImpactRow. @throws WriteError
void write_impact_curve(const std::filesystem::path& file, std::span<const ImpactRow> rows);

/// summary.json: steps, times, energies and what became of each particle. @throws WriteError
/// @param inputs  names of the files that were read, and their SHA-256
void write_impact_summary(const std::filesystem::path& file, const ImpactScene& scene,
                          const ImpactResult& result,
                          const std::vector<std::pair<std::string, std::string>>& inputs);

/// What should make a reader doubt the result, one line each.
std::vector<std::string> impact_warnings(const ImpactResult& result);

/// For the terminal: one line per particle, at most 20.
std::string format_impact_table(const ImpactResult& result);

}  // namespace breccia
