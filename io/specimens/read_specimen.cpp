#include "io/specimens/read_specimen.hpp"

#include <algorithm>
#include <cctype>

#include "core/base/error.hpp"
#include "io/specimens/read_csv.hpp"
#include "io/specimens/read_mdpa.hpp"
#include "io/text/suggest.hpp"
#include "io/text/text_file.hpp"

namespace breccia {
namespace {

std::string ending(const std::filesystem::path& file) {
  std::string text = file.extension().string();
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

void check_radii(const std::vector<SpecimenSphere>& spheres, const std::string& name) {
  for (const SpecimenSphere& s : spheres)
    if (!(s.radius > 0))
      fail<BadInput>("{}:{}: sphere {} has radius {}; it must be above 0", name, s.line, s.id, s.radius);
}

void check_ids(const std::vector<SpecimenSphere>& spheres, const std::string& name) {
  const auto by_id = [](const SpecimenSphere* a, const SpecimenSphere* b) { return a->id < b->id; };
  std::vector<const SpecimenSphere*> sorted;
  sorted.reserve(spheres.size());
  for (const SpecimenSphere& sphere : spheres) sorted.push_back(&sphere);
  if (!std::is_sorted(sorted.begin(), sorted.end(), by_id))
    std::stable_sort(sorted.begin(), sorted.end(), by_id);
  const auto twice =
      std::adjacent_find(sorted.begin(), sorted.end(), [](auto* a, auto* b) { return a->id == b->id; });
  if (twice != sorted.end())
    fail<BadInput>("{}:{}: id {} is also in line {}; ids must differ", name, twice[1]->line, twice[1]->id,
                   twice[0]->line);
}

}  // namespace

void check_specimen_type(const std::filesystem::path& file) {
  const std::string type = ending(file);
  if (type == ".csv" || type == ".mdpa") return;
  for (const char* later : {".msh", ".h5", ".data", ".lmp", ".lammps", ".lammpstrj", ".dump"})
    if (type == later)
      fail<BadInput>("specimen type \"{}\" is not in this version; valid: \".csv\", \".mdpa\"", type);
  fail<BadInput>("unknown specimen type {} of {}; valid: \".csv\", \".mdpa\"", quote(type),
                 quote(file.filename().string()));
}

Specimen read_specimen(const std::filesystem::path& file) {
  const std::string name = file.string();
  try {
    check_specimen_type(file);
  } catch (const BadInput& error) {
    fail<BadInput>("{}: {}", name, error.what());
  }
  const std::string text = read_text(file);
  Specimen specimen;
  specimen.source = name;
  specimen.spheres = ending(file) == ".csv" ? spheres_from_csv(name, text) : spheres_from_mdpa(name, text);
  if (specimen.spheres.empty()) fail<BadInput>("{}: no sphere in the file", name);
  check_radii(specimen.spheres, name);
  check_ids(specimen.spheres, name);
  return specimen;
}

}  // namespace breccia
