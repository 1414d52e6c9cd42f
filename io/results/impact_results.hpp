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

/// walls-0.csv: of each name force, torque (means since the row before) and work so far. @throws
/// WriteError
void write_wall_rows(const std::filesystem::path& file, const ImpactScene& scene, const ImpactResult& result);

/// The spheres where they are at the end, as a case reads them. @throws WriteError
void write_final_spheres(const std::filesystem::path& file, const ImpactScene& scene,
                         const ImpactResult& result);

/// summary.json: steps, times, energies and what became of each particle. @throws WriteError
/// @param inputs  names of the files that were read, and their SHA-256
void write_impact_summary(const std::filesystem::path& file, const ImpactScene& scene,
                          const ImpactResult& result,
                          const std::vector<std::pair<std::string, std::string>>& inputs);

/// What should make a reader doubt the result, one line each.
std::vector<std::string> impact_warnings(const ImpactScene& scene, const ImpactResult& result);

/// For the terminal: one line per particle, at most 20.
std::string format_impact_table(const ImpactScene& scene, const ImpactResult& result);

}  // namespace breccia
