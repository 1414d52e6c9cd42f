#include "io/results/curve_csv.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "io/files/atomic_write.hpp"

namespace breccia {
namespace {

using Field = std::pair<std::string_view, double CurveRow::*>;

constexpr std::array<Field, 13> fields{{
    {"time_s", &CurveRow::time_s},
    {"axial_strain", &CurveRow::axial_strain},
    {"platen_strain", &CurveRow::platen_strain},
    {"axial_stress_Pa", &CurveRow::axial_stress_Pa},
    {"radial_strain", &CurveRow::radial_strain},
    {"volumetric_strain", &CurveRow::volumetric_strain},
    {"confining_stress_Pa", &CurveRow::confining_stress_Pa},
    {"broken_tension", &CurveRow::broken_tension},
    {"broken_shear", &CurveRow::broken_shear},
    {"kinetic_J", &CurveRow::kinetic_J},
    {"stored_J", &CurveRow::stored_J},
    {"dissipated_J", &CurveRow::dissipated_J},
    {"work_J", &CurveRow::work_J},
}};
static_assert(sizeof(CurveRow) == fields.size() * sizeof(double), "a field of CurveRow is not written");

}  // namespace

void write_curve(const std::filesystem::path& file, std::span<const CurveRow> rows) {
  std::string text;
  auto out = std::back_inserter(text);
  std::string_view comma;
  for (const Field& field : fields) {
    fmt::format_to(out, "{}{}", comma, field.first);
    comma = ",";
  }
  text += '\n';
  for (const CurveRow& row : rows) {
    comma = "";
    for (const Field& field : fields) {
      text += comma;
      comma = ",";
      const double value = row.*field.second;
      if (!std::isnan(value)) fmt::format_to(out, "{}", value);
    }
    text += '\n';
  }
  atomic_write(file, text);
}

}  // namespace breccia
