#include "io/results/impact_results.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "io/files/atomic_write.hpp"
#include "io/specimens/read_specimen.hpp"

namespace breccia {
namespace {

using Json = nlohmann::ordered_json;
using Field = std::pair<std::string_view, double ImpactRow::*>;

constexpr std::array<Field, 6> fields{{{"time_s", &ImpactRow::time_s},
                                       {"overlap_m", &ImpactRow::overlap_m},
                                       {"normal_force_N", &ImpactRow::normal_force_N},
                                       {"tangential_force_N", &ImpactRow::tangential_force_N},
                                       {"kinetic_J", &ImpactRow::kinetic_J},
                                       {"contacts", &ImpactRow::contacts}}};
static_assert(sizeof(ImpactRow) == fields.size() * sizeof(double), "a field of ImpactRow is not written");

Json of(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

/// Of each name: the mean over the second half of the run, and the work at its end.
Json walls_of(const ImpactScene& scene, const ImpactResult& result) {
  Json walls = Json::array();
  if (result.wall_rows.empty()) return walls;
  for (std::size_t k = 0; k < scene.wall_names.size(); ++k) {
    Vec3 force, torque;
    const std::size_t from = result.wall_rows.size() / 2, count = result.wall_rows.size() - from;
    for (std::size_t row = from; row < result.wall_rows.size(); ++row) {
      force += (1.0 / static_cast<double>(count)) * result.wall_rows[row][k].force;
      torque += (1.0 / static_cast<double>(count)) * result.wall_rows[row][k].torque;
    }
    walls.push_back({{"name", scene.wall_names[k]},
                     {"mean_force_N", of(force)},
                     {"mean_torque_Nm", of(torque)},
                     {"work_J", result.wall_rows.back()[k].work}});
  }
  return walls;
}

}  // namespace

void write_impact_curve(const std::filesystem::path& file, std::span<const ImpactRow> rows) {
  std::string text;
  auto out = std::back_inserter(text);
  for (const Field& field : fields)
    fmt::format_to(out, "{}{}", &field == fields.begin() ? "" : ",", field.first);
  text += '\n';
  for (const ImpactRow& row : rows) {
    for (const Field& field : fields)
      fmt::format_to(out, "{}{}", &field == fields.begin() ? "" : ",", row.*field.second);
    text += '\n';
  }
  atomic_write(file, text);
}

void write_wall_rows(const std::filesystem::path& file, const ImpactScene& scene,
                     const ImpactResult& result) {
  std::string text = "time_s";
  for (const std::string& name : scene.wall_names)
    for (const char* what :
         {"force_x_N", "force_y_N", "force_z_N", "torque_x_Nm", "torque_y_Nm", "torque_z_Nm", "work_J"})
      text += fmt::format(",{} {}", name, what);
  text += '\n';
  auto out = std::back_inserter(text);
  for (std::size_t row = 0; row < result.wall_rows.size(); ++row) {
    fmt::format_to(out, "{}", result.rows[row].time_s);
    for (const auto& [f, t, work] : result.wall_rows[row])
      fmt::format_to(out, ",{},{},{},{},{},{},{}", f.x, f.y, f.z, t.x, t.y, t.z, work);
    text += '\n';
  }
  atomic_write(file, text);
}

void write_final_spheres(const std::filesystem::path& file, const ImpactScene& scene,
                         const ImpactResult& result) {
  Specimen specimen;
  for (std::size_t k = 0; k < result.particles.size(); ++k)
    specimen.spheres.push_back(
        {result.particles[k].gid, result.particles[k].position, scene.particles[k].radius});
  write_specimen_csv(file, specimen);
}

std::vector<std::string> impact_warnings(const ImpactScene& scene, const ImpactResult& result) {
  std::vector<std::string> warnings;
  const bool rebounds = norm(scene.gravity) == 0.0;  // a heap rests on its contacts
  if (result.open_contacts > 0 && rebounds)
    warnings.push_back(
        fmt::format("{} contacts still press at the end: these are not rebound velocities; lengthen "
                    "time.duration if they should be",
                    result.open_contacts));
  return warnings;
}

void write_impact_summary(const std::filesystem::path& file, const ImpactScene& scene,
                          const ImpactResult& result,
                          const std::vector<std::pair<std::string, std::string>>& inputs) {
  Json particles = Json::array();
  for (const ImpactRecord& p : result.particles)
    particles.push_back({{"id", p.gid},
                         {"position_m", of(p.position)},
                         {"velocity_m_s", of(p.velocity)},
                         {"spin_rad_s", of(p.spin)},
                         {"largest_overlap_m", p.largest_overlap},
                         {"largest_force_N", p.largest_force},
                         {"contact_time_s", p.contact_time}});
  Json run{{"law", scene.law == ContactLaw::linear ? "linear" : "hertz-mindlin"},
           {"steps", result.steps},
           {"searches", result.searches},
           {"time_step_s", result.time_step},
           {"critical_time_step_s", result.critical_time_step},
           {"time_s", result.time},
           {"run_time_s", result.run_time},
           {"kinetic_before_J", result.kinetic_before},
           {"kinetic_after_J", result.kinetic_after},
           {"open_contacts", result.open_contacts},
           {"stopped_by", result.interrupted ? "interrupted" : "duration"},
           {"warnings", impact_warnings(scene, result)},
           {"walls", walls_of(scene, result)},
           {"particles", std::move(particles)}};
  Json files = Json::object();
  for (const auto& [name, digest] : inputs) files[name] = digest;
  const Json all{{"test", "impact"}, {"version", BRECCIA_VERSION}, {"threads", scene.threads},
                 {"ranks", 1},       {"inputs", std::move(files)}, {"runs", Json::array({std::move(run)})}};
  atomic_write(file, all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

std::string format_impact_table(const ImpactScene& scene, const ImpactResult& result) {
  constexpr std::size_t most = 20;
  std::string text = fmt::format("{:>8} {:>36} {:>36} {:>12} {:>12} {:>12}\n", "particle", "velocity, m/s",
                                 "spin, rad/s", "overlap, m", "force, N", "contact, s");
  const auto triple = [](const Vec3& v) { return fmt::format("{:.5g}, {:.5g}, {:.5g}", v.x, v.y, v.z); };
  for (std::size_t k = 0; k < std::min(most, result.particles.size()); ++k) {
    const ImpactRecord& p = result.particles[k];
    text += fmt::format("{:>8} {:>36} {:>36} {:>12.5g} {:>12.5g} {:>12.5g}\n", p.gid, triple(p.velocity),
                        triple(p.spin), p.largest_overlap, p.largest_force, p.contact_time);
  }
  if (result.particles.size() > most)
    text += fmt::format("{:>8} all {} are in summary.json\n", "...", result.particles.size());
  for (const std::string& warning : impact_warnings(scene, result)) text += "warning: " + warning + '\n';
  return text;
}

}  // namespace breccia
